# SPDX-License-Identifier: Apache-2.0
"""From options to a running agent: files first, then transports, then ROS 2."""

from __future__ import annotations

import gc
import sys
from functools import partial

import click

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.early_signals import EarlySignals
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.own_time import Waited
from microros_gen.agent.readiness import is_service, watchdog
from microros_gen.agent.recording.recorder import RecordedTransport
from microros_gen.agent.ros.rclpy_bridge import open_bridge
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.agent.server import Server
from microros_gen.agent.system_memory import system_bytes
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.cli.agent.assembly import check_memory, make_agent, memory_of_system, report_limits
from microros_gen.cli.agent.clients import client_state_node
from microros_gen.cli.agent.files import AgentFiles, read_files
from microros_gen.cli.agent.graph import graph_server
from microros_gen.cli.agent.monitoring import checked_places, monitoring
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.parameters import ParametersOnDemand
from microros_gen.cli.agent.policy import reloading, report_policy
from microros_gen.cli.agent.recording import end, open_recorder, run
from microros_gen.cli.agent.seal import PskFile, Seals
from microros_gen.cli.agent.transports import Shared, close_all, connections, open_transports
from microros_gen.cli.agent.workers import serve_with_workers
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostic, UserError


def serve(options: AgentOptions, signals: EarlySignals) -> None:
    """Serve until a signal comes; a ready line for each transport goes to stdout. UserError: it cannot start."""
    if options.policy is None and options.psk_file is None and not is_service():
        signals.nothing_to_reload()
    _check_system()
    files = read_files(options)
    tight = memory_of_system(options, system_bytes())
    for diagnostic in (*files.warnings, *([tight] if tight is not None else [])):
        echo_found(f"{diagnostic.render()}\n")
    checked_places(options)
    check_memory(options.limits)
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
    if options.workers > 1:
        announce = partial(_announce, EventLog(sys.stdout, as_json))
        serve_with_workers(options, files, log, announce, signals)
    else:
        _serve_alone(options, files, log, signals)


def _serve_alone(options: AgentOptions, files: AgentFiles, log: EventLog, signals: EarlySignals) -> None:
    limits = options.limits
    streams = connections(options.transports)
    pool, budgets = InputPool(limits.input_bytes, limits.clients + streams), Budgets(limits, streams)
    shared = Shared(pool, budgets.output, Fairness(waited=Waited()), Account())
    transports = open_transports(options.transports, options.discovery, log, shared)
    parameters = ParametersOnDemand(options.parameter_server, options.parameter_file, options.domain, log)
    try:
        report, wait_s = graph_reporter(log), limits.request_wait_s
        bridge = open_bridge(limits.domains, options.domain, files.hashes, report, wait_s, parameters.on_type)
        recorder = open_recorder(options, log)
    except UserError:
        close_all(transports)
        raise
    psk_file, seals = PskFile(options, files.keys, log), Seals(files.keys, log)
    transports = seals.sealed(transports, shared.strangers)
    if recorder is not None:
        transports = [RecordedTransport(transport, recorder) for transport in transports]
    agent = make_agent(options, files, bridge, log, shared, budgets)
    if options.policy is not None and files.policy is not None:
        report_policy(options.policy, files.policy, log)
    report_limits(log, limits, streams)
    if options.verbose > 0:
        transports = [TracedTransport(transport, log) for transport in transports]
    server = Server(agent, transports, log, watchdog())
    announcements = EventLog(sys.stdout, log.as_json)
    gc.collect()
    gc.freeze()  # modules and libraries stay: to look through them now and then would stop the agent for 20 ms
    try:
        with (
            graph_server(options.graph_server, options.domain, log),
            client_state_node(options, limits, agent, log),
            monitoring(options, agent, transports, log),
            parameters.running(),
            signals.reloading(
                server, (reloading(options, agent, log), psk_file.reloading(partial(seals.use, agent)))
            ),
            signals.stopping(server),
        ):
            has_begun = run(server, recorder, partial(_announce, announcements))
    except UserError:  # one of the servers cannot start
        agent.close()
        close_all(transports)
        end(recorder, has_begun=False)
        raise
    end(recorder, has_begun)


def _check_system() -> None:
    """ROS 2's packages, and the system calls that the agent waits with, are Linux's."""
    if sys.platform != "linux":
        hint = (
            "Under Windows run it in WSL 2 (usbipd attach --wsl hands serial devices on), on macOS in a virtual"
            " machine; clients reach it over UDP, TCP or a serial line"
        )
        raise UserError([Diagnostic("the agent needs Linux", hint=hint, id="MG-9709")])


def _announce(announcements: EventLog, transport: Transport) -> None:
    kind, _, address = transport.label.partition(" ")
    text = "agent ready: {transport} {address}"
    announcements.emit(Level.INFO, "ready", text, transport=kind, address=address)
