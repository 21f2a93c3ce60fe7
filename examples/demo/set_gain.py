# SPDX-License-Identifier: Apache-2.0
"""An ordinary rclpy node: sets a parameter of the firmware, and prints what it sends before and after."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import Log
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from std_msgs.msg import Float64

FIRMWARE = "dimmer"
SAMPLES = 11
"""More than a period of the brightness."""
GAIN = 10.0
TIMEOUT_S = 30.0


class Operator(Node):
    """Keeps what the firmware sends."""

    def __init__(self) -> None:
        super().__init__("demo_operator")
        self.brightness: list[float] = []
        self.logs: list[str] = []
        self.changes: list[str] = []
        self.parameters = AsyncParameterClient(self, FIRMWARE)
        self.create_subscription(Float64, "brightness", lambda m: self.brightness.append(m.data), 10)
        self.create_subscription(Log, "/rosout", self.on_log, 100)
        self.create_subscription(DiagnosticArray, "/diagnostics", self.on_diagnostics, 10)

    def on_log(self, message: Log) -> None:
        """Keep the lines of the firmware."""
        if message.name == FIRMWARE:
            self.logs.append(message.msg)

    def on_diagnostics(self, message: DiagnosticArray) -> None:
        """Keep how often parameters have changed, as the firmware reports it."""
        self.changes += [item.value for status in message.status for item in status.values]


def wait(node: Operator, what: str, condition: Callable[[], object]) -> None:
    """Spin until `condition()`; exit with the name of what does not come."""
    end = time.monotonic() + TIMEOUT_S
    while not condition():
        if time.monotonic() >= end:
            sys.exit(f"operator: {what} did not come within {TIMEOUT_S:.0f} s")
        rclpy.spin_once(node, timeout_sec=0.1)


def set_parameter(node: Operator, parameter: Parameter) -> None:
    """Set a parameter and print the firmware's answer."""
    future = node.parameters.set_parameters([parameter])
    wait(node, "the answer", future.done)
    (result,) = future.result().results
    answer = "accepted" if result.successful else f"refused: {result.reason}"
    print(f"set {parameter.name} to {parameter.value}: {answer}", flush=True)


def highest(node: Operator) -> float:
    """Return the largest of the next samples."""
    node.brightness.clear()
    wait(node, "/brightness", lambda: len(node.brightness) >= SAMPLES)
    return max(node.brightness)


def main() -> int:
    """Return 0 when the new gain is seen in what the firmware sends."""
    rclpy.init()
    node = Operator()
    print("operator ready", flush=True)
    try:
        wait(node, "the node of the firmware", node.parameters.services_are_ready)
        before = highest(node)
        print(f"/brightness rises to {before}", flush=True)
        node.logs.clear()  # whether what the firmware logged when it started arrives depends on discovery
        set_parameter(node, Parameter("gain", value=GAIN))
        set_parameter(node, Parameter("gain", value=1000.0))
        set_parameter(node, Parameter("color", value="green"))
        after = highest(node)
        print(f"/brightness rises to {after}", flush=True)
        wait(node, "/diagnostics", lambda: "1" in node.changes)
        print("/diagnostics reports 1 change", flush=True)
        wait(node, "/rosout", lambda: len(node.logs) >= 2)
        for line in node.logs:
            print(f"/rosout: {line}", flush=True)
    except (KeyboardInterrupt, ExternalShutdownException):
        return 130
    return 0 if after == GAIN * before else 1


if __name__ == "__main__":
    sys.exit(main())
