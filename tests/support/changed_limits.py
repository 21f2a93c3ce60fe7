# SPDX-License-Identifier: Apache-2.0
"""Applications before and after one of their limits changed, as users change it: what a build has to compile again."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Change:
    """An application file, and the same with another limit."""

    before: str
    after: str


def _change(text: str, old: str, new: str) -> Change:
    """Return the change from `old`, which has to be in the file once, to `new`."""
    assert text.count(old) == 1, old
    return Change(text, text.replace(old, new))


_SENDER = """\
version: 1
profiles: [pure_sender]
interfaces: [sensor_msgs/msg/Imu]
pools: {publishers: 2, history: 4, slot_size: 400}
memory: {arena: 1 KiB}
limits: {'*': {string: 24}}
"""
_RECEIVER = """\
version: 1
profiles: [pure_sender, pure_reader]
limits: {'*': {string: 24}}
nodes:
  - name: here
    publishers:
      - {topic: out, type: sensor_msgs/msg/Imu}
    subscriptions:
      - {topic: in, type: sensor_msgs/msg/Imu, queue: 2}
"""
_IN_FRAGMENTS = """\
version: 1
profiles: [pure_sender]
transport: {type: udp, agent: "127.0.0.1:8888", mtu: 256}
limits: {'*': {string: 24}}
nodes:
  - name: here
    publishers:
      - {topic: out, type: sensor_msgs/msg/Imu, qos: {reliability: reliable, depth: 4}}
"""
CHANGES: Mapping[str, Change] = MappingProxyType(
    {
        "string": _change(_SENDER, "string: 24", "string: 32"),
        "history": _change(_SENDER, "history: 4", "history: 6"),
        "slot_size": _change(_SENDER, "slot_size: 400", "slot_size: 408"),
        "mtu": _change(_IN_FRAGMENTS, "mtu: 256", "mtu: 264"),
        "arena": _change(_SENDER, "arena: 1 KiB", "arena: 2 KiB"),
        "publishers": _change(_SENDER, "publishers: 2", "publishers: 3"),
        "string of a receiver": _change(_RECEIVER, "string: 24", "string: 32"),
        "queue": _change(_RECEIVER, "queue: 2", "queue: 3"),
    }
)
"""By what changes."""
