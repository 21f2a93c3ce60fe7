# SPDX-License-Identifier: Apache-2.0
"""An rclpy process with a node /motor that has parameters.

One JSON object a line: {"do": "start"}, {"do": "stop"} (destroys the node), {"do": "set", "name": "gain", "value": 3},
{"do": "value", "name": "gain"}, {"do": "matched"} (subscriptions of its events).
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving

VALUES: dict[str, Any] = {
    "truth": True,
    "gain": 3,
    "rate": 0.5,
    "label": "left",
    "bytes": [b"\0", b"\xff"],
    "truths": [True, False],
    "counts": [1, -(2**40)],
    "rates": [0.5, -2.0],
    "labels": ["a", "left"],
}
"""What the node declares, besides `limited`: an integer from 0 to 10, `share`: a double, and `fixed`: read only."""


@contextmanager
def remote_parameters(domain: int) -> Iterator[LineProcess]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.remote_parameters", domain) as process:
        yield LineProcess(process)


class _Peer:
    def __init__(self, executor: Any) -> None:
        self._executor = executor
        self._node: Any = None

    def start(self) -> bool:
        import rclpy
        from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

        self._node = rclpy.create_node("motor")
        for name, content in VALUES.items():
            self._node.declare_parameter(name, content)
        limits = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10, step=1)])
        self._node.declare_parameter("limited", 1, limits)
        part = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.25)
        share = ParameterDescriptor(
            description="Share of power",
            additional_constraints="a multiple of 0.25",
            floating_point_range=[part],
        )
        self._node.declare_parameter("share", 0.5, share)
        self._node.declare_parameter("fixed", 1, ParameterDescriptor(read_only=True))
        self._executor.add_node(self._node)
        return True

    def stop(self) -> bool:
        self._executor.remove_node(self._node)
        self._node.destroy_node()
        return True

    def set(self, name: str, value: Any) -> bool:
        from rclpy.parameter import Parameter

        (result,) = self._node.set_parameters([Parameter(name, value=value)])
        return bool(result.successful)

    def value(self, name: str) -> Any:
        content = self._node.get_parameter(name).value
        listed = [*content] if not isinstance(content, (bool, int, float, str)) else content
        return (
            [b.hex() if isinstance(b, bytes) else b for b in listed] if isinstance(listed, list) else listed
        )

    def matched(self) -> int:
        return int(self._node.count_subscribers("/parameter_events"))


def main() -> None:
    """Serve commands from stdin; a thread spins."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(rclpy.create_node("watcher"))
    threading.Thread(target=executor.spin, daemon=True).start()
    peer = _Peer(executor)
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
