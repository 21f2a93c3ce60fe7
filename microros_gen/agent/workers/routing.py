# SPDX-License-Identifier: Apache-2.0
"""Which worker a message is for: that of its client's key, the key modulo the number of workers.

A key has the same worker wherever and whenever its client comes, so that all that an agent does for a key (another
address, a second session, kept samples, quotas) happens in one process, and a worker that starts again gets the same
clients. Most messages in a session name no key; they go where the session at their address is, or where a client that
just came from there was sent.
"""

from __future__ import annotations

import zlib

from microros_gen.agent.wire.constants import SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY, SubmessageId

NEWCOMERS = 4_096
"""Addresses from which a client wants to open a session, and has none yet; further ones replace the oldest."""
_CREATE_CLIENT = int(SubmessageId.CREATE_CLIENT)
_KEY = 12
"""Offset of the key in a CREATE_CLIENT: after the header of the submessage, cookie, version and vendor."""
Place = tuple[int, bytes]
"""Number of a transport, and the code of an address there."""


class Router:
    """The workers of keys and addresses, by number from 0."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._claimed: dict[Place, int] = {}
        self._newcomers: dict[Place, tuple[int, int]] = {}
        """Worker and session id."""

    def of_key(self, key: bytes) -> int:
        """Return the worker of a client key (4 bytes, big endian)."""
        return int.from_bytes(key, "big") % self._workers

    def worker_for(self, data: bytes, place: Place) -> int:
        """Return the worker of a message from `place`, whatever its bytes are."""
        session = data[0] if data else SESSION_NONE_WITHOUT_KEY
        start = 4 if session >= SESSION_NONE_WITHOUT_KEY else 8
        outside = session in (SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY)
        if outside and len(data) > start + _KEY + 4 and data[start] == _CREATE_CLIENT:
            worker = self.of_key(data[start + _KEY : start + _KEY + 4])
            self._note(place, worker, data[start + _KEY + 4])
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
        return zlib.crc32(place[1]) % self._workers

    def claim(self, place: Place, worker: int) -> int | None:
        """Register a session at `place`; return the worker that had one there, if it is another one."""
        self._newcomers.pop(place, None)
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
        return places

    def _note(self, place: Place, worker: int, session: int) -> None:
        self._newcomers.pop(place, None)
        self._newcomers[place] = worker, session
        if len(self._newcomers) > NEWCOMERS:
            del self._newcomers[next(iter(self._newcomers))]
