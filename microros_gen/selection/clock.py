# SPDX-License-Identifier: Apache-2.0
"""ROS time: the subscription of /clock, which the component `clock_ros` opens without a word of the application."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from microros_gen.application.model import CLOCK_TOPIC, Application, EndpointDecl, NodeDecl, Qos
from microros_gen.diagnostics import Diagnostics
from microros_gen.selection.model import Selection

CLOCK_ROS = "clock_ros"
CLOCK_TYPE = "rosgraph_msgs/msg/Clock"


def with_clock(application: Application, selection: Selection, diagnostics: Diagnostics) -> Application:
    """Return the application with the subscription of /clock where `clock_ros` is selected.

    Its QoS is that of rclcpp::ClockQoS: best effort, and the newest sample alone counts. It is the first subscription
    of all: with `nodes:` it belongs to the first node, whose rule for /clock counts; any other rule for it is an error.
    """
    listens = selection.has(CLOCK_ROS)
    _check_rules(application.nodes[1:] if listens else application.nodes, listens, diagnostics)
    if not listens:
        return application
    span = application.clock.span if application.clock else None
    qos = Qos(reliability="best_effort", depth=1)
    clock = EndpointDecl(
        "subscription", CLOCK_TOPIC, CLOCK_TYPE, qos, span=span, queue=1, of_the_library=True
    )
    if not application.nodes:
        return replace(application, implied=(clock,))
    first, *others = application.nodes
    if first.clock_topic:
        clock = replace(clock, topic=first.clock_topic, given=CLOCK_TOPIC)
    return replace(application, nodes=(replace(first, endpoints=(clock, *first.endpoints)), *others))


def _check_rules(nodes: Iterable[NodeDecl], listens: bool, diagnostics: Diagnostics) -> None:
    """Report rules for /clock of nodes that do not subscribe to it."""
    for node in nodes:
        if node.clock_topic:
            hint = "Give the rule to the first node" if listens else "Select it with `clock: ros`"
            diagnostics.error(
                f"the node {node.name} does not subscribe to {CLOCK_TOPIC}", node.clock_span, hint
            )
