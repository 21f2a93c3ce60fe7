# SPDX-License-Identifier: Apache-2.0
"""What the topic of micro_ros_agent takes: a declared node, and entities that the client creates."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

LONGEST_NAME = 95
"""Bytes of a name or type that is read, without its NUL, where the application has no limit."""
_PACKAGE = "micro_ros_msgs/msg"


@dataclass(frozen=True)
class GraphTopicPlan:
    """Nothing: the component `graph` has the sizes."""


def plan(context: PlanContext, diagnostics: Diagnostics) -> GraphTopicPlan:
    """Report what the topic cannot be read with."""
    if not context.application.nodes:
        diagnostics.error(
            "the component 'graph_topic' needs a declared node",
            context.application.spans.get("components"),
            "Declare the nodes: `nodes: [{name: device}]`",
            id="MG-7047",
        )
    if context.selection.entities == "preconfigured":
        diagnostics.error(
            "the component 'graph_topic' cannot be used with 'entities: preconfigured': for each query the agent"
            " replaces the reader",
            context.application.spans.get("entities"),
            "Use `entities: binary`, or the component 'graph' with a graph server",
            id="MG-7048",
        )
    return GraphTopicPlan()


def record(part: GraphTopicPlan) -> object:
    """Return what the plan id is made of."""
    return []


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bound of a name that is read; the message itself is never in memory."""
    own = {rule.path for rule in application.limits}
    rules = (
        LimitRule((f"{_PACKAGE}/Graph", "nodes"), None, 0),
        LimitRule((f"{_PACKAGE}/Node", "node_namespace"), LONGEST_NAME, None),
        LimitRule((f"{_PACKAGE}/Node", "node_name"), LONGEST_NAME, None),
        LimitRule((f"{_PACKAGE}/Node", "entities"), None, 0),
        LimitRule((f"{_PACKAGE}/Entity", "name"), LONGEST_NAME, None),
        LimitRule((f"{_PACKAGE}/Entity", "types"), LONGEST_NAME, 0),
    )
    return tuple(rule for rule in rules if rule.path not in own)
