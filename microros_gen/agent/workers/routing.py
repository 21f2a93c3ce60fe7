# SPDX-License-Identifier: Apache-2.0
"""Which worker a message is for: that of its client's key, the key modulo the number of workers.

A key has the same worker wherever and whenever its client comes, so that all that an agent does for a key (another
address, a second session, kept samples, quotas) happens in one process, and a worker that starts again gets the same
clients. Most messages in a session name no key; they go where the session at their address is, or where a worker has
admitted a client that just came from there. A CREATE_CLIENT alone does not change that: anyone can send one with the
address of a client, and its worker may refuse it.
"""

from __future__ import annotations

import zlib
from typing import TypeVar

from microros_gen.agent.seal.layout import worker_of
from microros_gen.agent.wire.constants import SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY, SubmessageId
from microros_gen.agent.workers.adoption import worker_of_key

NEWCOMERS = 4_096
"""For each worker: addresses from which it has admitted a client that has no session yet (`Limits.newcomers`).

Of all that requested for a session, as many for each worker again. Further ones replace the oldest."""
_CREATE_CLIENT = int(SubmessageId.CREATE_CLIENT)
_KEY = 12
"""Offset of the key in a CREATE_CLIENT: after the header of the submessage, cookie, version and vendor."""
Place = tuple[int, bytes]
"""Number of a transport, and the code of an address there."""
Entry = TypeVar("Entry")


class Router:
    """The workers of keys and addresses, by number from 0."""

    def __init__(self, workers: int, is_sealed: bool = False) -> None:
        """`is_sealed`: all messages that are accepted are sealed, and show their worker (`seal.layout`)."""
        self._workers = workers
        self._is_sealed = is_sealed
        self._claimed: dict[Place, int] = {}
        self._newcomers: dict[Place, tuple[int, int]] = {}
        """Those that their worker has admitted: worker and session id."""
        self._requested: dict[Place, int] = {}
        """Where the last CREATE_CLIENT of each address was sent, for clients that do not wait for its answer."""

    def of_key(self, key: bytes) -> int:
        """Return the worker of a client key (4 bytes, big endian)."""
        return worker_of_key(key, self._workers)

    def worker_for(self, data: bytes, place: Place, only: int | None = None) -> int:
        """Return the worker of a message from `place`, whatever its bytes are; `only`: that of unknown senders."""
        if self._is_sealed:
            sealed = worker_of(data, self._workers)
            return zlib.crc32(place[1]) % self._workers if sealed is None else sealed
        session = data[0] if data else SESSION_NONE_WITHOUT_KEY
        start = 4 if session >= SESSION_NONE_WITHOUT_KEY else 8
        outside = session in (SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY)
        if outside and len(data) > start + _KEY + 4 and data[start] == _CREATE_CLIENT:
            worker = self.of_key(data[start + _KEY : start + _KEY + 4])
            self._put(self._requested, place, worker)
            return worker
        if start == 8 and len(data) >= 8:
            return self.of_key(data[4:8])
        newcomer = self._newcomers.get(place)
        if newcomer is not None and newcomer[1] == session:
            return newcomer[0]
        claimed = self._claimed.get(place)
        if claimed is not None:
            return claimed
        if newcomer is not None:
            return newcomer[0]
        known = self._requested.get(place, only)
        return zlib.crc32(place[1]) % self._workers if known is None else known

    def admit(self, place: Place, worker: int, session: int) -> None:
        """Register that a worker has admitted a client at `place`, which gets to know it next."""
        self._put(self._newcomers, place, (worker, session))

    def claim(self, place: Place, worker: int) -> int | None:
        """Register a session at `place`; return the worker that had one there, if it is another one."""
        self._newcomers.pop(place, None)
        self._requested.pop(place, None)
        before = self._claimed.get(place)
        self._claimed[place] = worker
        return before if before != worker else None

    def other_at(self, place: Place, worker: int) -> int | None:
        """Return the worker that has a session at `place`, if it is another one than `worker`."""
        found = self._claimed.get(place)
        return found if found != worker else None

    def release(self, place: Place, worker: int) -> None:
        """Register that a worker has no session at `place` any more."""
        if self._claimed.get(place) == worker:
            del self._claimed[place]

    def forget(self, worker: int) -> list[Place]:
        """Register that a worker has no session any more; return where it had one."""
        places = [place for place, owner in self._claimed.items() if owner == worker]
        for place in places:
            del self._claimed[place]
        for place in [place for place, (owner, _) in self._newcomers.items() if owner == worker]:
            del self._newcomers[place]
        return places

    def _put(self, table: dict[Place, Entry], place: Place, entry: Entry) -> None:
        """Note the entry of a place; it replaces the oldest one where there are too many."""
        table.pop(place, None)
        table[place] = entry
        if len(table) > NEWCOMERS * self._workers:
            del table[next(iter(table))]
