# SPDX-License-Identifier: Apache-2.0
"""micro_ros_msgs/msg/Graph as rosbags writes and reads it, from definitions of this file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

DEFINITIONS = {
    "Graph": "micro_ros_msgs/Node[] nodes",
    "Node": "string<=256 node_namespace\nstring<=256 node_name\nmicro_ros_msgs/Entity[] entities",
    "Entity": "byte entity_type\nstring<=256 name\nstring<=256[] types",
}
PUBLISHER, SUBSCRIBER, SERVER, CLIENT = range(4)
Entity = tuple[int, str, tuple[str, ...]]
"""Its kind, name and types."""
Nodes = dict[str, set[Entity]]
"""Of each node, by its fully qualified name."""
_TYPE = "micro_ros_msgs/msg/Graph"


def decoded(sample: bytes) -> Nodes:
    """Return what rosbags reads in a sample with its encapsulation header."""
    graph = _store().deserialize_cdr(sample, _TYPE)
    return {
        f"{node.node_namespace.rstrip('/')}/{node.node_name}": {
            (entity.entity_type, entity.name, tuple(entity.types)) for entity in node.entities
        }
        for node in graph.nodes
    }


def encoded(nodes: Mapping[str, Sequence[Entity]], little_endian: bool = True) -> bytes:
    """Return the CDR body of a sample, without its encapsulation header."""
    types = _store().types
    messages = [
        types["micro_ros_msgs/msg/Node"](
            node.rpartition("/")[0] or "/",
            node.rpartition("/")[2],
            [types["micro_ros_msgs/msg/Entity"](kind, name, list(of)) for kind, name, of in entities],
        )
        for node, entities in nodes.items()
    ]
    written = _store().serialize_cdr(types[_TYPE](messages), _TYPE, little_endian=little_endian)
    return bytes(written)[4:]


@cache
def _store() -> Any:
    store: Any = get_typestore(Stores.EMPTY)
    for name, text in DEFINITIONS.items():
        store.register(get_types_from_msg(text, f"micro_ros_msgs/msg/{name}"))
    return store
