# SPDX-License-Identifier: Apache-2.0
"""The rings in the memory that two images of one chip share.

Both images have the same topics with `local: chip`, each of them one end, and so the same layout. Where the rings are
and what they hold is in a hash that both compare when they run.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

from microros_gen.application.model import EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.local_delivery.check import MOST_SLOTS
from microros_gen.records import dataclass

IMAGE_WORDS = 2
"""Words of each of the two images at the start of the memory (rmw_shared.c)."""

END_WORDS = 6
"""Words of the two ends of a ring (rmw_shared.c)."""


@dataclass(frozen=True)
class SharedRing:
    """The ring of a topic: where its two ends and its slots begin and how long a slot is, words of 4 bytes.

    `type_hash` is that of its messages; `endpoint`: the index among all endpoints.
    """

    domain: int
    topic: str
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
    """Return the rings in the order of domains and topics, which both images have: first all ends, then the slots."""
    found = []
    ends = sorted(_ends(context), key=lambda end: end[:2])
    at = 2 * IMAGE_WORDS + END_WORDS * len(ends)
    for place, (domain, topic, endpoint, index, largest) in enumerate(ends):
        type_hash = context.types[type_name(endpoint.type)].type_hash
        first, slots, words = 2 * IMAGE_WORDS + END_WORDS * place, slots_of(endpoint), 1 + (largest + 3) // 4
        sends = endpoint.kind == "publisher"
        found.append(SharedRing(domain, topic, type_hash, first, at, words, index, slots, sends))
        at += slots * words
    return tuple(found)


def key_of(rings: tuple[SharedRing, ...]) -> int:
    """Return a number, never 0, that differs where the two images do not agree."""
    text = "\n".join(f"{r.domain} {r.topic} {r.type_hash} {r.words} {r.slots}" for r in rings)
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") or 1


def slots_of(endpoint: EndpointDecl) -> int:
    """Return how many messages the ring of an end has room for: the depth of its QoS."""
    return min(max(endpoint.qos.depth, 1), MOST_SLOTS)


def _ends(context: PlanContext) -> Iterator[tuple[int, str, EndpointDecl, int, int]]:
    """Yield domain, topic, end, index among the endpoints, and the bytes of the largest message."""
    places = {"publisher": 0, "subscription": context.runtime.entities.publisher_places}
    for kind, first in places.items():
        for index, (_, node, endpoint) in enumerate(declarations(context.application, kind)):
            if endpoint.local == "chip":
                largest = context.types[type_name(endpoint.type)].largest(kind, index)
                yield node.domain_id, full_name(node, endpoint), endpoint, first + index, largest
