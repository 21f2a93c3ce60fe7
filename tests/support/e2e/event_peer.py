# SPDX-License-Identifier: Apache-2.0
"""An rclpy process with endpoints like those of a device, what rclpy's events say of them, and others that they meet.

One JSON object a line: {"do": "observe", "topic": "/a", "kind": "publisher", "reliable": true}, {"do": "statuses"}
(lists by topic and event: total and current, or total and policy), {"do": "add", "topic": "/a", "kind": "subscription",
"reliable": true, "lasting": false} (answers its number), {"do": "remove", "number": 0}.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from tests.support.agent.line_process import LineProcess, serving


@contextmanager
def event_peer(domain: int) -> Iterator[LineProcess]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.event_peer", domain) as process:
        yield LineProcess(process)


class _Peer:
    def __init__(self, node: Any) -> None:
        self._node = node
        self._added: list[Any] = []
        self._observed: list[Any] = []
        self._statuses: dict[str, list[int]] = {}

    def observe(self, topic: str, kind: str, reliable: bool) -> bool:
        from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks

        def matched(status: Any) -> None:
            self._statuses[f"{topic} matched"] = [status.total_count, status.current_count]

        def incompatible(status: Any) -> None:
            self._statuses[f"{topic} incompatible"] = [status.total_count, int(status.last_policy_kind)]

        events = PublisherEventCallbacks if kind == "publisher" else SubscriptionEventCallbacks
        callbacks = events(matched=matched, incompatible_qos=incompatible)
        self._statuses[f"{topic} matched"] = [0, 0]
        self._statuses[f"{topic} incompatible"] = [0, 1]
        self._observed.append(self._made(topic, kind, reliable, False, event_callbacks=callbacks))
        return True

    def statuses(self) -> dict[str, list[int]]:
        return self._statuses

    def add(self, topic: str, kind: str, reliable: bool = True, lasting: bool = False) -> int:
        self._added.append(self._made(topic, kind, reliable, lasting))
        return len(self._added) - 1

    def remove(self, number: int) -> bool:
        entity = self._added[number]
        is_publisher = type(entity).__name__ == "Publisher"
        destroy = self._node.destroy_publisher if is_publisher else self._node.destroy_subscription
        return bool(destroy(entity))

    def _made(self, topic: str, kind: str, reliable: bool, lasting: bool, **more: Any) -> Any:
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        profile = QoSProfile(
            depth=10,
            reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if lasting else DurabilityPolicy.VOLATILE,
        )
        message = import_module("std_msgs.msg").Int32
        if kind == "publisher":
            return self._node.create_publisher(message, topic, profile, **more)
        return self._node.create_subscription(message, topic, lambda _: None, profile, **more)


def main() -> None:
    """Serve commands from stdin; a thread spins."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("observed")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    peer = _Peer(node)
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
