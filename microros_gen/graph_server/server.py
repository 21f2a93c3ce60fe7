# SPDX-License-Identifier: Apache-2.0
"""A ROS node that answers queries of the graph and publishes a notice when it changes."""

from __future__ import annotations

import random
import time
from collections.abc import Callable

from microros_gen.graph_server.answers import list_endpoints, list_names
from microros_gen.graph_server.status import Arrivals, endpoint_status
from microros_gen.ros.endpoints import Respond, Value
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

NODE = "microros_graph"
NAMES_SERVICE = f"/{NODE}/list_names"
ENDPOINTS_SERVICE = f"/{NODE}/list_endpoints"
STATUS_SERVICE = f"/{NODE}/endpoint_status"
CHANGE_TOPIC = f"/{NODE}/changes"
CHANGE_QOS = Qos(transient_local=True, depth=1)
BETWEEN_CHANGES_S = 0.2
"""Shortest time between two notices: a system that starts changes a hundred times a second."""
_VERSIONS = 1 << 32
_QUESTIONS = 256
"""Questions of one version whose answers are remembered."""
_WAIT_S = 0.5


class GraphServer(Serving):
    """Serves on the node of a peer, in the thread that calls `turn`."""

    def __init__(
        self, peer: Peer, report: Callable[[str], object], clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Create services and publisher; `report` gets a line about each request that could not be answered.

        Raises RosError if the node cannot have them.
        """
        super().__init__(peer, report)
        self._clock = clock
        self._graph = peer.graph()
        # The versions of a server that restarts are not those that its clients have seen.
        self._first = self._version = self._announced = random.randrange(1, _VERSIONS // 2)
        self._answered: dict[object, int] = {}
        self._next_s = clock()
        peer.on_graph_change(self._changed)  # before the requests that are ready at the same time
        self._serve(
            NAMES_SERVICE,
            "microros_graph_msgs/srv/ListNames",
            lambda r: list_names(self._graph, r, self.version),
            self._gave,
        )
        self._serve(
            ENDPOINTS_SERVICE,
            "microros_graph_msgs/srv/ListEndpoints",
            lambda r: list_endpoints(self._graph, r, self.version),
            self._gave,
        )
        self._instance, self._arrivals = random.randrange(1, _VERSIONS), Arrivals()
        self._serve(
            STATUS_SERVICE,
            "microros_graph_msgs/srv/EndpointStatus",
            lambda r: endpoint_status(self._graph, r, self._instance, self._arrivals),
            lambda r: r["any_server"] or r["instance"] in (0, self._instance),
        )
        self._changes = peer.publisher(CHANGE_TOPIC, "microros_graph_msgs/msg/Change", CHANGE_QOS)

    def turn(self, wait_s: float = _WAIT_S) -> None:
        """Wait for requests and changes, at most `wait_s` seconds, and serve them."""
        if self._announced != self._version:
            wait_s = min(wait_s, self._next_s - self._clock())
        self._spin(wait_s)
        if self._announced != self._version and self._clock() >= self._next_s:
            self._announced = self._version
            self._next_s = self._clock() + BETWEEN_CHANGES_S
            self._changes.publish({"version": self._version})

    def version(self, question: object, answer: object) -> int:
        """Return the version of the graph: a new one if the question was answered otherwise in this one.

        DDS changes the graph of the node before it notifies the node. Pages in between would belong to two graphs, and
        have one version.
        """
        known = hash(answer)
        if self._answered.setdefault(question, known) != known:
            self._changed()
            self._answered[question] = known
        elif len(self._answered) > _QUESTIONS:
            self._answered.pop(next(iter(self._answered)))
        return self._version

    def _serve(
        self,
        service: str,
        kind: str,
        answer: Callable[[Value], Value],
        is_meant: Callable[[Value], bool],
    ) -> None:
        """Serve requests that are meant for this server, and those for a server that is not there any more."""

        def serve(request: Value, respond: Respond) -> None:
            if is_meant(request) or self._graph.count_servers(service) < 2:
                respond(answer(request))

        self._peer.serve_later(service, kind, serve)

    def _gave(self, request: Value) -> bool:
        """Return whether a list begins, or began with a page of this server."""
        version: int = request["version"]
        since, current = version - self._first, self._version - self._first
        return version == 0 or since % _VERSIONS <= current % _VERSIONS

    def _changed(self) -> None:
        self._version = (self._version + 1) % _VERSIONS or 1
        self._answered.clear()
