# SPDX-License-Identifier: Apache-2.0
"""The interface between the agent and ROS 2. The rest of the agent works, and is tested, without ROS."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from microros_gen.agent.representation.description import Qos, Service, Topic
from microros_gen.agent.wire.constants import Status
from microros_gen.records import dataclass


class BridgeError(Exception):
    """ROS 2 refused an operation; the text has reason and remedy, `status` is sent to the client."""

    def __init__(self, reason: str, status: Status = Status.DDS_ERROR) -> None:
        super().__init__(reason)
        self.status = status


class BusyError(BridgeError):
    """DDS has no room for a sample now, because readers have not taken earlier ones; a retry may succeed.

    `done`: number of samples of the same submessage that it accepted before.
    """

    def __init__(self, reason: str, done: int = 0) -> None:
        super().__init__(reason, Status.RESOURCES)
        self.done = done


HashOf = Callable[[str], "str | None"]
"""Function that returns the hash (RIHS01_…, REP-2011) of a type, or None if it is unknown.

Types are named as in ROS: `pkg/msg/Type`; for services `pkg/srv/Type`, `pkg/srv/Type_Request` and
`pkg/srv/Type_Response`; actions likewise.
"""


@dataclass(frozen=True)
class Matched:
    """A publisher or subscription (`kind`) of a client's node has `count` matched endpoints now."""

    node: str
    kind: str
    endpoint: str
    count: int

    def __str__(self) -> str:
        return f"{self.kind} {self.endpoint} of {self.node} has {self.count} counterparts"


@dataclass(frozen=True)
class Incompatible:
    """Another node has incompatible QoS; `policy` is the last one that differed (`reliability`, …)."""

    node: str
    kind: str
    endpoint: str
    policy: str
    count: int

    def __str__(self) -> str:
        return (
            f"{self.kind} {self.endpoint} of {self.node} does not match {self.count} counterparts:"
            f" another quality of service, {self.policy}"
        )


@dataclass(frozen=True)
class HashMismatch:
    """Another node announces a type of this name with another definition: its samples will be misread."""

    node: str
    endpoint: str
    hash: str
    other_node: str
    other_hash: str

    def __str__(self) -> str:
        return (
            f"{self.endpoint}: {self.node} was generated with the type {self.hash}, but {self.other_node} has"
            f" {self.other_hash}: their definitions differ, so samples will be misread"
        )


@dataclass(frozen=True)
class TypeMismatch:
    """Another node announces the same topic with a type of another name: the two will not be connected."""

    node: str
    endpoint: str
    other_node: str
    other_type: str

    def __str__(self) -> str:
        return (
            f"{self.endpoint} of {self.node} is not connected with {self.other_node},"
            f" whose type is {self.other_type}"
        )


@dataclass(frozen=True)
class HashUnknown:
    """No interface file defines a type: it is bridged, but its endpoints announce no hash. Reported once."""

    type: str

    def __str__(self) -> str:
        return f"type {self.type}: no interface file is known, so no type hash is announced"


@dataclass(frozen=True)
class OtherDomain:
    """A client requested another ROS domain than that of the agent's shell. Reported once per domain."""

    node: str
    domain: int
    own: int

    def __str__(self) -> str:
        return (
            f"node {self.node} is in ROS domain {self.domain}, as its client requests, and ROS_DOMAIN_ID is {self.own}"
            f" here: programs of domain {self.own} do not see it. Start the agent with --domain {self.own} to have all"
            f" clients there, or say `domain_id: {self.own}` at the node in the application file of the client"
        )


@dataclass(frozen=True)
class NoServer:
    """A request was dropped; `lost`: how many since the service was last available."""

    node: str
    endpoint: str
    reason: str
    lost: int

    def __str__(self) -> str:
        return (
            f"client {self.endpoint} of {self.node}: a request was dropped: {self.reason}"
            " (further ones are only counted, until somebody does)"
        )


@dataclass(frozen=True)
class ServerFound:
    """A service appeared after requests to it; `lost` of them were dropped."""

    node: str
    endpoint: str
    lost: int

    def __str__(self) -> str:
        return f"client {self.endpoint} of {self.node}: it is served now; {self.lost} requests were dropped before"


@dataclass(frozen=True)
class NoClient:
    """A reply was dropped because its client is gone; the service has lost `lost` replies."""

    node: str
    endpoint: str
    lost: int

    def __str__(self) -> str:
        return (
            f"service {self.endpoint} of {self.node}: a reply was dropped: the client that asked is gone"
            " (further ones are only counted)"
        )


GraphReport = (
    NoServer
    | ServerFound
    | NoClient
    | Matched
    | Incompatible
    | HashMismatch
    | TypeMismatch
    | HashUnknown
    | OtherDomain
)
"""A report about the ROS graph, made within `ready` and on creation of an entity; its text is for people."""


class Writer(Protocol):
    """A ROS publisher of a client."""

    @property
    def label(self) -> str:
        """Topic and type by their ROS names, for the log."""

    def publish(self, serialized: bytes) -> None:
        """Publish a sample: encapsulation header, then CDR body.

        Raises BusyError, after about a millisecond, if a retry may succeed, and then for some milliseconds immediately,
        without trying DDS. Raises BridgeError if it is refused for good.
        """

    def settled(self, wait_s: float = 0.0) -> bool:
        """Return whether all readers have acknowledged everything; wait for that, at most `wait_s` seconds."""

    def destroy(self) -> None:
        """Leave the ROS graph; nothing else is called afterwards."""


class Source(Protocol):
    """An entity of a client that receives data from ROS 2: a reader, a replier or a requester.

    `take` of each returns the next item, or None when it is empty. `Bridge.ready` reports a source again only after it
    was empty: a caller that stops before None has to continue without a report.
    """

    @property
    def label(self) -> str:
        """Names and types in ROS 2, for the log."""

    def unread(self) -> int:
        """Return about how many items arrived since it was last empty; expensive."""

    def destroy(self) -> None:
        """Leave the ROS graph; nothing else is called afterwards."""


class Reader(Source, Protocol):
    """A ROS subscription of a client."""

    def take(self) -> bytes | None:
        """Return the next sample: encapsulation header (4 bytes), then CDR body. May raise BridgeError."""


class Replier(Source, Protocol):
    """A ROS service, which the client answers."""

    def take(self) -> tuple[bytes, bytes] | None:
        """Return the next request: SampleIdentity as on the XRCE wire (24 bytes), and encapsulation with CDR body."""

    def reply(self, identity: bytes, serialized: bytes) -> None:
        """Answer the request that had `identity`: encapsulation header, then CDR body. May raise BridgeError.

        Never waits for the client; a reply to one that is gone is dropped with a `NoClient`.
        """


class Requester(Source, Protocol):
    """A ROS service client, with which the client calls."""

    def request(self, serialized: bytes) -> int:
        """Send a request (encapsulation header, then CDR body); return the number that its reply will have.

        A request whose service does not exist waits for it some seconds (XRCE clients cannot check whether it exists),
        and is then dropped with a `NoServer`. The caller is not notified.
        """

    def take(self) -> tuple[int, bytes] | None:
        """Return the next reply: the number of its request, and encapsulation with CDR body."""


class Node(Protocol):
    """A ROS node of a client."""

    @property
    def label(self) -> str:
        """Fully qualified name, for the log."""

    @property
    def domain(self) -> int:
        """Its ROS domain, 0 to 232."""

    def create_writer(self, topic: Topic, qos: Qos) -> Writer:
        """Create a publisher. Raises BridgeError if the topic's name or type is invalid."""

    def create_reader(self, topic: Topic, qos: Qos) -> Reader:
        """Create a subscription. Raises BridgeError if the topic's name or type is invalid."""

    def create_replier(self, service: Service) -> Replier:
        """Create a service. Raises BridgeError if its name or type is invalid."""

    def create_requester(self, service: Service) -> Requester:
        """Create a service client. Raises BridgeError if its name or type is invalid."""

    def destroy(self) -> None:
        """Leave the ROS graph, after everything else of the node has."""


class Bridge(Protocol):
    """The way into ROS 2."""

    def create_node(self, name: str, domain: int, hash_of: HashOf | None = None) -> Node:
        """Create a node; `name` is `node` or `namespace/node`, of any characters. Raises BridgeError if that fails.

        `hash_of` returns the type hashes that this client was generated with (its manifest); default: the bridge's.
        """

    def fileno(self) -> int:
        """Return the descriptor that is readable while `ready` has something to report."""

    def ready(self) -> list[Source]:
        """Return the sources that received data since their last report, each once. Never waits."""

    def trim(self) -> None:
        """Return free memory to the system; takes some milliseconds."""

    def close(self) -> None:
        """Release everything; nodes are destroyed before."""
