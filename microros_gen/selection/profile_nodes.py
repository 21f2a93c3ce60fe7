# SPDX-License-Identifier: Apache-2.0
"""Nodes of profiles: those of an application that says nothing of entities."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TypeVar

from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.selection.component import Component, ResolvedProfile
from microros_gen.selection.declared import without_components

_OF_ENTITIES = frozenset({"nodes", "interfaces", "pools"})
"""Keys of an application file that say which entities there are."""
_NODE = NodeDecl(name="device", endpoints=(EndpointDecl("publisher", "count", "std_msgs/msg/Int32"),))
_Part = TypeVar("_Part")


def with_profile_nodes(application: Application, profiles: Iterable[ResolvedProfile]) -> Application:
    """Return the application with the nodes of its profiles, unless it says itself which entities there are.

    What needs a component that the application drops is not among them.
    """
    if not _is_silent(application):
        return application
    nodes = joined_nodes(node for profile in profiles for node in profile.nodes)
    dropped = {change.name for change in application.components if not change.add}
    return replace(application, nodes=without_components(nodes, dropped))


def with_default_node(application: Application, components: Iterable[Component]) -> Application:
    """Return the application with one node where no profile has any, if its components open endpoints in every node."""
    each = any(implied.every_node for component in components for implied in component.implies)
    return replace(application, nodes=(_NODE,)) if each and _is_silent(application) else application


def _is_silent(application: Application) -> bool:
    """Return whether nothing says which entities there are."""
    return not application.nodes and not _OF_ENTITIES & application.spans.keys()


def joined_nodes(nodes: Iterable[NodeDecl]) -> tuple[NodeDecl, ...]:
    """Return each node once: nodes of one full name are one, with what any of them has; the first one wins."""
    found: dict[str, NodeDecl] = {}
    for node in nodes:
        name = node.full_name
        found[name] = _joined(found[name], node) if name in found else node
    return tuple(found.values())


def _joined(first: NodeDecl, other: NodeDecl) -> NodeDecl:
    return replace(
        first,
        endpoints=_once((e.kind, e.topic, e) for e in (*first.endpoints, *other.endpoints)),
        timers=_once(("", t.name, t) for t in (*first.timers, *other.timers)),
        parameters=_once(("", p.name, p) for p in (*first.parameters, *other.parameters)),
        parameters_at=first.parameters_at or other.parameters_at,
        parameter_clients=_once(
            ("", c.node, c) for c in (*first.parameter_clients, *other.parameter_clients)
        ),
        modes=_once(("", m.name, m) for m in (*first.modes, *other.modes)),
        actions=_once(("", a.name, a) for a in (*first.actions, *other.actions)),
        action_clients=_once(("", a.name, a) for a in (*first.action_clients, *other.action_clients)),
        executors=_once(("", e.name, e) for e in (*first.executors, *other.executors)),
        clock_topic=first.clock_topic or other.clock_topic,
        clock_span=first.clock_span or other.clock_span,
    )


def _once(named: Iterable[tuple[str, str, _Part]]) -> tuple[_Part, ...]:
    found: dict[tuple[str, str], _Part] = {}
    for kind, name, part in named:
        found.setdefault((kind, name), part)
    return tuple(found.values())
