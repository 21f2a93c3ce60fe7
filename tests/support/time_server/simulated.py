# SPDX-License-Identifier: Apache-2.0
"""A node of rclpy with use_sim_time in a process: follows orders, a JSON object a line, and answers with another one.

`{"set": {"speed": 2.0}}` sets parameters of the time server at one moment, by rclpy's client. Every answer has
the time, `now`, in seconds, and the differences of all jumps so far, `jumps`.
"""

from __future__ import annotations

import json
import sys
import threading
from typing import Any

import rclpy
from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient

_NS_PER_S = 1e9


class Simulated:
    """The node, which spins in a thread."""

    def __init__(self) -> None:
        rclpy.init(args=[])
        use_sim_time = Parameter("use_sim_time", Parameter.Type.BOOL, True)
        self.node = Node("simulated_rclpy", parameter_overrides=[use_sim_time])
        self.jumps: list[float] = []
        threshold = JumpThreshold(
            min_forward=Duration(seconds=5), min_backward=Duration(nanoseconds=-1), on_clock_change=False
        )
        self._handle = self.node.get_clock().create_jump_callback(threshold, post_callback=self._jumped)
        self._client = AsyncParameterClient(self.node, "/microros_time")
        executor = SingleThreadedExecutor()
        executor.add_node(self.node)
        threading.Thread(target=executor.spin, daemon=True).start()

    def _jumped(self, jump: Any) -> None:
        self.jumps.append(jump.delta.nanoseconds / _NS_PER_S)

    def set(self, values: dict[str, Any]) -> str:
        """Set parameters; return the reason of a refusal."""
        assert self._client.wait_for_services(60.0)
        done = threading.Event()
        future = self._client.set_parameters_atomically([Parameter(k, value=v) for k, v in values.items()])
        future.add_done_callback(lambda _: done.set())
        assert done.wait(60.0)
        return str(future.result().result.reason)

    def now_s(self) -> float:
        """Return the time of the node's clock."""
        return float(self.node.get_clock().now().nanoseconds / _NS_PER_S)


def main() -> None:
    """Answer orders until the input ends."""
    simulated = Simulated()
    for line in sys.stdin:
        order = json.loads(line)
        reason = simulated.set(order["set"]) if "set" in order else ""
        answer = {"reason": reason, "now": simulated.now_s(), "jumps": simulated.jumps}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
