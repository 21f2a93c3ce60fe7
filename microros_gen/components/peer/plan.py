# SPDX-License-Identifier: Apache-2.0
"""The links of this board with others, the topics on them, and the storage of their messages."""

from __future__ import annotations

import hashlib
import json

from microros_gen.application.system_decl import Link
from microros_gen.application.system_file import UART, address_of
from microros_gen.client.plan.declared import type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.agentless.plan import is_alone
from microros_gen.components.peer.check import (
    MESSAGE_OVERHEAD,
    Key,
    OwnEnd,
    check_peers,
    matches,
    own_ends,
)
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

_NUMBER_BITS = 8
"""Low bits of a client key, which count the sessions; the others are the hash of the table."""


@dataclass(frozen=True)
class PeerTopic:
    """A topic of a link, at its position in the table."""

    domain_id: int
    name: str
    type: str


@dataclass(frozen=True, kw_only=True)
class PeerLinkPlan:
    """A link with `board`; `writers` and `readers`: index of a publisher or subscription, and of its topic."""

    index: int
    board: str
    remote: str
    remote_port: int
    local_port: int
    position: int
    key: int
    mtu: int
    topics: tuple[PeerTopic, ...]
    writers: tuple[tuple[int, int], ...]
    readers: tuple[tuple[int, int], ...]

    @property
    def tables(self) -> tuple[str, ...]:
        """The routes of the link as lines of C."""
        lines: list[str] = []
        for name, routes in (("writers", self.writers), ("readers", self.readers)):
            if routes:
                lines.append(f"static const xrce_peer_route_t peer_{name}_{self.index}[] = {{")
                lines += [f"  {{{end}, {topic}}}, /* {self.topics[topic].name} */" for end, topic in routes]
                lines += ["};", ""]
        return tuple(lines)

    @property
    def entry(self) -> tuple[str, ...]:
        """The entry of the table of links as lines of C."""
        writers = f"peer_writers_{self.index}" if self.writers else "NULL"
        readers = f"peer_readers_{self.index}" if self.readers else "NULL"
        return (
            f'  {{"{self.board}", "{self.remote}", {self.remote_port}, {self.local_port}, {writers}, {readers}, '
            f"{len(self.writers)}, {len(self.readers)},",
            f"   0x{self.key:08x}u, {self.mtu}, {self.position}}},",
        )


@dataclass(frozen=True, kw_only=True)
class PeerPlan:
    """`mtu`: the largest of all links, bytes; `slots` of `slot_size` bytes each hold reliable messages of a link."""

    links: tuple[PeerLinkPlan, ...]
    mtu: int
    slots: int
    slot_size: int
    alone: bool

    @property
    def count(self) -> int:
        """Return the number of links."""
        return len(self.links)

    @property
    def shown(self) -> str:
        """Return what a report says: the boards, and the topics on the link with each."""
        words = [f"{link.board} ({', '.join(topic.name for topic in link.topics)})" for link in self.links]
        return ", ".join(words) + ("; no agent is needed" if self.alone else "")


def plan(context: PlanContext, diagnostics: Diagnostics) -> PeerPlan:
    """Return the links; ends of a topic that do not agree are reported."""
    ends = own_ends(context)
    check_peers(context, ends, diagnostics)
    links = tuple(_link(index, link, ends, context) for index, link in enumerate(context.application.links))
    reliable = [
        context.types[type_name(own.end.type)].largest("publisher", own.index)
        for own in ends
        if own.publishes and own.end.reliability == "reliable"
    ]
    return PeerPlan(
        links=links,
        mtu=max((link.mtu for link in links), default=0),
        slots=max((link.history for link in context.application.links), default=1) if reliable else 1,
        slot_size=(max(reliable, default=0) + MESSAGE_OVERHEAD + 3) & ~3,
        alone=is_alone(context.application),
    )


def record(part: PeerPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "links": [
            [
                *(link.board, link.remote, link.remote_port, link.local_port, link.position, link.key),
                *(list(map(list, link.writers)), list(map(list, link.readers))),
            ]
            for link in part.links
        ],
        "storage": [part.mtu, part.slots, part.slot_size],
    }


def _link(index: int, link: Link, ends: tuple[OwnEnd, ...], context: PlanContext) -> PeerLinkPlan:
    shared = {own.key: own for own in ends if any(matches(own, link))}
    topics = tuple(PeerTopic(*key, shared[key].end.type) for key in sorted(shared))
    number: dict[Key, int] = {(topic.domain_id, topic.name): i for i, topic in enumerate(topics)}
    routes = [(own, number[own.key]) for own in ends if own.key in number and any(matches(own, link))]
    host, port = (address_of(link.other.name) or ("", 0)) if link.kind == "udp" else (link.own.name, 0)
    local = (address_of(link.own.name) or ("", 0))[1] if link.kind == "udp" else 0
    return PeerLinkPlan(
        index=index,
        board=link.board,
        remote="" if host == UART else host,
        remote_port=port,
        local_port=local,
        position=link.position,
        key=_key(topics, link, context),
        mtu=link.mtu,
        topics=topics,
        writers=tuple((own.index, topic) for own, topic in routes if own.publishes),
        readers=tuple((own.index, topic) for own, topic in routes if not own.publishes),
    )


def _key(topics: tuple[PeerTopic, ...], link: Link, context: PlanContext) -> int:
    """Return the key of the first session: the hash of what both images must have alike, then 0."""
    table = [
        [t.domain_id, t.name, t.type, context.types[type_name(t.type)].type_hash, link.mtu] for t in topics
    ]
    digest = hashlib.sha256(json.dumps(table).encode()).digest()
    return (int.from_bytes(digest[:3], "big") or 1) << _NUMBER_BITS
