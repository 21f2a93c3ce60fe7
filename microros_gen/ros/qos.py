# SPDX-License-Identifier: Apache-2.0
"""Quality of service as plain data."""

from __future__ import annotations

import importlib
from typing import Any

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Qos:
    """Defaults are those of ROS 2. `depth` samples are kept, or all with None; a duration of 0 is none."""

    reliable: bool = True
    transient_local: bool = False
    depth: int | None = 10
    deadline_ms: int = 0
    lifespan_ms: int = 0


def c_profile(qos: Qos) -> Any:
    """Return what rclpy's handles take; rclpy is there."""
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
    return profile.get_c_qos_profile()
