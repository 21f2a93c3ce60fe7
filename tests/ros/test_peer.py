# SPDX-License-Identifier: Apache-2.0
"""A peer besides rclpy's own nodes with installed types, and two peers with a type that no installation has."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.interfaces.type_hashes import type_hashes
from microros_gen.ros.errors import CodecError, RosError
from microros_gen.ros.libraries import TIMEOUT
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.raw_types import raw_types
from tests.support.agent.process import environment, own_domain
from tests.support.patience import seconds

pytestmark = pytest.mark.ros
IDLE_S = 15.0
GET_TYPES = "rcl_interfaces/srv/GetParameterTypes"


@pytest.fixture(scope="module")
def on_this_machine() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment(own_domain()).items():
            patch.setenv(name, value)
        yield


@pytest.fixture
def peer(on_this_machine: None, own_folder: Path) -> Iterator[Peer]:
    with Peer("peer", "/bench", own_domain(), [own_folder]) as opened:
        yield opened


@pytest.fixture
def other(on_this_machine: None, own_folder: Path) -> Iterator[Peer]:
    with Peer("other", domain=own_domain(), interface_paths=[own_folder]) as opened:
        yield opened


class Node:
    """rclpy's own node, in the thread of the test."""

    def __init__(self) -> None:
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node as RosNode

        self.context = Context()
        self.context.init(args=[], domain_id=own_domain())
        self.node: Any = RosNode("installed", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def spin(self) -> None:
        self.executor.spin_once(0)

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()


@pytest.fixture
def installed_node(on_this_machine: None) -> Iterator[Node]:
    node = Node()
    yield node
    node.close()


def spin_both(peer: Peer, other: Node, done: Any) -> None:
    def look() -> Any:
        other.spin()
        return done()

    assert peer.spin(look, seconds(IDLE_S)), "not seen"


def test_topics_of_installed_types_both_ways(peer: Peer, installed_node: Node) -> None:
    from sensor_msgs.msg import JointState

    messages: list[Any] = []
    received: list[Any] = []
    node: Any = installed_node.node
    node.create_subscription(JointState, "/bench/out", messages.append, 10)
    sending: Any = node.create_publisher(JointState, "/bench/in", 10)
    publisher = peer.publisher("out", "sensor_msgs/msg/JointState")
    subscription = peer.subscribe("/bench/in", "sensor_msgs/JointState", received.append)

    def connected() -> bool:
        ends = (publisher.subscriptions(), subscription.publishers(), sending.get_subscription_count())
        return all(ends)

    spin_both(peer, installed_node, connected)
    publisher.publish({"header": {"frame_id": "base"}, "name": ["a", "b"], "position": [1.0, -2.5]})
    sending.publish(JointState(name=["é"], effort=[0.5]))
    spin_both(peer, installed_node, lambda: messages and received)
    assert (
        messages[0].header.frame_id,
        messages[0].name,
        list(messages[0].position),
    ) == (
        "base",
        ["a", "b"],
        [1.0, -2.5],
    )
    assert received[0]["name"] == ["é"]
    assert (received[0]["effort"], received[0]["velocity"]) == ([0.5], [])
    found: list[Any] = []

    def named() -> bool:
        found[:] = node.get_publishers_info_by_topic("/bench/out")
        return bool(found) and (found[0].node_name, found[0].node_namespace) == ("peer", "/bench")

    spin_both(peer, installed_node, named)
    announced, own = found[0], node.get_publishers_info_by_topic("/bench/in")[0]
    assert str(announced.topic_type_hash) == str(own.topic_type_hash)
    assert (type_hashes()("sensor_msgs/msg/JointState") or "?") in str(own.topic_type_hash)


def test_services_of_installed_types_both_ways(peer: Peer, installed_node: Node) -> None:
    service: Any = importlib.import_module("rcl_interfaces.srv").GetParameterTypes

    def lengths(request: Any, response: Any) -> Any:
        response.types = bytes(len(name) for name in request.names)
        return response

    node: Any = installed_node.node
    node.create_service(service, "/bench/theirs", lengths)
    client = peer.client("theirs", GET_TYPES)
    spin_both(peer, installed_node, client.available)
    answers: list[Any] = []
    client.send({"names": ["a", "bcd"]}, answers.append)
    spin_both(peer, installed_node, lambda: answers)
    assert answers == [{"types": b"\1\3"}]

    peer.serve("ours", GET_TYPES, lambda request: {"types": [len(request["names"])]})
    asking = node.create_client(service, "/bench/ours")
    spin_both(peer, installed_node, asking.service_is_ready)
    future = asking.call_async(service.Request(names=["x", "y", "z"]))
    spin_both(peer, installed_node, future.done)
    assert list(future.result().types) == [3]


def test_a_type_that_is_not_installed(peer: Peer, other: Peer) -> None:
    messages: list[Any] = []
    lasting = Qos(transient_local=True, depth=1)
    peer.publisher("/state", "own_msgs/msg/Report", lasting).publish({"here": {"x": 2.0}, "wide": "ß"})
    other.subscribe("/state", "own_msgs/Report", messages.append, lasting)
    assert other.spin(lambda: messages, seconds(IDLE_S))
    assert messages[0]["here"] == {"x": 2.0, "y": -7}
    assert (messages[0]["wide"], messages[0]["count"]) == ("ß", 9)


def test_a_service_that_is_not_installed(peer: Peer, other: Peer) -> None:
    def add(request: dict[str, Any]) -> dict[str, Any]:
        return {"sum": request["a"] + request["b"], "notes": ["done"]}

    other.serve("/add", "own_msgs/srv/Add", add)
    client = peer.client("/add", "own_msgs/srv/Add")
    assert peer.spin(client.available, seconds(IDLE_S))
    answers: list[Any] = []
    client.send({"a": 40, "b": 2}, answers.append)

    def answered() -> Any:
        other.spin_once(0.01)
        return answers

    assert peer.spin(answered, seconds(IDLE_S))
    assert answers == [{"sum": 42, "notes": ["done"]}]
    assert client.call({"a": 1}, timeout_s=0.3) is None  # nobody spins the server


def test_a_call_waits_for_its_response(peer: Peer) -> None:
    """Client and server of one peer: calling spins both."""
    peer.serve("/own", "own_msgs/srv/Add", lambda request: {"sum": -request["a"]})
    client = peer.client("/own", "own_msgs/srv/Add")
    assert client.call({"a": 5}, seconds(IDLE_S)) == {"sum": -5, "notes": []}
    assert peer.client("/nobody", "own_msgs/srv/Add").call({}, timeout_s=0.2) is None


def test_a_response_waits_until_its_client_is_discovered(
    peer: Peer, other: Peer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine the request can come before what tells of the client: rcl gives such a response up."""
    libraries = raw_types().libraries
    send, results = libraries.send_response, [TIMEOUT, TIMEOUT]
    monkeypatch.setattr(
        libraries, "send_response", lambda *arguments: results.pop() if results else send(*arguments)
    )
    other.serve("/late", "own_msgs/srv/Add", lambda request: {"sum": request["a"]})
    client = peer.client("/late", "own_msgs/srv/Add")
    assert peer.spin(client.available, seconds(IDLE_S))
    responses: list[Any] = []
    client.send({"a": 3}, responses.append)
    client.send({"a": 4}, responses.append)

    def responded() -> bool:
        other.spin_once(0.01)
        return len(responses) == 2

    assert peer.spin(responded, seconds(IDLE_S))
    assert sorted(response["sum"] for response in responses) == [3, 4]
    assert not results

    monkeypatch.setattr("microros_gen.ros.endpoints.UNDISCOVERED_S", 0.0)
    results.append(TIMEOUT)
    client.send({"a": 5}, responses.append)
    with pytest.raises(RosError, match="response on /late"):
        other.spin(lambda: False, seconds(IDLE_S))


def test_what_is_refused(peer: Peer) -> None:
    publisher = peer.publisher("/state", "own_msgs/msg/Report")
    with pytest.raises(CodecError, match="own_msgs/msg/Report: count: -1 is not a uint16"):
        publisher.publish({"count": -1})
    with pytest.raises(RosError, match="own_msgs/srv/Add is not a message"):
        peer.publisher("/state", "own_msgs/srv/Add")
    with pytest.raises(RosError, match="own_msgs/msg/Report is not a service"):
        peer.client("/state", "own_msgs/msg/Report")
    with pytest.raises(RosError, match="no topic"):
        peer.subscribe("/no topic", "own_msgs/msg/Report", print)
    peer.serve("/spins", "own_msgs/srv/Add", lambda _: {"sum": int(peer.spin_once())})
    with pytest.raises(RosError, match="a callback cannot spin"):
        peer.client("/spins", "own_msgs/srv/Add").call({}, seconds(IDLE_S))
    peer.close()
    peer.close()


def test_a_removed_server_no_longer_answers(peer: Peer, other: Peer) -> None:
    server = peer.serve("/removed", GET_TYPES, lambda _: {"types": [1]})
    client = other.client("/removed", GET_TYPES)
    assert is_answered(peer, other, client)
    peer.remove(server)
    other.spin(lambda: not client.available(), seconds(IDLE_S))
    assert not client.available()
    again = peer.serve("/removed", GET_TYPES, lambda _: {"types": [2]})
    peer.remove(again)
    with pytest.raises(ValueError, match="not in list"):
        peer.remove(again)


def is_answered(peer: Peer, other: Peer, client: Any) -> bool:
    """Send a request; return whether a response arrives while both spin."""
    responses: list[dict[str, Any]] = []
    other.spin(client.available, seconds(IDLE_S))
    client.send({"names": []}, responses.append)

    def step() -> bool:
        peer.spin_once(0.01)
        return bool(responses)

    other.spin(step, seconds(IDLE_S))
    return bool(responses)


def test_a_callback_removes_nothing(peer: Peer, other: Peer) -> None:
    errors: list[RosError] = []

    def receive(_: dict[str, Any]) -> None:
        with pytest.raises(RosError, match="after `spin_once`") as raised:
            peer.remove(subscription)
        errors.append(raised.value)

    subscription = peer.subscribe("/removing", "std_msgs/msg/Int32", receive)
    publisher = other.publisher("/removing", "std_msgs/msg/Int32")
    other.spin(lambda: publisher.subscriptions() == 1, seconds(IDLE_S))
    publisher.publish({"data": 1})
    assert peer.spin(lambda: errors, seconds(IDLE_S))
