# SPDX-License-Identifier: Apache-2.0
"""Clients that opened a session and sent nothing in it yet, and which client is replaced when no place is free.

Over UDP anyone can send a CREATE_CLIENT with a forged address, and DDS-XRCE has no handshake to prove an address. Such
a datagram therefore creates only a small record here, and no client: no streams, no objects, nothing in the ROS graph,
and no place that a client in session needs. The first message of the session from the same address makes it a client.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable

from microros_gen.agent.clients import Client
from microros_gen.agent.streams_out import Link
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.wire.constants import (
    COOKIE,
    SESSION_NONE_WITH_KEY,
    SESSION_NONE_WITHOUT_KEY,
    VERSION,
    Status,
)
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.records import dataclass

HARD_LIVELINESS = "uxr_hl"
"""Property with which a client requests its own time-out, in ms."""
Answer = Callable[[bytes, Hashable, Transport], None]
EMPTY_S = 1.0
"""Seconds of silence after which a client without objects may be replaced."""


@dataclass(frozen=True)
class Newcomer:
    """The contents of a CREATE_CLIENT, and its sender."""

    link: Link
    timeout_s: float
    address: Hashable
    transport: Transport


def answer(data: bytes, address: Hashable, transport: Transport) -> None:
    """Send a message to a newcomer; a worker process replaces this (see `Agent.welcome`)."""
    transport.send(data, address)


class Newcomers:
    """At most `limit` of them; a new one replaces the oldest."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._by_address: dict[Hashable, Newcomer] = {}

    def __len__(self) -> int:
        return len(self._by_address)

    def note(self, newcomer: Newcomer) -> None:
        """Remember a newcomer; it replaces the previous one of its address."""
        self.forget(newcomer.address)
        self._by_address[newcomer.address] = newcomer
        if len(self._by_address) > self._limit:
            del self._by_address[next(iter(self._by_address))]

    def forget(self, address: Hashable) -> None:
        """Remove the newcomer of an address, if any."""
        self._by_address.pop(address, None)

    def at(self, address: Hashable) -> Newcomer | None:
        """Return the newcomer of an address, or None."""
        return self._by_address.get(address)

    def knows(self, header: Header, address: Hashable) -> bool:
        """Return whether a message from `address` belongs to the session of a newcomer."""
        found = self._by_address.get(address)
        if found is None or header.session != found.link.session:
            return False
        return header.session >= SESSION_NONE_WITHOUT_KEY or header.key == found.link.key

    def proved(self, header: Header, address: Hashable) -> Newcomer | None:
        """Remove and return the newcomer to whose session a message from `address` belongs."""
        return self._by_address.pop(address) if self.knows(header, address) else None


def who_gives_way(clients: Iterable[Client], now: float, silent_s: float) -> Client | None:
    """Return the client to replace, or None if all are active.

    First a silent one without objects, then one that left the ROS graph, then one that was silent for `silent_s`
    seconds; among equals the one with the oldest last message.
    """
    found: tuple[int, float, Client] | None = None
    for client in clients:
        silent = now - client.last_received
        if not len(client.objects) and silent >= EMPTY_S:
            rank = 0
        elif client.asleep:
            rank = 1
        elif silent >= silent_s:
            rank = 2
        else:
            continue
        if found is None or (rank, client.last_received) < found[:2]:
            found = rank, client.last_received, client
    return found[2] if found else None


class Strangers:
    """Senders of samples without a session, with the time of their first sample: the newest `limit` ones."""

    def __init__(self, listen_s: float, limit: int, per_second: int) -> None:
        """Listen to each for `listen_s` seconds; all of them may send `per_second` messages in a second."""
        self._per_second = per_second
        self._answered = 0
        self._second = 0.0
        self._listen_s = listen_s
        self._limit = limit
        self._since: dict[tuple[Transport, Hashable], float] = {}

    def count(self, now: float) -> None:
        """Count a message outside of any session. Raises MalformedError if there are too many."""
        if now >= self._second:
            self._second, self._answered = now + 1.0, 0
        self._answered += 1
        if self._answered > self._per_second:
            raise MalformedError("too_many_strangers", f"more than {self._per_second} without a session")

    def forget(self, transport: Transport, address: Hashable) -> None:
        """Remove a sender, which has opened a session."""
        self._since.pop((transport, address), None)

    def listened_to(self, transport: Transport, address: Hashable, now: float) -> bool:
        """Return whether a sender was observed for long enough to be adopted."""
        since = self._since.setdefault((transport, address), now)
        if len(self._since) > self._limit:
            del self._since[next(iter(self._since))]
        enough = now - since >= self._listen_s
        if enough:
            self.forget(transport, address)
        return enough


def check(wanted: CreateClient, minimum_mtu: int) -> Status:
    """Return whether the values of a CREATE_CLIENT are valid."""
    nobody = (SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY)
    if wanted.cookie != COOKIE or wanted.key == bytes(4) or wanted.session in nobody:
        return Status.INVALID_DATA
    if wanted.version[0] != VERSION[0]:
        return Status.INCOMPATIBLE
    return Status.OK if wanted.mtu >= minimum_mtu else Status.INVALID_DATA


def timeout_of(wanted: CreateClient, usual_s: float) -> float:
    """Return the time-out in seconds that a client requests, or the default."""
    text = dict(wanted.properties or ()).get(HARD_LIVELINESS, "")
    if text.isascii() and text.isdigit() and len(text) < 9 and int(text) > 0:
        return int(text) / 1000
    return usual_s
