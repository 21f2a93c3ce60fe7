# SPDX-License-Identifier: Apache-2.0
"""The rings in the memory that two images of one chip share.

Both images have the same topics and services with `local: chip`, each of them one end, and so the same layout. Where
the rings are and what they hold is in a hash that both compare when they run.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

from microros_gen.application.kinds import KINDS, SERVICE_KINDS, EntityKind
from microros_gen.application.model import EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.local_delivery.check import MOST_SLOTS
from microros_gen.components.local_delivery.check_services import SERVICE_SLOTS
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

IMAGE_WORDS = 2
"""Words of each of the two images at the start of the memory (rmw_shared.c)."""

END_WORDS = 6
"""Words of the two ends of a ring (rmw_shared_ring.c)."""

CALL_WORDS = 3
"""Words of the identity of a request or reply in its slot (rmw_shared_call.c)."""


@dataclass(frozen=True)
class SharedRing:
    """The ring of a topic: where its two ends and its slots begin and how long a slot is, words of 4 bytes.

    A service has two of them; `part`: `Request` or `Response`, nothing for a topic. `type_hash` is that of its
    messages; `endpoint`: the index among all endpoints.
    """

    domain: int
    topic: str
    part: str
    type_hash: str
    ends: int
    at: int
    words: int
    endpoint: int
    slots: int
    sends: bool

    @property
    def row(self) -> str:
        """The row of the table in C."""
        sends = "true" if self.sends else "false"
        numbers = f"{self.ends}u, {self.at}u, {self.words}u, {self.endpoint}, {self.slots}"
        return f"{{{numbers}, {sends}}}"


def rings(context: PlanContext) -> tuple[SharedRing, ...]:
    """Return the rings in the order of domains and names, which both images have: first all ends, then the slots."""
    found = []
    ends = sorted(_ends(context), key=lambda end: (end.domain, end.name, end.part))
    at = 2 * IMAGE_WORDS + END_WORDS * len(ends)
    for place, end in enumerate(ends):
        known = context.types[end.type]
        words = 1 + (CALL_WORDS if end.part else 0)
        words += (known.largest(end.endpoint.kind, end.index) + 3) // 4
        found.append(
            SharedRing(
                *(end.domain, end.name, end.part, known.type_hash, 2 * IMAGE_WORDS + END_WORDS * place, at),
                *(words, end.first + end.index, slots_of(end.endpoint), end.sends),
            )
        )
        at += found[-1].slots * words
    return tuple(found)


def key_of(rings: tuple[SharedRing, ...]) -> int:
    """Return a number, never 0, that differs where the two images do not agree."""
    text = "\n".join(
        f"{r.domain} {r.topic}{r.part and ' '}{r.part} {r.type_hash} {r.words} {r.slots}" for r in rings
    )
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") or 1


def slots_of(endpoint: EndpointDecl) -> int:
    """Return how many messages the ring of an end has room for: its depth, or the queue of a service or client."""
    if endpoint.kind in SERVICE_KINDS:
        return endpoint.queue or SERVICE_SLOTS
    return min(max(endpoint.qos.depth, 1), MOST_SLOTS)


@dataclass(frozen=True)
class _End:
    """An end of a ring: the index of its endpoint in its kind, and that of the first one among all endpoints."""

    domain: int
    name: str
    part: str
    type: TypeName
    endpoint: EndpointDecl
    first: int
    index: int
    sends: bool


def _ends(context: PlanContext) -> Iterator[_End]:
    """Yield the ends in this image."""
    entities = context.runtime.entities
    first = 0
    for kind in KINDS:
        for index, (_, node, endpoint) in enumerate(declarations(context.application, kind.name)):
            if endpoint.local == "chip":
                for part, sends in kind.parts:
                    name = full_name(node, endpoint)
                    type_ = _message(kind, endpoint, part)
                    yield _End(node.domain_id, name, part, type_, endpoint, first, index, sends)
        first += entities.publisher_places if kind is KINDS[0] else entities.places(kind.name).max


def _message(kind: EntityKind, endpoint: EndpointDecl, part: str) -> TypeName:
    name = type_name(endpoint.type, kind.type_kind)
    return derived_name(name, part) if part else name
