# SPDX-License-Identifier: Apache-2.0
"""Endpoints that the library opens by itself: those that the selected components state in their `implies`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from microros_gen.application.kinds import KIND
from microros_gen.application.model import (
    Application,
    EndpointChange,
    EndpointDecl,
    LimitRule,
    NodeDecl,
)
from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.selection.component import Catalogue, Component, Implied
from microros_gen.selection.model import Selection
from microros_gen.selection.profile_nodes import with_default_node


def with_implied(
    application: Application, selection: Selection, catalogue: Catalogue, diagnostics: Diagnostics
) -> Application:
    """Return the application with the endpoints that its components imply, before its own ones.

    With `nodes:` an endpoint belongs to the first node, or one to every node. Without them the library opens
    subscriptions alone by itself, once: for anything else the nodes have to be declared. An application that says
    nothing of entities has one node then.
    """
    changes = {change.name: change for change in application.endpoints}
    once = _endpoints(selection, changes, every_node=False)
    each = _endpoints(selection, changes, every_node=True)
    _check_changes(application, (*once, *each), catalogue, diagnostics)
    chosen = [item.component for item in selection.components]
    application = with_default_node(application, chosen)
    if application.nodes:
        first, *others = application.nodes
        nodes = (_with(first, (*once, *each)), *(_with(node, each) for node in others))
        return replace(application, nodes=nodes)
    # A component that is not ready is refused already: its endpoints would only be a second error.
    if all(chosen.component.ready for chosen in selection.components):
        _refuse([*(e for e in once if e.kind != "subscription"), *each], selection, diagnostics)
    return replace(application, implied=once)


def _refuse(endpoints: Sequence[EndpointDecl], selection: Selection, diagnostics: Diagnostics) -> None:
    """Report endpoints that need a declared node: in one message, since one line fixes all of them."""
    if not endpoints:
        return
    first, others = endpoints[0], len(endpoints) - 1
    more = f" (and {others} more)" if others else ""
    openers = (c for c in selection.components if first.topic in [i.name for i in c.component.implies])
    places = (cause.span for opener in openers for cause in opener.causes)
    diagnostics.error(
        f"the {first.kind} '{first.topic}'{more}, which a component opens by itself, needs a declared node",
        next((place for place in places if place is not None), None),
        "Declare the nodes: `nodes: [{name: device}]`",
        id="MG-4021",
    )


def _endpoints(
    selection: Selection, changes: Mapping[str, EndpointChange], every_node: bool
) -> tuple[EndpointDecl, ...]:
    return tuple(
        _endpoint(implied, changes.get(implied.name))
        for chosen in selection.components
        for implied in chosen.component.implies
        if implied.every_node == every_node and not (implied.unless and selection.has(implied.unless))
    )


def _endpoint(implied: Implied, change: EndpointChange | None) -> EndpointDecl:
    endpoint = EndpointDecl(
        *(implied.kind, implied.name, implied.type, implied.qos),
        queue=implied.queue,
        stored=implied.stored,
        of_the_library=True,
        executed=implied.executed,
        usual_limits=implied.limits,
        streamed=implied.streamed,
        outside_ros=implied.outside_ros,
    )
    if change is None:
        return endpoint
    qos = endpoint.qos if change.depth is None else replace(endpoint.qos, depth=change.depth)
    queue = endpoint.queue if change.queue is None else change.queue
    limits = tuple(_below(rule, implied.type) for rule in change.limits)
    return replace(endpoint, qos=qos, queue=queue, limits=limits, span=change.span)


def _below(rule: LimitRule, type_name: str) -> LimitRule:
    """Return a rule whose path begins with the type."""
    return rule if rule.path == ("*",) else replace(rule, path=(type_name, *rule.path[1:]))


def _check_changes(
    application: Application,
    endpoints: Iterable[EndpointDecl],
    catalogue: Catalogue,
    diagnostics: Diagnostics,
) -> None:
    """Report each change of an endpoint that no selected component opens, or of a queue that it does not have."""
    kinds = {endpoint.topic: KIND[endpoint.kind] for endpoint in endpoints}
    for change in application.endpoints:
        kind = kinds.get(change.name)
        if kind is None:
            message = f"no selected component opens an endpoint '{change.name}'"
            opening = next((c for c in catalogue.values() if _opens(c, change.name)), None)
            hint = (
                f"Add `components: [+{opening.name}]`" if opening is not None else nearest(change.name, kinds)
            )
            hint = hint or "Endpoints of `nodes:` have their settings there"
            diagnostics.error(message, change.span, hint, id="MG-4049")
        elif change.queue is not None and not kind.receives:
            message = f"the {kind.name} '{change.name}' has no queue"
            diagnostics.error(message, change.span, "Remove `queue`, or write `depth`", id="MG-4050")


def _opens(component: Component, name: str) -> bool:
    return component.ready and any(implied.name == name for implied in component.implies)


def _with(node: NodeDecl, endpoints: tuple[EndpointDecl, ...]) -> NodeDecl:
    return replace(node, endpoints=(*endpoints, *node.endpoints)) if endpoints else node
