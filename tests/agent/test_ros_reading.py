# SPDX-License-Identifier: Apache-2.0
"""From rclpy in another process through the agent to an XRCE client: samples, requests and replies."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from agent.bridging import GET_TYPES, names_body, read_names, read_types, types_body
from agent.client import (
    RELIABLE,
    XrceClient,
    dds_type,
    int32_body,
    participant_blob,
    reader_blob,
    service_blob,
    topic_blob,
)
from agent.observer import Observer, observing
from agent.process import AgentProcess, own_domain, running_agent
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData
from microros_gen.agent.wire.submessages import encode
from microros_gen.interfaces.type_hashes import type_hashes

pytestmark = pytest.mark.ros

INT32 = "std_msgs/msg/Int32"
LITTLE = b"\0\1\0\0"
READER_QOS_RELIABLE_KEEP_LAST = 3
IDENTITY = 24
REQUEST_PREFIX = 4


@pytest.fixture(scope="module")
def interfaces(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package of interface files that nobody has built."""
    root = tmp_path_factory.mktemp("interfaces")
    (root / "acme_msgs" / "msg").mkdir(parents=True)
    (root / "acme_msgs" / "msg" / "Thing.msg").write_text("int32 number\nstring<=10 name\n")
    return root


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def agent(domain: int, interfaces: Path) -> Iterator[AgentProcess]:
    with running_agent(domain, "--interface-path", str(interfaces)) as running:
        yield running


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running


@pytest.fixture
def client(agent: AgentProcess) -> Iterator[XrceClient]:
    with XrceClient(agent.port, timeout_s=15.0) as made:
        assert made.connect() == 0
        yield made
        made.leave()


def subscription(client: XrceClient, node: str, topic: str, type_name: str, domain: int) -> int:
    """Create node, topic, subscriber and reader, ask for all samples; return the reader's id."""
    create(client, 0x11, participant_blob(node), 0, domain)
    create(client, 0x12, topic_blob(f"rt/{topic}", dds_type(type_name)), 0x11)
    create(client, 0x14, b"\0\0", 0x11)
    create(client, 0x16, reader_blob(0x12, READER_QOS_RELIABLE_KEEP_LAST, 200), 0x14)
    ask_for_all(client, 0x16)
    return 0x16


def service(client: XrceClient, object_id: int, node: str, name: str, domain: int) -> int:
    """Create a node and a replier or a requester, ask for all that comes; return its id."""
    create(client, 0x11, participant_blob(node), 0, domain)
    create(client, object_id, service_blob(name, GET_TYPES), 0x11)
    ask_for_all(client, object_id)
    return object_id


def create(client: XrceClient, object_id: int, body: bytes, parent: int, domain: int = 0) -> None:
    status = client.create(object_id, Format.BINARY, body, parent, domain)
    assert status in (0, 1), f"{object_id:#06x}: {status:#04x}"


def ask_for_all(client: XrceClient, object_id: int) -> None:
    question = ReadData(client._next_request(), object_id, RELIABLE, delivery=DeliveryControl(0xFFFF))
    client.send(RELIABLE, encode(question))


def samples(client: XrceClient, count: int) -> list[bytes]:
    found = []
    for _ in range(count):
        data = client.take(Data)
        assert isinstance(data, Data)
        found.append(data.data)
    return found


def until(done: Callable[[], object], timeout_s: float = 15.0) -> None:
    end = time.monotonic() + timeout_s
    while not done():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_samples_of_ros_arrive_in_order(client: XrceClient, observer: Observer, domain: int) -> None:
    subscription(client, "ear", "heard", INT32, domain)
    until(lambda: len(observer.ask(do="endpoints", topic="/heard")) == 1)
    publish = {"do": "publish", "topic": "/heard", "type": INT32}
    observer.ask(**publish, values=[])
    until(lambda: observer.ask(do="matched", topic="/heard") == 1)
    observer.ask(**publish, values=[{"data": value} for value in range(150)])
    assert samples(client, 150) == [int32_body(value) for value in range(150)]


def test_twenty_requests_of_ros_are_answered_by_a_slow_client(
    client: XrceClient, observer: Observer, domain: int
) -> None:
    """Every request is at the client before it answers the first; the last is answered first."""
    replier = service(client, 0x18, "slow_server", "/slow", domain)
    asked = [["x" * i] for i in range(20)]
    observer.ask(do="call", service="/slow", type=GET_TYPES, names=asked)
    requests = samples(client, 20)
    assert len({request[:IDENTITY] for request in requests}) == 20
    for request in reversed(requests):
        names = read_names(LITTLE + request[IDENTITY:])
        client.write(replier, request[:IDENTITY] + types_body([len(name) for name in names])[4:])
    client.drain()
    until(lambda: None not in observer.ask(do="replies"))
    assert observer.ask(do="replies") == [[i] for i in range(20)]


def test_twenty_requests_of_a_client_get_their_replies(
    client: XrceClient, observer: Observer, domain: int
) -> None:
    observer.ask(do="serve", service="/held", type=GET_TYPES, hold=20)
    requester = service(client, 0x17, "asker", "/held", domain)
    asked: dict[bytes, int] = {}
    for i in range(20):
        client.write(requester, names_body(["y" * i])[4:])
        asked[client._request.to_bytes(2, "big") + requester.to_bytes(2, "big")] = i
    replies = samples(client, 20)
    got = {reply[:REQUEST_PREFIX]: read_types(LITTLE + reply[REQUEST_PREFIX:]) for reply in replies}
    assert got == {head: [i] for head, i in asked.items()}


def test_a_type_from_interface_files_alone(
    client: XrceClient, observer: Observer, domain: int, interfaces: Path
) -> None:
    expected = type_hashes([interfaces])("acme_msgs/msg/Thing")
    topic = "things"
    subscription(client, "things", topic, "acme_msgs/msg/Thing", domain)
    until(lambda: observer.ask(do="endpoints", topic="/things"))
    [found] = observer.ask(do="endpoints", topic="/things")
    assert (found["type"], found["hash"]) == ("acme_msgs/msg/Thing", expected)
    assert (found["kind"], found["reliability"]) == ("SUBSCRIPTION", "RELIABLE")
