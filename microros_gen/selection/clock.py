# SPDX-License-Identifier: Apache-2.0
"""ROS time: what the application file says of the subscription of /clock, which `clock_ros` implies."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from microros_gen.application.model import CLOCK_TOPIC, Application, EndpointDecl, NodeDecl
from microros_gen.diagnostics import Diagnostics
from microros_gen.selection.model import Selection

CLOCK_ROS = "clock_ros"


def with_clock(application: Application, selection: Selection, diagnostics: Diagnostics) -> Application:
    """Return the application with its rule for /clock applied to the implied subscription.

    The rule of the first node counts, which has that subscription; any other rule for it is an error.
    """
    listens = selection.has(CLOCK_ROS)
    _check_rules(application.nodes[1:] if listens else application.nodes, listens, diagnostics)
    if not listens:
        return application
    if not application.nodes:
        return replace(application, implied=tuple(_placed(application, e, "") for e in application.implied))
    first, *others = application.nodes
    endpoints = tuple(_placed(application, e, first.clock_topic) for e in first.endpoints)
    return replace(application, nodes=(replace(first, endpoints=endpoints), *others))


def _placed(application: Application, endpoint: EndpointDecl, topic: str) -> EndpointDecl:
    """Return the implied subscription of /clock with its place in the file, and on `topic` where a rule says so."""
    if not endpoint.of_the_library or endpoint.topic != CLOCK_TOPIC:
        return endpoint
    endpoint = replace(endpoint, span=application.clock.span if application.clock else None)
    return replace(endpoint, topic=topic, declared_as=CLOCK_TOPIC) if topic else endpoint


def _check_rules(nodes: Iterable[NodeDecl], listens: bool, diagnostics: Diagnostics) -> None:
    """Report rules for /clock of nodes that do not subscribe to it."""
    for node in nodes:
        if node.clock_topic:
            hint = "Give the rule to the first node" if listens else "Select it with `clock: ros`"
            diagnostics.error(
                f"the node {node.name} does not subscribe to {CLOCK_TOPIC}",
                node.clock_span,
                hint,
                id="MG-4003",
            )
