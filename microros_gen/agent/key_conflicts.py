# SPDX-License-Identifier: Apache-2.0
"""Detection of two clients with the same key: each takes over the other's session. It is reported once."""

from __future__ import annotations

from collections.abc import Hashable

from microros_gen.agent.clients import Client
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.base import Transport

MEMORY_S = 60.0
"""Seconds for which the previous address of a key is remembered."""
IN_FLIGHT_S = 1.0
"""Seconds in which a message from the previous address may still be under way."""
Place = tuple[Transport, Hashable]


class KeyConflicts:
    """The previous addresses of keys, at most `limit`."""

    def __init__(self, log: EventLog, limit: int) -> None:
        self._log = log
        self._limit = limit
        self._before: dict[Place, tuple[bytes, float]] = {}
        self._reported: set[bytes] = set()

    def moved(self, client: Client, transport: Transport, address: Hashable, now: float) -> None:
        """Record that the key of `client` is used from another address; moving back and forth reveals two clients."""
        key = client.session.link.key
        self._before.pop((client.transport, client.address), None)
        self._before[client.transport, client.address] = key, now
        if len(self._before) > self._limit:
            del self._before[next(iter(self._before))]
        was, when = self._before.pop((transport, address), (b"", 0.0))
        if was == key and now - when < MEMORY_S:
            self._report(key, client.place, transport.name_of(address))

    def observe(self, transport: Transport, address: Hashable, now: float) -> bytes | None:
        """Return the key that the sender at an address without a client used recently, or None."""
        key, when = self._before.get((transport, address), (b"", now))
        return key if key and IN_FLIGHT_S < now - when < MEMORY_S else None

    def fight(self, client: Client, transport: Transport, address: Hashable) -> None:
        """Report that `client` shares its key with a sender at another address."""
        self._report(client.session.link.key, client.place, transport.name_of(address))

    def _report(self, key: bytes, place: str, other: str) -> None:
        if key in self._reported or len(self._reported) >= self._limit:
            return
        self._reported.add(key)
        self._log.emit(
            Level.WARNING,
            "same_key_twice",
            "two clients use the key {client}: one at {peer}, one at {other}; each takes over the session of the other."
            " Give each its own, in its application file: `session: {{key: …}}`",
            client=key.hex().upper(),
            peer=place,
            other=other,
        )
