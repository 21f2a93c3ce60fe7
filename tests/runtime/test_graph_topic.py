# SPDX-License-Identifier: Apache-2.0
"""Queries that are answered from the topic of micro_ros_agent, with a scripted agent and a clock of the test."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from tests.support.ros_graph_message import CLIENT, PUBLISHER, SERVER, SUBSCRIBER, Entity
from tests.support.runtime.driver import Client, Result
from tests.support.runtime.graph_topic_agent import GraphTopicAgent
from tests.support.runtime.harness import build
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_topic]
memory: {arena: 4000}
pools: {guard_conditions: 1, slot_size: 1024}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: order, type: std_msgs/msg/Int32}]
    clients: [{name: set, type: std_srvs/srv/SetBool, limits: {message: 8}, storage: none}]
"""
OK, ERROR, TIMEOUT, UNSUPPORTED, BAD_ALLOC, INVALID, NO_NODE = 0, 1, 2, 3, 10, 11, 203
BAD_NODE, BAD_NAMESPACE = 201, 202
INT32, SET_BOOL, STRING = ("std_msgs/msg/Int32",), ("std_srvs/srv/SetBool",), ("std_msgs/msg/String",)
BETWEEN_MS = 1000
"""How long a query waits for the next piece: create_timeout."""
FRAGMENT_BYTES = 256
"""Bytes of a message of the agent."""
NODES: dict[str, Sequence[Entity]] = {
    "/arm/device": (
        (PUBLISHER, "/arm/count", INT32),
        (SUBSCRIBER, "/arm/order", INT32),
        (CLIENT, "/arm/set", SET_BOOL),
    ),
    "/a/b/deep": ((SUBSCRIBER, "/arm/count", INT32), (SERVER, "/arm/set", SET_BOOL)),
    "/root": (
        (SUBSCRIBER, "/arm/count", STRING),
        (PUBLISHER, "/arm/order", INT32),
        (PUBLISHER, "/empty", ()),
    ),
    "/silent": (),
}
CAPTURED = bytes.fromhex(
    "030000000c0000002f70656572732f6465657000070000006f7261636c6500000400000000000000120000002f706172"
    "616d657465725f6576656e7473000000010000002200000072636c5f696e74657266616365732f6d73672f506172616d"
    "657465724576656e740001000b0000002f61726d2f636f756e74000001000000130000007374645f6d7367732f6d7367"
    "2f496e7433320002090000002f61726d2f7365740000000001000000150000007374645f737276732f7372762f536574"
    "426f6f6c00030000090000002f61726d2f7365740000000001000000150000007374645f737276732f7372762f536574"
    "426f6f6c00000000020000002f000000070000007365636f6e6400000400000000000000120000002f706172616d6574"
    "65725f6576656e7473000000010000002200000072636c5f696e74657266616365732f6d73672f506172616d65746572"
    "4576656e74000000070000002f776f726473000001000000140000007374645f6d7367732f6d73672f537472696e6700"
    "02000000090000002f61726d2f7365740000000001000000150000007374645f737276732f7372762f536574426f6f6c"
    "00030000090000002f61726d2f7365740000000001000000150000007374645f737276732f7372762f536574426f6f6c"
    "00000000020000002f0000000f0000006d6963726f726f735f677261706800000200000002000000090000002f61726d"
    "2f7365740000000001000000150000007374645f737276732f7372762f536574426f6f6c00030000090000002f61726d"
    "2f7365740000000001000000150000007374645f737276732f7372762f536574426f6f6c00"
)
"""A sample of micro_ros_agent 5.0.2 (af00787), of three nodes. It lists every service at every node, both ways."""
QUERIES = (
    "names topics",
    "nodes",
    "enclaves",
    "infos subscriptions /arm/count",
    "count publishers /arm/count",
)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("graph_topic") / "tree", APPLICATION)
    return build(tree.without_port(), ["port_fake.c", "client_graph.c"], "graph_topic")


class Device:
    """The program, its agent and the graph that it publishes."""

    def __init__(self, client: Client, agent: GraphTopicAgent) -> None:
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

    def heartbeats(self) -> None:
        """Let the agent ask for acknowledgements while the device waits."""
        self.client.on_sleep = lambda: self.client.queued.extend(self.agent.tick())


@pytest.fixture(params=["fragments", "messages", "big endian"])
def device(program: Path, request: pytest.FixtureRequest) -> Iterator[Device]:
    # One publisher; the subscription of the graph is the first one.
    agent = GraphTopicAgent(
        mtu=1024 if request.param == "messages" else FRAGMENT_BYTES, nodes=dict(NODES), reader=1
    )
    agent.big_endian = request.param == "big endian"
    with Client(program, agent) as client:
        yield Device(client, agent)


@pytest.fixture
def chunked(program: Path) -> Iterator[Device]:
    """The device, whose samples come in fragments."""
    agent = GraphTopicAgent(mtu=FRAGMENT_BYTES, nodes=dict(NODES), reader=1)
    with Client(program, agent) as client:
        yield Device(client, agent)


def test_the_reader_is_that_of_micro_ros(chunked: Device) -> None:
    """Its topic is one of DDS: no prefix of ROS in front of the name."""
    topic = chunked.agent.objects[((1 << 4) | 2).to_bytes(2, "big")]
    assert b"\x16\0\0\0ros_to_microros_graph\0" in topic
    assert b"micro_ros_msgs::msg::dds_::Graph_\0" in topic
    assert b"rt/arm/count\0" in chunked.agent.objects[b"\0\2"]
    reader = chunked.agent.objects[chunked.agent.identity]
    assert reader[10 + 2] & 0x0B == 0x0B, "reliable, transient local, keep last"


def test_names_with_types(device: Device) -> None:
    assert device.items("names topics") == [
        "/arm/count std_msgs/msg/Int32 std_msgs/msg/String",
        "/arm/order std_msgs/msg/Int32",
        "/empty",
    ]
    assert device.items("names services") == ["/arm/set std_srvs/srv/SetBool"]


def test_names_of_a_node(device: Device) -> None:
    assert device.items("names publishers_of device /arm") == ["/arm/count std_msgs/msg/Int32"]
    assert device.items("names subscriptions_of device /arm") == ["/arm/order std_msgs/msg/Int32"]
    assert device.items("names services_of deep /a/b") == ["/arm/set std_srvs/srv/SetBool"]
    assert device.items("names clients_of device /arm") == ["/arm/set std_srvs/srv/SetBool"]
    assert device.items("names clients_of root /") == []
    assert device.items("names clients_of silent /") == []
    assert "graph: the node /arm/nobody is not known" in device.fails(
        "names services_of nobody /arm", NO_NODE
    )


def test_names_of_a_node_that_no_node_can_have(device: Device) -> None:
    assert "name 'no%such'" in device.fails("names publishers_of no%such /arm", BAD_NODE)
    assert "name '1a'" in device.fails("names services_of 1a /arm", BAD_NODE)
    for namespace in ("arm", "x", "/arm/", "/a//b"):
        error = device.fails(f"names clients_of device {namespace}", BAD_NAMESPACE)
        assert f"name '{namespace}'" in error
    assert "a namespace begins with /" in device.fails("names publishers_of no%such x", BAD_NAMESPACE)


def test_nodes(device: Device) -> None:
    assert device.items("nodes") == ["/arm device", "/a/b deep", "/ root", "/ silent"]
    enclaves = ["/arm device /", "/a/b deep /", "/ root /", "/ silent /"]
    assert device.items("enclaves") == enclaves


def test_endpoints_of_a_topic(device: Device) -> None:
    """The message has neither QoS nor hash nor identifier: history, reliability and so on are unknown."""
    nothing = f"{'00' * 32} {'00' * 16}"
    subscriptions = device.items("infos subscriptions /arm/count")
    assert [line.split()[:4] for line in subscriptions] == [
        ["/a/b", "deep", *INT32, "2"],
        ["/", "root", *STRING, "2"],
    ]
    assert all(nothing in line for line in subscriptions)
    (publisher,) = device.items("infos publishers /arm/order")
    assert publisher.split()[:4] == ["/", "root", *INT32, "1"]
    assert device.items("infos publishers /nothing") == []


def test_counts(device: Device) -> None:
    assert device.count("count subscriptions /arm/count") == 2
    assert device.count("count publishers /arm/count") == 1
    assert device.count("count publishers /arm") == 0
    assert device.count("count servers /arm/set") == 1
    assert device.count("count clients /arm/set") == 1
    assert device.count("count available") == 1
    device.agent.nodes["/a/b/deep"] = ()
    assert device.count("count available") == 0


def test_matched_counts_are_those_of_the_own_type(device: Device) -> None:
    assert device.count("count matched_subscriptions") == 1, "that of a String does not match"
    assert device.count("count matched_publishers") == 1


def test_a_sample_of_micro_ros_agent(chunked: Device) -> None:
    chunked.agent.sample = lambda: CAPTURED  # type: ignore[method-assign]
    assert chunked.items("nodes") == ["/peers/deep oracle", "/ second", "/ microros_graph"]
    assert chunked.items("names topics") == [
        "/parameter_events rcl_interfaces/msg/ParameterEvent",
        "/arm/count std_msgs/msg/Int32",
        "/words std_msgs/msg/String",
    ]
    assert chunked.items("names services") == ["/arm/set std_srvs/srv/SetBool"]
    assert chunked.items("names publishers_of second /")[1:] == ["/words std_msgs/msg/String"]
    assert chunked.items("names subscriptions_of oracle /peers/deep") == ["/arm/count std_msgs/msg/Int32"]
    assert chunked.count("count publishers /parameter_events") == 2
    assert chunked.count("count available") == 1
    assert chunked.count("count matched_subscriptions") == 1


def test_what_the_topic_does_not_tell(device: Device) -> None:
    assert "use a graph server" in device.fails("names mangled", UNSUPPORTED)
    assert "begins with a slash" in device.fails("count publishers not_absolute", INVALID)
    assert "a name does not fit" in device.fails("count publishers /" + "x" * 95, ERROR)


NAMES = (
    "/",
    "//a",
    "/a//b",
    "/a/",
    "/1a",
    "/a/2",
    "/a-b",
    "/a.b",
    "/{a}",
    "/~",
    "a",
    "/a",
    "/a1/_b2",
    "/A/b_",
    "/_",
)


def test_a_name_is_valid_where_it_is_for_rcl(device: Device) -> None:
    """The oracle is the function of rmw with which rcl_count_publishers of ROS 2 checks a name."""
    pytest.importorskip("rclpy")
    import rclpy.validate_full_topic_name
    from rclpy.exceptions import InvalidTopicNameException

    for name in NAMES:
        try:
            expected = OK if rclpy.validate_full_topic_name.validate_full_topic_name(name) else INVALID
        except InvalidTopicNameException:
            expected = INVALID
        assert device.client.call(f"count publishers {name}").code == expected, name


def test_a_graph_of_500_nodes(chunked: Device) -> None:
    """Of a message larger than 64 KiB only the answer is in memory."""
    entities = tuple((SERVER, f"/node/service_{n}", SET_BOOL) for n in range(6))
    for number in range(500):
        own = (PUBLISHER, f"/topic_{number}", INT32), (SUBSCRIBER, "/clock", INT32)
        chunked.agent.nodes[f"/ns/node_{number}"] = (*own, *entities)
    assert len(chunked.agent.sample()) > 150_000
    assert chunked.count("count subscriptions /clock") == 500
    assert chunked.count("count publishers /topic_499") == 1
    assert chunked.items("names publishers_of node_250 /ns") == ["/topic_250 std_msgs/msg/Int32"]
    assert len(chunked.items("names services")) == 7, "each name once"
    assert "raise memory: {arena:" in chunked.fails("names topics", BAD_ALLOC)
    assert chunked.count("count available") == 1


@pytest.mark.parametrize("stated", [0, 4, 65535])
def test_the_length_in_front_of_fragments_has_only_16_bits(chunked: Device, stated: int) -> None:
    chunked.agent.stated = stated
    assert chunked.count("count subscriptions /arm/count") == 2


def test_names_that_have_no_room_are_an_error(chunked: Device) -> None:
    longest = "/" + "x" * 94
    chunked.agent.nodes = {"/a": ((PUBLISHER, longest, INT32),), "/b": ()}
    assert chunked.items("names topics") == [f"{longest} {INT32[0]}"]
    assert chunked.count(f"count publishers {longest[:-1]}") == 0
    too_long = "a name does not fit: set limits: {micro_ros_msgs/msg/Entity: {name: 190}}"
    chunked.agent.nodes["/b"] = ((PUBLISHER, longest + "y", INT32), (SUBSCRIBER, "/short", (longest + "y",)))
    assert too_long in chunked.fails("names topics", ERROR)
    assert too_long in chunked.fails("names subscriptions_of b /", ERROR)
    assert too_long in chunked.fails("infos subscriptions /short", ERROR)
    assert chunked.count(f"count publishers {longest}") == 1, "the longer one is another"
    chunked.agent.nodes[longest + "y"] = ()
    assert too_long in chunked.fails("nodes", ERROR)
    assert chunked.items("names publishers_of a /") == [f"{longest} {INT32[0]}"]


def test_a_list_that_has_no_room_is_an_error_and_leaves_nothing(chunked: Device) -> None:
    many = tuple((SUBSCRIBER, "/arm/count", INT32) for _ in range(40))
    chunked.agent.nodes |= {f"/a{n}": many[:1] for n in range(150)}
    for _ in range(3):
        assert "raise memory: {arena:" in chunked.fails("nodes", BAD_ALLOC)
        assert "raise memory: {arena:" in chunked.fails("infos subscriptions /arm/count", BAD_ALLOC)
    chunked.agent.nodes = dict(NODES)
    assert len(chunked.items("names topics")) == 3


def test_without_a_sample(chunked: Device) -> None:
    chunked.agent.offers = False
    result = chunked.client.call("count publishers /arm/count")
    assert (result.code, result.slept) == (TIMEOUT, BETWEEN_MS)
    assert result.error.startswith("no whole sample of ros_to_microros_graph, nothing for 1000 ms")
    for timeout_ms in (1, 10, 9000):
        result = chunked.client.call(f"wait publishers /arm/count {timeout_ms}")
        assert (result.code, result.slept) == (TIMEOUT, timeout_ms)
        assert "no whole sample" in result.error
    chunked.agent.offers = True
    assert chunked.count("count publishers /arm/count") == 1


def test_the_time_counts_from_piece_to_piece(chunked: Device) -> None:
    """A slow line takes longer for all of it than a query waits for nothing."""
    chunked.agent.nodes |= {f"/node_{n}": ((PUBLISHER, f"/topic_{n}", INT32),) for n in range(60)}
    chunked.client.byte_ms = 0.5
    result = chunked.client.ok("count publishers /topic_59")
    assert result.lines == ("count 1",)
    assert result.slept > 2 * BETWEEN_MS


def test_lost_fragments_are_sent_again(chunked: Device) -> None:
    generator = random.Random(16)
    chunked.agent.nodes |= {f"/node_{n}": ((PUBLISHER, f"/topic_{n}", INT32),) for n in range(30)}
    chunked.heartbeats()
    chunked.agent.drop_answer = lambda _: generator.random() < 0.2
    chunked.agent.drop = lambda _: generator.random() < 0.2
    for number in range(10):
        result = chunked.client.call(f"count publishers /topic_{number}")
        if result.code != TIMEOUT:  # the reader was not replaced in time
            assert (result.code, result.lines) == (OK, ("count 1",))
    chunked.agent.drop = chunked.agent.drop_answer = lambda _: False
    assert chunked.count("count publishers /topic_29") == 1


def test_a_sample_that_is_broken_off(chunked: Device) -> None:
    """The agent gives up the rest of a sample: the next one counts, and nothing of the first."""
    chunked.agent.nodes = {f"/node_{n}": ((PUBLISHER, "/topic", INT32),) for n in range(12)}
    fragments: list[int] = []
    published = 0

    def lose_third(datagram: bytes) -> bool:
        """Lose the third fragment."""
        if datagram[1] != 0x80 or datagram[4] != 0x0D:
            return False
        fragments.append(int.from_bytes(datagram[2:4], "little"))
        return fragments[-1] == fragments[:3][-1] and len(fragments) >= 3

    def tick() -> None:
        """Announce that it is gone for good; then another sample follows."""
        nonlocal published
        if len(fragments) >= 3:
            chunked.agent.unacknowledged.pop(fragments[2], None)
        if chunked.agent.unacknowledged:
            chunked.client.queued += chunked.agent.tick()
        elif len(fragments) >= 3 and not published:
            published += 1
            chunked.client.queued += chunked.agent.publish()

    chunked.agent.drop_answer = lose_third
    chunked.client.on_sleep = tick
    assert chunked.count("count publishers /topic") == 12
    assert published == 1


def test_an_agent_that_restarts_in_the_middle_of_a_sample(chunked: Device) -> None:
    chunked.agent.nodes = {f"/node_{n}": ((PUBLISHER, "/topic", INT32),) for n in range(40)}
    chunked.client.byte_ms = 0.2
    asleep = 0

    def restart() -> None:
        nonlocal asleep
        asleep += 1
        if asleep == 12:
            chunked.agent.restart()
            chunked.client._late.clear()

    chunked.client.on_sleep = restart
    first = chunked.client.call("count publishers /topic")
    assert asleep > 12
    assert (first.code, first.lines) in ((OK, ("count 40",)), (TIMEOUT, ()))
    chunked.client.byte_ms = 0
    for _ in range(20):
        chunked.client.wait(200)
        chunked.client.ok("spin 0")
    assert chunked.count("count publishers /topic") == 40


def test_a_query_over_the_wrap_of_the_clock(chunked: Device) -> None:
    chunked.client.wait(2**32 - 500)
    for _ in range(20):
        chunked.client.wait(100)
        assert chunked.client.call("count publishers /arm/count").code in (OK, TIMEOUT)
    assert chunked.count("count publishers /arm/count") == 1


def test_a_change_wakes_a_wait_set(chunked: Device) -> None:
    assert chunked.client.ok("change 200").slept < 1000, "the first sample"
    assert chunked.client.call("change 200").code == TIMEOUT
    chunked.client.queued += chunked.agent.publish()
    assert chunked.client.call("change 200").code == TIMEOUT, "the graph is as it was"
    chunked.agent.nodes["/new"] = ()
    chunked.client.queued += chunked.agent.publish()
    assert chunked.client.ok("change 200").slept < 10
    chunked.count("count publishers /arm/count")
    assert chunked.client.call("change 200").code == TIMEOUT, "a query is no change"


def test_a_change_calls_back_in_the_executor(chunked: Device) -> None:
    chunked.client.ok("spin 20")
    before = chunked.count("changes")
    for expected in (1, 2):
        chunked.agent.nodes[f"/new_{expected}"] = ()
        chunked.client.queued += chunked.agent.publish()
        chunked.client.ok("spin 20")
        assert chunked.count("changes") == before + expected
    chunked.client.ok("spin 20")
    assert chunked.count("changes") == before + 2


def test_waits_for_publishers(chunked: Device) -> None:
    def appear() -> None:
        if chunked.client.now_ms > started_ms + 300 and "/late" not in chunked.agent.nodes:
            chunked.agent.nodes |= {"/late": ((PUBLISHER, "/late", INT32),)}
            chunked.agent.nodes |= {"/later": ((PUBLISHER, "/late", INT32),)}
            chunked.client.queued += chunked.agent.publish()

    started_ms = chunked.client.now_ms
    chunked.client.on_sleep = appear
    assert 300 <= chunked.client.ok("wait publishers /late 2000").slept < 400
    assert chunked.client.ok("wait publishers /late 2000").slept < 100
    result = chunked.client.call("wait subscriptions /late 700")
    assert (result.code, result.slept) == (TIMEOUT, 700)


@pytest.mark.parametrize("query", QUERIES)
def test_truncated_samples(chunked: Device, query: str) -> None:
    """A sample that ends early is none: the query waits for the next one."""
    chunked.agent.nodes = {"/a": NODES["/arm/device"], "/b": NODES["/root"]}
    wanted = chunked.client.ok(query).lines
    whole = chunked.agent.sample
    body = whole()
    for size in range(0, len(body) - 3, 7):
        chunked.agent.sample = lambda size=size: body[:size]  # type: ignore[method-assign, misc]
        assert "no whole sample" in chunked.fails(query, TIMEOUT)
    chunked.agent.sample = whole  # type: ignore[method-assign]
    assert chunked.client.ok(query).lines == wanted


def test_damaged_samples(chunked: Device) -> None:
    """Random bytes are changed; sanitizers watch, and the next query is answered."""
    generator = random.Random(14)
    whole = chunked.agent.sample

    def damaged() -> bytes:
        return bytes(byte if generator.random() > 0.01 else generator.randrange(256) for byte in whole())

    chunked.agent.sample = damaged  # type: ignore[method-assign]
    failed = 0
    for number in range(200):
        result = chunked.client.call(QUERIES[number % len(QUERIES)])
        failed += result.code != OK
        assert result.code == OK or result.error
    assert 30 < failed < 200
    chunked.agent.sample = whole  # type: ignore[method-assign]
    assert len(chunked.items("names topics")) == 3


def test_ends_and_begins_again(chunked: Device) -> None:
    chunked.client.ok("end")
    chunked.client.ok("init")
    assert len(chunked.items("names topics")) == 3
    chunked.client.ok("end")
