# SPDX-License-Identifier: Apache-2.0
"""Endpoints that the library opens by itself: those that the selected components state in their `implies`."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.diagnostics import Diagnostics
from microros_gen.selection.model import Selection


def with_implied(application: Application, selection: Selection, diagnostics: Diagnostics) -> Application:
    """Return the application with the endpoints that its components imply, before its own ones.

    With `nodes:` an endpoint belongs to the first node, or one to every node. Without them the library opens
    subscriptions alone by itself, once: for anything else the nodes have to be declared.
    """
    once = _endpoints(selection, every_node=False)
    each = _endpoints(selection, every_node=True)
    if application.nodes:
        first, *others = application.nodes
        nodes = (_with(first, (*once, *each)), *(_with(node, each) for node in others))
        return replace(application, nodes=nodes)
    refused = [e for e in once if e.kind != "subscription"]
    for endpoint in (*refused, *each):
        diagnostics.error(
            f"the {endpoint.kind} '{endpoint.topic}', which a component opens by itself, needs a declared node",
            application.spans.get("components"),
            "Declare the nodes: `nodes: [{name: …}]`",
            id="MG-4021",
        )
    return replace(application, implied=once)


def _endpoints(selection: Selection, every_node: bool) -> tuple[EndpointDecl, ...]:
    return tuple(
        EndpointDecl(i.kind, i.name, i.type, i.qos, queue=i.queue, of_the_library=True)
        for chosen in selection.components
        for i in chosen.component.implies
        if i.every_node == every_node
    )


def _with(node: NodeDecl, endpoints: tuple[EndpointDecl, ...]) -> NodeDecl:
    return replace(node, endpoints=(*endpoints, *node.endpoints)) if endpoints else node
