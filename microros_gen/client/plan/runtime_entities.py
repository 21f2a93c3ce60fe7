# SPDX-License-Identifier: Apache-2.0
"""The declared entities of the C runtime: nodes, publishers, subscriptions and timers, and the queues of samples."""

from __future__ import annotations

from dataclasses import field

from microros_gen.application.model import logger_name
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class NodePlan:
    """A declared node. `participant_name` is what goes on the wire: `name`, or `namespace/name`.

    `given_name` and `given_namespace` are what the source passes, where `remap:` changes them.
    """

    index: int
    name: str
    namespace: str
    participant_name: str
    domain_id: int
    given_name: str = ""
    given_namespace: str = ""

    @property
    def logger_name(self) -> str:
        """The name of its logger in ROS 2."""
        return logger_name(self.namespace, self.name)

    @property
    def source_name(self) -> str:
        """The name that the source passes."""
        return self.given_name or self.name

    @property
    def source_namespace(self) -> str:
        """The namespace that the source passes, as ROS 2 reports it."""
        return "/" + (self.given_namespace or self.namespace).strip("/")

    @property
    def full_namespace(self) -> str:
        """The namespace as ROS 2 reports it: `/`, `/a/b`."""
        return "/" + self.namespace.strip("/")


@dataclass(frozen=True)
class PublisherPlan:
    """A declared publisher; `topic` is the expanded ROS name (`/imu/data`), `dds_topic` is `rt` + topic.

    `limited` is the prefix of the C names of its type under own limits (typesupport/plan/own_limits.py); empty: those
    of the type. `declared_as` is the expanded name that the source has, where `remap:` makes it `topic`.
    """

    index: int
    node: int
    topic: str
    dds_topic: str
    type: TypeName
    reliable: bool
    limited: str = field(default="", repr=False)
    declared_as: str = field(default="", repr=False)

    @property
    def dds_type(self) -> str:
        """The type's name on the wire: `std_msgs::msg::dds_::Int32_`."""
        return dds_type(self.type)


@dataclass(frozen=True)
class SubscriptionPlan:
    """A declared subscription, as PublisherPlan.

    `index` counts subscriptions alone. For a message of variable length, `storage` is what the names of its storage
    begin with in C, `header` declares it, `c_type` is its struct and `buffers`: what holds while none of its
    members has memory of the application's. `stored`: the library has such storage and binds the message to it.
    """

    index: int
    node: int
    topic: str
    dds_topic: str
    type: TypeName
    reliable: bool
    storage: str = ""
    header: str = ""
    c_type: str = ""
    buffers: tuple[str, ...] = ()
    stored: bool = False
    declared_as: str = field(default="", repr=False)

    @property
    def binder(self) -> str:
        """The C function that binds its message to storage: NULL without such."""
        return f"subscription_bind_{self.index}" if self.stored else "NULL"

    @property
    def dds_type(self) -> str:
        """The type's name on the wire: `std_msgs::msg::dds_::Int32_`."""
        return dds_type(self.type)


@dataclass(frozen=True)
class QueuePlan:
    """What waits for the application to take it: `slots` samples, of at most `slot_size` bytes each.

    `requested_bytes`: they share this number of bytes, and each takes its own size; None: each takes `slot_size`. A
    sample is what DATA contains after the object's id: the CDR body, for a service after 24 bytes (the requester), for
    a client after 4 (the request). `streamed`: none waits, a component takes samples piece by piece.
    """

    slots: int
    slot_size: int
    requested_bytes: int | None = field(default=None, repr=False)
    streamed: bool = field(default=False, repr=False)

    @property
    def size(self) -> int:
        """Bytes of all samples together."""
        return self.slots * self.slot_size if self.requested_bytes is None else self.requested_bytes

    @property
    def waits_alone(self) -> bool:
        """Whether a sample of the largest size waits alone."""
        return self.size < 2 * self.slot_size


@dataclass(frozen=True)
class TimerPlan:
    """A declared timer; its period in nanoseconds. `kind` is clock, rtos or hardware: what makes it ready.

    `gated`: the state of its node decides when it may be ready.
    """

    index: int
    node: int
    name: str
    period_ns: int
    kind: str = "clock"
    gated: bool = False
