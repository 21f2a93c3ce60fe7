# SPDX-License-Identifier: Apache-2.0
"""The agent with several worker processes: `--workers`."""

from __future__ import annotations

import gc
import pickle
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.early_signals import EarlySignals
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.readiness import watchdog
from microros_gen.agent.server import Server
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.workers.channel import Kind
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
from microros_gen.cli.agent.policy import reloading, report_policy
from microros_gen.cli.agent.recording import end, open_recorder, run
from microros_gen.cli.agent.seal import PskFile
from microros_gen.cli.agent.transports import Shared, close_all, connections, open_transports
from microros_gen.cli.agent.worker import WorkerStart
from microros_gen.diagnostics import UserError


class _InForce:
    """Keeps the policy and the keys in force for workers that start again, and gives them to those that run."""

    def __init__(self, front: Front, starts: Sequence[WorkerStart]) -> None:
        self._front = front
        self._starts = starts

    def apply_policy(self, policy: Policy | None) -> None:
        """Replace the policy."""
        self._keep(lambda files: replace(files, policy=policy))
        self._front.tell(Kind.RELOAD, pickle.dumps(policy))

    def use_keys(self, keys: Mapping[int, bytes]) -> None:
        """Replace the pre-shared keys."""
        self._keep(lambda files: replace(files, keys=keys))
        self._front.tell(Kind.KEYS, pickle.dumps(keys))

    def _keep(self, changed: Callable[[AgentFiles], AgentFiles]) -> None:
        self._starts = [replace(start, files=changed(start.files)) for start in self._starts]
        for worker, start in zip(self._front.workers, self._starts, strict=True):
            worker.start_data = pickle.dumps(start)


def serve_with_workers(
    options: AgentOptions,
    files: AgentFiles,
    log: EventLog,
    announce: Callable[[Transport], None],
    signals: EarlySignals,
) -> None:
    """Serve until a signal comes; call `announce` for each transport. UserError: it cannot start."""
    limits = options.limits
    streams = connections(options.transports)
    pool, budgets = InputPool(limits.input_bytes, limits.clients + streams), Budgets(limits, streams)
    shared = Shared(pool, budgets.output, Fairness(), Account())
    transports = open_transports(options.transports, options.discovery, log, shared)
    served = transports if options.discovery is None else transports[:-1]
    try:
        recorder = open_recorder(options, log)
    except UserError:
        close_all(transports)
        raise
    psk_file = PskFile(options, files.keys, log)
    recording = recorder.shared([transport.label for transport in served]) if recorder is not None else None
    described = tuple(_described(transport) for transport in served)
    starts = [
        WorkerStart(options, number, without_types(files), described, recording)
        for number in range(1, options.workers + 1)
    ]
    front = Front(
        _workers(starts, log),
        served,
        log,
        limits,
        is_sealed=files.keys is not None,
        adopted=files.preconfigured.adopted,
    )
    in_force = _InForce(front, starts)
    parameters = ParametersOnDemand(options.parameter_server, options.parameter_file, options.domain, log)
    front.on_type = parameters.on_type
    server = Server(front, transports, log, watchdog())
    gc.collect()
    gc.freeze()
    try:
        with signals.stopping(server):
            front.start(START_S, lambda: server.stops)
            if server.stops:  # a signal came meanwhile: end in order, without having served
                server.run(announce, time.monotonic)
                end(recorder, has_begun=False)
                return
            _report(log, options, files, streams)
            with (
                graph_server(options.graph_server, options.domain, log),
                client_state_node(options, limits, front, log),
                monitoring(options, front, transports, log),
                parameters.running(),
                signals.reloading(
                    server,
                    (reloading(options, in_force, log), psk_file.reloading(in_force.use_keys)),
                ),
            ):
                has_begun = run(server, recorder, announce)
    except UserError:
        front.close()
        close_all(transports)
        end(recorder, has_begun=False)
        raise
    end(recorder, has_begun)


def _report(log: EventLog, options: AgentOptions, files: AgentFiles, streams: int) -> None:
    if options.policy is not None and files.policy is not None:
        report_policy(options.policy, files.policy, log)
    report_limits(log, options.limits, streams)
    text = (
        "{count} workers, each with these limits, together {clients} clients and {memory} MiB; client KEY has worker"
        " KEY mod {count} + 1"
    )
    count, limits = options.workers, options.limits
    memory = round(count * limits.memory_bytes / (1 << 20), 1)
    log.emit(Level.INFO, "workers", text, count=count, clients=count * limits.clients, memory=memory)


def _workers(starts: Sequence[WorkerStart], log: EventLog) -> list[WorkerProcess]:
    descriptors = [each.descriptor for each in starts[0].transports if each.descriptor >= 0]
    recording = starts[0].recording
    if recording is not None:
        descriptors += [recording.file, recording.memory]
    program = (
        f"import sys; sys.path[:] = {sys.path!r}; from microros_gen.cli.agent.worker import main; main()"
    )
    command = [sys.executable, "-c", program]  # -m would import from the current folder first
    return [WorkerProcess(start.number, command, descriptors, pickle.dumps(start), log) for start in starts]


def _described(transport: Transport) -> FrontTransport:
    descriptor = transport.descriptor if isinstance(transport, Udp) else -1
    return FrontTransport(transport.label, transport.forgeable, descriptor)
