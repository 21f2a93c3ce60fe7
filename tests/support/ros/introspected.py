# SPDX-License-Identifier: Apache-2.0
"""A node of rclpy with service introspection (best effort at /unheard), and a simulation at twice the speed."""

from __future__ import annotations

import time
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import qos_profile_sensor_data, qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Temperature
from std_srvs.srv import SetBool

PERIOD_S = 0.1
SPEED = 2
LATE_S = 3
"""Age of the stamp in each message of /ticks, in the time of the simulation."""


def main() -> None:
    rclpy.init()
    node: Any = rclpy.create_node("introspected")
    service = node.create_service(SetBool, "enable", _enable)
    service.configure_introspection(
        node.get_clock(), qos_profile_system_default, ServiceIntrospectionState.CONTENTS
    )
    node.create_service(SetBool, "silent", _enable)
    unheard = node.create_service(SetBool, "unheard", _enable)
    unheard.configure_introspection(
        node.get_clock(), qos_profile_sensor_data, ServiceIntrospectionState.CONTENTS
    )
    clock, ticks = node.create_publisher(Clock, "/clock", 1), node.create_publisher(Temperature, "ticks", 10)
    began = time.monotonic()

    def publish() -> None:
        now = 1000 + SPEED * (time.monotonic() - began)
        message = Clock()
        message.clock.sec, message.clock.nanosec = int(now), int(now % 1 * 1e9)
        clock.publish(message)
        tick = Temperature()
        tick.header.stamp.sec, tick.header.stamp.nanosec = int(now - LATE_S), int(now % 1 * 1e9)
        ticks.publish(tick)

    node.create_timer(PERIOD_S, publish)
    print("ready", flush=True)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        return


def _enable(request: Any, response: Any) -> Any:
    response.success, response.message = request.data, "enabled" if request.data else "disabled"
    return response


if __name__ == "__main__":
    main()
