# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that calls a service and sets a parameter in turns, and notes when it did.

One JSON object a line: {"node": "/arm/device", "service": "/arm/turn", "parameter": "steps", "times": 100} answers
{"round_trips_ns": […], "set_at_ns": […]} by the monotonic clock of the machine.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from typing import Any


class _Caller:
    """Calls one after the other; callbacks run in a thread."""

    def __init__(self, node: Any, command: dict[str, Any]) -> None:
        from rclpy.parameter_client import AsyncParameterClient
        from std_srvs.srv import SetBool

        self._request = SetBool.Request(data=True)
        self._client = node.create_client(SetBool, command["service"])
        self._parameters = AsyncParameterClient(node, command["node"])
        self._name, self._times = command["parameter"], command["times"]
        assert self._client.wait_for_service(command["timeout"])
        assert self._parameters.wait_for_services(command["timeout"])

    def run(self) -> dict[str, list[int]]:
        from rclpy.parameter import Parameter

        round_trips, set_at = [], []
        for i in range(self._times):
            start = time.monotonic_ns()
            assert _done(self._client.call_async(self._request)).success
            round_trips.append(time.monotonic_ns() - start)
            change = [Parameter(self._name, value=i).to_parameter_msg()]
            set_at.append(time.monotonic_ns())
            (result,) = _done(self._parameters.set_parameters(change)).results
            assert result.successful, result.reason
        return {"round_trips_ns": round_trips, "set_at_ns": set_at}


def _done(future: Any) -> Any:
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    assert done.wait(60)
    return future.result()


def main() -> None:
    """Serve commands from stdin."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("parameter_times_asker", start_parameter_services=False)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        print(json.dumps(_Caller(node, json.loads(line)).run()), flush=True)


if __name__ == "__main__":
    main()
