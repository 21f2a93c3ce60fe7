# SPDX-License-Identifier: Apache-2.0
"""ROS time: the subscription of /clock, which the component `clock_ros` opens without a word of the application."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.model.application import Application, EndpointDecl, Qos
from microros_gen.model.selection import Selection

CLOCK_ROS = "clock_ros"
CLOCK_TOPIC = "/clock"
CLOCK_TYPE = "rosgraph_msgs/msg/Clock"


def with_clock(application: Application, selection: Selection) -> Application:
    """Return the application with the subscription of /clock where `clock_ros` is selected.

    Its QoS is that of rclcpp::ClockQoS: best effort, and the newest sample alone counts. It is the first subscription
    of all: with `nodes:` it belongs to the first node.
    """
    if not selection.has(CLOCK_ROS):
        return application
    span = application.clock.span if application.clock else None
    qos = Qos(reliability="best_effort", depth=1)
    clock = EndpointDecl(
        "subscription", CLOCK_TOPIC, CLOCK_TYPE, qos, span=span, queue=1, of_the_library=True
    )
    if not application.nodes:
        return replace(application, implied=(clock,))
    first, *others = application.nodes
    return replace(application, nodes=(replace(first, endpoints=(clock, *first.endpoints)), *others))
