# SPDX-License-Identifier: Apache-2.0
"""The links of this board with others, the topics and services on them, and the storage of their messages."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable

from microros_gen.application.kinds import SERVICE_KINDS, TOPIC_KINDS
from microros_gen.application.system_decl import Link
from microros_gen.application.system_file import UART, address_of
from microros_gen.application.system_find import exchanged
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.serving import IDENTITY_SIZE
from microros_gen.components.agentless.plan import is_alone
from microros_gen.components.peer.bus_load import BusLoad, plan_bus_loads
from microros_gen.components.peer.check import (
    MESSAGE_OVERHEAD,
    Key,
    OwnEnd,
    check_peers,
    matches,
    own_ends,
)
from microros_gen.components.peer.check_services import check_services, requests_of
from microros_gen.components.peer.fragments import FragmentsPlan, plan_fragments
from microros_gen.components.peer.load import LinkLoad, plan_loads
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

_WRITER, _READER = TOPIC_KINDS
_REPLIER, _REQUESTER = SERVICE_KINDS
_NUMBER_BITS = 8
"""Low bits of a client key, which count the sessions; the others are the hash of the table."""


@dataclass(frozen=True)
class PeerTopic:
    """A topic or service of a link, at its position in the table."""

    domain_id: int
    name: str
    type: str


@dataclass(frozen=True, kw_only=True)
class PeerLinkPlan:
    """A link with `board`; `writers` and `readers`: index of a publisher or subscription, and of its topic.

    `repliers` and `requesters`: the same for services and clients, and how many requests a service may get at a time.
    `sent_id` and `received_id`: the identifiers of frames on CAN FD, else 0.
    """

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
    services: tuple[PeerTopic, ...] = ()
    repliers: tuple[tuple[int, int, int], ...] = ()
    requesters: tuple[tuple[int, int, int], ...] = ()
    sent_id: int = 0
    received_id: int = 0

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
    """`mtu`: the largest of all links, bytes; `slots` of `slot_size` bytes each hold reliable messages of a link.

    `loads`, `buses`: of the lines and CAN buses on which publishers have a rate. `in_fragments`: messages that are
    larger than an MTU. `finds`: the library looks for a network interface that is removed and returns.
    """

    links: tuple[PeerLinkPlan, ...]
    mtu: int
    slots: int
    slot_size: int
    alone: bool
    finds: bool = False
    loads: tuple[LinkLoad, ...] = ()
    buses: tuple[BusLoad, ...] = ()
    in_fragments: FragmentsPlan = FragmentsPlan()

    @property
    def count(self) -> int:
        """Return the number of links."""
        return len(self.links)

    @property
    def replier_count(self) -> int:
        """Return the number of services on all links."""
        return sum(len(link.repliers) for link in self.links)

    @property
    def requester_count(self) -> int:
        """Return the number of clients on all links."""
        return sum(len(link.requesters) for link in self.links)

    @property
    def serves(self) -> bool:
        """Return whether other boards call services of this one."""
        return self.replier_count > 0

    @property
    def calls(self) -> bool:
        """Return whether clients of this board call others."""
        return self.requester_count > 0

    @property
    def services(self) -> bool:
        """Return whether a link has services."""
        return self.serves or self.calls

    @property
    def head(self) -> int:
        """Return the bytes in front of a received message, for the identity of a request before its body."""
        return IDENTITY_SIZE - MESSAGE_OVERHEAD if self.serves else 0

    @property
    def service_tables(self) -> tuple[str, ...]:
        """The services and clients of all links as lines of C."""
        lines: list[str] = []
        for name in ("repliers", "requesters"):
            rows = [
                f"  {{{end}, {service}, {link.index}, {requests}}}, /* {link.services[service].name}: {link.board} */"
                for link in self.links
                for end, service, requests in getattr(link, name)
            ]
            if rows:
                size = f"MICROROS_PEER_{name.upper()}"
                lines += [f"const xrce_peer_service_t xrce_peer_{name}[{size}] = {{", *rows, "};"]
        return tuple(lines)

    @property
    def shown(self) -> str:
        """Return what a report says: the boards, and the topics and services on the link with each."""
        words = [
            f"{link.board} ({', '.join(each.name for each in (*link.topics, *link.services))})"
            for link in self.links
        ]
        return ", ".join(words) + ("; no agent is needed" if self.alone else "")

    @property
    def fragments(self) -> bool:
        """Return whether a message is sent in fragments."""
        return self.in_fragments.sends

    @property
    def joins(self) -> bool:
        """Return whether a message arrives in fragments."""
        return self.in_fragments.joined > 0

    @property
    def joined(self) -> int:
        """Return the bytes of the largest message that arrives in fragments."""
        return self.in_fragments.joined

    @property
    def largest_received(self) -> int:
        """Return the bytes of the largest message of another board, in one piece or joined of its fragments."""
        return max(self.mtu, self.joined)

    @property
    def largest_table(self) -> tuple[str, ...]:
        """The largest reliable message on each link as lines of C, where some are sent in fragments."""
        values = ", ".join(map(str, self.in_fragments.largest))
        return (
            ("", f"const uint32_t xrce_peer_largest[MICROROS_PEERS] = {{{values}}};")
            if self.fragments
            else ()
        )

    @property
    def frames_table(self) -> tuple[str, ...]:
        """The identifiers of frames on each link as lines of C, on CAN FD."""
        rows = [f"  {{0x{link.sent_id:08x}u, 0x{link.received_id:08x}u}}," for link in self.links]
        head = "const xrce_peer_frames_t xrce_peer_frames[MICROROS_PEERS] = {"
        return ("", head, *rows, "};") if any(link.sent_id for link in self.links) else ()

    @property
    def rated(self) -> bool:
        """Return whether a publisher on a link has a rate."""
        return bool(self.loads or self.buses)

    @property
    def loads_shown(self) -> str:
        """Return what a report says of the loads."""
        return "; ".join([*(load.shown for load in self.loads), *(bus.shown for bus in self.buses)])


def plan(context: PlanContext, diagnostics: Diagnostics) -> PeerPlan:
    """Return the links; ends of a topic that do not agree are reported."""
    ends = own_ends(context)
    check_peers(context, ends, diagnostics)
    check_services(ends, context, diagnostics)
    links = tuple(_link(index, link, ends, context) for index, link in enumerate(context.application.links))
    reliable = [own.sent_size(context) for own in ends if own.end.reliability == "reliable"]
    largest = max(reliable, default=0)
    fragments = plan_fragments(context, ends)
    return PeerPlan(
        links=links,
        mtu=max((link.mtu for link in links), default=0),
        slots=max((link.history for link in context.application.links), default=1) if largest else 1,
        slot_size=(max(largest, MESSAGE_OVERHEAD) + fragments.head + 3) & ~3,
        alone=is_alone(context.application),
        finds=context.target.hosted and any(link.kind != "serial" for link in context.application.links),
        loads=plan_loads(context, ends, diagnostics),
        buses=plan_bus_loads(context, ends, diagnostics),
        in_fragments=fragments,
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
        "services": [
            [list(map(list, link.repliers)), list(map(list, link.requesters))] for link in part.links
        ],
        "storage": [part.mtu, part.slots, part.slot_size],
        **(
            {"frames": [[link.sent_id, link.received_id] for link in part.links]} if part.frames_table else {}
        ),
        **({"fragments": [*part.in_fragments.largest, part.joined]} if part.fragments or part.joins else {}),
    }


def _link(index: int, link: Link, ends: tuple[OwnEnd, ...], context: PlanContext) -> PeerLinkPlan:
    shared = [own for own in ends if any(matches(own, link))]
    topics = _table(own for own in shared if not own.is_service)
    services = _table(own for own in shared if own.is_service)
    host, port = (address_of(link.other.name) or ("", 0)) if link.kind == "udp" else (link.own.name, 0)
    local = (address_of(link.own.name) or ("", 0))[1] if link.kind == "udp" else 0
    return PeerLinkPlan(
        index=index,
        board=link.board,
        remote="" if host == UART else host,
        remote_port=port,
        local_port=local,
        position=link.position,
        key=_key(topics, services, link, context),
        mtu=link.mtu,
        topics=topics,
        writers=_routes(shared, _WRITER, topics),
        readers=_routes(shared, _READER, topics),
        services=services,
        repliers=_calls(shared, _REPLIER, services, link),
        requesters=_calls(shared, _REQUESTER, services, link),
        sent_id=link.can.sent if link.can is not None else 0,
        received_id=link.can.received if link.can is not None else 0,
    )


def _table(ends: Iterable[OwnEnd]) -> tuple[PeerTopic, ...]:
    """Return the topics or services of ends in the order of both boards."""
    types: dict[Key, str] = {own.key: own.end.type for own in ends}
    return tuple(PeerTopic(*key, types[key]) for key in sorted(types))


def _routes(ends: list[OwnEnd], kind: str, table: tuple[PeerTopic, ...]) -> tuple[tuple[int, int], ...]:
    number: dict[Key, int] = {(topic.domain_id, topic.name): i for i, topic in enumerate(table)}
    return tuple((own.index, number[own.key]) for own in ends if own.end.kind == kind)


def _calls(
    ends: list[OwnEnd], kind: str, table: tuple[PeerTopic, ...], link: Link
) -> tuple[tuple[int, int, int], ...]:
    requests = [requests_of(own, link) for own in ends if own.end.kind == kind]
    return tuple((*route, most) for route, most in zip(_routes(ends, kind, table), requests, strict=True))


def _key(
    topics: tuple[PeerTopic, ...], services: tuple[PeerTopic, ...], link: Link, context: PlanContext
) -> int:
    """Return the key of the first session: the hash of what both images must have alike, then 0."""
    table = [
        [
            t.domain_id,
            t.name,
            t.type,
            *(context.types[part].type_hash for part in exchanged(_type(t))),
            link.mtu,
        ]
        for t in (*topics, *services)
    ]
    digest = hashlib.sha256(json.dumps(table).encode()).digest()
    return (int.from_bytes(digest[:3], "big") or 1) << _NUMBER_BITS


def _type(topic: PeerTopic) -> TypeName:
    return TypeName(*topic.type.split("/"))
