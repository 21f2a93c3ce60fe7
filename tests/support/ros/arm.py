# SPDX-License-Identifier: Apache-2.0
"""Nodes of rclpy for commands on a graph: /arm with topics, parameters, a service and an action, and /gripper."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.action.server import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu
from std_msgs.msg import Int32
from std_srvs.srv import SetBool
from test_msgs.action import Fibonacci

PERIOD_S = 0.1
FEEDBACK_S = 0.05


def main() -> None:
    rclpy.init()
    arm: Any = rclpy.create_node("arm")
    limits = FloatingPointRange(from_value=0.0, to_value=10.0, step=0.5)
    arm.declare_parameter("gain", 1.5, ParameterDescriptor(description="how", floating_point_range=[limits]))
    arm.declare_parameter("names", ["a", "b"])
    arm.declare_parameter("limits.low", 3)
    arm.declare_parameter("spare", 7, ParameterDescriptor(dynamic_typing=True))
    counter = arm.create_publisher(Int32, "count", 10)
    imu = arm.create_publisher(Imu, "imu", QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT))
    counted = [0]

    def publish() -> None:
        counted[0] += 1
        counter.publish(Int32(data=counted[0]))
        sample = Imu()
        sample.header.stamp = arm.get_clock().now().to_msg()
        sample.header.frame_id = "base"
        imu.publish(sample)

    arm.create_timer(PERIOD_S, publish)
    arm.create_subscription(Int32, "numbers", lambda message: print(f"number {message.data}", flush=True), 10)
    arm.create_service(SetBool, "enable", _enable)
    server = ActionServer(
        arm,
        Fibonacci,
        "fibonacci",
        _fibonacci,
        goal_callback=None,
        cancel_callback=lambda _: CancelResponse.ACCEPT,
        callback_group=ReentrantCallbackGroup(),
    )
    executor = MultiThreadedExecutor()
    executor.add_node(arm)
    executor.add_node(LifecycleNode("gripper"))
    print("ready", flush=True)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        server.destroy()


def _enable(request: Any, response: Any) -> Any:
    response.success, response.message = request.data, "enabled" if request.data else "disabled"
    return response


def _fibonacci(goal: Any) -> Any:
    found = [0, 1]
    while len(found) <= goal.request.order:
        if goal.is_cancel_requested:
            goal.canceled()
            print("canceled", flush=True)
            return Fibonacci.Result(sequence=found)
        found.append(found[-1] + found[-2])
        goal.publish_feedback(Fibonacci.Feedback(sequence=found[:40]))
        time.sleep(FEEDBACK_S)
        found = found[:60]
    goal.succeed()
    return Fibonacci.Result(sequence=found)


if __name__ == "__main__":
    main()
