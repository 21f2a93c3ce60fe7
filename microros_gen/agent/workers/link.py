# SPDX-License-Identifier: Apache-2.0
"""A worker's end of the channel to its front, as one of the descriptors that its main loop waits for."""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace

from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import TURN_S, Account
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Origin, Receive, Transport
from microros_gen.agent.workers.channel import Channel, Kind, message_of
from microros_gen.agent.workers.remote import RemoteTransport, WorkerUdp
from microros_gen.agent.workers.report import Report

Own = WorkerUdp | RemoteTransport
PART_BYTES = 4_096
"""Bytes that are read from the front before the time is looked at."""


class FrontLink:
    """Does what the front says. Nobody has a session here: messages are those of the worker's transports."""

    def __init__(
        self,
        channel: Channel,
        number: int,
        agent: Agent,
        own: Sequence[Own],
        transports: Sequence[Transport],
        log: EventLog,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`own`: the worker's transports, numbered as those of the front; `transports`: the same, traced if wanted."""
        self._channel = channel
        self._number = number
        self._agent = agent
        self._own = own
        self._transports = transports
        self._log = log
        self._clock = clock
        self.stop: Callable[[], object] = _nothing
        """Called when the worker is to end."""
        self.on_keys: Callable[[Mapping[int, bytes]], object] = _ignore
        """Called with the pre-shared keys that are in force."""
        self.on_adopt: Callable[[frozenset[bytes]], object] = _ignore
        """Called with the keys (at most one) of which a client without a key in its messages may be adopted."""
        self._missing: frozenset[bytes] | None = None
        """The missing clients that were reported last."""
        self.label = "front"
        self.ready = True
        self.forgeable = False
        self.fileno = channel.fileno

    def pump(self, receive: Receive) -> None:
        """Do what has arrived, until other work has its turn."""
        end = self._clock() + TURN_S
        while self._pump(receive) and self._clock() < end:
            continue
        if self._channel.closed:  # the front has ended
            self.stop()

    def _pump(self, receive: Receive) -> bool:
        """Do a small part of what has arrived; return whether there was something."""
        reached: dict[int, None] = {}
        frames = self._channel.receive(PART_BYTES)
        for kind, content in frames:
            if kind in (Kind.MESSAGE, Kind.DIRECT, Kind.LEFT):
                number, code, data = message_of(content)
                self._pass(kind, self._own[number], code, data)
                reached[number] = None
            elif kind is Kind.ASK:
                self.report(states=bool(content))
            elif kind is Kind.RELOAD:
                self._agent.apply_policy(pickle.loads(content))
            elif kind is Kind.KEYS:
                self.on_keys(pickle.loads(content))
            elif kind is Kind.ADOPT:
                self.on_adopt(frozenset({content} - {b""}))
            elif kind is Kind.STOP:
                self.stop()
        for number in reached:
            self._transports[number].pump(receive)
        return bool(frames)

    def report(self, states: bool) -> None:
        """Send a report, with the states of all clients if `states`."""
        agent, number = self._agent, self._number
        clients = tuple(replace(state, worker=number) for state in agent.client_states()) if states else None
        report = Report(agent.samples, agent.delivered, dict(self._log.counters), clients, len(agent.clients))
        self._channel.send(Kind.STATUS, report.encode())

    def _pass(self, kind: Kind, own: Own, code: bytes, data: bytes) -> None:
        if kind is Kind.MESSAGE:
            own.deliver(code, data)
        elif kind is Kind.LEFT:
            self._agent.release_to_other(own.address(code))
        elif isinstance(own, WorkerUdp):
            own.direct(code)

    def tick(self, now: float) -> None:
        """See Transport; report which clients to adopt are missing, if this has changed."""
        missing = self._agent.missing()
        if missing != self._missing:
            self._missing = missing
            self._channel.send(Kind.MISSING, b"".join(sorted(missing)))

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport."""

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""

    def flush(self) -> None:
        """See Transport."""
        self._channel.flush()

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return self.label

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport."""
        return b""

    def close(self) -> None:
        """See Transport: the channel stays open for the last report."""


def _nothing() -> None:
    """Do nothing; the default."""


def _ignore(_value: object) -> None:
    """Do nothing; the default."""
