# SPDX-License-Identifier: Apache-2.0
"""Bounds of the names in a request, which are those of the component `graph`; its topic has no QoS."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.components.graph.plan import LONGEST_NAME
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

_REQUEST = "microros_graph_msgs/srv/EndpointStatus_Request"


@dataclass(frozen=True)
class GraphEventsPlan:
    """Nothing: the component `graph` has the sizes."""


def plan(context: PlanContext, diagnostics: Diagnostics) -> GraphEventsPlan:
    """Report what a request cannot be made with."""
    refuse_own_limits(context, "graph_events", diagnostics)
    if context.selection.has("graph_topic"):
        diagnostics.error(
            "the component 'graph_events' needs a graph server, and 'graph_topic' replaces it",
            context.application.spans.get("components"),
            "Remove 'graph_topic': the topic of micro_ros_agent has no QoS",
            id="MG-7161",
        )
    return GraphEventsPlan()


def record(part: GraphEventsPlan) -> object:
    """Return what the plan id is made of."""
    return []


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of a request; they follow the application's bound of a name."""
    own = {rule.path: rule for rule in application.limits}
    name = own.get(("microros_graph_msgs/msg/Name", "name"))
    longest = name.string if name is not None and name.string is not None else LONGEST_NAME
    rules = (LimitRule((_REQUEST, member), longest, None) for member in ("topic", "node"))
    return tuple(rule for rule in rules if rule.path not in own)
