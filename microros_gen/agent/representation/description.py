# SPDX-License-Identifier: Apache-2.0
"""Descriptions of objects, independent of the form in which the client sent them."""

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
    """Quality of service of an endpoint. `depth` 0 means the default of 1; times are in ms, 0 means no limit."""

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
    """A participant, which becomes a ROS node. `name` is `node`, `namespace/node` or empty; `domain` is 0 to 232."""

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

    `separation_ms`: minimum time between two samples of a reader (time-based filter), 0 for no minimum.
    `content_filter`: filter expression that the client requests; ROS 2 has no such filters, so it is refused.
    """

    topic: Topic | None
    topic_id: int
    qos: Qos
    separation_ms: int = 0
    content_filter: str = ""


@dataclass(frozen=True)
class Service:
    """A requester or replier. If its topic names are empty, they are derived from the service's name."""

    name: str
    request_type: str
    reply_type: str
    request_topic: str = ""
    reply_topic: str = ""


@dataclass(frozen=True)
class TypeDefinition:
    """A type by its full name; `text` is its definition in XML, empty if the client sent only the name.

    ROS 2 identifies types by name, so the definition is only compared with that of another CREATE.
    """

    name: str
    text: str = ""


@dataclass(frozen=True)
class QosProfile:
    """A QoS profile, named `Library::Profile`, for writers and for readers; None if it does not define one."""

    name: str
    writer: Qos | None = None
    reader: Qos | None = None


@dataclass(frozen=True)
class Part:
    """An object in an application: its kind, and the index of its container among the parts (None: no container)."""

    kind: int
    container: int | None
    description: Participant | Topic | Group | Endpoint


@dataclass(frozen=True)
class Application:
    """Several objects that are created together; containers come before their contents."""

    name: str
    parts: tuple[Part, ...] = ()


Description = Participant | Topic | Group | Endpoint | Service | TypeDefinition | QosProfile | Application


class UnknownNameError(Exception):
    """A description refers to an unknown topic or QoS profile; the text is for people."""


class UnsupportedKindError(Exception):
    """A description is of a kind that the agent does not support; the text names the kind."""
