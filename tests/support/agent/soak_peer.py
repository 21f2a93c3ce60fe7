# SPDX-License-Identifier: Apache-2.0
"""The ROS side of the soak, an rclpy process: keeps the ledger of what came, publishes, serves and calls.

Topic /soak/up has strings `KEY:LIFE:NUMBER:SIZE:xxx...` of the clients, /soak/down `NUMBER:SIZE:xxx...` for them.
Service /soak/ledger answers requests of words: `tally KEY LIFE` with how many came, in order and whole, and how
many did not; `call SERVICE COUNT` by calling a client's service COUNT times at once; `called SERVICE` with how many of
those were answered right, and wrong; `done SERVICE` ends that. A line on stdin is answered with the names of all
other nodes, as JSON.
"""

from __future__ import annotations

import itertools
import json
import queue
import sys
import threading
from typing import Any

DOWN_S = 0.2
LONG_EVERY, LONG = 7, 1500
DEPTH = 2000
"""Samples that a reader may be behind: on a machine full of work DDS repeats late what it lost; 100 would be 20 s."""


class Ledger:
    """What came from whom."""

    def __init__(self, node: Any) -> None:
        from rcl_interfaces.srv import GetParameterTypes
        from rclpy.qos import DurabilityPolicy, QoSProfile
        from std_msgs.msg import String

        self._node = node
        self._service_class = GetParameterTypes
        self._string = String
        self._good: dict[tuple[str, str], int] = {}
        self._bad: dict[tuple[str, str], int] = {}
        self._calls: dict[str, tuple[Any, list[int]]] = {}
        self._number = 0
        latched = QoSProfile(depth=5000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_subscription(String, "/soak/up", self._arrived, latched)
        node.create_service(GetParameterTypes, "/soak/ledger", self._asked)
        self._down = node.create_publisher(String, "/soak/down", DEPTH)
        node.create_timer(DOWN_S, self._publish)

    def _arrived(self, message: Any) -> None:
        key, life, number, size, rest = message.data.split(":", 4)
        good = self._good.setdefault((key, life), 0)
        if int(number) == good and rest == "x" * int(size):
            self._good[key, life] = good + 1
        else:
            self._bad[key, life] = self._bad.get((key, life), 0) + 1

    def _publish(self) -> None:
        size = LONG if self._number % LONG_EVERY == 0 else 10
        self._down.publish(self._string(data=f"{self._number}:{size}:" + "x" * size))
        self._number += 1

    def _asked(self, request: Any, response: Any) -> Any:
        response.types = bytes(getattr(self, "_" + request.names[0])(*request.names[1:]))
        return response

    def _tally(self, key: str, life: str) -> list[int]:
        return [min(255, found.get((key, life), 0)) for found in (self._good, self._bad)]

    def _call(self, service: str, count: str) -> list[int]:
        self._hang_up(service)
        client = self._node.create_client(self._service_class, service)
        self._calls[service] = client, [int(count), 0, 0]
        return [0]

    def _called(self, service: str) -> list[int]:
        client, state = self._calls[service]
        if state[0] and client.service_is_ready():
            for i in range(state[0]):
                request = self._service_class.Request(names=["y" * i])
                future = client.call_async(request)
                future.add_done_callback(
                    lambda done, i=i: self._answered(state, list(done.result().types) == [i])
                )
            state[0] = 0
        return state[1:]

    def _answered(self, state: list[int], right: bool) -> None:
        state[1 if right else 2] += 1

    def _done(self, service: str) -> list[int]:
        self._hang_up(service)
        return [0]

    def _hang_up(self, service: str) -> None:
        if service in self._calls:
            self._node.destroy_client(self._calls.pop(service)[0])


def main() -> None:
    """Take part until stdin ends."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("soak_peer")
    Ledger(node)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    lines: queue.Queue[str] = queue.Queue()

    def listen() -> None:
        for line in itertools.chain(sys.stdin, [""]):
            lines.put(line)

    threading.Thread(target=listen, daemon=True).start()
    print("[]", flush=True)
    while True:
        executor.spin_once(timeout_sec=0.02)
        try:
            line = lines.get_nowait()
        except queue.Empty:
            continue
        if not line:
            return
        names = {f"{space.rstrip('/')}/{name}" for name, space in node.get_node_names_and_namespaces()}
        print(json.dumps(sorted(names - {"/soak_peer"})), flush=True)


if __name__ == "__main__":
    main()
