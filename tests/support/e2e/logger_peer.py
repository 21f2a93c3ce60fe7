# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that reads and sets levels of loggers, and has a node with rclpy's own logger services as the model.

One JSON object a line: {"node": "/arm/device", "get": ["arm"]} or {"node": …, "set": [["arm", 30]]}; the answer is the
response, null without one in time.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import seconds

MODEL = "/model/device"


class LoggerPeer(LineProcess):
    """The test's side."""

    def get(self, node: str, *names: str) -> Any:
        return self.ask(node=node, get=names, timeout=seconds(30))

    def set(self, node: str, *levels: tuple[str, int]) -> Any:
        return self.ask(node=node, set=levels, timeout=seconds(30))


@contextmanager
def logger_peer(domain: int) -> Iterator[LoggerPeer]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.logger_peer", domain) as process:
        yield LoggerPeer(process)


def _answer(node: Any, command: dict[str, Any]) -> Any:
    from rcl_interfaces.msg import LoggerLevel
    from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

    kind, name = (GetLoggerLevels, "get") if "get" in command else (SetLoggerLevels, "set")
    client = node.create_client(kind, f"{command['node']}/{name}_logger_levels")
    if not client.wait_for_service(command["timeout"]):
        return None
    request = (
        GetLoggerLevels.Request(names=command["get"])
        if name == "get"
        else SetLoggerLevels.Request(levels=[LoggerLevel(name=n, level=v) for n, v in command["set"]])
    )
    done = threading.Event()
    future = client.call_async(request)
    future.add_done_callback(lambda _: done.set())
    if not done.wait(command["timeout"]):
        return None
    if name == "get":
        return [[level.name, level.level] for level in future.result().levels]
    return [[result.successful, result.reason] for result in future.result().results]


def main() -> None:
    """Serve commands from stdin; callbacks run in a thread."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("asker")
    model = rclpy.create_node("device", namespace="/model", enable_logger_service=True)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(model)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        print(json.dumps(_answer(node, json.loads(line))), flush=True)


if __name__ == "__main__":
    main()
