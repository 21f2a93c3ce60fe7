# SPDX-License-Identifier: Apache-2.0
"""Queries of the ROS graph by a node, and a wait for its changes (rcl/graph.h, rmw/get_topic_endpoint_info.h)."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from ctypes import byref, c_size_t
from typing import Any

from microros_gen.records import dataclass
from microros_gen.ros.errors import RosError
from microros_gen.ros.libraries import FAILURES, OK, Libraries, first_line

Names = tuple[tuple[str, tuple[str, ...]], ...]
"""Fully qualified names, sorted, with their sorted types (`std_msgs/msg/Int32`)."""


@dataclass(frozen=True)
class GraphEndpoint:
    """A publisher or subscription of a topic.

    `node` is fully qualified; `hash` has 32 bytes and means what `hash_version` says (REP-2011: 1 is RIHS01); `gid` has
    16 bytes. `reliability`, `durability`, `history`, `liveliness` are values of rmw/types.h. Durations are nanoseconds.
    """

    node: str
    type: str
    hash_version: int
    hash: bytes
    gid: bytes
    reliability: int
    durability: int
    history: int
    liveliness: int
    depth: int
    deadline: int
    lifespan: int
    lease: int


class Graph:
    """The ROS graph as the RMW implementation of a node has discovered it."""

    def __init__(self, handles: Any, node: Any) -> None:
        """Use rclpy's handles and the handle of a node that outlives this."""
        self._handles = handles
        self._node = node

    def nodes(self) -> tuple[str, ...]:
        """Return the fully qualified names of all nodes, sorted; a name that two nodes share is listed twice."""
        found = self._node.get_node_names_and_namespaces()
        return tuple(sorted(full_name(name, namespace) for name, namespace in found))

    def nodes_with_enclaves(self) -> tuple[tuple[str, str], ...]:
        """Return what `nodes` does, each with its enclave: "/", unless the node was started with another one."""
        found = self._node.get_node_names_and_namespaces_with_enclaves()
        return tuple(sorted((full_name(name, namespace), enclave) for name, namespace, enclave in found))

    def topics(self, demangle: bool = True) -> Names:
        """Return all topics that have an endpoint; not demangled as DDS has them, those of services too."""
        return _names(self._handles.rclpy_get_topic_names_and_types(self._node, not demangle))

    def services(self) -> Names:
        """Return all services that have a server or a client."""
        return _names(self._handles.rclpy_get_service_names_and_types(self._node))

    def publishers_of(self, node: str, demangle: bool = True) -> Names | None:
        """Return the topics that the node publishes, as `topics` does; None if no such node exists."""
        ask = functools.partial(
            self._handles.rclpy_get_publisher_names_and_types_by_node, self._node, not demangle
        )
        return self._of_node(ask, node)

    def subscriptions_of(self, node: str, demangle: bool = True) -> Names | None:
        """Return the topics that the node subscribes to, as `topics` does; None if no such node exists."""
        ask = functools.partial(
            self._handles.rclpy_get_subscriber_names_and_types_by_node, self._node, not demangle
        )
        return self._of_node(ask, node)

    def services_of(self, node: str) -> Names | None:
        """Return the services that the node serves; None if no such node exists."""
        ask = functools.partial(self._handles.rclpy_get_service_names_and_types_by_node, self._node)
        return self._of_node(ask, node)

    def clients_of(self, node: str) -> Names | None:
        """Return the services that the node has clients of; None if no such node exists."""
        ask = functools.partial(self._handles.rclpy_get_client_names_and_types_by_node, self._node)
        return self._of_node(ask, node)

    def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
        """Return the publishers of a topic, sorted by node and GID. Raises RosError for an invalid name."""
        return self._endpoints(self._handles.rclpy_get_publishers_info_by_topic, topic)

    def subscriptions(self, topic: str) -> tuple[GraphEndpoint, ...]:
        """Return the subscriptions of a topic, sorted by node and GID. Raises RosError for an invalid name."""
        return self._endpoints(self._handles.rclpy_get_subscriptions_info_by_topic, topic)

    def count_servers(self, service: str) -> int:
        """Return the number of servers of a service. Raises RosError for an invalid name."""
        return self._count(self._node.get_count_services, service)

    def count_clients(self, service: str) -> int:
        """Return the number of clients of a service. Raises RosError for an invalid name."""
        return self._count(self._node.get_count_clients, service)

    def _of_node(self, ask: Callable[[str, str], Any], node: str) -> Names | None:
        namespace, _, name = node.rpartition("/")
        try:
            return _names(ask(name, namespace or "/"))
        except FAILURES:  # it left meanwhile, or its name is none
            return None

    def _endpoints(self, ask: Callable[..., Any], topic: str) -> tuple[GraphEndpoint, ...]:
        try:
            found = ask(self._node, topic, False)
        except FAILURES as error:
            raise RosError(f"{topic}: {first_line(error)}") from error
        return tuple(sorted(map(_endpoint, found), key=lambda endpoint: (endpoint.node, endpoint.gid)))

    def _count(self, ask: Callable[[str], int], name: str) -> int:
        try:
            return int(ask(name))
        except FAILURES as error:
            raise RosError(f"{name}: {first_line(error)}") from error


class GraphChanges:
    """Waits for changes of the ROS graph; `spin_once` of the peer calls back once for several changes."""

    kind = "guard_condition"

    def __init__(self, node: Any, libraries: Libraries, callback: Callable[[], object]) -> None:
        """Raise RosError if the node has no graph guard condition."""
        self._libraries = libraries
        self._condition = libraries.graph_guard_condition(node.pointer)
        if not self._condition:
            raise RosError(f"graph guard condition: {libraries.error()}")
        self._callback = callback

    def add(self, waits: Any) -> int:
        """Add it to an rclpy wait set; return its index there."""
        index = c_size_t()
        result = self._libraries.add_guard_condition(waits.pointer, self._condition, byref(index))
        if result != OK:
            raise RosError(f"graph guard condition: {self._libraries.error()}")
        return index.value

    def look(self) -> None:
        """Call back."""
        self._callback()


def full_name(name: str, namespace: str) -> str:
    """Return the fully qualified name of a node."""
    return f"/{name}" if namespace == "/" else f"{namespace}/{name}"


def _names(found: Iterable[tuple[str, Iterable[str]]]) -> Names:
    return tuple(sorted((name, tuple(sorted(types))) for name, types in found))


def _endpoint(info: dict[str, Any]) -> GraphEndpoint:
    qos, type_hash = info["qos_profile"], info["topic_type_hash"]
    return GraphEndpoint(
        node=full_name(info["node_name"], info["node_namespace"]),
        type=info["topic_type"],
        hash_version=type_hash["version"],
        hash=bytes(type_hash["value"]),
        gid=bytes(info["endpoint_gid"]),
        reliability=qos["reliability"],
        durability=qos["durability"],
        history=qos["history"],
        liveliness=qos["liveliness"],
        depth=qos["depth"],
        deadline=qos["deadline"].nanoseconds,
        lifespan=qos["lifespan"].nanoseconds,
        lease=qos["liveliness_lease_duration"].nanoseconds,
    )
