# SPDX-License-Identifier: Apache-2.0
"""A worker of an agent with several: the program that its front starts (`workers.py`)."""

from __future__ import annotations

import gc
import pickle
import signal
import socket
import sys
import time
from collections.abc import Callable, Hashable, Sequence
from functools import partial

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.log import EventLog
from microros_gen.agent.newcomers import Answer
from microros_gen.agent.own_time import Waited
from microros_gen.agent.recording.recorder import RecordedTransport, Recorder, SharedFile
from microros_gen.agent.ros.rclpy_bridge import open_bridge
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.agent.seal.layout import worker_of
from microros_gen.agent.server import Server
from microros_gen.agent.trace import TracedTransport
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.observed import ObservedTransport
from microros_gen.agent.wire.constants import SESSION_NONE_WITHOUT_KEY
from microros_gen.agent.workers.addresses import udp_code
from microros_gen.agent.workers.channel import Channel, Kind, message_frame
from microros_gen.agent.workers.front_transport import FrontTransport
from microros_gen.agent.workers.link import FrontLink
from microros_gen.agent.workers.remote import RemoteTransport, WorkerUdp
from microros_gen.agent.workers.worker_process import IGNORED
from microros_gen.cli.agent.assembly import make_agent
from microros_gen.cli.agent.files import AgentFiles, with_types
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.parameters import NOTICE
from microros_gen.cli.agent.seal import Seals
from microros_gen.cli.agent.transports import Shared
from microros_gen.diagnostics import UserError
from microros_gen.records import dataclass


@dataclass(frozen=True)
class WorkerStart:
    """What a worker gets on its standard input."""

    options: AgentOptions
    number: int
    files: AgentFiles
    """Without types; the policy is the one in force."""
    transports: tuple[FrontTransport, ...]
    recording: SharedFile | None = None
    """The file that all processes of the agent write, if any."""


FINISH_S = 2.0
"""Seconds in which the front takes the last messages."""


def main() -> None:
    """Serve until the front says stop, or ends."""
    for number in IGNORED:
        signal.signal(number, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, IGNORED)
    channel = Channel(socket.socket(fileno=int(sys.argv[1])))
    start: WorkerStart = pickle.load(sys.stdin.buffer)
    try:
        _serve(start, channel)
    except UserError as error:
        channel.send(Kind.FAILED, pickle.dumps(list(error.diagnostics)))
    channel.finish(FINISH_S)


def _serve(start: WorkerStart, channel: Channel) -> None:
    options, limits = start.options, start.options.limits
    log = EventLog(
        sys.stderr,
        options.log_format == "json",
        options.verbose,
        bytes_per_second=limits.log_bytes_per_second,
        worker=start.number,
    )
    files = with_types(start.files, options)
    budgets = Budgets(limits)
    pool = InputPool(limits.input_bytes, limits.clients)
    shared = Shared(pool, budgets.output, Fairness(waited=Waited()), Account())

    def on_type(name: str) -> None:
        if name == NOTICE:
            channel.send(Kind.TYPE, name.encode())

    files.preconfigured.adopt_only(frozenset())  # until the front says otherwise
    bridge = open_bridge(
        limits.domains, options.domain, files.hashes, graph_reporter(log), limits.request_wait_s, on_type
    )
    agent = make_agent(options, files, bridge, log, shared, budgets)
    own: list[WorkerUdp | RemoteTransport] = [
        WorkerUdp(number, front, channel, shared.strangers)
        if front.descriptor >= 0
        else RemoteTransport(number, front, channel, log)
        for number, front in enumerate(start.transports)
    ]
    place = start.number - 1
    outside = _outside(agent) if files.keys is None else _of_other(place, options.workers)
    for transport in own:
        if isinstance(transport, WorkerUdp):
            transport.outside = outside
    agent.welcome(_welcoming(channel, own))
    seals = Seals(files.keys, log)
    transports = seals.sealed(own, shared.strangers, range(place, 1 << 32, options.workers))
    if start.recording is not None:
        recorder = Recorder.of_shared(start.recording, start.number, log)
        transports = [RecordedTransport(transport, recorder) for transport in transports]
    if options.verbose > 0:
        transports = [TracedTransport(transport, log) for transport in transports]
    link = FrontLink(channel, start.number, agent, own, transports, log)
    server = Server(agent, [link, *transports], log)
    link.stop = server.stop
    link.on_keys = partial(seals.use, agent)
    link.on_adopt = files.preconfigured.adopt_only
    gc.collect()
    gc.freeze()
    channel.send(Kind.READY)
    server.run(lambda _: None, time.monotonic)
    link.report(states=False)


def _outside(agent: Agent) -> Callable[[bytes, Hashable], bool]:
    client_at = agent.clients.at

    def outside(data: bytes, address: Hashable) -> bool:
        client = client_at(address)
        if client is None or not data:
            return True
        link = client.session.link
        return data[0] != link.session or (data[0] < SESSION_NONE_WITHOUT_KEY and data[4:8] != link.key)

    return outside


def _of_other(place: int, workers: int) -> Callable[[bytes, Hashable], bool]:
    """Return what says whether a sealed message is for another worker than that at `place` (from 0)."""

    def outside(data: bytes, _address: Hashable) -> bool:
        return worker_of(data, workers) not in (None, place)

    return outside


def _welcoming(channel: Channel, own: Sequence[WorkerUdp | RemoteTransport]) -> Answer:
    """Return what lets the front answer newcomers over UDP, after another worker has removed its client there."""
    numbers = {
        id(transport): number for number, transport in enumerate(own) if isinstance(transport, WorkerUdp)
    }

    def welcome(data: bytes, address: Hashable, transport: Transport) -> None:
        number = numbers.get(id(address[0])) if isinstance(address, tuple) else None
        if number is None:
            transport.send(data, address)
            return
        if isinstance(transport, ObservedTransport):
            transport.show_sent(data, address)
        channel.send(Kind.NEWCOMER, message_frame(number, udp_code(address[1]), data))  # type: ignore[index]

    return welcome
