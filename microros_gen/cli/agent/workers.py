# SPDX-License-Identifier: Apache-2.0
"""The agent with several worker processes: `--workers`."""

from __future__ import annotations

import gc
import pickle
import sys
import time
from collections.abc import Callable, Sequence

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.readiness import notify, watchdog
from microros_gen.agent.server import Server, reloaded_by_signal, stopped_by_signals
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.workers.front import Front
from microros_gen.agent.workers.front_transport import FrontTransport
from microros_gen.agent.workers.worker_process import WorkerProcess
from microros_gen.cli.agent.assembly import report_limits
from microros_gen.cli.agent.clients import client_state_node
from microros_gen.cli.agent.files import AgentFiles
from microros_gen.cli.agent.graph import graph_server
from microros_gen.cli.agent.monitoring import monitoring
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.parameters import ParametersOnDemand
from microros_gen.cli.agent.transports import Shared, close_all, connections, open_transports
from microros_gen.cli.agent.worker import WorkerStart
from microros_gen.diagnostics import Diagnostics, UserError

START_S = 60.0
"""Seconds in which all workers must serve after the start."""


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
            diagnostics.error(message, span, f"Leave --workers out, or {named}", id="MG-9840")
    diagnostics.check()


def serve_with_workers(options: AgentOptions, log: EventLog, announce: Callable[[Transport], None]) -> None:
    """Serve until a signal comes; call `announce` for each transport. UserError: it cannot start."""
    limits = options.limits
    streams = connections(options.transports)
    pool, budgets = InputPool(limits.input_bytes, limits.clients + streams), Budgets(limits, streams)
    shared = Shared(pool, budgets.output, Fairness(), Account())
    transports = open_transports(options.transports, options.discovery, log, shared)
    served = transports if options.discovery is None else transports[:-1]
    front = Front(_workers(options, served, log), served, log, limits.clients, limits.stop_s)
    parameters = ParametersOnDemand(options.parameter_server, options.parameter_file, options.domain, log)
    front.on_type = parameters.on_type
    server = Server(front, transports, log, watchdog())
    gc.collect()
    gc.freeze()
    try:
        with stopped_by_signals(server):
            front.start(START_S)
            report_limits(log, limits, streams)
            text = "{count} workers, each with these limits; client KEY has worker KEY mod {count} + 1"
            log.emit(Level.INFO, "workers", text, count=options.workers)
            with (
                graph_server(options.graph_server, options.domain, log),
                client_state_node(options, limits, front, log),
                monitoring(options, front, transports, log),
                parameters.running(),
                reloaded_by_signal(server, (front.reload if options.policy is not None else None,)),
            ):
                notify("READY=1")
                server.run(announce, time.monotonic)
    except UserError:
        front.close()
        close_all(transports)
        raise


def _workers(options: AgentOptions, transports: Sequence[Transport], log: EventLog) -> list[WorkerProcess]:
    described = tuple(_described(transport) for transport in transports)
    descriptors = [each.descriptor for each in described if each.descriptor >= 0]
    command = [sys.executable, "-m", "microros_gen.cli.agent.worker"]
    return [
        WorkerProcess(
            number, command, descriptors, pickle.dumps(WorkerStart(options, number, described)), log
        )
        for number in range(1, options.workers + 1)
    ]


def _described(transport: Transport) -> FrontTransport:
    descriptor = transport.descriptor if isinstance(transport, Udp) else -1
    return FrontTransport(transport.label, transport.forgeable, descriptor)
