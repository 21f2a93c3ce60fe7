# SPDX-License-Identifier: Apache-2.0
"""A node of the robot that runs under Linux: an ordinary lifecycle node of rclpy with one parameter.

It knows nothing of modes: the mode manager sets its parameter and infers the mode from the value.
"""

from __future__ import annotations

import argparse
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn


class RobotNode(LifecycleNode):
    """Reports each transition."""

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Accept."""
        return self.accept("configured")

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Accept."""
        super().on_activate(state)
        return self.accept("activated")

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Accept."""
        super().on_deactivate(state)
        return self.accept("deactivated")

    def accept(self, what: str) -> TransitionCallbackReturn:
        """Log a transition."""
        self.get_logger().info(what)
        return TransitionCallbackReturn.SUCCESS


def main() -> int:
    """Spin until the robot ends."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name")
    parser.add_argument("parameter")
    parser.add_argument("value", type=lambda text: float(text) if text[:1].isdigit() else text)
    options = parser.parse_args()
    rclpy.init()
    node = RobotNode(options.name)
    node.declare_parameter(options.parameter, options.value)
    print(f"{options.name} ready", flush=True)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
