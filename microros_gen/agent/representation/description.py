# SPDX-License-Identifier: Apache-2.0
"""What an object is, whichever way the client described it."""

from __future__ import annotations

from enum import Enum

from microros_gen.records import dataclass


class Durability(Enum):
    """DDS durability kinds."""

    VOLATILE = "volatile"
    TRANSIENT_LOCAL = "transient_local"
    TRANSIENT = "transient"
    PERSISTENT = "persistent"


@dataclass(frozen=True)
class Qos:
    """Quality of service of an endpoint; depth 0 means the default of 1; times in ms, 0 for no limit."""

    reliable: bool = True
    durability: Durability = Durability.VOLATILE
    keep_last: bool = True
    depth: int = 0
    deadline_ms: int = 0
    lifespan_ms: int = 0

    def __str__(self) -> str:
        history = f"keep_last {self.depth or 1}" if self.keep_last else "keep_all"
        return f"{'reliable' if self.reliable else 'best_effort'}, {self.durability.value}, {history}"


@dataclass(frozen=True)
class Participant:
    """A participant: a ROS node. `name` is `node` or `namespace/node`, or empty."""

    name: str
    domain: int


@dataclass(frozen=True)
class Topic:
    """A topic by its DDS names, for example `rt/chatter` and `std_msgs::msg::dds_::String_`."""

    name: str
    type_name: str


@dataclass(frozen=True)
class Group:
    """A publisher or a subscriber."""

    name: str = ""
    partitions: tuple[str, ...] = ()


@dataclass(frozen=True)
class Endpoint:
    """A data writer or reader; its topic is described in place (XML) or is the object `topic_id` (binary).

    `separation_ms`: a reader's time-based filter. `content_filter`: what it asks for, which ROS 2 does not have.
    """

    topic: Topic | None
    topic_id: int
    qos: Qos
    separation_ms: int = 0
    content_filter: str = ""


@dataclass(frozen=True)
class Service:
    """A requester or a replier; topic names may be empty, then they follow from the service's name."""

    name: str
    request_type: str
    reply_type: str
    request_topic: str = ""
    reply_topic: str = ""


@dataclass(frozen=True)
class TypeDefinition:
    """A type by its full name; `text` is its definition in XML, empty for one that is named only.

    ROS 2 knows its types by name, so a definition is kept and compared, and not used.
    """

    name: str
    text: str = ""


@dataclass(frozen=True)
class QosProfile:
    """A named quality of service (`Library::Profile`) for writers and for readers; None: it does not say."""

    name: str
    writer: Qos | None = None
    reader: Qos | None = None


@dataclass(frozen=True)
class Part:
    """An object within an application: its kind, and the place of its container among the parts (None: none)."""

    kind: int
    container: int | None
    description: Participant | Topic | Group | Endpoint


@dataclass(frozen=True)
class Application:
    """Several objects that are made together, containers before what they contain."""

    name: str
    parts: tuple[Part, ...] = ()


Description = Participant | Topic | Group | Endpoint | Service | TypeDefinition | QosProfile | Application


class UnknownNameError(Exception):
    """A description names a topic or a quality of service that is not there; the text is for people."""


class UnsupportedKindError(Exception):
    """An object of a kind that the agent does not have; the text names the kind."""
