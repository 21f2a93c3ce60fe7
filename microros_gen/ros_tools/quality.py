# SPDX-License-Identifier: Apache-2.0
"""QoS of commands: the presets of ROS 2, what the publishers of a topic offer, and QoS as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from microros_gen.ros.graph import GraphEndpoint
from microros_gen.ros.qos import Qos

PRESETS: Mapping[str, Qos] = {
    "default": Qos(),
    "sensor_data": Qos(reliable=False, depth=5),
    "services_default": Qos(),
    "parameters": Qos(depth=1000),
    "parameter_events": Qos(depth=1000),
    "action_status_default": Qos(transient_local=True, depth=1),
}
"""By the names of the ros2 command line (rmw/qos_profiles.h)."""
RELIABLE, BEST_EFFORT = 1, 2
TRANSIENT_LOCAL = 1
_RELIABILITIES = ("system_default", "reliable", "best_effort", "unknown", "best_available")
_DURABILITIES = ("system_default", "transient_local", "volatile", "unknown", "best_available")
_HISTORIES = ("system_default", "keep_last", "keep_all", "unknown")
_LIVELINESSES = ("system_default", "automatic", "", "manual_by_topic", "unknown", "best_available")
"""By their numbers in rmw/types.h."""
_WORDS = MappingProxyType(
    {
        "reliability": _RELIABILITIES,
        "durability": _DURABILITIES,
        "history": _HISTORIES,
        "liveliness": _LIVELINESSES,
    }
)
_INFINITE = 9223372036854775807
"""Nanoseconds of RMW_DURATION_INFINITE."""


def matching(publishers: Sequence[GraphEndpoint], preset: Qos) -> tuple[Qos, tuple[str, ...]]:
    """Return a QoS that all publishers match, with `preset`'s depth, and remarks on what only some of them offer."""
    if not publishers:
        return preset, ()
    reliable = [p.reliability == RELIABLE for p in publishers]
    durable = [p.durability == TRANSIENT_LOCAL for p in publishers]
    notes = tuple(
        f"some, but not all, publishers are {good}: using {bad}, which connects to all of them"
        for found, good, bad in (
            (reliable, "reliable", "best_effort"),
            (durable, "transient_local", "volatile"),
        )
        if any(found) and not all(found)
    )
    return Qos(reliable=all(reliable), transient_local=all(durable), depth=preset.depth), notes


def endpoint_lines(endpoint: GraphEndpoint, kind: str) -> tuple[str, ...]:
    """Return the lines of `topic info -v` for a publisher or subscription; `kind` is PUBLISHER or SUBSCRIPTION."""
    namespace, _, name = endpoint.node.rpartition("/")
    history = _word(_HISTORIES, endpoint.history).upper()
    depth = f" ({endpoint.depth})" if history == "KEEP_LAST" else ""
    return (
        f"Node name: {name}",
        f"Node namespace: {namespace or '/'}",
        f"Topic type: {endpoint.type}",
        f"Topic type hash: {hash_text(endpoint) or 'INVALID'}",
        f"Endpoint type: {kind}",
        f"GID: {'.'.join(f'{byte:02x}' for byte in endpoint.gid)}",
        "QoS profile:",
        f"  Reliability: {_word(_RELIABILITIES, endpoint.reliability).upper()}",
        f"  History (Depth): {history}{depth}",
        f"  Durability: {_word(_DURABILITIES, endpoint.durability).upper()}",
        f"  Lifespan: {_duration(endpoint.lifespan)}",
        f"  Deadline: {_duration(endpoint.deadline)}",
        f"  Liveliness: {_word(_LIVELINESSES, endpoint.liveliness).upper()}",
        f"  Liveliness lease duration: {_duration(endpoint.lease)}",
    )


def hash_text(endpoint: GraphEndpoint) -> str | None:
    """Return the type hash of an endpoint as in REP-2011, None if it announces none."""
    return f"RIHS01_{endpoint.hash.hex()}" if endpoint.hash_version == 1 else None


def recorded(endpoint: GraphEndpoint) -> dict[str, Any]:
    """Return the QoS of a publisher as rosbag2 records it (`offered_qos_profiles`)."""
    return {
        "history": _word(_HISTORIES, endpoint.history),
        "depth": endpoint.depth,
        "reliability": _word(_RELIABILITIES, endpoint.reliability),
        "durability": _word(_DURABILITIES, endpoint.durability),
        "deadline": _seconds(endpoint.deadline),
        "lifespan": _seconds(endpoint.lifespan),
        "liveliness": _word(_LIVELINESSES, endpoint.liveliness),
        "liveliness_lease_duration": _seconds(endpoint.lease),
        "avoid_ros_namespace_conventions": False,
    }


def word_of(policy: str, value: Any) -> str:
    """Return the word for a policy in a recording: earlier versions of rosbag2 wrote the number."""
    return _word(_WORDS[policy], value) if isinstance(value, int) else str(value)


def _word(words: Sequence[str], number: int) -> str:
    return words[number] if 0 <= number < len(words) else "unknown"


def _duration(nanoseconds: int) -> str:
    return "Infinite" if nanoseconds >= _INFINITE else f"{nanoseconds} nanoseconds"


def _seconds(nanoseconds: int) -> dict[str, int]:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return {"sec": seconds, "nsec": rest}
