# SPDX-License-Identifier: Apache-2.0
"""Quality of service as plain data."""

from __future__ import annotations

import importlib
from typing import Any

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Qos:
    """QoS policies with ROS 2's defaults (rmw_qos_profile_default).

    `depth`: keep the last samples, 1 or more; None keeps all. `deadline_ms`, `lifespan_ms`: 0 or more; 0 sets none.
    `lease_ms`: lease duration of the liveliness, 0 sets none; `manual_liveliness`: by topic instead of automatic.
    """

    reliable: bool = True
    transient_local: bool = False
    depth: int | None = 10
    deadline_ms: int = 0
    lifespan_ms: int = 0
    manual_liveliness: bool = False
    lease_ms: int = 0


def c_profile(qos: Qos) -> Any:
    """Return the profile as rclpy's handles expect it; rclpy must be importable."""
    module = importlib.import_module("rclpy.qos")
    duration = importlib.import_module("rclpy.duration").Duration
    reliability, durability, history = (
        module.ReliabilityPolicy,
        module.DurabilityPolicy,
        module.HistoryPolicy,
    )
    profile = module.QoSProfile(
        reliability=reliability.RELIABLE if qos.reliable else reliability.BEST_EFFORT,
        durability=durability.TRANSIENT_LOCAL if qos.transient_local else durability.VOLATILE,
        history=history.KEEP_ALL if qos.depth is None else history.KEEP_LAST,
        depth=qos.depth or 1,
    )
    if qos.deadline_ms:
        profile.deadline = duration(nanoseconds=qos.deadline_ms * 1_000_000)
    if qos.lifespan_ms:
        profile.lifespan = duration(nanoseconds=qos.lifespan_ms * 1_000_000)
    if qos.manual_liveliness:
        profile.liveliness = module.LivelinessPolicy.MANUAL_BY_TOPIC
    if qos.lease_ms:
        profile.liveliness_lease_duration = duration(nanoseconds=qos.lease_ms * 1_000_000)
    return profile.get_c_qos_profile()
