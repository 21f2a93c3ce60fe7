# SPDX-License-Identifier: Apache-2.0
"""What happens in the ROS graph around the entities of clients: who matches, who cannot, whose type is another one.

ROS 2 tells by events, so nothing is polled. A type hash is compared a moment after a match, since the name of the node
that an endpoint belongs to comes later than the endpoint.
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
"""Seconds for comparisons before it is others' turn, and until they go on."""
MOST_COMPARED = 128
"""Endpoints of one topic in this agent up to which it is compared: to ask for very many takes as long as they are."""
MOST_REPORTED = 64
"""Differences that are told of one endpoint."""
FEW, TOGETHER_S = 32, 0.05
"""Endpoints of a node that are asked at once what happened; more are asked some time later, for all that happened."""
CHECK_AFTER_S = 0.5
"""From a match to the comparison of hashes."""
CHECKS = 20
"""How often an endpoint is looked at whose node has no name yet, `CHECK_AFTER_S` apart."""
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
"""What rmw calls a node whose name it does not know yet."""


@dataclass(frozen=True, eq=False)
class Endpoint:
    """A ROS endpoint of a client, as reports name it.

    `topic` and `type` are its names in the graph; with `mangled` those in DDS, as the two topics of a service have.
    `hash` is None when nobody knows it.
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
    """Events of an endpoint, and what was seen of them: ROS 2's own changes start again when a callback is set."""

    matched: Any
    refused: Any
    mistyped: Any
    counts: tuple[int, int] = (0, 0)
    refusals: int = 0

    def events(self) -> tuple[Any, ...]:
        return self.matched, self.refused, self.mistyped


class TopicTypes:
    """The types of the agent's topics in one domain: all its clients there are one DDS participant, which has one type
    for a topic. (rmw_fastrtps refuses another one too, with a text that says nothing of it.)"""

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
        """Forget an endpoint."""
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

    def __init__(self, handles: Any, wakeups: Wakeups[Any], report: Callable[[GraphReport], None]) -> None:
        self._handles = handles
        self._wakeups = wakeups
        self._report = report
        self._due: dict[_Place, dict[Endpoint, tuple[Any, int]]] = {}
        """What is to be compared, with the handle of its node and how often a nameless other one is waited for."""
        self._reported: dict[Endpoint, set[GraphReport]] = {}
        self._timer = wakeups.add_timer(self)

    def soon(self, node: Any, topics: TopicTypes, endpoint: Endpoint) -> None:
        """Compare `endpoint` in a moment; `node` is the handle of its node, `topics` are those of its domain."""
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
        """See Watcher. A topic is asked for once, however many endpoints it has here; then it is others' turn."""
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
        """Compare the endpoints at a place with others there; return whether one of those has no name yet."""
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
        """Give all endpoints of the other direction, and of ours: who publishes with us may have another type too."""
        for get in (
            self._handles.rclpy_get_publishers_info_by_topic,
            self._handles.rclpy_get_subscriptions_info_by_topic,
        ):
            try:
                yield from get(node, place[1], place[2])
            except FAILURES:  # the graph cannot be asked now: the next match compares again
                return


class Events(Watcher):
    """Events of the publishers and subscriptions of one node."""

    def __init__(
        self,
        handles: Any,
        node: Any,
        wakeups: Wakeups[Any],
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
        """When it is to be looked at; 0: nothing happened."""
        self.entities: set[Destroyable] = set()
        """What the node has."""

    def watch(self, endpoint: Endpoint, handle: Any) -> None:
        """Report what happens to an endpoint until `release`; ROS 2 has events for publishers and subscriptions."""
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
        """Compare the type of `endpoint` with that of others in a moment."""
        self._comparison.soon(self._node, self.topics, endpoint)

    def readers(self, endpoint: Endpoint, size: int) -> set[bytes]:
        """Return the first `size` bytes of the GUIDs of all readers that the graph has of the topic of `endpoint`."""
        get = self._handles.rclpy_get_subscriptions_info_by_topic
        found = get(self._node, endpoint.topic, endpoint.mangled)
        return {bytes(reader["endpoint_gid"][:size]) for reader in found}

    def release(self, endpoints: Iterable[Endpoint]) -> None:
        """Forget endpoints before they are destroyed."""
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
        """See Watcher. All endpoints of the node are asked, as it has one descriptor: if they are many, not at once."""
        if len(self._watched) > FEW and not self._is_time():
            return
        for endpoint, watched in list(self._watched.items()):
            self._look_at(endpoint, watched)

    def _is_time(self) -> bool:
        """Return whether a node with many endpoints is to be looked at now; else it is in a moment."""
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
    """Return whether `found` has another type than one with this name and hash; quickly, for very many."""
    if found["topic_type"] != type_name:
        return True
    announced = found["topic_type_hash"]
    return (
        type_hash is not None
        and announced["version"] == 1
        and bytes(announced["value"]).hex() != type_hash.removeprefix("RIHS01_")
    )


def _difference(endpoint: Endpoint, found: dict[str, Any]) -> GraphReport | None:
    """Return what is different in `found`, an endpoint of the same topic, or None."""
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
