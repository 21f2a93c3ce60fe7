# SPDX-License-Identifier: Apache-2.0
"""What an XRCE client and an rclpy process see of each other."""

from __future__ import annotations

INT32 = "std_msgs/msg/Int32"


def matched(topic: str, node: str):  # type: ignore[no-untyped-def]
    return lambda graph: any(p[0] == node for p in graph["publishers"].get(topic, []))


def gone(node: str):  # type: ignore[no-untyped-def]
    return lambda graph: node not in graph["nodes"]
