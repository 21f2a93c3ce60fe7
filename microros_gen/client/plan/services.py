# SPDX-License-Identifier: Apache-2.0
"""Declared service servers and clients, as the C runtime has them."""

from __future__ import annotations

from dataclasses import field

from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class StoredMessage:
    """A message that gets storage from its declaration, as of SubscriptionPlan. `part` is request or response."""

    part: str
    storage: str
    header: str
    c_type: str
    buffers: tuple[str, ...]


@dataclass(frozen=True)
class ServicePlan:
    """A declared service or client, by `kind`; `index` counts those of its kind alone.

    `name` is the expanded ROS name (`/arm/set_bool`), `type` the service's. `limited` begins the C names of the type of
    what it sends, where that has its own limits. `stored`: what it receives, and what a service answers. `declared_as`
    as for publishers.
    """

    kind: str
    index: int
    node: int
    name: str
    type: TypeName
    limited: str = field(default="", repr=False)
    stored: tuple[StoredMessage, ...] = ()
    declared_as: str = ""

    def binder(self, part: str) -> str:
        """Return the C function that binds its request or response to storage: NULL without such."""
        stored = any(message.part == part for message in self.stored)
        return f"bind_{self.kind}_{self.index}_{part}" if stored else "NULL"

    @property
    def dds_type(self) -> str:
        """The type's name on the wire, in front of that of its messages: `std_srvs::srv::dds_::SetBool_`."""
        return dds_type(self.type)
