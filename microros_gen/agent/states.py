# SPDX-License-Identifier: Apache-2.0
"""The agent's view of its clients: connected, silent or gone; lost messages; reconnections.

`ClientStates` records what happens to clients, at no cost per datagram, and measures their traffic once a second. It
keeps one record for each client in session, and those of the last clients that left, up to the maximum number of
clients.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass as mutable
from dataclasses import field
from enum import IntEnum

from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.output_queue import Queue
from microros_gen.agent.traffic import Counts, Direction, Meter, counts_of
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.records import dataclass


class Presence(IntEnum):
    """Presence of a client; the numbers are those of microros_agent_msgs/msg/ClientState."""

    CONNECTED = 0
    SILENT = 1
    GONE = 2
    REFUSED = 3


@dataclass(frozen=True)
class ClientState:
    """One client at one moment. Counts are those since the agent started, over all sessions with the same key."""

    key: str
    """Eight hexadecimal digits, as in the log."""
    presence: Presence
    """SILENT: silent for its time-out, so its entities have left the ROS graph."""
    transport: str
    address: str
    nodes: tuple[str, ...]
    """Fully qualified names; the last known ones of a client that is silent or gone."""
    silent_s: float
    """Seconds since its last message."""
    sessions: int
    """Sessions that it opened, or that were adopted. A board that restarts opens one."""
    reconnects: int
    """Sessions after the first one."""
    silences: int
    """Number of time-outs after silence."""
    round_trip_s: float | None
    """Last measured seconds from a reliable message to its acknowledgement; None: not measured."""
    lost: int
    """Number of messages from the client that were lost, arrived after later ones (best effort), or were abandoned."""
    resent: int
    """Number of reliable messages that were sent to it again."""
    last_error: str
    """The last warning about it; empty: none."""
    denied: int = 0
    """Number of its sessions and objects that were refused because they are not permitted."""
    received: Direction = Direction()
    """The messages from it, and their rates in the last second."""
    sent: Direction = Direction()
    repeated: int = 0
    """Number of messages from it on reliable streams that arrived again: it sent them again, or a network did."""
    queue: Queue = Queue()
    """What waits for it: for an acknowledgement, or to be sent."""
    input_bytes: int = 0
    """Bytes from it that wait: for the rest of a message, for a missing one, or for its turn."""
    worker: int | None = None
    """Number of the process that serves it, if the agent has several."""


@mutable
class _Record:
    """What is known of a key beyond its current session."""

    client: Client | None
    """None: it never had a session."""
    presence: Presence = Presence.CONNECTED
    sessions: int = 0
    silences: int = 0
    lost: int = 0
    resent: int = 0
    repeated: int = 0
    traffic: Counts = (0, 0, 0, 0)
    """That of the clients before `client`."""
    meter: Meter = field(default_factory=Meter)
    nodes: tuple[str, ...] = ()
    round_trip_s: float | None = None
    last_error: str = ""
    transport: str = ""
    """Where it was refused."""
    address: str = ""
    refused: int = 0
    denied: int = 0
    """Objects that were refused in earlier sessions."""
    refused_at: float = 0.0


LOOK_S = 0.25
"""Minimum seconds between two views for `ask`."""
MEASURE_S = 1.0
"""Seconds over which rates are measured."""
_SESSIONS = ("client_connected", "client_again", "client_adopted")
"""Events that begin a session."""


class ClientStates:
    """Records of clients by key."""

    def __init__(self, clients: ClientTable, clock: Callable[[], float], most: int) -> None:
        """Keep the records of at most `most` clients that are gone. `clock`: that of the agent, in seconds."""
        self._clients = clients
        self._clock = clock
        self._most = most
        self._records: dict[str, _Record] = {}
        self._look_at = clock()
        self._measure_at = clock()
        self._is_wanted = False
        self._latest: tuple[ClientState, ...] = ()

    def note(self, client: Client, event: str) -> None:
        """Record an event of the log about a client's session."""
        record = self._records.get(client.name)
        if record is None:
            record = self._records[client.name] = _Record(client)
        if event in _SESSIONS:
            self._begin(record, client)
        elif event == "client_silent":
            record.presence = Presence.SILENT
            record.silences += 1
        elif event == "client_back":
            record.presence = Presence.CONNECTED
        elif event == "client_gone" and record.client is client:
            record.presence = Presence.GONE
            self._forget_oldest()

    def refused(self, key: str, transport: Transport, address: Hashable, reason: str) -> None:
        """Record that the policy refused a session."""
        record = self._records.get(key)
        if record is None:
            record = self._records[key] = _Record(None)
        if record.presence not in (Presence.CONNECTED, Presence.SILENT) or record.client is None:
            record.presence = Presence.REFUSED
            record.transport, record.address = transport.label, transport.name_of(address)
            record.refused_at = self._clock()
            self._forget_oldest()
        record.refused += 1
        record.last_error = reason

    def fault(self, key: str, reason: str) -> None:
        """Record a warning about a client."""
        record = self._records.get(key)
        if record is not None:
            record.last_error = reason

    def ask(self) -> tuple[ClientState, ...]:
        """Return the view that a `look` took, and let the next one take another one; may be called in any thread."""
        self._is_wanted = True
        return self._latest

    def look(self, now: float) -> None:
        """Measure rates once a second; take the view if it is wanted: this takes a millisecond for 100 clients."""
        if now >= self._measure_at:
            self._measure_at = now + MEASURE_S
            for record in self._records.values():
                if record.client is not None:
                    record.meter.measure(_traffic(record, record.client), now)
        if self._is_wanted and now >= self._look_at:
            self._is_wanted = False
            self._look_at = now + LOOK_S
            self._latest = self.snapshot()

    def snapshot(self) -> tuple[ClientState, ...]:
        """Return the state of every client, in the order of their first sessions."""
        now = self._clock()
        return tuple(self._state(key, record, now) for key, record in self._records.items())

    def _begin(self, record: _Record, client: Client) -> None:
        if record.client is not client:
            if record.client is not None:
                record.lost += record.client.session.lost
                record.resent += record.client.session.resent
                record.denied += record.client.denials
                record.repeated += record.client.session.repeated
                record.traffic = _traffic(record, record.client)
            record.client = client
        record.sessions += 1
        record.presence = Presence.CONNECTED

    def _state(self, key: str, record: _Record, now: float) -> ClientState:
        client = record.client
        if client is None:
            return _never_connected(key, record, now)
        if record.presence is Presence.CONNECTED:
            record.nodes = _nodes(client) or record.nodes
        is_refused = record.presence is Presence.REFUSED
        messages_in, bytes_in, messages_out, bytes_out = _traffic(record, client)
        rates = record.meter.rates
        measured = client.session.round_trip_s
        record.round_trip_s = record.round_trip_s if measured is None else measured
        return ClientState(
            key=key,
            presence=record.presence,
            transport=record.transport if is_refused else client.transport.label,
            address=record.address if is_refused else client.place,
            nodes=record.nodes,
            silent_s=max(0.0, now - client.last_received),
            sessions=record.sessions,
            reconnects=max(0, record.sessions - 1),
            silences=record.silences,
            round_trip_s=record.round_trip_s,
            lost=record.lost + client.session.lost,
            resent=record.resent + client.session.resent,
            last_error=record.last_error,
            denied=record.refused + record.denied + client.denials,
            received=Direction(messages_in, bytes_in, rates[0], rates[1]),
            sent=Direction(messages_out, bytes_out, rates[2], rates[3]),
            repeated=record.repeated + client.session.repeated,
            queue=client.session.queue,
            input_bytes=client.session.held + client.inbox_bytes,
        )

    def _forget_oldest(self) -> None:
        closed: list[str] = []
        refused: list[str] = []  # apart: a flood of refused keys removes nothing of those that had sessions
        for key, record in self._records.items():
            if record.presence in (Presence.GONE, Presence.REFUSED):
                (refused if record.client is None else closed).append(key)
        for keys in (closed, refused):
            for key in keys[: max(0, len(keys) - self._most)]:
                del self._records[key]


def _never_connected(key: str, record: _Record, now: float) -> ClientState:
    return ClientState(
        key=key,
        presence=record.presence,
        transport=record.transport,
        address=record.address,
        nodes=(),
        silent_s=max(0.0, now - record.refused_at),
        sessions=0,
        reconnects=0,
        silences=0,
        round_trip_s=None,
        lost=0,
        resent=0,
        last_error=record.last_error,
        denied=record.refused,
    )


def _traffic(record: _Record, client: Client) -> Counts:
    """Return the counts of a key over all of its clients, of which `client` is the last."""
    before, now = record.traffic, counts_of(client)
    return before[0] + now[0], before[1] + now[1], before[2] + now[2], before[3] + now[3]


def _nodes(client: Client) -> tuple[str, ...]:
    return tuple(
        entity.label
        for entity in client.objects
        if entity.kind == ObjectKind.PARTICIPANT and entity.node is not None
    )
