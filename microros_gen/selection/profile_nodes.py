# SPDX-License-Identifier: Apache-2.0
"""Nodes of profiles: those of an application that says nothing of entities."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any

from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.selection.component import Component, ResolvedProfile
from microros_gen.selection.declared import without_components

_OF_ENTITIES = frozenset({"nodes", "interfaces", "pools"})
"""Keys of an application file that say which entities there are."""
_NODE = NodeDecl(name="device", endpoints=(EndpointDecl("publisher", "count", "std_msgs/msg/Int32"),))
_NAMES = ("name", "topic", "node")
"""Attributes, of which a part of a node has one: what it is called."""


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
    """Return one node with the parts of both; of two parts with one name it has that of the first node."""
    parts: dict[str, Any] = {
        field.name: _once((*own, *getattr(other, field.name)))
        for field in fields(NodeDecl)
        if isinstance(own := getattr(first, field.name), tuple)
    }
    return replace(
        first,
        parameters_at=first.parameters_at or other.parameters_at,
        clock_topic=first.clock_topic or other.clock_topic,
        clock_span=first.clock_span or other.clock_span,
        **parts,
    )


def _once(parts: Iterable[object]) -> tuple[object, ...]:
    found: dict[tuple[str, str], object] = {}
    for part in parts:
        name = next(getattr(part, key) for key in _NAMES if hasattr(part, key))
        found.setdefault((getattr(part, "kind", ""), name), part)
    return tuple(found.values())
