# SPDX-License-Identifier: Apache-2.0
"""From rclpy in another process through the agent to an XRCE client: samples, requests and replies."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.agent.wire.data_messages import Data
from microros_gen.interfaces.type_hashes import type_hashes
from tests.support.agent.bridging import GET_TYPES, names_body, read_names, read_types, types_body
from tests.support.agent.client import (
    XrceClient,
    int32_body,
)
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import AgentProcess, own_domain, running_agent
from tests.support.agent.ros_reading import (
    IDENTITY,
    INT32,
    LITTLE,
    REQUEST_PREFIX,
    service,
    subscription,
    until,
)

pytestmark = pytest.mark.ros


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
    with XrceClient(agent.port, timeout_s=15.0) as connected:
        assert connected.connect() == 0
        yield connected
        connected.leave()


def samples(client: XrceClient, count: int) -> list[bytes]:
    found = []
    for _ in range(count):
        data = client.take(Data)
        assert isinstance(data, Data)
        found.append(data.data)
    return found


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
    names = [["x" * i] for i in range(20)]
    observer.ask(do="call", service="/slow", type=GET_TYPES, names=names)
    requests = samples(client, 20)
    assert len({request[:IDENTITY] for request in requests}) == 20
    for request in reversed(requests):
        prefixes = read_names(LITTLE + request[IDENTITY:])
        client.write(replier, request[:IDENTITY] + types_body([len(name) for name in prefixes])[4:])
    client.drain()
    until(lambda: None not in observer.ask(do="replies"))
    assert observer.ask(do="replies") == [[i] for i in range(20)]


def test_twenty_requests_of_a_client_get_their_replies(
    client: XrceClient, observer: Observer, domain: int
) -> None:
    observer.ask(do="serve", service="/held", type=GET_TYPES, hold=20)
    requester = service(client, 0x17, "asker", "/held", domain)
    numbers: dict[bytes, int] = {}
    for i in range(20):
        client.write(requester, names_body(["y" * i])[4:])
        numbers[client._request.to_bytes(2, "big") + requester.to_bytes(2, "big")] = i
    replies = samples(client, 20)
    received = {reply[:REQUEST_PREFIX]: read_types(LITTLE + reply[REQUEST_PREFIX:]) for reply in replies}
    assert received == {head: [i] for head, i in numbers.items()}


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
