# SPDX-License-Identifier: Apache-2.0
"""A client that reads, calls and serves: it vanishes and returns, and its agent is another one some day."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from microros_gen.agent.wire.data_messages import Data
from tests.support.agent.bridging import GET_TYPES, names_body, read_names, read_types, types_body
from tests.support.agent.client import RELIABLE, NoAnswerError, XrceClient, int32_body, service_blob
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_reading import (
    IDENTITY,
    INT32,
    LITTLE,
    REQUEST_PREFIX,
    ask_for_all,
    create,
    service,
    subscription,
    until,
)

pytestmark = pytest.mark.ros

READER, REQUESTER, REPLIER = 0x16, 0x17, 0x18
NODE = "/sleeper"


def everything(client: XrceClient, domain: int) -> None:
    """Create a subscription, a service client and a service, and read from all."""
    assert client.connect() == 0
    subscription(client, NODE, "told", INT32, domain)
    service(client, REPLIER, NODE, "/done_here", domain)
    create(client, REQUESTER, service_blob("/done_there", GET_TYPES), 0x11)
    ask_for_all(client, REQUESTER)


def in_graph(observer: Observer) -> tuple[bool, bool, bool]:
    """Return whether ROS 2 sees the subscription, the service and the service client."""
    reported = any(e["node"] == NODE for e in observer.ask(do="endpoints", topic="/told"))
    graph = observer.ask(do="graph")
    if NODE not in graph["nodes"]:
        return reported, False, False
    services, clients = observer.ask(do="node", node=NODE[1:], namespace="/")
    return reported, ["/done_here", [GET_TYPES]] in services, ["/done_there", [GET_TYPES]] in clients


def awake_until(client: XrceClient, done: Callable[[], object]) -> None:
    """Wait for something while the client answers what the agent asks it."""

    def look() -> object:
        client.pump(0.001)
        return done()

    until(look)


def data(client: XrceClient, object_id: int, wanted: Callable[[bytes], bool] = lambda _: True) -> bytes:
    """Return the next sample of an object that is `wanted`."""
    while True:
        found = client.take(Data)
        assert isinstance(found, Data)
        if found.object == object_id and wanted(found.data):
            return found.data


def use(client: XrceClient, observer: Observer, number: int) -> None:
    """A sample, a request and a call arrive."""
    reported: dict[str, Any] = {"do": "publish", "topic": "/told", "type": INT32}
    observer.ask(**reported, values=[{"data": 0}])
    awake_until(client, lambda: observer.ask(do="matched", topic="/told") == 1)
    observer.ask(**reported, values=[{"data": number}])
    assert data(client, READER, lambda body: body == int32_body(number))
    observer.ask(do="call", service="/done_here", type=GET_TYPES, names=[["x" * number]])
    request = data(client, REPLIER)
    assert read_names(LITTLE + request[IDENTITY:]) == ["x" * number]
    client.write(REPLIER, request[:IDENTITY] + types_body([number])[4:])
    awake_until(client, lambda: observer.ask(do="replies") == [[number]])
    client.write(REQUESTER, names_body(["y" * number])[4:])
    assert read_types(LITTLE + data(client, REQUESTER)[REQUEST_PREFIX:]) == [number]
    client.drain()


def test_they_leave_the_graph_and_return_with_all_they_asked_for() -> None:
    domain = own_domain()
    with (
        observing(domain) as observer,
        running_agent(domain, "--client-timeout", "2") as agent,
        XrceClient(agent.port, key=0x5000, timeout_s=20) as client,
    ):
        observer.ask(do="serve", service="/done_there", type=GET_TYPES, hold=1)
        everything(client, domain)
        awake_until(client, lambda: in_graph(observer) == (True, True, True))
        use(client, observer, 3)
        until(lambda: in_graph(observer) == (False, False, False))
        assert client.ping() == 1, "its session outlives its sleep"
        awake_until(client, lambda: in_graph(observer) == (True, True, True))
        use(client, observer, 4)


@pytest.mark.system
def test_another_agent_is_noticed_and_given_everything_again() -> None:
    domain = own_domain()
    with observing(domain) as observer, running_agent(domain) as agent:
        observer.ask(do="serve", service="/done_there", type=GET_TYPES, hold=1)
        with XrceClient(agent.port, key=0x5001, timeout_s=20) as client:
            everything(client, domain)
            use(client, observer, 5)
            assert agent.stop() == 0
            until(lambda: in_graph(observer) == (False, False, False))
            way = ("udp4", "--port", str(agent.port))
            with running_agent(domain, transport=way):
                assert client.ping() == 0, "the new agent reports an unknown session"
                client.send(RELIABLE, b"\x0c\x01\x00\x00")
                with pytest.raises(NoAnswerError):
                    client.take(Data, timeout_s=0.3)
                everything(client, domain)
                use(client, observer, 6)
                assert client.leave() == 0
                until(lambda: in_graph(observer) == (False, False, False))
