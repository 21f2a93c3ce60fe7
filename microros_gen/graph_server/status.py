# SPDX-License-Identifier: Apache-2.0
"""What an endpoint matches, and what its QoS prevents: responses of microros_graph_msgs/srv/EndpointStatus.

Endpoints get numbers in the order in which they were first seen. A caller says which was the newest one when it asked
before, so nothing about callers is remembered.
"""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.graph_server.answers import INVALID, OK, UNKNOWN_NODE, incompatibility, is_name, meant
from microros_gen.ros.endpoints import Value
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphEndpoint

_NUMBERS = 1 << 32
_MOST = 4096
"""Endpoints whose numbers are remembered; above, the oldest count as new where they are seen again."""


class Arrivals:
    """The numbers of endpoints, by their GID."""

    def __init__(self, newest: int = 0) -> None:
        """Give the first endpoint the number after `newest`."""
        self.newest = newest
        self._numbers: dict[bytes, int] = {}

    def see(self, endpoints: Sequence[GraphEndpoint]) -> None:
        """Give each endpoint that was never seen a number."""
        for endpoint in endpoints:
            if endpoint.gid not in self._numbers:
                self.newest = (self.newest + 1) % _NUMBERS
                self._numbers[endpoint.gid] = self.newest
                if len(self._numbers) > _MOST:
                    self._numbers.pop(next(iter(self._numbers)))

    def age(self, endpoint: GraphEndpoint) -> int:
        """Return how many endpoints are newer than one that was seen; modulo 2^32."""
        return (self.newest - self._numbers[endpoint.gid]) % _NUMBERS


def endpoint_status(graph: Graph, request: Value, instance: int, arrivals: Arrivals) -> Value:
    """Return the response; `instance` is that of the server (1 to 2^32 - 1)."""
    topic, is_subscription = request["topic"], request["subscription"]
    if not is_name(topic):
        return {"status": INVALID, "instance": instance}
    try:
        publishers, subscriptions = graph.publishers(topic), graph.subscriptions(topic)
    except RosError:  # a name too long
        return {"status": INVALID, "instance": instance}
    own, others = (subscriptions, publishers) if is_subscription else (publishers, subscriptions)
    arrivals.see(others)
    own_meant = meant([endpoint for endpoint in own if endpoint.node == request["node"]], request)
    if not own_meant:
        return {"status": UNKNOWN_NODE, "instance": instance}
    matched, refused = [], []
    for other in others:
        policies = [
            incompatibility(*((other, end) if is_subscription else (end, other)))
            for end in own_meant
            if end.type == other.type
        ]
        if policies and all(policies):
            refused.append((arrivals.age(other), policies[0]))
        elif policies:
            matched.append(arrivals.age(other))
    known = request["instance"] == instance
    limit = (arrivals.newest - request["newest"]) % _NUMBERS if known else _NUMBERS
    return {
        "status": OK,
        "instance": instance,
        "newest": arrivals.newest,
        "matched": len(matched),
        "matched_new": sum(age < limit for age in matched),
        "incompatible": len(refused),
        "incompatible_new": sum(age < limit for age, _ in refused),
        "policy": min(refused)[1] if refused else 0,
    }
