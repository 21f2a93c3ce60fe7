# SPDX-License-Identifier: Apache-2.0
"""Fairness at the edges of the agent: the order of clients, what ROS 2 is asked, and which socket is read."""

from __future__ import annotations

import io
import select
import socket
import time
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest

from microros_gen.agent.fairness import MEMORY_S, REFUSED, START_S, Account, Accounts, Fairness
from microros_gen.agent.log import EventLog
from microros_gen.agent.ros.bridge import BusyError, GraphReport
from microros_gen.agent.ros.endpoints import FULL_S, RawWriter, Ros
from microros_gen.agent.ros.graph import Comparison, Endpoint, TopicTypes
from microros_gen.agent.ros.wakeups import Wakeups
from microros_gen.agent.transport.sockets import TCP4, UDP4
from microros_gen.agent.transport.tcp import Tcp
from microros_gen.agent.transport.udp import BATCH, Udp
from microros_gen.agent.wire.entity_messages import Heartbeat
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from microros_gen.diagnostics import UserError
from microros_gen.ros.layout import Allocator
from tests.support.agent.captured import CREATE_CLIENT_KEYED
from tests.support.agent.fakes import Bench
from tests.support.patience import deadline, seconds

# Order


class Paid:
    def __init__(self, name: str, used: float) -> None:
        self.name = name
        self.account = Account(used)


class Work:
    """A thread with one thing to do after another, and its clock."""

    def __init__(self) -> None:
        self.now = 100.0
        self.fair = Fairness(lambda: self.now)

    def first(self, *clients: Paid) -> Paid:
        """Return who is first."""
        waiting = list(clients)
        self.fair.order(waiting)
        return waiting[0]

    def do(self, client: Paid, seconds: float) -> None:
        """Work for a client."""
        self.now += seconds
        client.account.bill(seconds, self.now)


def test_who_cost_least_lately_is_first() -> None:
    work = Work()
    flood, other = Paid("flood", 0.0), Paid("other", 0.0)
    assert work.first(other, flood) is other
    work.do(other, 0.01)
    assert work.first(other, flood) is flood
    work.now += 20 * MEMORY_S
    work.do(flood, 0.001)
    assert work.first(flood, other) is other, "what it cost long ago does not count"


def test_a_client_that_asks_for_less_than_its_share_is_always_first() -> None:
    """And by itself in a list, or first there, nobody takes what the others have to wait for: it did so once."""
    work = Work()
    floods, light = [Paid(f"flood {n}", 0.0) for n in range(35)], Paid("light", 0.0)
    for turn in range(3_000):
        work.first(floods[turn % 35])  # as one that continues work that it had begun
        due = turn % 10 == 0  # 0.2 ms of each 20: a third of its share
        if due and turn > 100:
            assert work.first(*floods, light) is light
        work.do(light if due else work.first(*floods), 0.0002 if due else 0.002)


def test_shares_are_equal_whatever_a_unit_of_work_costs() -> None:
    work = Work()
    cheap, dear = Paid("cheap", 0.0), Paid("dear", 0.0)
    done = dict.fromkeys((cheap, dear), 0.0)
    for _ in range(10_000):
        first = work.first(dear, cheap)
        cost = 0.02 if first is dear else 0.0001
        work.do(first, cost)
        done[first] += cost
    assert 0.8 < done[cheap] / done[dear] < 1.25


def test_what_is_refused_counts_more_than_what_is_done() -> None:
    work = Work()
    asks, works = Paid("asks", 0.0), Paid("works", 0.0)
    done = dict.fromkeys((asks, works), 0.0)
    for _ in range(10_000):
        first = work.first(asks, works)
        first.account.refused = first is asks
        work.do(first, 0.001)
        done[first] += 0.001
    assert 0.9 < REFUSED * done[asks] / done[works] < 1.1


def test_who_is_new_is_not_before_those_who_ask_for_little() -> None:
    """Else whoever comes under one key after another would be before all others."""
    work = Work()
    accounts = Accounts(4, lambda: work.now)
    light, new = Paid("light", START_S / 2), Paid("new", 0.0)
    light.account.used_at = work.now
    new.account = accounts.of(b"new")
    assert work.first(new, light) is light
    assert accounts.of(b"new") is new.account, "to come again is no way round"
    work.now += 4 * MEMORY_S
    work.do(light, START_S / 10)
    assert work.first(new, light) is new


# ROS 2 is not asked more than it must be


class FullHandle:
    """A publisher whose readers take nothing."""

    def __init__(self) -> None:
        self.calls = 0

    def publish_raw(self, serialized: bytes) -> None:
        self.calls += 1
        raise RuntimeError("timeout")


class NoEvents:
    def __init__(self) -> None:
        self.entities: set[object] = set()


def test_a_writer_that_is_full_is_not_asked_for_each_sample() -> None:
    """S5: each time the agent would wait a millisecond in DDS."""
    handle = FullHandle()
    endpoint = Endpoint("/n", "publisher", "/t [x]", "/t", "x", None)
    types = SimpleNamespace(libraries=SimpleNamespace(default_allocator=Allocator))
    ros = Ros(types, lambda _report: None, 0.0)  # type: ignore[arg-type]
    writer = RawWriter(handle, ros, NoEvents(), (endpoint,), keeps_all=True)  # type: ignore[arg-type]
    began = time.monotonic()
    for _ in range(3_750):
        with pytest.raises(BusyError):
            writer.publish(b"\0\1\0\0")
    assert 1 <= handle.calls <= 2 + (time.monotonic() - began) / FULL_S


class Graph:
    """What a bridge asks of ROS 2 about a topic."""

    def __init__(self) -> None:
        self.calls: list[str] = []
        self.rclpy_get_publishers_info_by_topic = self._info
        self.rclpy_get_subscriptions_info_by_topic = self._info

    def _info(self, _node: object, topic: str, _mangled: bool) -> list[dict[str, Any]]:
        self.calls.append(topic)
        version = {"version": 0, "value": b""}
        other = {"node_name": "other", "node_namespace": "/", "topic_type": "y", "topic_type_hash": version}
        return [other]


def test_a_topic_is_asked_about_once_for_all_its_endpoints() -> None:
    wakeups: Wakeups = Wakeups()
    graph, reported, topics = Graph(), list[GraphReport](), TopicTypes()
    comparison = Comparison(graph, wakeups, reported.append)
    endpoints = [Endpoint(f"/n{n}", "publisher", "/t [x]", "/t", "x", None) for n in range(100)]
    for endpoint in endpoints:
        topics.claim([endpoint])
        comparison.soon("node", topics, endpoint)
    comparison.look()
    assert graph.calls == ["/t", "/t"]
    assert len(reported) == 100
    comparison.look()
    assert len(graph.calls) == 2, "nothing is left"
    for endpoint in endpoints:
        comparison.soon("node", topics, endpoint)
        comparison.forget(topics, endpoint)
    comparison.look()
    assert len(graph.calls) == 2, "nor of those that are gone"
    wakeups.close()


# Sockets


@pytest.fixture
def udp() -> Iterator[Udp]:
    transport = Udp(UDP4, "127.0.0.1", 0)
    yield transport
    transport.close()


def peer(transport: Udp) -> socket.socket:
    peer_socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    peer_socket.connect(("127.0.0.1", transport.port))
    return peer_socket


def test_a_client_that_sends_very_much_fills_only_its_queue(udp: Udp) -> None:
    """S12: and whoever cost less is read first."""
    flood, honest, stranger = peer(udp), peer(udp), peer(udp)
    now = time.monotonic()
    accounts = {flood.getsockname(): Account(1.0, now), honest.getsockname(): Account(0.5, now)}
    for place, account in accounts.items():
        udp.claim((udp, place), account)
    for _ in range(20_000):
        flood.send(bytes(200))
    honest.send(b"honest")
    stranger.send(b"stranger")
    received: list[tuple[bytes, Any]] = []
    udp.pump(lambda data, address, _: received.append((data, address[1])))  # type: ignore[index]
    by_peer = [data for data, place in received if place != flood.getsockname()]
    assert by_peer == [b"stranger", b"honest"], "who asks for little comes first, and neither is lost"
    assert received[2][1] == flood.getsockname()
    assert len(received) <= 2 + BATCH
    udp.release((udp, flood.getsockname()))
    udp.send(b"answer", (udp, honest.getsockname()))
    udp.flush()
    assert honest.recv(100) == b"answer"


def test_nothing_is_lost_or_mixed_up_while_clients_connect_and_leave(udp: Udp) -> None:
    clients = [peer(udp) for _ in range(20)]
    received: dict[Any, list[int]] = {client.getsockname(): [] for client in clients}

    def take(data: bytes, address: Any, _: object) -> None:
        received[address[1]].append(data[0])

    for number in range(100):
        for place, client in enumerate(clients):
            client.send(bytes((number,)))
            if (number + place) % 7 == 0:
                udp.claim((udp, client.getsockname()), Account())
            if (number + place) % 11 == 0:
                udp.release((udp, client.getsockname()))
        udp.pump(take)
    for _ in range(100):
        udp.pump(take)
    assert {place: sorted(numbers) for place, numbers in received.items()} == {
        place: list(range(100)) for place in received
    }


def test_datagrams_of_others_in_a_new_socket_are_theirs(udp: Udp, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between bind and connect the system hands a part of all datagrams to it: here more than are kept at once."""
    client, others = peer(udp), [peer(udp) for _ in range(20)]

    def open_slowly(listener: socket.socket, place: Any) -> socket.socket:
        opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        opened.setblocking(False)
        for shared in (listener, opened):
            shared.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        opened.bind(listener.getsockname())
        for other in others:
            for _ in range(BATCH + 10):
                other.send(other.getsockname()[1].to_bytes(2, "big"))
        opened.connect(place)
        return opened

    monkeypatch.setattr("microros_gen.agent.transport.udp.open_connected", open_slowly)
    udp.claim((udp, client.getsockname()), Account())
    client.send(client.getsockname()[1].to_bytes(2, "big"))
    received: list[tuple[int, int]] = []
    for _ in range(100):
        udp.pump(lambda data, address, _: received.append((int.from_bytes(data, "big"), address[1][1])))  # type: ignore[index]
    assert len(received) > 2 * BATCH
    assert all(sent == place for sent, place in received)
    assert client.getsockname()[1] in {place for _, place in received}


def test_what_was_refused_before_does_not_take_the_next_datagram_along(udp: Udp) -> None:
    """A connected socket tells of an earlier datagram that nobody took when it is to send the next one."""
    closed = peer(udp)
    place = closed.getsockname()
    udp.claim((udp, place), Account())
    closed.close()
    udp.send(b"nobody", (udp, place))
    udp.flush()
    again = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    again.bind(place)
    again.settimeout(seconds(5))
    udp.send(b"somebody", (udp, place))
    udp.flush()
    assert again.recv(100) == b"somebody"


def test_of_connections_the_one_that_cost_least_is_read_first() -> None:
    transport = Tcp(TCP4, "127.0.0.1", 0, EventLog(io.StringIO()))
    connections = [socket.create_connection(("127.0.0.1", transport.port)) for _ in range(3)]
    received: list[tuple[int, Any]] = []

    def take(data: bytes, address: Any, _: object) -> None:
        received.append((data[0], address))

    def say(number: int, connection: socket.socket) -> None:
        connection.sendall(b"\1\0" + bytes((number,)))

    def pump_until(count: int) -> None:
        """Pump until so many messages were received: a turn ends early where the machine has other work."""
        end = deadline(10)
        while len(received) < count and time.monotonic() < end:
            transport.pump(take)

    for number, connection in enumerate(connections):
        say(number, connection)
    pump_until(3)
    by_number = dict(received)
    for number, used in ((0, 3.0), (1, 1.0), (2, 2.0)):
        transport.claim(by_number[number], Account(used, time.monotonic()))
        say(number, connections[number])
    by_number[1].account.busy = True
    received.clear()
    for connection in by_number.values():
        assert select.select([connection.socket], [], [], seconds(10))[0], "what was sent arrives"
    pump_until(2)
    assert [number for number, _ in received] == [2, 0], "who is not done with what it said is not read"
    by_number[1].account.busy = False
    pump_until(3)
    assert received[2][0] == 1
    for connection in connections:
        connection.close()
    transport.close()


def test_messages_before_a_client_had_a_queue_are_handled_first(udp: Udp) -> None:
    client = peer(udp)
    address = (udp, client.getsockname())
    for number in range(3):
        client.send(bytes((number,)))
    received: list[int] = []

    def take(data: bytes, _address: object, _transport: object) -> None:
        received.append(data[0])
        if data[0] == 0:
            udp.claim(address, Account(-1.0))
            client.send(b"\3")

    for _ in range(3):
        udp.pump(take)
    assert received == [0, 1, 2, 3]


def test_what_a_client_said_where_it_was_does_not_make_it_move_back(udp: Udp) -> None:
    bench, before, after = Bench(), peer(udp), peer(udp)
    head = Header(1, 0, 0, bytes.fromhex("a1b2c3d4"))
    before.send(bytes.fromhex(CREATE_CLIENT_KEYED))
    udp.pump(bench.agent.receive)
    before.send(join(head, [encode(Heartbeat(0, 0, 0x80))]))
    udp.pump(bench.agent.receive)
    (client,) = bench.agent.clients
    client.account.busy = True  # so what it says now is not read before it says more from elsewhere
    before.send(join(head, [encode(Heartbeat(0, 0, 0x80))]))
    after.send(join(head, [encode(Heartbeat(0, 0, 0x80))]))
    udp.pump(bench.agent.receive)
    client.account.busy = False
    for _ in range(3):
        udp.pump(bench.agent.receive)
    assert client.address == (udp, after.getsockname())
    assert bench.text.getvalue().count(" moved from ") == 1


def test_another_agent_does_not_get_the_port(udp: Udp) -> None:
    udp.claim((udp, peer(udp).getsockname()), Account())
    with pytest.raises(UserError, match="in use"):
        Udp(UDP4, "127.0.0.1", udp.port)
