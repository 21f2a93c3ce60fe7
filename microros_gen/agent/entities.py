# SPDX-License-Identifier: Apache-2.0
"""One object of a client and its ROS 2 entity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field

from microros_gen.agent.budgets import Shares
from microros_gen.agent.history import ReaderHistory, WriterHistory
from microros_gen.agent.policy.access import Access
from microros_gen.agent.representation import Description, Endpoint, Participant, Service, Topic
from microros_gen.agent.ros.bridge import (
    Bridge,
    BridgeError,
    HashOf,
    Node,
    Reader,
    Replier,
    Requester,
    Writer,
)
from microros_gen.agent.wire.constants import ObjectKind, Status
from microros_gen.agent.wire.entity_messages import Representation
from microros_gen.records import dataclass

Readable = Reader | Replier | Requester


@dataclass(frozen=True)
class Home:
    """The ROS 2 context of one client's objects.

    `fallback_name` is for participants without a name; `hash_of` returns the source of type hashes for the name of a
    node (see Manifests).
    """

    bridge: Bridge
    fallback_name: str
    hash_of: Callable[[str], HashOf | None] = lambda node: None
    shares: Shares = field(default_factory=Shares.unlimited)
    """The memory budget of the client."""
    access: Access = field(default_factory=Access)
    """What the client may use."""

    def node(self, participant: Participant) -> Node:
        """Create the node of a participant. Raises BridgeError if ROS 2 refuses it."""
        name = participant.name.strip("/") or self.fallback_name
        return self.bridge.create_node(name, participant.domain, self.hash_of(name))


@dataclass(eq=False)
class Entity:
    """One object; `sources` are those it was created from, container first. `node`, `writer`, `source`: in ROS 2."""

    id: int
    description: Description
    sources: tuple[Entity, ...]
    node: Node | None = None
    writer: Writer | None = None
    source: Readable | None = None
    """The entity that receives data from ROS 2: a reader, a replier or a requester."""
    representation: Representation | None = None
    """The client's description; None for a preconfigured object."""
    cost: int = 0
    """Bytes charged for it, without samples."""
    history: WriterHistory | ReaderHistory | None = None
    """Its history in Fast DDS."""
    written: int = 0
    """Number of samples, requests or replies that the client sent through it."""
    kept: list[bytes] = field(default_factory=list)
    """Samples that were taken from ROS 2 and are still to be sent to the client, the next one last."""
    delivered: int = 0
    """Number of samples, requests or replies sent to the client."""
    calls_bytes: int = 0
    """Bytes charged for open requests."""
    outstanding: dict[bytes | int, bytes] = field(default_factory=dict)
    """Open requests, the oldest first.

    By the number of a request of the client: its ids (request, object). Or identities that the client has to answer."""

    @property
    def kind(self) -> int:
        """Kind of object."""
        return self.id & 0x0F

    @property
    def participant(self) -> Entity:
        """The participant that contains it, or itself if it is one."""
        found = self
        while found.kind != ObjectKind.PARTICIPANT and found.sources:
            found = found.sources[0]
        return found

    def inside(self, container: Entity) -> bool:
        """Return whether it is a part of `container`, at any depth."""
        return bool(self.sources) and (self.sources[0] is container or self.sources[0].inside(container))

    def check(self, access: Access, fallback: str) -> None:
        """Check whether a client may have it; `fallback` names its node if it has no name.

        Raises RefusedError, or BridgeError for a name that is invalid in ROS 2.
        """
        topic = self.sources[1].description if len(self.sources) > 1 else None
        access.check(self.kind, self.description, topic, fallback)

    @property
    def label(self) -> str:
        """Name in the log; empty for objects without a ROS name."""
        side = self.node or self.writer or self.source
        return side.label if side else ""

    @property
    def separation_s(self) -> float:
        """Minimum time between two delivered samples in s (time-based filter); 0: no minimum."""
        return self.description.separation_ms / 1000 if isinstance(self.description, Endpoint) else 0.0

    @property
    def keeps(self) -> bool:
        """Whether its samples are kept while its client sleeps: true for reliable readers."""
        about = self.description
        return self.kind == ObjectKind.DATAREADER and isinstance(about, Endpoint) and about.qos.reliable

    def keep(self, samples: Sequence[bytes], shares: Shares, after: bool = False) -> int:
        """Keep samples in order, before or after those already kept; return the number that did not fit."""
        taken = [sample for sample in samples if shares.history.take(len(sample))]
        lost = len(samples) - len(taken)
        taken.reverse()
        self.kept = [*taken, *self.kept] if after else [*self.kept, *taken]
        return lost

    def next_kept(self, shares: Shares) -> bytes:
        """Return the next kept sample."""
        sample = self.kept.pop()
        shares.history.add(-len(sample))
        return sample

    def drop_kept(self, shares: Shares) -> None:
        """Drop all kept samples."""
        shares.history.add(-sum(map(len, self.kept)))
        self.kept.clear()

    def forget_calls(self, shares: Shares) -> None:
        """Remove all open requests."""
        self.outstanding.clear()
        shares.calls.add(-self.calls_bytes)
        self.calls_bytes = 0

    def publish(self, serialized: bytes) -> None:
        """Publish a sample of a data writer: encapsulation header, then CDR body. May raise BridgeError."""
        if not self.history.fits(len(serialized)):  # type: ignore[union-attr]
            self.history.make_room(len(serialized), self.writer)  # type: ignore[union-attr, arg-type]
        self.writer.publish(serialized)  # type: ignore[union-attr]
        self.written += 1

    def enter(self, home: Home) -> None:
        """Create its ROS entity unless it exists. Raises BridgeError when ROS 2 refuses."""
        if self.node or self.writer or self.source:
            return
        description = self.description
        if isinstance(description, Participant):
            self.node = home.node(description)
        elif isinstance(description, Endpoint):
            self._enter_endpoint(description, home.shares)
        elif isinstance(description, Service):
            node = self._home()
            replier = self.kind == ObjectKind.REPLIER
            make: Callable[[Service], Replier | Requester] = (
                node.create_replier if replier else node.create_requester
            )
            self.source = make(description)

    def leave(self, shares: Shares) -> None:
        """Destroy its ROS entity; open requests get no answer."""
        side = self.writer or self.source or self.node
        if side is not None:
            side.destroy()
        self.writer = self.source = self.node = None
        if self.history is not None:
            self.history.give_back()
            self.history = None
        self.forget_calls(shares)

    def _enter_endpoint(self, description: Endpoint, shares: Shares) -> None:
        topic = description.topic or self.sources[1].description
        node = self._home()
        if not isinstance(topic, Topic):
            raise BridgeError("its topic is not there")
        writes = self.kind == ObjectKind.DATAWRITER
        history = (WriterHistory if writes else ReaderHistory)(description.qos, shares)
        try:
            if writes:
                self.writer = node.create_writer(topic, description.qos)
            else:
                self.source = node.create_reader(topic, description.qos)
        except BridgeError:
            history.give_back()
            raise
        self.history = history

    def _home(self) -> Node:
        node = self.participant.node
        if node is None:
            raise BridgeError("its participant is not there")
        return node


@dataclass(frozen=True)
class Outcome:
    """The result of a CREATE; `reason` explains a failure, `entity` is the new object."""

    status: Status
    reason: str = ""
    entity: Entity | None = None
