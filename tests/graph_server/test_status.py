# SPDX-License-Identifier: Apache-2.0
"""What an endpoint matches, what its QoS prevents, and which of them are new; rclpy's own events: tests/e2e."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from microros_gen.graph_server.answers import (
    DEADLINE,
    DURABILITY,
    INVALID,
    LIVELINESS,
    OK,
    RELIABILITY,
    UNKNOWN_NODE,
    incompatibility,
)
from microros_gen.graph_server.status import Arrivals, endpoint_status
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphEndpoint
from tests.support.runtime.graph_agent import endpoint

RELIABLE, BEST_EFFORT = 1, 2
TRANSIENT_LOCAL, VOLATILE = 1, 2
OWN = endpoint("/arm/device", 1)
INSTANCE = 9
QOS = {"reliability": OWN.reliability, "durability": OWN.durability, "deadline": OWN.deadline}


class Fixed(Graph):
    """A topic whose endpoints are given."""

    def __init__(self, *others: GraphEndpoint) -> None:
        self.others = list(others)

    def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
        if len(topic) > 99:
            raise RosError("too long")
        return (OWN,)

    def subscriptions(self, topic: str) -> tuple[GraphEndpoint, ...]:
        return tuple(self.others)


def status(graph: Graph, arrivals: Arrivals, **request: Any) -> dict[str, Any]:
    whole = {"topic": "/count", "node": "/arm/device", "subscription": False, "instance": 0, "newest": 0}
    return endpoint_status(graph, {**whole, **QOS, **request}, INSTANCE, arrivals)


@pytest.mark.parametrize("newest", [0, 2**32 - 2, 2**32 - 1])
def test_what_is_new_since_the_last_answer(newest: int) -> None:
    """Also where the numbers of endpoints wrap."""
    arrivals = Arrivals(newest)
    lasting = endpoint("/c", 4, durability=TRANSIENT_LOCAL)
    graph = Fixed(endpoint("/a", 2), endpoint("/b", 3))
    first = status(graph, arrivals)
    assert (first["status"], first["instance"], first["newest"]) == (OK, INSTANCE, (newest + 2) % 2**32)
    assert (first["matched"], first["matched_new"], first["policy"]) == (2, 2, 0)
    known = {"instance": INSTANCE, "newest": first["newest"]}
    assert status(graph, arrivals, **known)["matched_new"] == 0
    graph.others = [endpoint("/b", 3), lasting, endpoint("/a", 5)]  # one has left and come again
    second = status(graph, arrivals, **known)
    assert (second["matched"], second["matched_new"]) == (2, 1)
    assert (second["incompatible"], second["incompatible_new"], second["policy"]) == (1, 1, DURABILITY)
    assert second["newest"] == (newest + 4) % 2**32
    again = status(graph, arrivals, instance=INSTANCE, newest=second["newest"])
    assert (again["matched_new"], again["incompatible_new"], again["policy"]) == (0, 0, DURABILITY)
    assert status(graph, arrivals, instance=INSTANCE + 1, newest=1)["matched_new"] == 2, "of another server"


def test_the_policy_is_that_of_the_newest() -> None:
    arrivals = Arrivals()
    reliable = endpoint("/a", 2, durability=TRANSIENT_LOCAL)
    graph = Fixed(reliable)
    assert status(graph, arrivals)["policy"] == DURABILITY
    graph.others = [reliable, endpoint("/z", 1, deadline=1)]
    assert status(graph, arrivals)["policy"] == DEADLINE


def test_other_types_neither_match_nor_are_they_incompatible() -> None:
    found = status(Fixed(endpoint("/a", 2, type="std_msgs/msg/Int64")), Arrivals())
    assert (found["matched"], found["incompatible"], found["newest"]) == (0, 0, 1)


def test_a_subscription_meets_publishers() -> None:
    class Turned(Fixed):
        def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
            return (endpoint("/a", 2, reliability=BEST_EFFORT), endpoint("/b", 3, durability=TRANSIENT_LOCAL))

        def subscriptions(self, topic: str) -> tuple[GraphEndpoint, ...]:
            return (OWN,)

    found = status(Turned(), Arrivals(), subscription=True)
    assert (found["matched"], found["incompatible"], found["policy"]) == (1, 1, RELIABILITY)


def test_what_cannot_be_answered() -> None:
    assert status(Fixed(), Arrivals(), node="/arm/other") == {"status": UNKNOWN_NODE, "instance": INSTANCE}
    for topic in ("", "relative", "/a/", "/" + "a" * 99):
        assert status(Fixed(), Arrivals(), topic=topic) == {"status": INVALID, "instance": INSTANCE}


def test_an_endpoint_that_is_forgotten_is_new_again() -> None:
    arrivals = Arrivals()
    others = [replace(OWN, gid=number.to_bytes(16, "big")) for number in range(4097)]
    arrivals.see(others)
    assert arrivals.newest == 4097
    arrivals.see(others[1:])
    assert arrivals.newest == 4097
    arrivals.see(others[:1])
    assert arrivals.newest == 4098


@pytest.mark.parametrize(
    ("changed", "policy"),
    [
        ({}, 0),
        ({"durability": TRANSIENT_LOCAL}, DURABILITY),
        ({"deadline": OWN.deadline - 1}, DEADLINE),
        ({"liveliness": 3}, LIVELINESS),
        ({"lease": -1}, LIVELINESS),
        ({"deadline": 1, "durability": TRANSIENT_LOCAL}, DEADLINE),
        ({"liveliness": 3, "deadline": 1}, LIVELINESS),
    ],
)
def test_policies_of_a_subscription(changed: dict[str, int], policy: int) -> None:
    assert incompatibility(OWN, replace(OWN, **changed)) == policy  # type: ignore[arg-type]


def test_reliability_is_reported_before_all_others() -> None:
    publisher = replace(OWN, reliability=BEST_EFFORT)
    wanted = replace(OWN, durability=TRANSIENT_LOCAL, deadline=1, liveliness=3)
    assert incompatibility(publisher, wanted) == RELIABILITY
    assert incompatibility(publisher, replace(wanted, reliability=BEST_EFFORT)) == LIVELINESS
