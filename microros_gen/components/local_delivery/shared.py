# SPDX-License-Identifier: Apache-2.0
"""The rings in the memory that the images of one chip share.

All images have the same layout: after the words of each image, for each pair of images the rings of the topics and
services of which each of them has an end, one pair after the other. A hash of all rings is compared when they run.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping

from microros_gen.application.kinds import KINDS
from microros_gen.application.model import ChipImage
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.components.local_delivery.chip_ends import ChipEnd, limits_of, other_ends, own_ends, pairs
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import WireSizes
from microros_gen.typesupport.plan.types import TypePlan

IMAGE_WORDS = 2
"""Words of each image at the start of the memory (rmw_shared_sign.h)."""

END_WORDS = 6
"""Words of the two ends of a ring (rmw_shared_ring.c)."""

CALL_WORDS = 3
"""Words of the identity of a request or reply in its slot (rmw_shared_call.c)."""

WORD = 4
"""Bytes."""


@dataclass(frozen=True)
class ChipRing:
    """A ring between two images: where its two ends and its slots begin and how long a slot is, words of 4 bytes.

    A service has two of them; `part`: `Request` or `Response`, nothing for a topic. `type_hash` is that of its
    messages; `writer`: the position of the image that writes.
    """

    pair: tuple[ChipEnd, ChipEnd]
    part: str
    type_hash: str
    writer: int
    ends: int
    at: int
    words: int

    @property
    def domain(self) -> int:
        """The domain of its endpoints."""
        return self.pair[0].key[0]

    @property
    def topic(self) -> str:
        """The name of the topic or service."""
        return self.pair[0].name

    @property
    def images(self) -> tuple[int, int]:
        """The positions of its images."""
        return (self.pair[0].position, self.pair[1].position)

    @property
    def slots(self) -> int:
        """The number of its messages."""
        return self.pair[0].slots

    @property
    def end(self) -> int:
        """Where its slots end."""
        return self.at + self.slots * self.words

    @property
    def hashed(self) -> str:
        """What its images have to agree about."""
        part = f" {self.part}" if self.part else ""
        return f"{self.domain} {self.topic}{part} {self.type_hash} {self.words} {self.slots}"


@dataclass(frozen=True)
class SharedRing:
    """A ring with an end in this image: `endpoint` is the index among all of its endpoints."""

    ring: ChipRing
    endpoint: int
    sends: bool

    @property
    def other(self) -> int:
        """The position of the other image."""
        return sum(self.ring.images) - self.ring.writer if self.sends else self.ring.writer

    @property
    def row(self) -> str:
        """The row of the table in C."""
        sends = "true" if self.sends else "false"
        ring = self.ring
        return f"{{{ring.ends}u, {ring.at}u, {ring.words}u, {self.endpoint}, {ring.slots}, {sends}}}"


def chip_rings(context: PlanContext) -> tuple[ChipRing, ...]:
    """Return the rings between the images of the chip by pairs, domains and names; a pair's ends precede its slots."""
    chip = context.application.chip
    if chip is None:
        return ()
    ends = (*own_ends(context), *other_ends(chip))
    found = [
        (_images(pair), pair[0].key, part, index, pair)
        for pair in pairs(ends)
        for index, (part, _, _) in enumerate(pair[0].parts)
    ]
    found.sort(key=lambda entry: entry[:4])
    at = IMAGE_WORDS * (len(chip.images) + 1)
    rings: list[ChipRing] = []
    for images in sorted({entry[0] for entry in found}):
        of_pair = [entry[2:] for entry in found if entry[0] == images]
        ends_at, at = at, at + END_WORDS * len(of_pair)
        for place, (part, index, pair) in enumerate(of_pair):
            type_hash, size = _message(pair, index, context)
            words = 1 + (CALL_WORDS if part else 0) + (size + WORD - 1) // WORD
            writer = next(end.position for end in pair if end.parts[index][2])
            ring = ChipRing(pair, part, type_hash, writer, ends_at + END_WORDS * place, at, words)
            rings.append(ring)
            at = ring.end
    return tuple(rings)


def own_rings(rings: tuple[ChipRing, ...], context: PlanContext) -> tuple[SharedRing, ...]:
    """Return the rings with an end in this image; those of an endpoint are neighbors."""
    chip = context.application.chip
    position = chip.position if chip else 0
    found = []
    for ring in rings:
        for end in ring.pair:
            if end.position == position:
                endpoint = _first(end.endpoint.kind, context.runtime) + end.index
                found.append(SharedRing(ring, endpoint, ring.writer == position))
    return tuple(sorted(found, key=lambda r: (r.ring.pair[0].key, r.other, r.ring.part)))


def key_of(rings: tuple[ChipRing, ...], images: int) -> int:
    """Return a number, never 0, that differs where the images do not agree."""
    lines = [ring.hashed for ring in rings]
    if images > 2:
        lines = [
            f"{r.images[0]} {r.images[1]} {r.writer} {line}" for r, line in zip(rings, lines, strict=True)
        ]
        lines.append(f"{images} images")
    text = "\n".join(lines)
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") or 1


def shown_pairs(rings: tuple[ChipRing, ...]) -> Iterator[str]:
    """Yield what a report says of each pair of images: their names, and the place and size of their rings."""
    first: dict[tuple[int, int], ChipRing] = {}
    last: dict[tuple[int, int], ChipRing] = {}
    for ring in rings:
        first.setdefault(ring.images, ring)
        last[ring.images] = ring
    for images, ring in first.items():
        names = "-".join(end.board for end in ring.pair)
        yield f"{names} {(last[images].end - ring.ends) * WORD} at {ring.ends * WORD}"


def _images(pair: tuple[ChipEnd, ChipEnd]) -> tuple[int, int]:
    return (pair[0].position, pair[1].position)


def _first(kind: str, runtime: RuntimePlan) -> int:
    """Return the index of the first endpoint of a kind among all endpoints."""
    places = (
        runtime.entities.publisher_places if known is KINDS[0] else runtime.entities.places(known.name).max
        for known in KINDS[: [known.name for known in KINDS].index(kind)]
    )
    return sum(places)


def _message(pair: tuple[ChipEnd, ChipEnd], index: int, context: PlanContext) -> tuple[str, int]:
    """Return the type hash of a message and its largest size, bytes: as this image has them, if it has an end."""
    chip = context.application.chip
    assert chip is not None
    for end in pair:
        if end.position == chip.position:
            return _own(end, index, context.types)
    end = pair[0]
    return _other(end, index, next(image for image in chip.images if image.position == end.position))


def _own(end: ChipEnd, index: int, types: Mapping[TypeName, TypePlan]) -> tuple[str, int]:
    known = types[end.parts[index][1]]
    return known.type_hash, known.largest(end.endpoint.kind, end.index)


def _other(end: ChipEnd, index: int, image: ChipImage) -> tuple[str, int]:
    _, type_, _ = end.parts[index]
    limits = limits_of(end, image, image.messages)[index]
    return image.hashes[str(type_)], WireSizes(image.messages).largest(type_, limits)
