# SPDX-License-Identifier: Apache-2.0
"""Names of services and of what they are made of."""

from __future__ import annotations

from microros_gen.interfaces.dds_names import reply_topic, request_topic
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass


def cpp_namespace(name: TypeName) -> str:
    """Return the C++ namespace of a type, as type supports have it: `std_msgs::msg`."""
    return f"{name.package}::{name.kind}"


@dataclass(frozen=True)
class ServiceName:
    """A service by its ROS names."""

    name: str
    type: TypeName

    @property
    def request(self) -> TypeName:
        """The message type of its requests."""
        return derived_name(self.type, "Request")

    @property
    def response(self) -> TypeName:
        """The message type of its responses."""
        return derived_name(self.type, "Response")

    def __str__(self) -> str:
        return f"{self.name} [{self.type}]"

    @property
    def request_topic(self) -> str:
        """The DDS topic of its requests."""
        return request_topic(self.name)

    @property
    def reply_topic(self) -> str:
        """The DDS topic of its replies."""
        return reply_topic(self.name)
