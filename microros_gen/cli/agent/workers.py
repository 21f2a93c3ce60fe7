# SPDX-License-Identifier: Apache-2.0
"""The agent with several worker processes: `--workers`."""

from __future__ import annotations

import gc
import pickle
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.readiness import notify, watchdog
from microros_gen.agent.server import Server, reloaded_by_signal, stopped_by_signals
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.workers.front import Front
from microros_gen.agent.workers.front_transport import FrontTransport
from microros_gen.agent.workers.worker_process import START_S, WorkerProcess
from microros_gen.cli.agent.assembly import report_limits
from microros_gen.cli.agent.clients import client_state_node
from microros_gen.cli.agent.files import AgentFiles, without_types
from microros_gen.cli.agent.graph import graph_server
from microros_gen.cli.agent.monitoring import monitoring
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.parameters import ParametersOnDemand
from microros_gen.cli.agent.policy import reloading
from microros_gen.cli.agent.transports import Shared, close_all, connections, open_transports
from microros_gen.cli.agent.worker import WorkerStart
from microros_gen.diagnostics import Diagnostics, UserError


def check_workers(options: AgentOptions, files: AgentFiles) -> None:
    """Raise UserError for options that several workers do not have."""
    if options.workers == 1:
        return
    diagnostics = Diagnostics()
    adopts = "`adopt: true` in --entities" if files.preconfigured.adopts else ""
    for named, path in (
        ("--psk-file", options.psk_file),
        ("--record", options.record),
        (adopts, options.entities),
    ):
        if named and path:
            message = f"{named} needs an agent of one process, and --workers is {options.workers}"
            span = options.places.get(path) if not isinstance(path, tuple) else None
            diagnostics.error(message, span, f"Use --workers 1, or leave out {named}", id="MG-9840")
    diagnostics.check()


class _Policies:
    """Keeps the policy in force for workers that start again, and gives it to those that run."""

    def __init__(self, front: Front, starts: Sequence[WorkerStart]) -> None:
        self._front = front
        self._starts = starts

    def apply_policy(self, policy: Policy | None) -> None:
        """Replace the policy."""
        for worker, start in zip(self._front.workers, self._starts, strict=True):
            worker.start_data = pickle.dumps(replace(start, files=replace(start.files, policy=policy)))
        self._front.reload(pickle.dumps(policy))


def serve_with_workers(
    options: AgentOptions, files: AgentFiles, log: EventLog, announce: Callable[[Transport], None]
) -> None:
    """Serve until a signal comes; call `announce` for each transport. UserError: it cannot start."""
    limits = options.limits
    streams = connections(options.transports)
    pool, budgets = InputPool(limits.input_bytes, limits.clients + streams), Budgets(limits, streams)
    shared = Shared(pool, budgets.output, Fairness(), Account())
    transports = open_transports(options.transports, options.discovery, log, shared)
    served = transports if options.discovery is None else transports[:-1]
    described = tuple(_described(transport) for transport in served)
    starts = [
        WorkerStart(options, number, without_types(files), described)
        for number in range(1, options.workers + 1)
    ]
    front = Front(_workers(starts, log), served, log, limits)
    parameters = ParametersOnDemand(options.parameter_server, options.parameter_file, options.domain, log)
    front.on_type = parameters.on_type
    server = Server(front, transports, log, watchdog())
    gc.collect()
    gc.freeze()
    try:
        with stopped_by_signals(server):
            front.start(START_S, lambda: server.stops)
            if server.stops:  # a signal came meanwhile: end in order, without having served
                server.run(announce, time.monotonic)
                return
            report_limits(log, limits, streams)
            text = "{count} workers, each with these limits; client KEY has worker KEY mod {count} + 1"
            log.emit(Level.INFO, "workers", text, count=options.workers)
            with (
                graph_server(options.graph_server, options.domain, log),
                client_state_node(options, limits, front, log),
                monitoring(options, front, transports, log),
                parameters.running(),
                reloaded_by_signal(server, (reloading(options, _Policies(front, starts), log),)),
            ):
                notify("READY=1")
                server.run(announce, time.monotonic)
    except UserError:
        front.close()
        close_all(transports)
        raise


def _workers(starts: Sequence[WorkerStart], log: EventLog) -> list[WorkerProcess]:
    descriptors = [each.descriptor for each in starts[0].transports if each.descriptor >= 0]
    program = (
        f"import sys; sys.path[:] = {sys.path!r}; from microros_gen.cli.agent.worker import main; main()"
    )
    command = [sys.executable, "-c", program]  # -m would import from the current folder first
    return [WorkerProcess(start.number, command, descriptors, pickle.dumps(start), log) for start in starts]


def _described(transport: Transport) -> FrontTransport:
    descriptor = transport.descriptor if isinstance(transport, Udp) else -1
    return FrontTransport(transport.label, transport.forgeable, descriptor)
