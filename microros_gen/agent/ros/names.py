# SPDX-License-Identifier: Apache-2.0
"""ROS names of what clients name for DDS: topics are `rt/…`, message types `pkg::msg::dds_::Type_`."""

from __future__ import annotations

import re
from dataclasses import dataclass

from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.wire.constants import Status

MAXIMUM_NAME = 255
"""Characters that ROS 2 allows in the name of a node."""
_TOPIC = re.compile(r"rt((?:/[A-Za-z_][A-Za-z0-9_]*)+)", re.ASCII)
_TYPE = re.compile(r"([a-z][a-z0-9_]*)::msg::dds_::([A-Z][A-Za-z0-9]*)_", re.ASCII)
_WRONG = re.compile(r"[^A-Za-z0-9_]", re.ASCII)


@dataclass(frozen=True)
class TypeName:
    """A message type by its ROS names."""

    package: str
    name: str

    def __str__(self) -> str:
        return f"{self.package}/msg/{self.name}"


def ros_topic(dds_name: str) -> str:
    """Return the absolute ROS name of a DDS topic; BridgeError for one that is no ROS topic."""
    match = _TOPIC.fullmatch(dds_name)
    if not match:
        raise BridgeError(
            f"topic '{dds_name}' is no ROS topic: 'rt/' and a ROS name is expected", Status.INVALID_DATA
        )
    return match[1]


def ros_type(dds_name: str) -> TypeName:
    """Return the ROS type of a DDS type name; BridgeError for one that is no ROS message."""
    match = _TYPE.fullmatch(dds_name)
    if not match:
        raise BridgeError(
            f"type '{dds_name}' is no ROS message: 'package::msg::dds_::Type_' is expected",
            Status.INVALID_DATA,
        )
    return TypeName(match[1], match[2])


def ros_node(name: str) -> tuple[str, str]:
    """Return node name and namespace (absolute) for `name`: `node` or `namespace/node`.

    Characters that ROS does not allow become `_`, a part that begins with a digit gets one in front; empty
    parts are left out. BridgeError when nothing remains or a part is too long.
    """
    parts = [_part(part) for part in name.split("/") if part]
    if not parts:
        raise BridgeError("the participant has no name", Status.INVALID_DATA)
    if len(parts[-1]) > MAXIMUM_NAME or sum(len(part) + 1 for part in parts[:-1]) > MAXIMUM_NAME - 10:
        raise BridgeError(f"the node name '{name[:40]}…' is too long", Status.INVALID_DATA)
    return parts[-1], "/" + "/".join(parts[:-1])


def _part(part: str) -> str:
    clean = _WRONG.sub("_", part)
    return f"_{clean}" if clean[0].isdigit() else clean
