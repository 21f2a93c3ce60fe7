# SPDX-License-Identifier: Apache-2.0
"""Observation of the ROS graph around clients' entities: matched endpoints, incompatible QoS, different types.

It uses events of ROS 2, so nothing is polled. Type hashes are compared shortly after a match, since the name of a node
is discovered later than its endpoints.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

from microros_gen.agent.ros.bridge import (
    BridgeError,
    GraphReport,
    HashMismatch,
    Incompatible,
    Matched,
    TypeMismatch,
)
from microros_gen.agent.ros.wakeups import Wakeups, Watcher
from microros_gen.agent.wire.constants import Status
from microros_gen.ros.libraries import FAILURES, OK, Libraries

LOOK_S, BETWEEN_S = 0.001, 0.02
"""Seconds of comparisons in one turn, and seconds until they continue."""
MOST_COMPARED = 128
"""Maximum endpoints of a topic in this agent for comparisons: the time of a query grows with their number."""
MOST_REPORTED = 64
"""Maximum number of differences reported for one endpoint."""
FEW, TOGETHER_S = 32, 0.05
"""Maximum endpoints of a node whose events are read at once; with more, they are read later, all together."""
CHECK_AFTER_S = 0.5
"""Seconds from a match to the comparison of hashes."""
CHECKS = 20
"""Number of checks of an endpoint whose node has no name yet, `CHECK_AFTER_S` apart."""
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
"""The name that rmw uses for a node whose name was not discovered yet."""


@dataclass(frozen=True, eq=False)
class Endpoint:
    """A ROS endpoint of a client, as reports name it.

    `topic` and `type` are its names in the graph; with `mangled` those in DDS, as the two topics of a service have.
    `hash` is None if it is unknown.
    """

    node: str
    kind: str
    label: str
    topic: str
    type: str
    hash: str | None
    mangled: bool = False


@dataclass(eq=False)
class _Watched:
    """Events of an endpoint with the last values: ROS 2 resets its own changes when a callback is set."""

    matched: Any
    refused: Any
    mistyped: Any
    counts: tuple[int, int] = (0, 0)
    refusals: int = 0

    def events(self) -> tuple[Any, ...]:
        return self.matched, self.refused, self.mistyped


class TopicTypes:
    """The types of the agent's topics in one domain.

    All its clients there share one DDS participant, which has one type for each topic. (rmw_fastrtps refuses another
    one as well, with a text that does not say so.)"""

    def __init__(self) -> None:
        self._by_topic: dict[str, set[Endpoint]] = {}

    def claim(self, endpoints: Iterable[Endpoint]) -> None:
        """Record what will be created. Raises BridgeError if the topic has another type."""
        for endpoint in endpoints:
            other = next(iter(self._by_topic.get(endpoint.topic, ())), None)
            if other is not None and other.type != endpoint.type:
                raise BridgeError(
                    f"{endpoint.kind} {endpoint.label}: {other.node} has this topic with the type {other.type},"
                    " and an agent has one type for a topic",
                    Status.INCOMPATIBLE,
                )
        for endpoint in endpoints:
            self._by_topic.setdefault(endpoint.topic, set()).add(endpoint)

    def count(self, topic: str) -> int:
        """Return how many endpoints of a topic the agent has."""
        return len(self._by_topic.get(topic, ()))

    def release(self, endpoint: Endpoint) -> None:
        """Remove an endpoint."""
        left = self._by_topic.get(endpoint.topic, set())
        left.discard(endpoint)
        if not left:
            self._by_topic.pop(endpoint.topic, None)


_Place = tuple[TopicTypes, str, bool]
"""A topic in a domain, and whether its name is that of DDS."""


class Destroyable(Protocol):
    """An entity of a node."""

    def destroy(self) -> None:
        """Leave the ROS graph."""


class Comparison(Watcher):
    """Compares types and type hashes of endpoints with those that other nodes announce for the same topic."""

    def __init__(self, handles: Any, wakeups: Wakeups, report: Callable[[GraphReport], None]) -> None:
        self._handles = handles
        self._wakeups = wakeups
        self._report = report
        self._due: dict[_Place, dict[Endpoint, tuple[Any, int]]] = {}
        """Endpoints to compare, with the handle of their node and the remaining checks of nameless counterparts."""
        self._reported: dict[Endpoint, set[GraphReport]] = {}
        self._timer = wakeups.add_timer(self)

    def soon(self, node: Any, topics: TopicTypes, endpoint: Endpoint) -> None:
        """Compare `endpoint` shortly; `node` is the handle of its node, `topics` are those of its domain."""
        self._reported.setdefault(endpoint, set())
        if not self._due:
            self._wakeups.set_timer(self._timer, CHECK_AFTER_S)
        self._due.setdefault((topics, endpoint.topic, endpoint.mangled), {}).setdefault(
            endpoint, (node, CHECKS)
        )

    def forget(self, topics: TopicTypes, endpoint: Endpoint) -> None:
        """Stop comparing an endpoint."""
        place = (topics, endpoint.topic, endpoint.mangled)
        due = self._due.get(place, {})
        due.pop(endpoint, None)
        if not due:
            self._due.pop(place, None)
        self._reported.pop(endpoint, None)

    def look(self) -> None:
        """See Watcher. A topic is queried once, however many endpoints it has here, in turns of limited time."""
        end = time.monotonic() + LOOK_S
        again: dict[_Place, dict[Endpoint, tuple[Any, int]]] = {}
        while self._due and time.monotonic() < end:
            place = next(iter(self._due))
            due = self._due.pop(place)
            nameless = place[0].count(place[1]) <= MOST_COMPARED and self._compare(place, due)
            left = {e: (node, tries - 1) for e, (node, tries) in due.items() if tries > 1}
            if nameless and left:
                again[place] = left
        wait_s = BETWEEN_S if self._due else CHECK_AFTER_S
        self._due.update(again)
        if self._due:
            self._wakeups.set_timer(self._timer, wait_s)

    def _compare(self, place: _Place, due: dict[Endpoint, tuple[Any, int]]) -> bool:
        """Compare the endpoints of a topic with others there; return whether one of those has a nameless node."""
        alike = {(endpoint.type, endpoint.hash) for endpoint in due}
        node, tries = next(iter(due.values()))
        last_try, nameless = tries <= 1, False
        for found in self._others(node, place):
            if found["node_name"] == _UNKNOWN_NODE and not last_try:
                nameless = True
            elif any(_differs(type_name, type_hash, found) for type_name, type_hash in alike):
                for endpoint in due:
                    self._report_once(endpoint, _difference(endpoint, found))
        return nameless

    def _report_once(self, endpoint: Endpoint, report: GraphReport | None) -> None:
        reported = self._reported[endpoint]
        if report is not None and report not in reported and len(reported) < MOST_REPORTED:
            reported.add(report)
            self._report(report)

    def _others(self, node: Any, place: _Place) -> Iterator[dict[str, Any]]:
        """Yield all endpoints of the topic, of both directions: another publisher may have a different type, too."""
        for get in (
            self._handles.rclpy_get_publishers_info_by_topic,
            self._handles.rclpy_get_subscriptions_info_by_topic,
        ):
            try:
                yield from get(node, place[1], place[2])
            except FAILURES:  # the graph cannot be queried now: the next match compares again
                return


class Events(Watcher):
    """Events of the publishers and subscriptions of one node."""

    def __init__(
        self,
        handles: Any,
        node: Any,
        wakeups: Wakeups,
        libraries: Libraries,
        comparison: Comparison,
        topics: TopicTypes,
        report: Callable[[GraphReport], None],
    ) -> None:
        self._handles = handles
        self._node = node
        self._wakeups = wakeups
        self._libraries = libraries
        self._comparison = comparison
        self.topics = topics
        self._report = report
        self._watched: dict[Endpoint, _Watched] = {}
        self._descriptor = self._timer = -1
        self._look_from = 0.0
        """When its events are to be read; 0: none are pending."""
        self.entities: set[Destroyable] = set()
        """The entities of the node."""

    def watch(self, endpoint: Endpoint, handle: Any) -> None:
        """Report events of an endpoint until `release`; ROS 2 has them for publishers and subscriptions."""
        self.compare(endpoint)
        if endpoint.mangled:
            return
        if self._descriptor < 0:
            self._descriptor = self._wakeups.add(self)
        kinds, prefix, incompatible = (
            (self._handles.rcl_publisher_event_type_t, "RCL_PUBLISHER", "OFFERED_INCOMPATIBLE_QOS")
            if endpoint.kind == "publisher"
            else (
                self._handles.rcl_subscription_event_type_t,
                "RCL_SUBSCRIPTION",
                "REQUESTED_INCOMPATIBLE_QOS",
            )
        )
        events = tuple(
            self._handles.EventHandle(handle, getattr(kinds, f"{prefix}_{name}"))
            for name in ("MATCHED", incompatible, "INCOMPATIBLE_TYPE")
        )
        watched = self._watched[endpoint] = _Watched(*events)
        for event in watched.events():
            pointer = event.pointer
            if self._libraries.notify_event(pointer, self._libraries.eventfd_write, self._descriptor) != OK:
                raise BridgeError(f"{endpoint.label}: {self._libraries.error()}")
        self._look_at(endpoint, watched)  # once at what happened before

    def compare(self, endpoint: Endpoint) -> None:
        """Compare the type of `endpoint` with that of others shortly."""
        self._comparison.soon(self._node, self.topics, endpoint)

    def readers(self, endpoint: Endpoint, size: int) -> set[bytes]:
        """Return the first `size` bytes of the GUIDs of all readers in the graph on the topic of `endpoint`."""
        get = self._handles.rclpy_get_subscriptions_info_by_topic
        found = get(self._node, endpoint.topic, endpoint.mangled)
        return {bytes(reader["endpoint_gid"][:size]) for reader in found}

    def release(self, endpoints: Iterable[Endpoint]) -> None:
        """Stop reporting endpoints that will be destroyed."""
        for endpoint in endpoints:
            self._comparison.forget(self.topics, endpoint)
            self.topics.release(endpoint)
            watched = self._watched.pop(endpoint, None)
            for event in watched.events() if watched else ():
                event.destroy_when_not_in_use()

    def close(self) -> None:
        """Destroy the remaining entities of the node, then close the descriptor, to which nothing writes any more."""
        for entity in list(self.entities):
            entity.destroy()
        for descriptor in (self._descriptor, self._timer):
            if descriptor >= 0:
                self._wakeups.remove(descriptor)
        self._descriptor = self._timer = -1

    def look(self) -> None:
        """See Watcher. Read the events of all endpoints of the node, which share a descriptor; later if they are
        many."""
        if len(self._watched) > FEW and not self._is_time():
            return
        for endpoint, watched in list(self._watched.items()):
            self._look_at(endpoint, watched)

    def _is_time(self) -> bool:
        """Return whether the events of a node with many endpoints are due; otherwise set the timer."""
        now = time.monotonic()
        if not self._look_from:
            self._look_from = now + TOGETHER_S
            if self._timer < 0:
                self._timer = self._wakeups.add_timer(self)
            self._wakeups.set_timer(self._timer, TOGETHER_S)
        if now < self._look_from:
            return False
        self._look_from = 0.0
        return True

    def _look_at(self, endpoint: Endpoint, watched: _Watched) -> None:
        status = watched.matched.take_event()
        counts = (status.total_count, status.current_count) if status else watched.counts
        if counts != watched.counts:
            before, watched.counts = watched.counts, counts
            self._report(Matched(endpoint.node, endpoint.kind, endpoint.label, counts[1]))
            if counts[0] > before[0]:
                self.compare(endpoint)
        status = watched.refused.take_event()
        if status is not None and status.total_count != watched.refusals:
            watched.refusals = status.total_count
            policy = status.last_policy_kind.name.removeprefix("RMW_QOS_POLICY_").lower()
            self._report(
                Incompatible(endpoint.node, endpoint.kind, endpoint.label, policy, status.total_count)
            )
        status = watched.mistyped.take_event()
        if status is not None and status.total_count_change:
            self.compare(endpoint)


def _differs(type_name: str, type_hash: str | None, found: dict[str, Any]) -> bool:
    """Return whether `found` has a different type name or hash; quickly, since there may be very many."""
    if found["topic_type"] != type_name:
        return True
    announced = found["topic_type_hash"]
    return (
        type_hash is not None
        and announced["version"] == 1
        and bytes(announced["value"]).hex() != type_hash.removeprefix("RIHS01_")
    )


def _difference(endpoint: Endpoint, found: dict[str, Any]) -> GraphReport | None:
    """Return the difference of `found`, an endpoint of the same topic, or None."""
    other = f"{found['node_namespace'].rstrip('/')}/{found['node_name']}"
    if found["topic_type"] != endpoint.type:
        return TypeMismatch(endpoint.node, endpoint.label, other, found["topic_type"])
    announced = found["topic_type_hash"]
    if endpoint.hash is None or announced["version"] != 1:
        return None
    text = f"RIHS01_{bytes(announced['value']).hex()}"
    if text == endpoint.hash:
        return None
    return HashMismatch(endpoint.node, endpoint.label, endpoint.hash, other, text)
