# SPDX-License-Identifier: Apache-2.0
"""An ordinary rclpy process that looks at the graph and subscribes; answers commands, one JSON object a line.

{"do": "subscribe", "topic": "/a", "type": "std_msgs/msg/Int32", "reliable": true, "transient_local": false}
{"do": "graph"}    nodes, topics with types, and publishers with their QoS
{"do": "samples"}  what arrived since the last time
"""

from __future__ import annotations

import importlib
import json
import os
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from agent.process import environment


class Observer:
    """The test's side: sends commands to the process and waits for what should be seen."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process
        self.samples: list[tuple[str, Any]] = []

    def ask(self, **command: Any) -> Any:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def subscribe(self, topic: str, type_name: str, **qos: bool) -> None:
        self.ask(do="subscribe", topic=topic, type=type_name, **qos)

    def see(self, seen: Callable[[dict[str, Any]], object], timeout_s: float = 15.0) -> dict[str, Any]:
        """Wait until `seen` is true of the graph; return the graph."""
        end = time.monotonic() + timeout_s
        while True:
            graph: dict[str, Any] = self.ask(do="graph")
            if seen(graph):
                return graph
            assert time.monotonic() < end, f"not seen: {graph}"
            time.sleep(0.05)

    def got(self, count: int, timeout_s: float = 15.0) -> list[tuple[str, Any]]:
        """Wait for `count` samples; return them."""
        end = time.monotonic() + timeout_s
        found: list[tuple[str, Any]] = []
        while len(found) < count:
            found += [(topic, value) for topic, value in self.ask(do="samples")]
            assert time.monotonic() < end, f"{len(found)} of {count} samples came: {found[-3:]}"
            time.sleep(0.02)
        return found


@contextmanager
def observing(domain: int) -> Iterator[Observer]:
    """Run an observer in a process of its own, in a ROS domain."""
    process = subprocess.Popen(
        [sys.executable, "-m", "agent.observer"],
        env={**environment(domain), "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        observer = Observer(process)
        assert observer.ask(do="graph")
        yield observer
    finally:
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            if stream:
                stream.close()


def main() -> None:
    """Serve commands from stdin."""
    import rclpy

    rclpy.init()
    node = rclpy.create_node("observer")
    arrived: list[tuple[str, Any]] = []
    commands: queue.Queue[str] = queue.Queue()
    threading.Thread(target=lambda: [commands.put(line) for line in sys.stdin], daemon=True).start()
    while True:
        rclpy.spin_once(node, timeout_sec=0.002)
        try:
            command = json.loads(commands.get_nowait())
        except queue.Empty:
            continue
        if command["do"] == "subscribe":
            _subscribe(node, command, arrived)
            answer: Any = True
        elif command["do"] == "graph":
            answer = _graph(node)
        else:
            answer, arrived[:] = list(arrived), []
        print(json.dumps(answer), flush=True)


def _subscribe(node: Any, command: dict[str, Any], arrived: list[tuple[str, Any]]) -> None:
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    package, _, name = command["type"].split("/")
    profile = QoSProfile(depth=1000)
    if not command.get("reliable", True):
        profile.reliability = ReliabilityPolicy.BEST_EFFORT
    if command.get("transient_local"):
        profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
    topic = command["topic"]
    node.create_subscription(
        getattr(importlib.import_module(f"{package}.msg"), name),
        topic,
        lambda message: arrived.append((topic, _plain(message))),
        profile,
    )


def _plain(value: Any) -> Any:
    """Return a message as dictionaries, lists and numbers."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: _plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    return value.tolist() if hasattr(value, "tolist") else value


def _graph(node: Any) -> dict[str, Any]:
    topics = {name: types for name, types in node.get_topic_names_and_types() if name != "/rosout"}
    return {
        "nodes": sorted(
            f"{namespace.rstrip('/')}/{name}" for name, namespace in node.get_node_names_and_namespaces()
        ),
        "topics": topics,
        "publishers": {
            name: [
                [
                    f"{info.node_namespace.rstrip('/')}/{info.node_name}",
                    info.qos_profile.reliability.name,
                    info.qos_profile.durability.name,
                ]
                for info in node.get_publishers_info_by_topic(name)
            ]
            for name in topics
        },
    }


if __name__ == "__main__":
    main()
