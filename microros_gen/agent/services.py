# SPDX-License-Identifier: Apache-2.0
"""Correlation of the requests and replies of one client, of which many may be open at the same time.

A requester's requests have a number in ROS 2, and for the client the ids of its WRITE_DATA. A replier's requests have a
SampleIdentity, which the reply repeats. The number of open requests is bounded: a new one replaces the oldest.
"""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.agent.budgets import CALL_BYTES
from microros_gen.agent.entities import Entity
from microros_gen.agent.input_pool import Holder
from microros_gen.agent.log import EventLog
from microros_gen.agent.ros.bridge import Replier, Requester
from microros_gen.agent.wire.constants import FLAG_LITTLE, ObjectKind
from microros_gen.agent.wire.errors import MalformedError

IDENTITY = 24
"""Bytes of a SampleIdentity: GUID of 16 bytes, then its sequence number (i32 high, u32 low)."""
ENCAPSULATION = (b"\x00\x00\x00\x00", b"\x00\x01\x00\x00")
"""Encapsulation header of a body for DDS, by the byte order flag of its WRITE_DATA: XCDR1, big or little endian."""


class Calls:
    """Open requests of a client; at most `limit` per requester and replier, within the budget of `holder`."""

    def __init__(self, log: EventLog, limit: int, name: str, holder: Holder | None = None) -> None:
        self._log = log
        self._holder = holder or Holder()
        self._limit = limit
        self._name = name

    def write(self, entity: Entity, ids: bytes, payload: bytes, flags: int) -> int:
        """Process a WRITE_DATA to a requester or a replier; `ids`: its request and object id.

        Return how many requests or replies were sent to ROS 2, 0 or 1. Raises MalformedError if the identity is
        incomplete, BridgeError if ROS 2 refuses.
        """
        side = entity.source
        little = flags & FLAG_LITTLE
        if entity.kind == ObjectKind.REQUESTER:
            requester: Requester = side  # type: ignore[assignment]
            self._note(entity, requester.request(ENCAPSULATION[little] + payload), ids)
        else:
            replier: Replier = side  # type: ignore[assignment]
            if not self._reply(entity, replier, payload, little):
                return 0
        entity.written += 1
        return 1

    def add_request(self, replier: Entity, identity: bytes) -> None:
        """Record a request that was sent to the client."""
        self._note(replier, identity, b"")

    def report_unanswered(self, objects: Iterable[Entity]) -> None:
        """Report requests that get no reply since their client is silent.

        ROS 2 drops a reply through a service that did not receive the request itself, so the one that is created when
        the client returns cannot send it.
        """
        waiting = sum(len(entity.outstanding) for entity in objects if entity.kind == ObjectKind.REPLIER)
        if waiting:
            text = (
                "client {client} was silent for too long: {requests} requests that it received get no reply"
            )
            self._log.count("unanswered", text, client=self._name, requests=waiting)

    def answered(self, requester: Entity, number: int) -> bytes:
        """Return the ids of the request that a reply is for; empty if it is not open any more."""
        ids = requester.outstanding.pop(number, b"")
        if ids:
            self._count(requester)
        else:
            self._log.count(
                "late_reply",
                "client {client}: a reply from {label} answers a request that is not outstanding; it was dropped",
                client=self._name,
                label=requester.label,
            )
        return ids

    def _reply(self, entity: Entity, replier: Replier, payload: bytes, little: int) -> bool:
        if len(payload) < IDENTITY:
            raise MalformedError("truncated", f"a reply of {len(payload)} bytes has no SampleIdentity")
        identity = payload[:IDENTITY] if little else swapped(payload[:IDENTITY])
        if entity.outstanding.pop(identity, None) is None:
            self._log.count(
                "unknown_request",
                "client {client}: a reply through {label} answers a request that is not outstanding; it was dropped",
                client=self._name,
                label=entity.label,
            )
            return False
        self._count(entity)
        replier.reply(identity, ENCAPSULATION[little] + payload[IDENTITY:])
        return True

    def _note(self, entity: Entity, key: bytes | int, ids: bytes) -> None:
        entity.outstanding[key] = ids
        if len(entity.outstanding) > self._limit or not self._count(entity):
            del entity.outstanding[next(iter(entity.outstanding))]
            self._log.count(
                "request_forgotten",
                "client {client}: {label} has {count} requests without a reply, too many; the oldest is forgotten",
                client=self._name,
                label=entity.label,
                count=len(entity.outstanding) + 1,
            )
            self._count(entity)

    def _count(self, entity: Entity) -> bool:
        """Update the number of open requests of an object; return False if it exceeds the client's limit."""
        size = CALL_BYTES * len(entity.outstanding)
        more = size - entity.calls_bytes
        if more > 0 and not self._holder.take(more):
            return False
        if more < 0:
            self._holder.add(more)
        entity.calls_bytes = size
        return True


def swapped(identity: bytes) -> bytes:
    """Return a SampleIdentity in the other byte order; it affects the sequence number only."""
    return identity[:16] + identity[19:15:-1] + identity[23:19:-1]
