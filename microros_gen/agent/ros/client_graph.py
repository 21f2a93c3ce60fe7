# SPDX-License-Identifier: Apache-2.0
"""The ROS graph for clients with micro-ROS's graph support, as a sample of their topic `ros_to_microros_graph`.

Such a client has a reader of micro_ros_msgs/msg/Graph: all nodes with what they publish, subscribe to, serve and call.
micro_ros_agent publishes it in DDS; here each reader gets it from the agent itself, the newest sample only. The graph
is read in steps of some milliseconds, and again when it has changed.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from microros_gen.agent.representation import Topic
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.graph import Destroyable
from microros_gen.agent.ros.wakeups import Wakeups, Watcher
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import Status
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphChanges, Names
from microros_gen.ros.libraries import Libraries

GRAPH_TOPIC = "ros_to_microros_graph"
"""Its name in DDS: it is no ROS topic."""
GRAPH_TYPE = "micro_ros_msgs::msg::dds_::Graph_"
LONGEST_TEXT = 256
"""Bytes of a name or type in micro_ros_msgs; what is longer is left out."""
LOOK_S, BETWEEN_S = 0.002, 0.02
"""Seconds for which nodes are read before it is others' turn, and until that goes on."""
CHANGES_S = 0.2
"""Seconds between two looks whether the graph has changed."""
_ENCAPSULATION = b"\0\1\0\0"
"""CDR, little-endian."""


class ClientGraph(Watcher):
    """The graph of one domain, read while a client has a reader of it."""

    def __init__(self, handles: Any, context: Any, node: Any, libraries: Libraries) -> None:
        """Read with `node`, a handle that outlives this; `context` is its context's handle."""
        self._handles = handles
        self._context = context
        self._node = node
        self._libraries = libraries
        self._graph = Graph(handles, node)
        self._readers: set[GraphReader] = set()
        self._wakeups: Wakeups | None = None
        """None while nobody reads."""
        self._timer = -1
        self._nodes: Iterator[bytes | None] | None = None
        """What is left of the graph that is being read."""
        self.sample = b""
        """Encapsulation header and CDR body of the newest message; empty before the first."""

    def read(self, topic: Topic, node: str, wakeups: Wakeups, entities: set[Destroyable]) -> GraphReader:
        """Return a new reader of the node `node`, one of its `entities`. Raises BridgeError for another type."""
        label = f"{topic.name} [micro_ros_msgs/msg/Graph]"
        if topic.type_name != GRAPH_TYPE:
            raise BridgeError(
                f"subscription {label} of {node}: the type '{topic.type_name[:80]}' is another one",
                Status.INCOMPATIBLE,
            )
        reader = GraphReader(self, label, wakeups, entities)
        self._readers.add(reader)
        if self._wakeups is None:
            self._timer = wakeups.add_timer(self)
            self._wakeups = wakeups
            self._changed()
            self._nodes = self._read_all()
            wakeups.set_timer(self._timer, BETWEEN_S)
        return reader

    def forget(self, reader: GraphReader) -> None:
        """Stop telling a reader; the graph is no longer read after the last one."""
        self._readers.discard(reader)
        if not self._readers and self._wakeups is not None:
            self._nodes, self.sample = None, b""
            self._wakeups.remove(self._timer)
            self._wakeups = None

    def look(self) -> None:
        """See Watcher: read some nodes, or look whether the graph has changed."""
        if self._wakeups is None:
            return
        if self._nodes is None and self._changed():
            self._nodes = self._read_all()
        end = time.monotonic() + LOOK_S
        while self._nodes is not None and time.monotonic() < end:
            sample = next(self._nodes)
            if sample is not None:
                self._nodes = None
                self._tell(sample)
        self._wakeups.set_timer(self._timer, CHANGES_S if self._nodes is None else BETWEEN_S)

    def _tell(self, sample: bytes) -> None:
        if sample != self.sample:
            self.sample = sample
            for reader in self._readers:
                reader.wake()

    def _changed(self) -> bool:
        """Return whether the graph has changed since the last call."""
        waits = self._handles.WaitSet(0, 1, 0, 0, 0, 0, self._context)
        try:
            waits.clear_entities()
            place = GraphChanges(self._node, self._libraries, lambda: None).add(waits)
            waits.wait(0)
            return bool(waits.is_ready(GraphChanges.kind, place))
        except RosError:
            return True
        finally:
            waits.destroy_when_not_in_use()

    def _read_all(self) -> Iterator[bytes | None]:
        """Give None after each node, at last the sample. What changes meanwhile is in it or announced again."""
        of_node: tuple[Callable[[str], Names | None], ...] = (
            self._graph.publishers_of,
            self._graph.subscriptions_of,
            self._graph.services_of,
            self._graph.clients_of,
        )
        sample = GraphSample()
        for node in self._graph.nodes():
            found = [of for ask in of_node if (of := ask(node)) is not None]
            if len(found) == len(of_node):  # it has not left meanwhile
                sample.add(node, found)
            yield None
        yield sample.content()


class GraphReader:
    """See Reader: the newest graph, once."""

    def __init__(self, graph: ClientGraph, label: str, wakeups: Wakeups, entities: set[Destroyable]) -> None:
        self.label = label
        self._graph = graph
        self._wakeups = wakeups
        self._entities = entities
        self._taken = b""
        self._descriptor = wakeups.add(self)
        entities.add(self)
        self.wake()

    def wake(self) -> None:
        """Let the bridge name this source."""
        with contextlib.suppress(BlockingIOError):
            os.eventfd_write(self._descriptor, 1)

    def take(self) -> bytes | None:
        """See Reader."""
        if self._taken == self._graph.sample:
            return None
        self._taken = self._graph.sample
        return self._taken or None

    def woken(self) -> None:
        """See WokenSource."""

    def unread(self) -> int:
        """See Source."""
        return int(self._taken != self._graph.sample)

    def destroy(self) -> None:
        """See Source. Destroying it again does nothing."""
        if self in self._entities:
            self._entities.discard(self)
            self._graph.forget(self)
            self._wakeups.remove(self._descriptor)


class GraphSample:
    """A message Graph while it is being written."""

    def __init__(self) -> None:
        self._nodes = 0
        self._written = Writer().u32(0)

    def add(self, node: str, entities: Sequence[Names]) -> None:
        """Append a node with its publishers, subscriptions, servers and clients, in this order.

        An entity with a text that is longer than micro_ros_msgs allows is left out.
        """
        namespace, _, name = node.rpartition("/")
        fitting = [
            (kind, entity, types)
            for kind, names in enumerate(entities)
            for entity, types in names
            if all(map(_fits, (entity, *types)))
        ]
        body = self._written.string(namespace or "/").string(name).u32(len(fitting))
        for kind, entity, types in fitting:
            body.u8(kind).string(entity).u32(len(types))
            for type_name in types:
                body.string(type_name)
        self._nodes += 1

    def content(self) -> bytes:
        """Return encapsulation header and CDR body."""
        return _ENCAPSULATION + self._nodes.to_bytes(4, "little") + self._written.content()[4:]


def _fits(text: str) -> bool:
    return len(text.encode()) <= LONGEST_TEXT
