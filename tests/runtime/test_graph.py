# SPDX-License-Identifier: Apache-2.0
"""Queries of the graph with a scripted agent and a clock of the test: results, limits, and servers that fail."""

from __future__ import annotations

import functools
import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.runtime.driver import Client, Result
from tests.support.runtime.graph_agent import GraphAgent, MadeGraph, endpoint
from tests.support.runtime.harness import build
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph]
memory: {arena: 2500}
pools: {guard_conditions: 1}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: order, type: std_msgs/msg/Int32}]
    clients: [{name: set, type: std_srvs/srv/SetBool, limits: {message: 8}, storage: none}]
"""
OK, ERROR, TIMEOUT, BAD_ALLOC, INVALID, NO_NODE = 0, 1, 2, 10, 11, 203
BAD_NODE, BAD_NAMESPACE = 201, 202
INT32, SET_BOOL = "std_msgs/msg/Int32", "std_srvs/srv/SetBool"
BETWEEN_MS = 1000
"""What a query waits for a server: create_timeout."""
TOPICS = tuple((f"/topic_{number}", (INT32,)) for number in range(5))
NODE = (("/arm/count", (INT32,)),)
DDS_TOPICS = (("rq/setRequest", ("std_srvs::srv::dds_::SetBool_Request_",)), ("rt/a", ("a::msg::dds_::A_",)))
FOREVER = 9223372036854775807


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("graph") / "tree", APPLICATION)
    return build(tree.without_port(), ["port_fake.c", "client_graph.c"], "graph")


class Device:
    """The program, its agent and the graph that its server knows."""

    def __init__(self, client: Client, agent: GraphAgent) -> None:
        self.client, self.agent = client, agent
        self.client.ok("init")

    def items(self, command: str) -> list[str]:
        return [line.removeprefix("item ") for line in self.client.ok(command).lines]

    def count(self, command: str) -> int:
        (line,) = self.client.ok(command).lines
        return int(line.removeprefix("count "))

    def fails(self, command: str, code: int) -> str:
        result: Result = self.client.call(command)
        assert result.code == code, result
        assert result.lines == ()
        return result.error


@pytest.fixture
def device(program: Path) -> Iterator[Device]:
    graph = MadeGraph(
        node_names=("/arm/device", "/a/b/deep", "/root"),
        enclaves={"/root": "/factory/root"},
        topic_names=TOPICS,
        service_names=(("/set", (SET_BOOL,)), ("/two", (SET_BOOL, "a/srv/B"))),
        dds_names=DDS_TOPICS,
        of_node={
            ("publishers", "/arm/device"): NODE,
            ("clients", "/root"): (),
            ("dds publishers", "/root"): DDS_TOPICS[:1],
            ("dds subscriptions", "/root"): DDS_TOPICS[1:],
        },
        publishing={"/arm/order": (endpoint("/root"),), "/arm/count": (endpoint("/arm/device"),)},
        subscribing={"/arm/count": (endpoint("/root", 1), endpoint("/a/b/deep", 2))},
        servers={"/arm/set": 2},
        clients={"/arm/set": 1},
    )
    # One publisher; then the subscription of changes; two clients of the graph after two subscriptions.
    agent = GraphAgent(mtu=256, graph=graph, reader=1, first_client=3)
    with Client(program, agent) as client:
        yield Device(client, agent)


def test_names_with_types(device: Device) -> None:
    assert device.items("names topics") == [f"/topic_{n} {INT32}" for n in range(5)]
    assert [request["first"] for _, request in device.agent.requests] == [0, 2, 4]
    assert device.items("names services") == [f"/set {SET_BOOL}", f"/two {SET_BOOL} a/srv/B"]


def test_names_of_a_node(device: Device) -> None:
    assert device.items("names publishers_of device /arm") == [f"/arm/count {INT32}"]
    assert device.agent.requests[-1][1]["node"] == "/arm/device"
    assert device.items("names clients_of root /") == []
    assert device.agent.requests[-1][1]["node"] == "/root"
    assert "graph: the node /arm/nobody is not known" in device.fails(
        "names services_of nobody /arm", NO_NODE
    )


def test_names_of_a_node_that_no_node_can_have(device: Device) -> None:
    requested = len(device.agent.requests)
    assert "name 'no%such'" in device.fails("names publishers_of no%such /arm", BAD_NODE)
    assert "name '1a'" in device.fails("names services_of 1a /arm", BAD_NODE)
    for namespace in ("arm", "x", "/arm/", "/a//b"):
        error = device.fails(f"names clients_of device {namespace}", BAD_NAMESPACE)
        assert f"name '{namespace}'" in error
    assert "a namespace begins with /" in device.fails("names publishers_of no%such x", BAD_NAMESPACE)
    assert len(device.agent.requests) == requested


def test_nodes(device: Device) -> None:
    assert device.items("nodes") == ["/arm device", "/a/b deep", "/ root"]
    assert all(request["types_max"] == 0 for _, request in device.agent.requests)


def test_nodes_with_enclaves(device: Device) -> None:
    assert device.items("enclaves") == ["/arm device /", "/a/b deep /", "/ root /factory/root"]
    assert len(device.agent.requests) == 2


def test_an_enclave_that_does_not_fit(device: Device) -> None:
    device.agent.graph.enclaves["/root"] = "/" + "x" * 300
    advice = "set limits: {microros_graph_msgs/msg/Name: {name: 190, types: {string: 190, sequence: 4}}}"
    assert advice in device.fails("enclaves", ERROR)


def test_a_server_that_reports_no_enclaves(device: Device) -> None:
    """All that was allocated is free again."""

    def without(response: dict[str, Any]) -> dict[str, Any]:
        return response | {"names": [name | {"types": []} for name in response["names"]]}

    device.agent.change = without
    for _ in range(5):
        assert "a node without an enclave" in device.fails("enclaves", ERROR)
    device.agent.change = lambda response: response
    assert len(device.items("enclaves")) == 3


def test_endpoints_of_a_topic(device: Device) -> None:
    hash_, forever = bytes(range(32)).hex(), "9223372036.854775807"
    rest = f"1 2 3 1 7 2.500000000 {forever} 0.000000000"
    assert device.items("infos subscriptions /arm/count") == [
        f"/ root {INT32} 2 1 {hash_} {'01' * 16} {rest}",
        f"/a/b deep {INT32} 2 1 {hash_} {'02' * 16} {rest}",
    ]
    assert device.items("infos publishers /arm/order") == [
        f"/ root {INT32} 1 1 {hash_} {'01' * 16} {rest}",
    ]
    assert device.items("infos publishers /nothing") == []


def test_counts(device: Device) -> None:
    assert device.count("count subscriptions /arm/count") == 2
    assert device.count("count publishers /arm/count") == 1
    assert device.count("count servers /arm/set") == 2
    assert device.count("count clients /arm/set") == 1
    assert device.count("count available") == 1
    device.agent.graph.servers.clear()
    assert device.count("count available") == 0
    assert all(request["endpoints_max"] == 0 for _, request in device.agent.requests)


def test_counts_of_own_endpoints(device: Device) -> None:
    best_effort = endpoint("/arm/device", reliability=2)
    assert device.count("count matched_subscriptions") == 2
    device.agent.graph.publishing["/arm/count"] = (best_effort,)
    assert device.count("count matched_subscriptions") == 0
    assert "an endpoint of the own node on /arm/order is not known" in device.fails(
        "count matched_publishers", ERROR
    )
    device.agent.graph.subscribing["/arm/order"] = (endpoint("/arm/device"),)
    assert device.count("count matched_publishers") == 1


def test_counts_are_those_of_the_endpoint_and_not_of_its_node(device: Device) -> None:
    """The device publishes /arm/count reliable, volatile, without deadline; its node has others of this topic."""
    forever, transient, late = {"deadline": FOREVER}, {"durability": 1, "deadline": FOREVER}, {"deadline": 9}
    graph = device.agent.graph
    graph.publishing["/arm/count"] = tuple(
        endpoint("/arm/device", i, **qos) for i, qos in enumerate((transient, forever, late))
    )
    for qos, expected in ((forever, 1), (transient, 0), (late, 0), ({"reliability": 2, **forever}, 1)):
        graph.subscribing["/arm/count"] = (endpoint("/root", **qos),)
        assert device.count("count matched_subscriptions") == expected, qos
    request = device.agent.requests[-1][1]
    assert (request["reliability"], request["durability"], request["deadline"]) == (1, 2, FOREVER)
    graph.publishing["/arm/count"] = graph.publishing["/arm/count"][:1]
    graph.subscribing["/arm/count"] = (endpoint("/root", **transient),)
    assert device.count("count matched_subscriptions") == 1, (
        "an agent that announces another QoS: all are meant"
    )


def test_names_of_dds(device: Device) -> None:
    items = [f"{name} {types[0]}" for name, types in DDS_TOPICS]
    assert device.items("names mangled") == items
    assert device.items("names mangled_publishers_of root /") == items[:1]
    assert device.items("names mangled_subscriptions_of root /") == items[1:]


def test_wrong_names_and_what_is_not_supported(device: Device) -> None:
    assert "not_absolute" in device.fails("count publishers not_absolute", INVALID)
    long = "/" + "x" * 95
    assert "a name does not fit" in device.fails(f"count publishers {long}", ERROR)
    assert "a name does not fit" in device.fails(f"names services_of {long[1:]} /", ERROR)
    assert device.count(f"count publishers {long[:-1]}") == 0


def test_names_that_have_no_room_are_an_error(device: Device) -> None:
    longest = "/" + "x" * 94
    device.agent.graph.topic_names = ((longest, (INT32,)),)
    assert device.items("names topics") == [f"{longest} {INT32}"]
    device.agent.graph.topic_names = (*TOPICS, (longest + "y", (INT32,)))
    assert "a name does not fit: set limits: {microros_graph_msgs/msg/Name: {name: 190, " in device.fails(
        "names topics", ERROR
    )
    device.agent.graph.topic_names = (("/three", (INT32, "a/msg/B", "a/msg/C")),)
    assert "sequence: 4}" in device.fails("names topics", ERROR)


def test_a_list_that_has_no_room_is_an_error_and_leaves_nothing(device: Device) -> None:
    device.agent.graph.topic_names = tuple((f"/topic_{n}", (INT32,)) for n in range(200))
    for _ in range(3):
        assert "raise memory: {arena:" in device.fails("names topics", BAD_ALLOC)
    device.agent.graph.node_names = tuple(f"/a{n}" for n in range(90))
    assert "raise memory: {arena:" in device.fails("nodes", BAD_ALLOC)
    device.agent.graph.subscribing["/arm/count"] = (endpoint("/root"),) * 20
    assert "raise memory: {arena:" in device.fails("infos subscriptions /arm/count", BAD_ALLOC)
    device.agent.graph.topic_names = TOPICS
    assert len(device.items("names topics")) == len(TOPICS)


def test_a_graph_that_changes_is_read_again(device: Device) -> None:
    responses = 0

    def later(response: dict[str, Any]) -> dict[str, Any]:
        nonlocal responses
        responses += 1
        return response | {"version": min(responses, 4)}

    device.agent.change = later
    assert len(device.items("names topics")) == len(TOPICS)
    assert [request["first"] for _, request in device.agent.requests] == [0, 2, 0, 2, 0, 2, 4]
    device.agent.change = lambda response: response | {"version": len(device.agent.requests)}
    assert "changes faster than it is read" in device.fails("names topics", ERROR)
    assert device.count("count publishers /arm/count") == 1


def test_without_a_server(device: Device) -> None:
    device.agent.server = False
    result = device.client.call("count publishers /arm/count")
    assert (result.code, result.slept) == (TIMEOUT, BETWEEN_MS)
    assert result.error == "no answer of a graph server within 1000 ms: start `microros-gen graph-server`"
    assert "no answer of a graph server" in device.fails("names topics", TIMEOUT)
    device.agent.server = True
    assert device.count("count publishers /arm/count") == 1


@pytest.mark.parametrize("timeout_ms", [1, 10, 700, 9000])
def test_a_wait_without_a_server_keeps_its_time(device: Device, timeout_ms: int) -> None:
    device.agent.server = False
    result = device.client.call(f"wait publishers /arm/count {timeout_ms}")
    assert (result.code, result.slept) == (TIMEOUT, timeout_ms)
    within = min(timeout_ms, BETWEEN_MS)
    assert f"no answer of a graph server within {within} ms" in result.error
    device.agent.server = True
    assert device.count("count publishers /arm/count") == 1


def test_a_wait_of_no_time_is_one_query(device: Device) -> None:
    """As in rcl: publishers that exist already are found."""
    device.client.ok("wait subscriptions /arm/count 0")
    before = len(device.agent.requests)
    result = device.client.call("wait subscriptions /arm/order 0")
    assert (result.code, result.error, len(device.agent.requests)) == (TIMEOUT, "", before + 1)
    device.agent.server = False
    result = device.client.call("wait publishers /arm/order 0")
    assert (result.code, result.slept) == (TIMEOUT, BETWEEN_MS)
    assert "no answer of a graph server" in result.error


def test_a_wait_that_fails_for_good_ends_at_once(device: Device) -> None:
    for name, code in (("/" + "x" * 95, ERROR), ("not_absolute", INVALID)):
        result = device.client.call(f"wait publishers {name} 9000")
        assert (result.code, result.slept < 100) == (code, True)
        assert result.error


def test_a_response_that_arrives_after_a_short_wait_is_not_that_of_the_next_query(device: Device) -> None:
    device.agent.held = []
    assert device.client.call("wait publishers /arm/order 10").code == TIMEOUT
    assert len(device.agent.held) == 1
    device.client.queued += device.agent.release()
    assert device.count("count subscriptions /arm/count") == 2


@pytest.mark.parametrize("timeout_ms", [60_000, -1])
@pytest.mark.parametrize("what", ["agent", "server"])
def test_a_wait_survives_a_restart(device: Device, what: str, timeout_ms: int) -> None:
    """The agent or server restarts at once and answers after 5 seconds; two publishers appear after 8."""
    started_ms, graph = device.client.now_ms, device.agent.graph
    restarted = False

    def pass_time() -> None:
        nonlocal restarted
        passed_ms = device.client.now_ms - started_ms
        if passed_ms > 300 and not restarted:
            restarted, device.agent.server = True, False
            if what == "agent":
                device.agent.restart()
        if passed_ms > 5000:
            device.agent.server = True
        if passed_ms > 8000 and "/late" not in graph.publishing:
            graph.publishing["/late"] = (endpoint("/root", 1), endpoint("/root", 2))
            device.client.queued += device.agent.notice()

    device.client.on_sleep = pass_time
    assert 8000 <= device.client.ok(f"wait publishers /late {timeout_ms}").slept < 10_000
    assert restarted


def test_a_wait_begun_while_the_agent_is_away(device: Device) -> None:
    """The next request finds no session; the wait ends when the agent is there again."""
    started_ms = device.client.now_ms
    device.agent.graph.publishing["/late"] = (endpoint("/root", 1), endpoint("/root", 2))
    device.agent.silent = True
    for _ in range(100):
        device.client.wait(200)
        device.client.ok("spin 0")
    result = device.client.call("wait publishers /late 300")
    assert (result.code, result.slept) == (TIMEOUT, 300)
    assert result.error

    def reappear() -> None:
        if device.client.now_ms > started_ms + 30_000 and device.agent.silent:
            device.agent.restart()
            device.agent.silent = False

    device.client.on_sleep = reappear
    device.client.ok("wait publishers /late 60000")
    assert not device.agent.silent


def test_a_server_that_appears_within_the_time(device: Device) -> None:
    device.agent.server = False
    asleep = 0

    def appear() -> None:
        nonlocal asleep
        asleep += 1
        device.agent.server = asleep > 10

    device.client.on_sleep = appear
    assert device.count("count publishers /arm/count") == 1


def test_an_agent_that_restarts(device: Device) -> None:
    asleep = 0

    def restart() -> None:
        nonlocal asleep
        asleep += 1
        if asleep == 1:
            device.agent.restart()

    device.agent.server = False
    device.client.on_sleep = restart
    assert device.client.call("names topics").code in (ERROR, TIMEOUT)
    device.agent.server = True
    for _ in range(20):
        device.client.wait(200)
        device.client.ok("spin 0")
    assert len(device.items("names topics")) == len(TOPICS)


def test_a_change_wakes_a_wait_set(device: Device) -> None:
    assert device.client.call("change 200").code == TIMEOUT
    device.client.queued += device.agent.notice()
    assert device.client.ok("change 200").slept == 0
    assert device.client.call("change 200").code == TIMEOUT


def test_a_change_calls_back_in_the_executor(device: Device) -> None:
    for expected in (1, 2):
        device.client.queued += device.agent.notice()
        device.client.ok("spin 20")
        assert device.count("changes") == expected
    device.client.ok("spin 20")
    assert device.count("changes") == 2


def test_a_change_during_a_query_is_not_lost(device: Device) -> None:
    device.client.queued += device.agent.notice()
    assert device.count("count publishers /arm/count") == 1
    device.client.ok("spin 20")
    assert device.count("changes") == 1


def test_waits_for_publishers(device: Device) -> None:
    graph, two = device.agent.graph, (endpoint("/root", 1), endpoint("/root", 2))

    def appear() -> None:
        if device.client.now_ms > started_ms + 300 and "/late" not in graph.publishing:
            graph.publishing["/late"] = two
            device.client.queued += device.agent.notice()

    started_ms = device.client.now_ms
    device.client.on_sleep = appear
    assert 300 <= device.client.ok("wait publishers /late 2000").slept < 400
    assert device.client.ok("wait publishers /late 2000").slept < 10
    graph.subscribing["/late"] = two[:1]
    result = device.client.call("wait subscriptions /late 700")
    assert (result.code, result.slept) == (TIMEOUT, 700)


CONTRADICTIONS: dict[str, Callable[[dict[str, Any]], dict[str, Any]]] = {
    "next beyond total": lambda r: r | {"next": r["total"] + 1},
    "next does not advance": lambda r: r | {"next": 0},
    "fewer names than next says": lambda r: r | {"names": r["names"][:1]},
    "no names": lambda r: r | {"names": [], "next": 0},
    "a total of all": lambda r: r | {"total": 2**32 - 1},
    "an unknown status": lambda r: r | {"status": 77},
}


@pytest.mark.parametrize("name", CONTRADICTIONS)
def test_responses_that_contradict_themselves(device: Device, name: str) -> None:
    device.agent.change = CONTRADICTIONS[name]
    result = device.client.call("names topics")
    assert result.code in (ERROR, BAD_ALLOC)
    assert result.error
    device.agent.change = lambda response: response
    assert len(device.items("names topics")) == len(TOPICS)


def test_a_node_name_without_a_slash(device: Device) -> None:
    device.agent.graph.node_names = ("plain",)
    assert "a node without a namespace" in device.fails("nodes", ERROR)
    device.agent.graph.node_names = ("/",)
    assert device.items("nodes") == ["/ "]


QUERIES = (
    "names services",
    "nodes",
    "enclaves",
    "infos subscriptions /arm/count",
    "count publishers /arm/count",
)


@pytest.mark.parametrize("query", QUERIES)
def test_truncated_responses(device: Device, query: str) -> None:
    bodies: list[bytes] = []

    def damage(body: bytes, size: int | None = None) -> bytes:
        bodies.append(body)
        return body[:size]

    device.agent.damage = damage
    device.client.ok(query)
    body = bodies[0]
    for size in range(len(body)):
        device.agent.damage = functools.partial(damage, size=size)
        result = device.client.call(query)
        assert result.code == ERROR, size
        assert result.error


def test_damaged_responses(device: Device) -> None:
    """Random bytes are changed; sanitizers watch, and the next query is answered."""
    generator = random.Random(14)
    device.agent.damage = lambda body: bytes(
        byte if generator.random() > 0.03 else generator.randrange(256) for byte in body
    )
    failed = 0
    for number in range(400):
        result = device.client.call(QUERIES[number % len(QUERIES)])
        failed += result.code != OK
        assert result.code == OK or result.error
    assert 100 < failed < 400
    device.agent.damage = lambda body: body
    assert len(device.items("names topics")) == len(TOPICS)


def test_ends_and_begins_again(device: Device) -> None:
    device.client.ok("end")
    device.client.ok("init")
    assert len(device.items("names topics")) == len(TOPICS)
    device.client.ok("end")
