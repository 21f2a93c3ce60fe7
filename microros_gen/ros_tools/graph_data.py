# SPDX-License-Identifier: Apache-2.0
"""The ROS graph as data: nodes, and what they exchange over topics, services and actions."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.records import dataclass
from microros_gen.ros.graph import Graph, Names
from microros_gen.ros_tools.discovery import action_names, is_hidden

_USUAL_TOPICS = ("/parameter_events", "/rosout")
_USUAL_SERVICES = (
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "get_type_description",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
)
"""What nearly every node of ROS 2 has: a picture of a graph leaves it out."""


@dataclass(frozen=True)
class NodeView:
    """What a node has; names are fully qualified and sorted."""

    name: str
    subscriptions: Names = ()
    publishers: Names = ()
    service_servers: Names = ()
    service_clients: Names = ()

    @property
    def action_servers(self) -> Names:
        """The actions that it serves."""
        return action_names(self.service_servers)

    @property
    def action_clients(self) -> Names:
        """The actions that it has clients of."""
        return action_names(self.service_clients)

    def shown(self, hidden: bool) -> NodeView:
        """Return it without hidden names, unless `hidden`."""
        if hidden:
            return self
        kept = (
            visible(names)
            for names in (self.subscriptions, self.publishers, self.service_servers, self.service_clients)
        )
        return NodeView(self.name, *kept)

    def without_usual(self) -> NodeView:
        """Return it without what nearly every node has."""
        return NodeView(
            self.name,
            _without_topics(self.subscriptions),
            _without_topics(self.publishers),
            _without_services(self.service_servers),
            _without_services(self.service_clients),
        )


def node_view(graph: Graph, node: str) -> NodeView:
    """Return what a node has; nothing if it is gone."""
    found = (
        graph.subscriptions_of(node),
        graph.publishers_of(node),
        graph.services_of(node),
        graph.clients_of(node),
    )
    return NodeView(node, *(names or () for names in found))


def visible(names: Names) -> Names:
    """Return the names that ROS 2 does not hide."""
    return tuple(entry for entry in names if not is_hidden(entry[0]))


def _without_topics(names: Names) -> Names:
    return tuple(entry for entry in names if entry[0] not in _USUAL_TOPICS)


def _without_services(names: Names) -> Names:
    return tuple(entry for entry in names if entry[0].rpartition("/")[2] not in _USUAL_SERVICES)


Vertex = tuple[str, str]
"""Kind (`node`, `topic`, `service` or `action`) and name."""


@dataclass(frozen=True)
class GraphView:
    """The graph as vertices and arrows, sorted. An arrow goes the way of a message or request."""

    vertices: tuple[Vertex, ...]
    edges: tuple[tuple[Vertex, Vertex], ...]


def graph_view(nodes: Iterable[NodeView], usual: bool = False) -> GraphView:
    """Return the graph of `nodes`; `usual`: with what nearly every node has. Nodes that share a name are one."""
    vertices: set[Vertex] = set()
    edges: set[tuple[Vertex, Vertex]] = set()
    for node in nodes:
        own: Vertex = ("node", node.name)
        vertices.add(own)
        shown = node.shown(False)
        shown = shown if usual else shown.without_usual()
        outgoing = (
            ("topic", shown.publishers),
            ("service", shown.service_clients),
            ("action", node.action_clients),
        )
        incoming = (
            ("topic", shown.subscriptions),
            ("service", shown.service_servers),
            ("action", node.action_servers),
        )
        edges.update((own, (kind, name)) for kind, names in outgoing for name, _ in names)
        edges.update(((kind, name), own) for kind, names in incoming for name, _ in names)
    vertices.update(end for edge in edges for end in edge)
    return GraphView(tuple(sorted(vertices)), tuple(sorted(edges)))
