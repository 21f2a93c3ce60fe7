# SPDX-License-Identifier: Apache-2.0
"""The topic of micro-ROS's graph support: a client with the XML of the public one, the graph as rclpy sees it."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator

import pytest

from microros_gen.agent.representation import Qos, Topic
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.client_graph import LONGEST_TEXT, GraphSample
from microros_gen.agent.wire.constants import Format, Status
from microros_gen.agent.wire.data_messages import Data
from microros_gen.ros.graph import Graph
from microros_gen.ros.peer import Peer
from tests.support.agent.bridging import Bridged
from tests.support.agent.client import NoAnswerError, XrceClient, participant_blob
from tests.support.agent.process import environment, own_domain, running_agent
from tests.support.agent.ros_reading import LITTLE, ask_for_all, create
from tests.support.patience import deadline
from tests.support.ros_graph_message import Nodes, decoded

pytestmark = pytest.mark.ros

IDLE_S = 15.0
TOPIC, TYPE = "ros_to_microros_graph", "micro_ros_msgs::msg::dds_::Graph_"
NAMED = f"<name>{TOPIC}</name><dataType>{TYPE}</dataType>"
READER = (
    "<dds><data_reader><historyMemoryPolicy>PREALLOCATED_WITH_REALLOC</historyMemoryPolicy><qos><reliability>"
    f"<kind>RELIABLE</kind></reliability></qos><topic><kind>NO_KEY</kind>{NAMED}"
    "<historyQos><kind>KEEP_ALL</kind></historyQos></topic></data_reader></dds>"
)
"""What rmw_microxrcedds sends for it."""


def seen(graph: Graph) -> Nodes:
    """Return what rclpy says, node by node."""
    queries = (graph.publishers_of, graph.subscriptions_of, graph.services_of, graph.clients_of)
    return {
        node: {(kind, *found) for kind, query in enumerate(queries) for found in query(node) or ()}
        for node in graph.nodes()
    }


@pytest.fixture(scope="module")
def asking() -> Iterator[Peer]:
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment(own_domain()).items():
            patch.setenv(name, value)
        with Peer("asking") as peer:
            yield peer


@pytest.fixture
def stock_client() -> Iterator[XrceClient]:
    """A client that created what rmw_microxrcedds does with RMW_UXRCE_GRAPH; the domain is always 0 there."""
    with (
        running_agent(own_domain(), "--domain", str(own_domain())) as agent,
        XrceClient(agent.port) as client,
    ):
        assert client.connect() == 0
        create(client, 0x11, participant_blob("microros_graph"), 0)
        for object_id, parent, text in (
            (0x14, 0x11, ""),
            (0x12, 0x11, f"<dds><topic>{NAMED}</topic></dds>"),
            (0x16, 0x14, READER),
        ):
            assert client.create(object_id, Format.XML, text.encode(), parent) in (
                Status.OK,
                Status.OK_MATCHED,
            )
        ask_for_all(client, 0x16)
        yield client
        client.leave()


def follow(client: XrceClient, wanted: Callable[[Nodes], object], peer: Peer) -> Nodes:
    """Take messages until the newest is what rclpy sees now, and is wanted; return it."""
    end = deadline(IDLE_S)
    found: Nodes = {}
    while not (wanted(found) and found == seen(peer.graph())):
        assert time.monotonic() < end, (found, seen(peer.graph()))
        with contextlib.suppress(NoAnswerError):
            data = client.take(Data, 0.1)
            assert isinstance(data, Data)
            found = decoded(LITTLE + data.data)
    return found


def test_a_stock_client_follows_the_graph(stock_client: XrceClient, asking: Peer) -> None:
    first = follow(stock_client, lambda nodes: {"/microros_graph", "/asking"} <= set(nodes), asking)
    assert first["/microros_graph"] == set(), "the topic is not one of ROS 2"
    with Peer("arm", "/left") as arm:
        arm.publisher("state", "std_msgs/msg/Int32")
        arm.subscribe("/goal", "std_msgs/msg/String", print)
        arm.serve("enable", "std_srvs/srv/SetBool", lambda _: {})
        arm.client("/left/home", "std_srvs/srv/Trigger")
        expected = {
            (0, "/left/state", ("std_msgs/msg/Int32",)),
            (1, "/goal", ("std_msgs/msg/String",)),
            (2, "/left/enable", ("std_srvs/srv/SetBool",)),
            (3, "/left/home", ("std_srvs/srv/Trigger",)),
        }
        follow(stock_client, lambda nodes: nodes.get("/left/arm") == expected, asking)
    follow(stock_client, lambda nodes: "/left/arm" not in nodes, asking)


def test_each_reader_gets_the_newest_graph_once(bridged: Bridged) -> None:
    node = bridged.bridge.create_node("microros_graph", bridged.domain)
    reader = node.create_reader(Topic(TOPIC, TYPE), Qos())
    assert reader.label == f"{TOPIC} [micro_ros_msgs/msg/Graph]"
    [sample] = bridged.take(reader, 1)
    assert "/microros_graph" in decoded(sample)
    assert (reader.take(), reader.unread()) == (None, 0)
    late = node.create_reader(Topic(TOPIC, TYPE), Qos())
    assert decoded(bridged.take(late, 1)[0])
    passing = bridged.bridge.create_node("passing", bridged.domain)
    latest: dict[str, Nodes] = {}
    bridged.wait(
        lambda: (
            [name for name, nodes in latest.items() if "/passing" in nodes]
            in (["first", "late"], ["late", "first"])
        ),
        {
            reader: lambda sample: latest.update(first=decoded(sample)),
            late: lambda sample: latest.update(late=decoded(sample)),
        },
    )
    passing.destroy()
    reader.destroy()
    reader.destroy()
    with pytest.raises(BridgeError) as refused:
        node.create_reader(Topic(TOPIC, "std_msgs::msg::dds_::Int32_"), Qos())
    assert refused.value.status == Status.INCOMPATIBLE
    node.destroy()
    assert late.take() is None


def test_a_text_that_is_too_long_is_left_out_with_its_entity() -> None:
    longest = "/" + "n" * (LONGEST_TEXT - 1)
    sample = GraphSample()
    sample.add(
        "/a/b", [((longest, ("x/msg/Y",)), (longest + "n", ("x/msg/Y",)), ("/t", ("x" * 257,))), (), (), ()]
    )
    sample.add("/c", [(), (), (), (("/s", ()),)])
    assert decoded(sample.content()) == {"/a/b": {(0, longest, ("x/msg/Y",))}, "/c": {(3, "/s", ())}}
