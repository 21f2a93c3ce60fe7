# SPDX-License-Identifier: Apache-2.0
"""The agent of one process, from options and files, and the limits that it reports."""

from __future__ import annotations

import resource
from dataclasses import asdict

from microros_gen.agent.budgets import Budgets, most_bytes, most_descriptors
from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.memory import MemoryGuard
from microros_gen.agent.ros.bridge import Bridge
from microros_gen.cli.agent.files import AgentFiles
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.transports import Shared
from microros_gen.diagnostics import Diagnostic, Severity, UserError

FRONT_BYTES = 64 << 20
"""Bytes of the first process of an agent with workers, which has no clients."""


def make_agent(
    options: AgentOptions, files: AgentFiles, bridge: Bridge, log: EventLog, shared: Shared, budgets: Budgets
) -> Agent:
    """Return an agent on `bridge` that shares its pools with the transports."""
    return Agent(
        bridge,
        log,
        options.limits,
        files.references,
        files.preconfigured,
        manifests=Manifests(files.clients.by_client),
        pool=shared.pool,
        fair=shared.fair,
        strangers=shared.strangers,
        memory=MemoryGuard(options.limits.memory_bytes, trim=bridge.trim),
        budgets=budgets,
        watched=options.watches_clients or options.is_monitored,
        policy=files.policy,
    )


def report_limits(log: EventLog, limits: Limits, connections: int) -> None:
    """Report all limits, the memory and the descriptors that they allow."""
    _report_memory(log, limits)
    _report_descriptors(log, limits, connections)
    reported = ", ".join(f"{name} {value:.10g}" for name, value in asdict(limits).items())
    log.emit(Level.INFO, "limits", f"limits: {reported}", **asdict(limits))


def check_memory(limits: Limits) -> None:
    """Raise UserError when the pools do not fit the memory that the agent may take."""
    wanted = most_bytes(limits)
    if wanted > limits.memory_bytes:
        message = f"the limits allow {wanted} bytes in total, but memory_bytes is {limits.memory_bytes}"
        pools = "history_bytes, object_bytes, input_bytes, output_bytes or call_bytes"
        raise UserError(
            [Diagnostic(message, hint=f"Lower {pools}, or set memory_bytes: {wanted}", id="MG-9708")]
        )


def memory_of_system(options: AgentOptions, available: int | None) -> Diagnostic | None:
    """Return a warning if all processes of the agent may take more than the `available` bytes (None: unknown)."""
    limits, workers = options.limits, options.workers
    front = FRONT_BYTES if workers > 1 else 0
    wanted = workers * limits.memory_bytes + front
    if available is None or wanted <= available:
        return None
    each = f"memory_bytes {limits.memory_bytes}"
    if front:
        each = f"{workers} workers with {each} each, and the first process"
    message = f"{each} may take {wanted} bytes, and the system has {available}"
    fitting = (available - front) // workers
    if fitting >= most_bytes(limits):
        hint = f"Set memory_bytes: {fitting}, or let the system give more (systemd: MemoryMax)"
    else:
        hint = (
            "Lower the pools (history_bytes, object_bytes, …) and memory_bytes, or let the system give more"
        )
    return Diagnostic(message, hint=hint, severity=Severity.WARNING, id="MG-9873")


def _report_memory(log: EventLog, limits: Limits) -> None:
    text = (
        "memory: at most {limit} MiB, of them for clients {history} of histories, {objects} of objects, {input} of"
        " input, {output} of output, {calls} of open requests (limits: memory_bytes, …)"
    )
    mib = {
        "limit": limits.memory_bytes,
        "history": limits.history_bytes,
        "objects": limits.object_bytes,
        "input": limits.input_bytes,
        "output": limits.output_bytes,
        "calls": limits.call_bytes,
    }
    log.emit(Level.INFO, "memory", text, **{name: round(size / (1 << 20), 1) for name, size in mib.items()})


def _report_descriptors(log: EventLog, limits: Limits, connections: int) -> None:
    most, allowed = most_descriptors(limits, connections), resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    text = "descriptors: at most {most} by the limits, and the system allows {allowed} (ulimit -n)"
    if 0 <= allowed < most:  # RLIM_INFINITY is negative
        text += ": when these are taken, further objects and connections are refused"
    log.emit(Level.INFO, "descriptors", text, most=most, allowed=allowed)
