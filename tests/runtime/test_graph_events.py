# SPDX-License-Identifier: Apache-2.0
"""Matched endpoints and incompatible QoS with a scripted agent and a clock of the test: silence, changes, wraps."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.runtime.driver import Client
from tests.support.runtime.graph_agent import GraphAgent, MadeGraph, endpoint
from tests.support.runtime.harness import build
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_events]
memory: {arena: 2500}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
"""
OWN = {"reliability": 1, "durability": 2, "deadline": 9223372036854775807}
TRANSIENT_LOCAL = 1
NONE, DURABILITY = 1, 2
AGAIN_MS = 1000
ALREADY_INIT = 100
EVENT_INVALID = 2000


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("graph_events") / "tree", APPLICATION)
    return build(tree.without_port(), ["port_fake.c", "client_graph_events.c"], "graph_events")


class Device:
    """The program, and the agent with the graph of the test."""

    def __init__(self, client: Client, agent: GraphAgent) -> None:
        self.client, self.agent = client, agent

    def spin(self, milliseconds: int = 20) -> None:
        self.client.ok(f"spin {milliseconds}")

    def status(self) -> list[int]:
        """Return total, change, current and change of what matches; total, change and policy of others; callbacks."""
        (line,) = self.client.ok("take").lines
        return [int(word) for word in line.split()[1:]]

    def change(self, *subscriptions: int, lasting: tuple[int, ...] = ()) -> None:
        """Let the topic have subscriptions with these numbers, and send a notice."""
        self.agent.graph.subscribing["/arm/count"] = (
            *(endpoint("/a", number, **OWN) for number in subscriptions),
            *(endpoint("/b", number, **{**OWN, "durability": TRANSIENT_LOCAL}) for number in lasting),
        )
        for datagram in self.agent.notice():
            self.client.queued.append(datagram)
        self.spin()


@contextmanager
def opened(program: Path, now_ms: int = 0) -> Iterator[Device]:
    """Run the program from a time of its clock on, with its node and publisher."""
    graph = MadeGraph(publishing={"/arm/count": (endpoint("/arm/device", 9, **OWN),)})
    # The subscription of changes; the clients of the graph after it, and then that of its events.
    agent = GraphAgent(mtu=256, graph=graph, reader=1, first_client=2)
    with Client(program, agent) as client:
        client.wait(now_ms)
        client.ok("init")
        yield Device(client, agent)


@pytest.fixture
def device(program: Path, request: pytest.FixtureRequest) -> Iterator[Device]:
    with opened(program, getattr(request, "param", 0)) as device:
        yield device


def test_changes_of_the_graph(device: Device) -> None:
    device.client.ok("open")
    device.spin()
    assert device.status() == [0, 0, 0, 0, 0, 0, NONE, 0]
    device.change(1, 2, lasting=(3,))
    assert device.status() == [2, 2, 2, 2, 1, 1, DURABILITY, 0]
    assert device.status() == [2, 0, 2, 0, 1, 0, DURABILITY, 0]
    device.change(2)
    assert device.status() == [2, 0, 1, -1, 1, 0, DURABILITY, 0]
    device.change(2, 4)
    device.change(4)
    device.change(4, 5)
    device.client.ok("listen")
    assert device.status() == [4, 2, 2, 1, 1, 0, DURABILITY, 3], "two came and one left"
    device.change(lasting=(6, 7))
    assert device.status() == [4, 0, 0, -2, 3, 2, DURABILITY, 6]
    assert [name for name, _ in device.agent.requests] == ["EndpointStatus"] * len(device.agent.requests)
    assert {request["node"] for _, request in device.agent.requests} == {"/arm/device"}
    count = len(device.agent.requests)
    device.spin(5 * AGAIN_MS)
    assert len(device.agent.requests) == count, "nothing is asked without a change"


def test_another_server_counts_again(device: Device) -> None:
    device.change(1, 2)
    device.client.ok("open")
    device.spin()
    assert device.status() == [2, 2, 2, 2, 0, 0, NONE, 0]
    device.agent.instance += 1
    device.agent.arrivals.__init__()  # type: ignore[misc]
    device.change(1, 2)
    assert device.status() == [4, 2, 2, 0, 0, 0, NONE, 0]


@pytest.mark.parametrize("device", [2**32 - 2 * AGAIN_MS, 0], indirect=True)
def test_a_silent_server_is_asked_once_a_second(device: Device) -> None:
    """Over the wrap of the milliseconds, too."""
    device.agent.server = False
    device.agent.graph.subscribing["/arm/count"] = (endpoint("/a", 1, **OWN),)
    device.client.ok("open")
    before = len(device.client.sent)
    device.spin(5 * AGAIN_MS)
    status = [s for s in device.client.sent[before:] if b"/arm/count" in s]
    assert 5 <= len(status) <= 7
    device.agent.server = True
    device.spin(3 * AGAIN_MS)
    assert device.status()[:4] == [1, 1, 1, 1]


def test_an_endpoint_that_is_not_discovered_yet(device: Device) -> None:
    own = device.agent.graph.publishing.pop("/arm/count")
    device.client.ok("open")
    device.spin(2 * AGAIN_MS)
    assert device.status()[:4] == [0, 0, 0, 0]
    assert 2 <= len(device.agent.requests) <= 5
    device.agent.graph.publishing["/arm/count"] = own
    device.agent.graph.subscribing["/arm/count"] = (endpoint("/a", 1, **OWN),)
    device.spin(3 * AGAIN_MS)
    assert device.status()[:4] == [1, 1, 1, 1]


def test_a_lost_session_stops_no_executor(tmp_path: Path) -> None:
    """A request without a session would wait as a publish call does."""
    tree = write_application(tmp_path / "tree", f"{APPLICATION}on_full: block 9 s\n")
    program = build(tree.without_port(), ["port_fake.c", "client_graph_events.c"], "graph_events")
    with opened(program) as device:
        device.client.ok("open")
        device.agent.silent = True
        device.spin(15 * AGAIN_MS)
        before = device.client.now_ms
        device.spin(5 * AGAIN_MS)
        assert device.client.now_ms - before < 6 * AGAIN_MS
        device.agent.silent = False
        device.agent.graph.subscribing["/arm/count"] = (endpoint("/a", 1, **OWN),)
        device.spin(15 * AGAIN_MS)
        assert device.status()[:4] == [1, 1, 1, 1]


def test_an_event_ends_with_its_entity(device: Device) -> None:
    device.change(1)
    device.client.ok("open")
    device.client.ok("fini")
    device.spin()
    assert device.client.call("take").code == EVENT_INVALID
    device.client.ok("open")
    device.spin()
    assert device.status()[:4] == [1, 1, 1, 1]
    device.client.ok("close")
    count = len(device.agent.requests)
    device.change(1, 2)
    assert len(device.agent.requests) == count
    assert device.status()[:4] == [1, 0, 1, 0]
    device.client.ok("fini")


def test_of_two_servers_the_first_one_is_asked_until_it_is_silent(device: Device) -> None:
    """Its counts are not added to those of the other one; an event that is opened later stays with it, too."""
    device.change(1)
    device.client.ok("open")
    device.spin()
    first = device.agent.instance
    assert [request["instance"] for _, request in device.agent.requests] == [0, first]
    assert not any(request["any_server"] for _, request in device.agent.requests)
    device.agent.server = False
    device.change(1, 2)
    device.spin(3 * AGAIN_MS)
    device.agent.server = True
    device.agent.instance += 1
    device.agent.arrivals.__init__()  # type: ignore[misc]
    before = len(device.agent.requests)
    device.spin(3 * AGAIN_MS)
    requests = [request for _, request in device.agent.requests[before:]]
    assert all(request["instance"] == first and request["any_server"] for request in requests)
    assert len(requests) == 2, "one for each event"
    device.change(1, 2, 3)
    last = [request for _, request in device.agent.requests[-2:]]
    assert [(request["instance"], request["any_server"]) for request in last] == [(first + 1, False)] * 2


def test_one_lost_response_does_not_lead_to_another_server(device: Device) -> None:
    device.client.ok("open")
    device.spin()
    device.agent.server = False
    device.change(1)
    device.agent.server = True
    device.spin(2 * AGAIN_MS)
    assert not any(request["any_server"] for _, request in device.agent.requests)
    assert device.status() == [1, 1, 1, 1, 0, 0, NONE, 0]
