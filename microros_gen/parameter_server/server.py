# SPDX-License-Identifier: Apache-2.0
"""A ROS node that holds the parameters of others; docs/howto/parameter_server.md is its contract."""

from __future__ import annotations

import time
from collections.abc import Callable

from microros_gen.parameter_server.file import ParameterFile
from microros_gen.parameter_server.node import HeldNode, Merged
from microros_gen.parameter_server.served import ServedNode
from microros_gen.ros.endpoints import Value
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

NODE = "microros_parameters"
NOTICES_TOPIC = f"/{NODE}/notices"
NOTICES_QOS = Qos(transient_local=True, depth=100)
EVENTS_TOPIC = "/parameter_events"
EVENTS_QOS = Qos(depth=1000)
_WAIT_S = 0.5
_NS = 1_000_000_000


class ParameterServer(Serving):
    """Serves on the node of a peer, in the thread that calls `turn`."""

    def __init__(
        self, peer: Peer, report: Callable[[str], object], file: ParameterFile | None = None
    ) -> None:
        """Serve the nodes of the file at once, others when they publish a notice; `report` gets lines for the log.

        Raises UserError as `ParameterFile.load` does, RosError if the node cannot have the services.
        """
        super().__init__(peer, report)
        self._file = file
        self._nodes: dict[str, ServedNode] = {}
        self._events = peer.publisher(EVENTS_TOPIC, "rcl_interfaces/msg/ParameterEvent", EVENTS_QOS)
        nodes, damage = file.load(self._node) if file is not None else ((), "")
        if damage:
            report(damage)
        for node in nodes:
            self._nodes[node.name] = ServedNode(node, peer, self)
        peer.subscribe(NOTICES_TOPIC, "microros_parameter_msgs/msg/Notice", self._noticed, NOTICES_QOS)

    @property
    def pending(self) -> int:
        """Return the number of values that their nodes do not have yet."""
        return sum(len(node.held.pending()) for node in self._nodes.values())

    def turn(self) -> None:
        """Wait for requests, at most half a second, and serve them."""
        due_s = min((node.exchange.next_s() for node in self._nodes.values()), default=float("inf"))
        self._spin(min(_WAIT_S, due_s - time.monotonic()))
        for node in list(self._nodes.values()):
            self._attempt(node.exchange.step)

    def keep(self) -> None:
        """Write the file."""
        if self._file is None:
            return
        try:
            self._file.save(node.held for node in self._nodes.values())
        except OSError as error:
            self._report(f"'{self._file.path}' cannot be written: {error.strerror}")

    def tell(self, node: str, event: Merged) -> None:
        """Publish an event."""
        seconds, nanoseconds = divmod(time.time_ns(), _NS)
        message: Value = {
            "stamp": {"sec": seconds, "nanosec": nanoseconds},
            "node": node,
            "new_parameters": event.new,
            "changed_parameters": event.changed,
            "deleted_parameters": event.deleted,
        }
        self._events.publish(message)

    def log(self, text: str) -> None:
        """Report a line."""
        self._report(text)

    def _node(self, name: str) -> HeldNode:
        return HeldNode(name, time.time, self._report)

    def _noticed(self, notice: Value) -> None:
        name = notice["node"]
        if name not in self._nodes:
            self._nodes[name] = ServedNode(self._node(name), self._peer, self)
        self._nodes[name].exchange.notice(notice["board"], notice["session"], notice["revision"])
