# SPDX-License-Identifier: Apache-2.0
"""Publishes what an MCAP file has: the QoS of its publishers, and the times of its messages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import yaml

from microros_gen.ros.qos import Qos
from microros_gen.ros_tools.mcap_reader import Channel
from microros_gen.ros_tools.quality import word_of

_INFINITE_MS = 1 << 40
"""Milliseconds of a duration from which it means none: RMW_DURATION_INFINITE is 292 years."""


def type_hash_of(channel: Channel) -> str | None:
    """Return the hash that the publishers announced (RIHS01), None if the file does not have it."""
    return channel.metadata.get("topic_type_hash") or None


def offered_qos(channel: Channel) -> tuple[Qos, bool]:
    """Return the QoS with which a topic is published again, and whether its publishers offered different ones.

    Of different ones it is what satisfies all subscriptions of the recorded publishers: reliable and transient local
    if any was, without deadline and lifespan. Without a QoS in the file: the default.
    """
    try:
        listed = yaml.safe_load(channel.metadata.get("offered_qos_profiles", "")) or []
    except (yaml.YAMLError, ValueError, LookupError, AttributeError, RecursionError):
        listed = []
    profiles = [_qos(each) for each in listed if isinstance(each, dict)] if isinstance(listed, list) else []
    if not profiles:
        return Qos(), False
    if len(set(profiles)) == 1:
        return profiles[0], False
    return _strongest(profiles), True


def _strongest(profiles: Sequence[Qos]) -> Qos:
    depths = [profile.depth for profile in profiles]
    known = [depth for depth in depths if depth is not None]
    return Qos(
        reliable=any(profile.reliable for profile in profiles),
        transient_local=any(profile.transient_local for profile in profiles),
        depth=max(known) if len(known) == len(depths) else None,
    )


def _qos(recorded: Mapping[str, Any]) -> Qos:
    """Return a QoS that rosbag2 recorded; history and depth are unknown for publishers that were discovered."""
    depth = recorded.get("depth")
    count = depth if isinstance(depth, int) and 0 < depth <= 100_000 else Qos.depth
    lease = _milliseconds(recorded.get("liveliness_lease_duration"))
    return Qos(
        reliable=word_of("reliability", recorded.get("reliability")) != "best_effort",
        transient_local=word_of("durability", recorded.get("durability")) == "transient_local",
        depth=None if word_of("history", recorded.get("history")) == "keep_all" else count,
        deadline_ms=_milliseconds(recorded.get("deadline")),
        lifespan_ms=_milliseconds(recorded.get("lifespan")),
        manual_liveliness=word_of("liveliness", recorded.get("liveliness")) == "manual_by_topic",
        lease_ms=lease,
    )


def _milliseconds(recorded: Any) -> int:
    """Return a duration in whole milliseconds, at least 1; 0: none."""
    if not isinstance(recorded, dict):
        return 0
    seconds, nanoseconds = recorded.get("sec", 0), recorded.get("nsec", 0)
    if not isinstance(seconds, int) or not isinstance(nanoseconds, int):
        return 0
    total = seconds * 1000 + -(-nanoseconds // 1_000_000)
    return total if 0 < total < _INFINITE_MS else 0
