# SPDX-License-Identifier: Apache-2.0
"""Which messages of a link are larger than its MTU, and what the two boards need for their fragments."""

from __future__ import annotations

from microros_gen.application.system_decl import Link
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.line_load import message_sizes
from microros_gen.client.plan.streams import FRAGMENT_HEADER, WRITE_DATA_OVERHEAD
from microros_gen.components.peer.check import OwnEnd, matches
from microros_gen.records import dataclass


@dataclass(frozen=True)
class FragmentsPlan:
    """`largest`: bytes of the largest reliable message that this board may send on each link, at least its MTU.

    `joined`: of the largest one that arrives in fragments; 0: none does.
    """

    largest: tuple[int, ...] = ()
    joined: int = 0
    sends: bool = False

    @property
    def head(self) -> int:
        """Return the bytes in front of a stored message for the header of its fragments."""
        return FRAGMENT_HEADER if self.sends else 0


def plan_fragments(context: PlanContext, ends: tuple[OwnEnd, ...]) -> FragmentsPlan:
    """Return what is larger than the MTU of its link. Only reliable messages are; others were reported."""
    links = context.application.links
    reliable = [own for own in ends if own.end.reliability == "reliable"]
    largest = []
    for link in links:
        sent = [own.sent_size(context) for own in reliable if any(matches(own, link))]
        largest.append(max(sent, default=0))
    taken = [
        size
        for link in links
        for own in ends
        for end in matches(own, link)
        if end.reliability == "reliable" and (size := own.taken_size(end, link, context)) > link.mtu
    ]
    return FragmentsPlan(
        largest=tuple(max(size, link.mtu) for size, link in zip(largest, links, strict=True)),
        joined=max(taken, default=0),
        sends=any(size > link.mtu for size, link in zip(largest, links, strict=True)),
    )


def sent_messages(size: int, link: Link) -> tuple[int, ...]:
    """Return the sizes of the messages on a link that carry one of `size` bytes."""
    return message_sizes(size - WRITE_DATA_OVERHEAD, link.mtu)
