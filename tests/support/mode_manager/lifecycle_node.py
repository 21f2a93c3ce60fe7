# SPDX-License-Identifier: Apache-2.0
"""A life cycle node of rclpy in a process: `python -m … NAME NAMESPACE JSON`, with the parameters of JSON.

The boolean parameters `refuse_activation`, `refuse_parameters`, `end_finalized` and the double `late_s` let it fail.
With `only_inactive` it takes parameters only while it is inactive.
"""

from __future__ import annotations

import json
import sys
import time
from contextlib import suppress
from typing import Any

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node

FAULTS: dict[str, Any] = {
    "refuse_activation": False,
    "refuse_parameters": False,
    "end_finalized": False,
    "only_inactive": False,
    "late_s": 0.0,
}


class FaultyNode(LifecycleNode):
    """Fails as its parameters say."""

    def __init__(self, name: str, namespace: str, values: dict[str, Any]) -> None:
        super().__init__(name, namespace=namespace)
        self._is_active = False
        for key, value in {**FAULTS, **values}.items():
            self.declare_parameter(key, value)
        self.add_on_set_parameters_callback(self._decide)

    def _decide(self, parameters: list[Any]) -> SetParametersResult:
        is_fault = all(parameter.name in FAULTS for parameter in parameters)
        if is_fault:
            return SetParametersResult(successful=True)
        if self.get_parameter("only_inactive").value and self._is_active:
            return SetParametersResult(successful=False, reason="only while inactive")
        refuses = self.get_parameter("refuse_parameters").value
        return SetParametersResult(successful=not refuses, reason="not now" if refuses else "")

    def on_activate(self, state: Any) -> TransitionCallbackReturn:
        time.sleep(self.get_parameter("late_s").value)
        if self.get_parameter("end_finalized").value:
            return TransitionCallbackReturn.ERROR
        if self.get_parameter("refuse_activation").value:
            return TransitionCallbackReturn.FAILURE
        self._is_active = True
        return super().on_activate(state)

    def on_deactivate(self, state: Any) -> TransitionCallbackReturn:
        self._is_active = False
        return super().on_deactivate(state)

    def on_error(self, _: Any) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.FAILURE


def main() -> None:
    name, namespace, text = sys.argv[1:4]
    rclpy.init()
    values = json.loads(text)
    if values.pop("plain", False):
        node = Node(name, namespace=namespace)
        for key, value in values.items():
            node.declare_parameter(key, value)
    else:
        node = FaultyNode(name, namespace, values)
    print("node ready", flush=True)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
