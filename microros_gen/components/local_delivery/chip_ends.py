# SPDX-License-Identifier: Apache-2.0
"""The ends of topics and services with `local: chip` in all images of a chip."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from microros_gen.application.kinds import KIND, NAMES, SERVICE_KINDS, other_end
from microros_gen.application.model import Application, Chip, ChipImage, EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.service_limits import part_rules
from microros_gen.components.local_delivery.check import MOST_SLOTS
from microros_gen.components.local_delivery.check_services import SERVICE_SLOTS
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Defaults, Root, plan_capacities
from microros_gen.typesupport.plan.size import TypeLimits

Key = tuple[int, str, bool]
"""Domain and name, and whether that is the name of a service."""


@dataclass(frozen=True)
class ChipEnd:
    """An endpoint of an image: the image's position on the chip and its name, and the index among those of its kind."""

    position: int
    board: str
    key: Key
    endpoint: EndpointDecl
    index: int

    @property
    def name(self) -> str:
        """Return the full name of the topic or service."""
        return self.key[1]

    @property
    def parts(self) -> tuple[tuple[str, TypeName, bool], ...]:
        """Return its messages, two of a service: the part (nothing of a topic), the type, and whether it sends them."""
        kind = KIND[self.endpoint.kind]
        name = type_name(self.endpoint.type, kind.type_kind)
        return tuple((part, derived_name(name, part) if part else name, sends) for part, sends in kind.parts)

    @property
    def slots(self) -> int:
        """Return how many messages a ring of it has room for: its depth, or the queue of a service or client."""
        if self.endpoint.kind in SERVICE_KINDS:
            return self.endpoint.queue or SERVICE_SLOTS
        return min(max(self.endpoint.qos.depth, 1), MOST_SLOTS)

    @property
    def shown(self) -> str:
        """Return what messages of another image call it."""
        span = self.endpoint.span
        place = f" ({span.source.name}:{span.line})" if span else ""
        return f"the {self.endpoint.kind} of the board '{self.board}'{place}"

    def matches(self, other: ChipEnd) -> bool:
        """Return whether `other` is the other end, in another image."""
        return (
            self.position != other.position
            and self.key == other.key
            and self.endpoint.kind == other_end(other.endpoint.kind)
        )


def own_ends(context: PlanContext) -> tuple[ChipEnd, ...]:
    """Return the ends in the image that is planned, by kind."""
    application = context.application
    board = application.system.board.name if application.system else ""
    return _ends(application, application.chip.position if application.chip else 0, board)


def other_ends(chip: Chip) -> tuple[ChipEnd, ...]:
    """Return the ends in the other images, in the order of these."""
    return tuple(
        end for image in chip.images for end in _ends(image.application, image.position, image.board)
    )


def pairs(ends: Iterable[ChipEnd]) -> Iterator[tuple[ChipEnd, ChipEnd]]:
    """Yield two ends that match, that of the image with the lower position first."""
    by_key: dict[Key, list[ChipEnd]] = {}
    for end in ends:
        by_key.setdefault(end.key, []).append(end)
    for found in by_key.values():
        for first in found:
            yield from (
                (first, last) for last in found if first.position < last.position and first.matches(last)
            )


def limits_of(
    end: ChipEnd, image: ChipImage, messages: Mapping[TypeName, Message]
) -> tuple[TypeLimits | None, ...]:
    """Return the limits of the messages of an end in another image; what is wrong with them its build reports.

    `messages` is closed.
    """
    kind, endpoint = KIND[end.endpoint.kind], end.endpoint
    name = type_name(endpoint.type, kind.type_kind)
    found = []
    for part, type_, _ in end.parts:
        own = part_rules(endpoint.limits, name, part, messages) if part else endpoint.limits
        root = Root(type_, own, endpoint.span)
        rules = image.application.limits
        found.append(
            plan_capacities(messages, [root], rules, Defaults(None, None), Diagnostics()).limits[type_]
        )
    return tuple(found)


def _ends(application: Application, position: int, board: str) -> tuple[ChipEnd, ...]:
    return tuple(
        ChipEnd(
            *(position, board, (node.domain_id, full_name(node, endpoint), KIND[kind].service_type)),
            *(endpoint, index),
        )
        for kind in NAMES
        for index, (_, node, endpoint) in enumerate(declarations(application, kind))
        if endpoint.local == "chip"
    )
