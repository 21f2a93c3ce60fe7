# SPDX-License-Identifier: Apache-2.0
"""From an XRCE client through the agent to rclpy in another process."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from microros_gen.agent.wire.constants import Format
from tests.support.agent import captured
from tests.support.agent.client import BEST_EFFORT, RELIABLE, XrceClient, imu_body, int32_body
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import AgentProcess, own_domain, running_agent
from tests.support.agent.ros_client import INT32, gone, matched

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def agent(domain: int) -> Iterator[AgentProcess]:
    with running_agent(domain) as running:
        yield running


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running


@pytest.fixture
def client(agent: AgentProcess) -> Iterator[XrceClient]:
    with XrceClient(agent.port) as connected:
        assert connected.connect() == 0
        yield connected
        connected.leave()


@pytest.mark.parametrize("stream", [RELIABLE, BEST_EFFORT], ids=["reliable", "best_effort"])
def test_samples_arrive(client: XrceClient, observer: Observer, domain: int, stream: int) -> None:
    topic = f"/robot/count_{stream}"
    observer.subscribe(topic, INT32)
    writer = client.publisher("/robot/counter", topic[1:], INT32, domain)
    graph = observer.see(matched(topic, "/robot/counter"))
    assert graph["topics"][topic] == [INT32]
    assert "/robot/counter" in graph["nodes"]
    client.wait_until_subscribed(writer, int32_body(-1), observer, topic)
    for i in range(200):
        client.write(writer, int32_body(i), stream)
    client.drain()
    values = [value["data"] for _, value in observer.got(200)]
    assert [v for v in values if v >= 0] == list(range(200))


def test_an_imu_message_arrives_with_all_its_fields(
    client: XrceClient, observer: Observer, domain: int
) -> None:
    observer.subscribe("/imu/data", "sensor_msgs/msg/Imu", reliable=False)
    writer = client.publisher("imu", "imu/data", "sensor_msgs/msg/Imu", domain, reliable=False)
    observer.see(matched("/imu/data", "/imu"))
    numbers = [i / 8 for i in range(37)]
    body = imu_body("imu_link", (7, 9), numbers)
    client.wait_until_subscribed(writer, body, observer, "/imu/data")
    client.write(writer, body, BEST_EFFORT)
    _, value = observer.got(1)[0]
    assert value["header"] == {"stamp": {"sec": 7, "nanosec": 9}, "frame_id": "imu_link"}
    flat = [
        *value["orientation"].values(),
        *value["orientation_covariance"],
        *value["angular_velocity"].values(),
        *value["angular_velocity_covariance"],
        *value["linear_acceleration"].values(),
        *value["linear_acceleration_covariance"],
    ]
    assert flat == numbers


def test_a_message_in_fragments(client: XrceClient, observer: Observer, domain: int) -> None:
    observer.subscribe("/long", "std_msgs/msg/String")
    writer = client.publisher("talker", "long", "std_msgs/msg/String", domain)
    observer.see(matched("/long", "/talker"))
    text = "0123456789" * 400
    body = (len(text) + 1).to_bytes(4, "little") + text.encode() + b"\0"
    client.wait_until_subscribed(writer, body, observer, "/long")
    client.write(writer, body)
    client.drain()
    assert observer.got(1)[0] == ("/long", {"data": text})


def test_qos_is_what_was_asked_for(client: XrceClient, observer: Observer, domain: int) -> None:
    client.publisher("qos", "qos_a", INT32, domain, number=1, reliable=True, transient_local=True)
    client.publisher("qos", "qos_b", INT32, domain, number=2, reliable=False)
    graph = observer.see(lambda g: matched("/qos_a", "/qos")(g) and matched("/qos_b", "/qos")(g))
    assert graph["publishers"]["/qos_a"] == [["/qos", "RELIABLE", "TRANSIENT_LOCAL"]]
    assert graph["publishers"]["/qos_b"] == [["/qos", "BEST_EFFORT", "VOLATILE"]]


def test_transient_local_samples_reach_a_late_subscriber(
    client: XrceClient, observer: Observer, domain: int
) -> None:
    writer = client.publisher("late", "latched", INT32, domain, transient_local=True, depth=1)
    client.write(writer, int32_body(42))
    client.drain()
    observer.see(matched("/latched", "/late"))
    observer.subscribe("/latched", INT32, transient_local=True)
    assert observer.got(1) == [("/latched", {"data": 42})]


def test_entities_in_xml(client: XrceClient, observer: Observer, domain: int) -> None:
    observer.subscribe("/chatter", "std_msgs/msg/String")
    assert client.create(0x11, Format.XML, captured.PARTICIPANT_XML.encode(), 0, domain) == 0
    assert client.create(0x12, Format.XML, captured.TOPIC_XML.encode(), 0x11) == 0
    assert client.create(0x13, Format.XML, b"", 0x11) == 0
    assert client.create(0x15, Format.XML, captured.WRITER_XML.encode(), 0x13) == 0
    observer.see(matched("/chatter", "/p1"))
    body = bytes.fromhex("03000000 686900")
    client.wait_until_subscribed(0x15, body, observer, "/chatter")
    client.write(0x15, body)
    assert observer.got(1)[0] == ("/chatter", {"data": "hi"})


def test_several_clients_and_each_leaves_alone(agent: AgentProcess, observer: Observer, domain: int) -> None:
    with ExitStack() as stack:
        clients = [
            stack.enter_context(XrceClient(agent.port, key=0x1000 + i, session=(0x81, 0x01)[i % 2]))
            for i in range(4)
        ]
        for i, client in enumerate(clients):
            assert client.connect() == 0
            client.publisher(f"many_{i}", f"many/topic_{i}", INT32, domain)
        names = {f"/many_{i}" for i in range(4)}
        observer.see(lambda g: names <= set(g["nodes"]))
        assert [c.ping() for c in clients] == [1] * 4
        assert clients[1].leave() == 0
        graph = observer.see(gone("/many_1"))
        assert names - {"/many_1"} <= set(graph["nodes"])
        for client in clients:
            client.leave()
        observer.see(lambda g: not names & set(g["nodes"]))


def test_a_client_that_restarts_goes_on(agent: AgentProcess, observer: Observer, domain: int) -> None:
    observer.subscribe("/restart", INT32)
    for port in range(2):  # each time from another port, as after a power cycle
        with XrceClient(agent.port, key=0x2000) as client:
            assert client.connect() == 0
            writer = client.publisher("restarting", "restart", INT32, domain)
            observer.see(matched("/restart", "/restarting"))
            client.wait_until_subscribed(writer, int32_body(-1), observer, "/restart")
            client.write(writer, int32_body(port))
            client.drain()
            assert ("/restart", {"data": port}) in observer.got(1)
    graph = observer.see(lambda g: True)
    assert graph["nodes"].count("/restarting") == 1


def test_ping(agent: AgentProcess) -> None:
    for session in (0x81, 0x01):
        with XrceClient(agent.port, key=0x3000 + session, session=session) as client:
            assert client.ping(in_session=False) == 0
            assert client.ping() == 0
            assert client.connect() == 0
            assert client.ping() == 1
            assert client.ping(in_session=False) == 1
            assert client.leave() == 0
            assert client.ping() == 0


def test_an_unknown_type_is_bridged_and_reported_once(
    client: XrceClient, agent: AgentProcess, observer: Observer, domain: int
) -> None:
    client.publisher("stranger", "strange", "no_such_msgs/msg/Thing", domain, number=1)
    client.publisher("stranger", "stranger", "no_such_msgs/msg/Thing", domain, number=2)
    graph = observer.see(
        lambda g: matched("/strange", "/stranger")(g) and matched("/stranger", "/stranger")(g)
    )
    assert graph["topics"]["/strange"] == ["no_such_msgs/msg/Thing"]
    assert "no interface file" in agent.wait_for("no_such_msgs/msg/Thing")


def test_a_client_that_vanishes_leaves_and_returns(domain: int, observer: Observer) -> None:
    with running_agent(domain, "--client-timeout", "1") as agent:
        with XrceClient(agent.port, key=0x4000) as client:
            assert client.connect() == 0
            writer = client.publisher("vanishing", "vanish", INT32, domain)
            observer.see(lambda g: client.ping() and "/vanishing" in g["nodes"])
            observer.see(gone("/vanishing"))
            assert "left the ROS graph" in agent.wait_for("was silent")
            client.write(writer, int32_body(1), BEST_EFFORT)
            observer.see(lambda g: client.ping() and "/vanishing" in g["nodes"])
        assert agent.stop() == 0
        observer.see(gone("/vanishing"))


def test_one_domain_for_all(domain: int, observer: Observer) -> None:
    with (
        running_agent(domain, "--domain", str(domain)) as agent,
        XrceClient(agent.port) as client,
    ):
        assert client.connect() == 0
        client.publisher("elsewhere", "moved", INT32, domain=3)
        observer.see(matched("/moved", "/elsewhere"))
