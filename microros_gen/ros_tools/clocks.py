# SPDX-License-Identifier: Apache-2.0
"""The time of a ROS graph: that of a simulation, which publishes it on /clock (REP-105, rcl_clock)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from microros_gen.ros.qos import Qos

if TYPE_CHECKING:
    from microros_gen.ros.peer import Peer

TOPIC = "/clock"
_TYPE = "rosgraph_msgs/msg/Clock"


class GraphClock:
    """The latest time of /clock."""

    def __init__(self, peer: Peer) -> None:
        """Subscribe with `peer`, whose `spin_once` takes the times. Raises RosError."""
        self._known = peer.types.message(_TYPE)
        self._now_ns = 0
        qos = Qos(reliable=False, depth=1)
        peer.subscribe_raw(TOPIC, self._known.name, self._known.type_hash(self._known.name), self._take, qos)

    def now_ns(self) -> int:
        """Return the time in nanoseconds, 0 before the first message."""
        return self._now_ns

    def _take(self, data: bytes, _info: Mapping[str, Any]) -> None:
        clock = self._known.codec.decode(self._known.name, data)["clock"]
        self._now_ns = clock["sec"] * 1_000_000_000 + clock["nanosec"]
