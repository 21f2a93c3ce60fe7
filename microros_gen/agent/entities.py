# SPDX-License-Identifier: Apache-2.0
"""One object of a client, and its side in ROS 2."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field

from microros_gen.agent.budgets import Shares
from microros_gen.agent.history import ReaderHistory, WriterHistory
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
    """Where the objects of one client go in ROS 2.

    `fallback_name` is for participants without a name; `hash_of` returns what tells the hashes of its types, by the
    name of its node (see Manifests).
    """

    bridge: Bridge
    fallback_name: str
    hash_of: Callable[[str], HashOf | None] = lambda node: None
    shares: Shares = field(default_factory=Shares.unlimited)
    """What the client may hold."""

    def node(self, participant: Participant) -> Node:
        """Create the node of a participant; may raise BridgeError."""
        name = participant.name.strip("/") or self.fallback_name
        return self.bridge.create_node(name, participant.domain, self.hash_of(name))


@dataclass(eq=False)
class Entity:
    """One object. `sources`: what it was made from, its container first; `node`, `writer`, `source`: its ROS side."""

    id: int
    description: Description
    sources: tuple[Entity, ...]
    node: Node | None = None
    writer: Writer | None = None
    source: Readable | None = None
    """What ROS 2 gives data to: a reader, a replier or a requester."""
    representation: Representation | None = None
    """How the client described it; None for one that the agent's files gave it."""
    cost: int = 0
    """Bytes that are counted for it, without samples."""
    history: WriterHistory | ReaderHistory | None = None
    """What Fast DDS keeps for it."""
    written: int = 0
    """Samples, requests or replies that a client sent through it."""
    kept: list[bytes] = field(default_factory=list)
    """Samples that were taken from ROS and are still to go to the client, the next one last."""
    delivered: int = 0
    """Samples, requests or replies that went to the client."""
    calls_bytes: int = 0
    """Bytes that are counted for what is outstanding."""
    outstanding: dict[bytes | int, bytes] = field(default_factory=dict)
    """What waits for an answer, the oldest first: numbers of requests with the ids (request, object) that a client gave
    them, or identities of requests that a client is to answer."""

    @property
    def kind(self) -> int:
        """Kind of object."""
        return self.id & 0x0F

    @property
    def participant(self) -> Entity:
        """The participant that contains it, or itself."""
        found = self
        while found.kind != ObjectKind.PARTICIPANT and found.sources:
            found = found.sources[0]
        return found

    def inside(self, container: Entity) -> bool:
        """Return whether it is a part of `container`, at any depth."""
        return bool(self.sources) and (self.sources[0] is container or self.sources[0].inside(container))

    @property
    def label(self) -> str:
        """Name for the log; empty for objects without a ROS name."""
        side = self.node or self.writer or self.source
        return side.label if side else ""

    @property
    def separation_s(self) -> float:
        """Minimum seconds between two delivered samples (time-based filter); 0: no minimum."""
        return self.description.separation_ms / 1000 if isinstance(self.description, Endpoint) else 0.0

    @property
    def keeps(self) -> bool:
        """Whether its samples are kept for a client that is away, as for reliable readers."""
        about = self.description
        return self.kind == ObjectKind.DATAREADER and isinstance(about, Endpoint) and about.qos.reliable

    def keep(self, samples: Sequence[bytes], shares: Shares, after: bool = False) -> int:
        """Keep samples in order, before or after those already kept; return how many did not fit."""
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
