# SPDX-License-Identifier: Apache-2.0
"""Names of services and of what they are made of."""

from __future__ import annotations

from microros_gen.interfaces.dds_names import reply_topic, request_topic
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass


def cpp_namespace(name: TypeName) -> str:
    """Return the C++ namespace of a type, as in type supports of rosidl: `std_msgs::msg`."""
    return f"{name.package}::{name.kind}"


@dataclass(frozen=True)
class ServiceName:
    """A service: its fully qualified ROS name and its type."""

    name: str
    type: TypeName

    @property
    def request(self) -> TypeName:
        """Return the message type of its requests, `pkg/srv/Type_Request`."""
        return derived_name(self.type, "Request")

    @property
    def response(self) -> TypeName:
        """Return the message type of its responses, `pkg/srv/Type_Response`."""
        return derived_name(self.type, "Response")

    def __str__(self) -> str:
        return f"{self.name} [{self.type}]"

    @property
    def request_topic(self) -> str:
        """Return the DDS topic of its requests, `rq/…Request` (rmw_fastrtps_cpp)."""
        return request_topic(self.name)

    @property
    def reply_topic(self) -> str:
        """Return the DDS topic of its replies, `rr/…Reply` (rmw_fastrtps_cpp)."""
        return reply_topic(self.name)
