# SPDX-License-Identifier: Apache-2.0
"""Pages, filters and limits of the graph server, with a graph of 500 nodes that nobody has to start."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from microros_gen.graph_server import answers
from microros_gen.graph_server.answers import list_endpoints, list_names
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphEndpoint, Names

NODES = tuple(f"/area_{i % 7}/node_{i:03}" for i in range(500))
TOPICS: Names = tuple((f"/t/{i:03}", ("std_msgs/msg/Int32",)) for i in range(40))
ENDPOINT = GraphEndpoint(
    "/n", "std_msgs/msg/Int32", 1, bytes(32), bytes(16), 1, 2, 3, 1, 0, 2**63 - 1, 2**63 - 1, 2**63 - 1
)


class Fixed(Graph):
    """A graph that is given."""

    def __init__(self, topics: Names = TOPICS) -> None:
        self._topics = topics
        self.ends: dict[str, tuple[GraphEndpoint, ...]] = {}

    def nodes(self) -> tuple[str, ...]:
        return NODES

    def topics(self, demangle: bool = True) -> Names:
        return self._topics

    def publishers_of(self, node: str, demangle: bool = True) -> Names | None:
        return TOPICS[:2] if node in NODES else None

    def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
        if topic == "/refused":
            raise RosError("invalid")
        return self.ends.get("publishers", ())

    def subscriptions(self, topic: str) -> tuple[GraphEndpoint, ...]:
        return self.ends.get("subscriptions", ())


def names(graph: Graph, **request: Any) -> dict[str, Any]:
    whole = {
        "what": answers.TOPICS,
        "node": "",
        "filter": "",
        "first": 0,
        "names_max": 100,
        "name_size": 0,
        "types_max": 9,
    }
    return list_names(graph, {**whole, **request}, lambda _question, _answer: 7)


def endpoints(graph: Graph, **request: Any) -> dict[str, Any]:
    whole = {
        "what": answers.PUBLISHERS,
        "name": "/t",
        "matched_by": "",
        "reliability": 0,
        "durability": 0,
        "deadline": 0,
        "first": 0,
        "endpoints_max": 9,
        "name_size": 0,
    }
    return list_endpoints(graph, {**whole, **request}, lambda _question, _answer: 7)


@pytest.mark.parametrize("page", [1, 3, 499, 500, 501])
def test_pages_have_every_node_once(page: int) -> None:
    found: list[str] = []
    first, turns = 0, 0
    while True:
        response = names(Fixed(), what=answers.NODES, first=first, names_max=page)
        assert (response["status"], response["version"], response["total"]) == (answers.OK, 7, 500)
        assert not response["truncated"]
        found += [item["name"] for item in response["names"]]
        first, turns = response["next"], turns + 1
        if first == response["total"]:
            break
    assert tuple(found) == NODES
    assert turns == -(-500 // page)


def test_a_page_after_the_end_is_empty() -> None:
    response = names(Fixed(), first=4_000_000_000)
    assert (response["names"], response["next"], response["total"]) == ([], 40, 40)


@pytest.mark.parametrize(
    ("wanted", "count"), [("", 500), (NODES[3], 1), ("/area_3/", 71), ("/area_3", 0), ("/area_3/node", 0)]
)
def test_a_filter_is_a_name_or_what_is_below_it(wanted: str, count: int) -> None:
    response = names(Fixed(), what=answers.NODES, filter=wanted, names_max=500)
    assert response["total"] == len(response["names"]) == count


def test_without_room_there_is_the_total() -> None:
    response = names(Fixed(), names_max=0)
    assert (response["total"], response["next"], response["names"], response["truncated"]) == (
        40,
        0,
        [],
        False,
    )


def test_a_name_that_does_not_fit_is_left_out_and_reported() -> None:
    graph = Fixed((("/long_name", ("a/msg/B",)), ("/s", ("a/msg/B", "a/msg/Longer"))))
    response = names(graph, name_size=8)
    assert response["names"] == [{"name": "/s", "types": ["a/msg/B"]}]
    assert (response["truncated"], response["total"], response["next"]) == (True, 2, 2)
    assert not names(graph, name_size=13)["truncated"]
    assert names(graph, name_size=12)["truncated"], "the NUL has to fit as well"


def test_names_that_do_not_fit_take_no_room_of_the_page() -> None:
    graph = Fixed((("/a_long_name", ()), ("/b_long_name", ()), ("/c", ())))
    response = names(graph, name_size=4, names_max=1)
    assert ([item["name"] for item in response["names"]], response["next"]) == (["/c"], 3)


def test_types_beyond_the_room_are_reported_unless_none_are_wanted() -> None:
    graph = Fixed((("/s", ("a/msg/A", "a/msg/B")),))
    limited, none = names(graph, types_max=1), names(graph, types_max=0)
    assert (limited["names"][0]["types"], limited["truncated"]) == (["a/msg/A"], True)
    assert (none["names"][0]["types"], none["truncated"]) == ([], False)


def test_lengths_are_bytes() -> None:
    assert names(Fixed((("/é", ()),)), name_size=4)["names"] == [{"name": "/é", "types": []}]
    assert names(Fixed((("/é", ()),)), name_size=3)["names"] == []


def test_what_cannot_be_answered_has_a_status() -> None:
    assert names(Fixed(), what=11) == {"status": answers.INVALID, "version": 7}
    unknown = names(Fixed(), what=answers.PUBLISHERS_OF, node="/nobody")
    assert unknown == {"status": answers.UNKNOWN_NODE, "version": 7}
    assert names(Fixed(), what=answers.PUBLISHERS_OF, node=NODES[0])["total"] == 2
    assert endpoints(Fixed(), what=9) == {"status": answers.INVALID, "version": 7}
    for name in ("", "/", "no name", "relative", "//", "/a/", "/1", "/é", "/refused"):
        assert endpoints(Fixed(), name=name) == {"status": answers.INVALID, "version": 7}
    assert endpoints(Fixed(), matched_by="/nobody") == {"status": answers.UNKNOWN_NODE, "version": 7}


def test_endpoints_have_pages_and_limits() -> None:
    graph = Fixed()
    graph.ends["publishers"] = tuple(replace(ENDPOINT, node=f"/node_{i}") for i in range(12))
    response = endpoints(graph, first=8, endpoints_max=2)
    assert [item["node"] for item in response["endpoints"]] == ["/node_8", "/node_9"]
    assert (response["next"], response["total"], response["truncated"]) == (10, 12, False)
    short = endpoints(graph, first=8, name_size=8)
    assert (short["endpoints"], short["truncated"], short["next"]) == ([], True, 12)
    assert endpoints(graph, endpoints_max=0)["total"] == 12
