# SPDX-License-Identifier: Apache-2.0
"""From options to a running agent: files first, then transports, then ROS 2."""

from __future__ import annotations

import gc
import resource
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import click

from microros_gen.agent.budgets import Budgets, most_bytes, most_descriptors
from microros_gen.agent.configuration.entities_file import parse_preconfigured
from microros_gen.agent.configuration.model import (
    CanChoice,
    PtyChoice,
    SerialChoice,
    SocketChoice,
    TransportChoice,
)
from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.memory import MemoryGuard
from microros_gen.agent.own_time import Waited
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.readiness import notify, watchdog
from microros_gen.agent.recording.recorder import RecordedTransport, Recorder
from microros_gen.agent.representation import References
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.agent.ros.rclpy_bridge import open_bridge
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.agent.server import Server, reloaded_by_signal, stopped_by_signals
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.sockets import PROTOCOLS
from microros_gen.cli.agent.clients import client_state_node
from microros_gen.cli.agent.graph import graph_server
from microros_gen.cli.agent.monitoring import checked_places, monitoring
from microros_gen.cli.agent.options import AgentOptions, read_sources
from microros_gen.cli.agent.parameters import ParametersOnDemand
from microros_gen.cli.agent.policy import read_policy, reloading, report_policy
from microros_gen.cli.agent.seal import PskFile, read_psk_file
from microros_gen.cli.agent.types import ClientTypes, HashOf, TypeHashes, read_manifests
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.interfaces.type_hashes import type_hashes
from microros_gen.records import dataclass


def serve(options: AgentOptions) -> None:
    """Serve until a signal comes; a ready line for each transport goes to stdout. UserError: it cannot start."""
    _check_system()
    files = _files(options)
    checked_places(options)
    if options.check:
        click.echo("no faults")
        return
    as_json = options.log_format == "json"
    log = EventLog(sys.stderr, as_json, options.verbose, bytes_per_second=options.limits.log_bytes_per_second)
    for name in files.hashes.differences(files.clients):
        text = (
            "{type}: its definition on this machine is not the one that a client was generated with; ROS 2 nodes that"
            " use the one here will misread it"
        )
        log.emit(Level.WARNING, "type_hash_differs", text, type=name)
    limits = options.limits
    streams = connections(options.transports)
    check_memory(limits)
    pool, budgets = InputPool(limits.input_bytes, limits.clients + streams), Budgets(limits, streams)
    shared = Shared(pool, budgets.output, Fairness(waited=Waited()), Account())
    transports = open_transports(options.transports, options.discovery, log, shared)
    parameters = ParametersOnDemand(options.parameter_server, options.parameter_file, options.domain, log)
    try:
        report, wait_s = graph_reporter(log), limits.request_wait_s
        bridge = open_bridge(limits.domains, options.domain, files.hashes, report, wait_s, parameters.on_type)
        recorder = _recorder(options, log)
    except UserError:
        _close(transports)
        raise
    psk_file = PskFile(options, files.keys, log)
    transports = psk_file.sealed(transports, shared.strangers)
    if recorder is not None:
        transports = [RecordedTransport(transport, recorder) for transport in transports]
    manifests = Manifests(files.clients.by_client)
    agent = Agent(
        bridge,
        log,
        limits,
        files.references,
        files.preconfigured,
        manifests=manifests,
        pool=pool,
        fair=shared.fair,
        strangers=shared.strangers,
        memory=MemoryGuard(limits.memory_bytes, trim=bridge.trim),
        budgets=budgets,
        watched=options.watches_clients or options.is_monitored,
        policy=files.policy,
    )
    if options.policy is not None and files.policy is not None:
        report_policy(options.policy, files.policy, log)
    _report_memory(log, limits)
    _report_descriptors(log, limits, streams)
    if options.verbose > 0:
        transports = [TracedTransport(transport, log) for transport in transports]
    reported = ", ".join(f"{name} {value:.10g}" for name, value in asdict(limits).items())
    log.emit(Level.INFO, "limits", f"limits: {reported}", **asdict(limits))
    server = Server(agent, transports, log, watchdog())
    announcements = EventLog(sys.stdout, as_json)
    gc.collect()
    gc.freeze()  # modules and libraries stay: to look through them now and then would stop the agent for 20 ms
    try:
        with (
            graph_server(options.graph_server, options.domain, log),
            client_state_node(options, limits, agent, log),
            monitoring(options, agent, transports, log),
            parameters.running(),
            reloaded_by_signal(server, (reloading(options, agent, log), psk_file.reloading(agent))),
            stopped_by_signals(server),
        ):
            if recorder is not None:
                recorder.begin()  # after all that may fail: it replaces what the file holds
            notify("READY=1")
            server.run(lambda transport: _announce(announcements, transport), time.monotonic)
    except UserError:  # one of the servers cannot start
        agent.close()
        _close(transports)
        if recorder is not None:
            recorder.give_up()
        raise
    if recorder is not None:
        recorder.close()


def _recorder(options: AgentOptions, log: EventLog) -> Recorder | None:
    """Return the recorder that the options ask for; UserError if it cannot write."""
    if options.record is None:
        return None
    try:
        return Recorder(options.record, log)
    except UserError as error:
        span = options.places.get(options.record)
        raise UserError([replace(d, span=d.span or span) for d in error.diagnostics]) from error


def check_memory(limits: Limits) -> None:
    """Raise UserError when the pools do not fit the memory that the agent may take."""
    wanted = most_bytes(limits)
    if wanted > limits.memory_bytes:
        message = f"the limits allow {wanted} bytes in total, but memory_bytes is {limits.memory_bytes}"
        pools = "history_bytes, object_bytes, input_bytes, output_bytes or call_bytes"
        raise UserError(
            [Diagnostic(message, hint=f"Lower {pools}, or set memory_bytes: {wanted}", id="MG-9708")]
        )


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


@dataclass(frozen=True)
class Shared:
    """What the agent and its transports have in common.

    What all hold of messages that are not complete counts in `pool`, what waits to be sent in `output`; `fair` says
    whose turn it is; `strangers` pays for clients without a session.
    """

    pool: InputPool
    output: InputPool
    fair: Fairness
    strangers: Account


def open_transports(
    choices: Sequence[TransportChoice], discovery: int | None, log: EventLog, shared: Shared
) -> list[Transport]:
    """Return open transports, and discovery of them at port `discovery`; UserError names all that fail."""
    opened: list[Transport] = []
    diagnostics = Diagnostics()
    for choice in dict.fromkeys(choices):
        try:
            opened.append(_open(choice, log, shared))
        except UserError as error:
            diagnostics.extend(replace(d, span=d.span or choice.span) for d in error.diagnostics)
    try:
        diagnostics.check()
        if discovery is not None:
            opened.append(_discovery(opened, log, discovery))
    except UserError:
        _close(opened)
        raise
    return opened


def connections(choices: Sequence[TransportChoice]) -> int:
    """Return how many TCP connections transports may have together."""
    from microros_gen.agent.transport.tcp import TcpLimits

    streams = [c for c in choices if isinstance(c, SocketChoice) and PROTOCOLS[c.kind].stream]
    return sum(int(dict(c.limits).get("connections", TcpLimits.connections)) for c in streams)


def _open(choice: TransportChoice, log: EventLog, shared: Shared) -> Transport:
    from microros_gen.agent.transport.canfd import CanFd
    from microros_gen.agent.transport.serial import Pty, serial_line
    from microros_gen.agent.transport.tcp import Tcp, TcpLimits
    from microros_gen.agent.transport.udp import Udp

    if isinstance(choice, SerialChoice):
        return serial_line(choice.device, choice.baud, log)
    if isinstance(choice, CanChoice):
        return CanFd(choice.device, log)
    if isinstance(choice, PtyChoice):
        return Pty(log, Path(choice.link) if choice.link else None, choice.baud)
    protocol = PROTOCOLS[choice.kind]
    host = choice.bind or protocol.loopback
    if not protocol.stream:
        return Udp(protocol, host, choice.port, shared.fair, shared.strangers)
    limits: dict[str, Any] = dict(choice.limits)
    tcp_limits = replace(TcpLimits(), **limits)
    return Tcp(
        protocol,
        host,
        choice.port,
        log,
        tcp_limits,
        shared.pool,
        shared.output,
        shared.fair,
        shared.strangers,
    )


def _discovery(opened: Sequence[Transport], log: EventLog, port: int) -> Transport:
    from microros_gen.agent.transport.discovery import Discovery
    from microros_gen.agent.transport.tcp import Tcp
    from microros_gen.agent.transport.udp import Udp

    return Discovery([t for t in opened if isinstance(t, Udp | Tcp)], log, port)


def _check_system() -> None:
    """ROS 2's packages, and the system calls that the agent waits with, are Linux's."""
    if sys.platform != "linux":
        hint = (
            "Under Windows run it in WSL 2 (usbipd attach --wsl hands serial devices on), on macOS in a virtual"
            " machine; clients reach it over UDP, TCP or a serial line"
        )
        raise UserError([Diagnostic("the agent needs Linux", hint=hint, id="MG-9709")])


def _close(transports: Sequence[Transport]) -> None:
    for transport in transports:
        transport.close()


@dataclass(frozen=True)
class _Files:
    """What the files say."""

    references: References
    preconfigured: Preconfigured
    clients: ClientTypes
    hashes: TypeHashes
    policy: Policy | None
    keys: Mapping[int, bytes] | None


def _files(options: AgentOptions) -> _Files:
    """Return what the files say; UserError with the faults of all of them."""
    diagnostics = Diagnostics()
    references, preconfigured = References(), Preconfigured()
    places = options.places
    profiles = read_sources(options.references, diagnostics, places)
    entities = read_sources(options.entities, diagnostics, places)
    policy, keys = read_policy(options, diagnostics), read_psk_file(options, diagnostics)
    clients = read_manifests(options.manifests, diagnostics)
    of_files: HashOf = _no_hash
    try:
        of_files = type_hashes(options.interface_paths)
    except UserError as error:
        missing = next((path for path in options.interface_paths if not path.exists()), Path())
        span = places.get(missing)
        diagnostics.extend(replace(d, span=d.span or span) for d in error.diagnostics)
    try:
        references = read_references(profiles)
    except UserError as error:
        diagnostics.extend(error.diagnostics)
    try:
        preconfigured = Preconfigured(parse_preconfigured(entities, diagnostics))
    except UserError as error:
        diagnostics.extend(error.diagnostics)
    diagnostics.check()
    for diagnostic in diagnostics:  # warnings
        echo_found(f"{diagnostic.render()}\n")
    return _Files(references, preconfigured, clients, TypeHashes(of_files, clients.common), policy, keys)


def _no_hash(_type_name: str) -> None:
    """Know no type."""


def _announce(announcements: EventLog, transport: Transport) -> None:
    kind, _, address = transport.label.partition(" ")
    text = "agent ready: {transport} {address}"
    announcements.emit(Level.INFO, "ready", text, transport=kind, address=address)
