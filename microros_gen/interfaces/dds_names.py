# SPDX-License-Identifier: Apache-2.0
"""Names on the way from ROS to DDS.

Sources: ROS 2 design "Topic and Service name mapping to DDS"; the participant's name as the rmw of micro-ROS
puts it on the wire.
"""

from __future__ import annotations

from microros_gen.interfaces.types import TypeName


def dds_topic(name: str) -> str:
    """Return the DDS topic of a fully qualified ROS topic name; a name without a slash in front is one of DDS."""
    return f"rt{name}" if name.startswith("/") else name


def dds_type(name: TypeName) -> str:
    """Return the DDS type name: `std_msgs/msg/Int32` → `std_msgs::msg::dds_::Int32_`."""
    return f"{name.package}::{name.kind}::dds_::{name.name}_"


def participant_name(node: str, namespace: str) -> str:
    """Return the name that a participant carries: `node`, or `/ns/node` where it has a namespace."""
    base = namespace.strip("/")
    return f"/{base}/{node}" if base else node


def request_topic(name: str) -> str:
    """Return the DDS topic of a service's requests; `name` is fully qualified."""
    return f"rq{name}Request"


def reply_topic(name: str) -> str:
    """Return the DDS topic of a service's replies; `name` is fully qualified."""
    return f"rr{name}Reply"
