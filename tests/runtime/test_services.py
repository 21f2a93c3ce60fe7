# SPDX-License-Identifier: Apache-2.0
"""Services and clients: creation, several requests under way, loss, disorder, what is refused, reconnection."""

from __future__ import annotations

import random
import struct

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan
from tests.support.plans import SERVER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.serving_agent import GUID, ServingAgent, identity
from tests.support.slices import first

SHARED = changed(SERVER, input__queues=(QueuePlan(9, 40, 60), QueuePlan(3, 20, 20), QueuePlan(2, 20)))
"""With `queue_bytes`."""
REPLIER = bytes.fromhex("0018")
REQUESTER = bytes.fromhex("0027")
SERVICE_TAKE_FAILED, CLIENT_TAKE_FAILED, NAME_INVALID = 601, 501, 104
SERVICE_INVALID, CLIENT_INVALID = 600, 500


class Peer:
    """A client program with a service and a client open, and its agent."""

    def __init__(self, bench: Bench, plan: RuntimePlan = SERVER, liveliness: str = "ping") -> None:
        self.agent = ServingAgent()
        self.client: Client = bench.start(plan, liveliness, self.agent)
        self.client.ok("init")
        self.client.ok("node 0 server -")
        self.client.ok("serve_init 0 0 set")
        self.client.ok("serve_client 0 0 /far/ask")
        self.client.spin(3)

    def send(self, datagrams: list[bytes]) -> None:
        self.client.queued += datagrams

    def request(self, sequence: int, value: int) -> None:
        self.send(self.agent.give(REPLIER, identity(sequence) + struct.pack("<i", value)))

    def take(self, header: int = 0) -> tuple[int, int] | None:
        result = self.client.call(f"serve_take 0 {header}")
        assert result.code in (0, SERVICE_TAKE_FAILED), result
        if result.code:
            return None
        _, value, sequence, guid = result.lines[0].split()
        assert bytes.fromhex(guid) == GUID
        return int(value), int(sequence)

    def ask(self, value: int) -> int:
        return int(self.client.ok(f"serve_ask 0 {value}").lines[0].split()[1])

    def reply(self) -> tuple[int, int] | None:
        result = self.client.call("serve_reply 0")
        assert result.code in (0, CLIENT_TAKE_FAILED), result
        if result.code:
            return None
        _, value, sequence = result.lines[0].split()
        return int(value), int(sequence)

    def counted(self, which: str) -> list[int]:
        (line,) = self.client.ok(f"serve_statistics 0 {which}").lines
        return [int(number) for number in line.split()[1:]]


def test_what_is_created(bench: Bench) -> None:
    """Bytes as the public client sends them; then READ_DATA for each, as micro-ROS sends it."""
    peer = Peer(bench)
    replier = peer.agent.objects[REPLIER]
    blob = bytes.fromhex("05000000") + b"/set\0" + bytes(3)
    blob += bytes.fromhex("1e000000") + b"test::srv::dds_::Ask_Request_\0" + bytes(2)
    blob += bytes.fromhex("1f000000") + b"test::srv::dds_::Ask_Response_\0"
    blob += b"\x01" + bytes.fromhex("0e000000") + b"rq/setRequest\0"
    blob += b"\x01" + bytes(1) + bytes.fromhex("0c000000") + b"rr/setReply\0"
    assert replier == bytes.fromhex("08030000") + struct.pack("<I", len(blob)) + blob + bytes.fromhex("0001")
    requester = peer.agent.objects[REQUESTER]
    assert requester[0] == 7
    assert b"rq/far/askRequest\0" in requester
    assert b"rr/far/askReply\0" in requester
    assert {(r.reader, r.stream, r.samples) for r in peer.agent.reads} == {
        (REPLIER, 0x80, 2),
        (REQUESTER, 0x80, 3),
    }
    assert peer.client.ok("serve_names").lines == ("names /set /far/ask",)


def test_what_fits_the_bytes_of_a_queue_is_asked_for(bench: Bench) -> None:
    """A request takes 28 bytes here and a reply 8; a place of these pools could have larger ones."""
    peer = Peer(bench, SHARED)
    assert {(r.reader, r.samples) for r in peer.agent.reads} == {(REPLIER, 2), (REQUESTER, 2)}


def test_requests_are_answered_in_any_order(bench: Bench) -> None:
    """Three requests taken before the first reply; sequence numbers have 64 bits."""
    peer = Peer(bench)
    for sequence, value in ((1, 10), (2, 20), (0x1_0000_0007, 30)):
        peer.request(sequence, value)
    taken = []
    for header in range(3):
        peer.client.spin(2)
        taken.append(peer.take(header))
    assert taken == [(10, 1), (20, 2), (30, 0x1_0000_0007)]
    assert peer.take() is None
    for header, value in ((2, 3), (0, 1), (1, 2)):
        peer.client.ok(f"serve_answer 0 {header} {value}")
    replies = [(0x1_0000_0007, 3), (1, 1), (2, 2)]
    assert peer.agent.answered == [identity(s) + struct.pack("<i", v) for s, v in replies]
    assert peer.counted("service") == [0, 0]


def test_a_big_endian_request(bench: Bench) -> None:
    """The identity has the byte order of its DATA; the reply's is little endian."""
    peer = Peer(bench)
    peer.agent.flags = 0
    peer.send(peer.agent.give(REPLIER, GUID + struct.pack(">iI", 1, 2) + struct.pack(">i", 77)))
    peer.client.spin()
    assert peer.take() == (77, (1 << 32) + 2)
    peer.client.ok("serve_answer 0 0 5")
    assert peer.agent.answered == [identity((1 << 32) + 2) + struct.pack("<i", 5)]


def test_a_request_waits_until_its_reply_has_room(bench: Bench) -> None:
    """An executor asks whether a service is ready: not while the stream is full of unacknowledged replies."""
    peer = Peer(bench)
    peer.request(1, 1)
    peer.client.spin()
    assert peer.client.ok("serve_ready 0").lines == ("ready 1",)
    peer.agent.silent = True
    for value in range(4):
        peer.ask(value)
    assert peer.client.ok("serve_ready 0").lines == ("ready 0",)
    refused = peer.client.call("serve_ask 0 5")
    assert refused.error == (
        "service /far/ask: stream full, 4 unacknowledged: the agent is away,"
        " or raise pools: {history: 5} in microros.yaml"
    )
    peer.agent.silent = False
    peer.client.spin(5, 100)
    assert peer.client.ok("serve_ready 0").lines == ("ready 1",)


def test_replies_arrive_in_the_order_of_the_server(bench: Bench) -> None:
    peer = Peer(bench)
    assert [peer.ask(value) for value in (7, 8, 9)] == [1, 2, 3]
    assert [body for _, _, body in peer.agent.calls] == [struct.pack("<i", v) for v in (7, 8, 9)]
    assert len({request for _, request, _ in peer.agent.calls}) == 3
    for number in (2, 0, 1):
        peer.send(peer.agent.reply(number, 100 + number))
    peer.client.spin()
    assert [peer.reply(), peer.reply(), peer.reply(), peer.reply()] == [(102, 3), (100, 1), (101, 2), None]


def test_a_reply_without_a_request(bench: Bench) -> None:
    """A second reply to one request, one of another object, one that is cut off: counted, and the next one comes."""
    peer = Peer(bench)
    peer.ask(1)
    peer.send(peer.agent.reply(0, 5))
    peer.send(peer.agent.reply(0, 6))
    peer.client.spin()
    assert peer.reply() == (5, 1)
    assert peer.reply() is None
    peer.ask(2)
    _, request, _ = peer.agent.calls[1]
    peer.send(peer.agent.give(REQUESTER, request + REPLIER + bytes(4), request[:1]))
    peer.client.spin(2)
    assert peer.reply() is None
    peer.send(peer.agent.reply(1, 9))
    peer.client.spin(2)
    assert peer.reply() == (9, 2)
    assert peer.counted("client") == [0, 3, 0, 0]


def test_more_requests_than_there_is_room_for_replies(bench: Bench) -> None:
    """The oldest request is abandoned, so a client without a server continues; its late reply is discarded."""
    peer = Peer(bench)
    assert [peer.ask(value) for value in range(4)] == [1, 2, 3, 4]
    assert peer.counted("client") == [0, 0, 1, 0]
    for number in range(4):
        peer.send(peer.agent.reply(number, number))
    found = []
    for _ in range(6):
        peer.client.spin(2)
        found.append(peer.reply())
    assert [r for r in found if r] == [(1, 2), (2, 3), (3, 4)]
    assert peer.counted("client") == [0, 1, 1, 0]


@pytest.mark.parametrize(
    ("sample", "code", "words"),
    [
        (identity(1) + bytes(20), 1, "/set: received 44 bytes, 40 fit: raise limits of test/srv/Ask_Request"),
        (identity(1)[:20], 1, "service /set: received 20 bytes, a header takes 24"),
        (identity(1) + bytes(2), 1, "data"),
    ],
    ids=["too large", "cut off", "no message"],
)
def test_a_malformed_request(bench: Bench, sample: bytes, code: int, words: str) -> None:
    peer = Peer(bench)
    peer.send(peer.agent.give(REPLIER, sample))
    peer.request(2, 22)
    peer.client.spin(2)
    result = peer.client.call("serve_take 0 0")
    assert result.code == code
    assert words in result.error
    assert peer.take() == (22, 2)
    assert peer.counted("service") == [0, 1]


@pytest.mark.parametrize(("plan", "seed"), [(SERVER, 0), (SERVER, 1), (SERVER, 2), (SHARED, 0), (SHARED, 1)])
def test_no_call_is_lost_or_doubled_at_30_percent_loss(bench: Bench, plan: RuntimePlan, seed: int) -> None:
    """Both directions at once, with loss, disorder and doubles."""
    chance = random.Random(seed)
    peer = Peer(bench, plan, liveliness="none")  # so much loss ends sessions, too
    peer.agent.drop = lambda datagram: chance.random() < 0.3
    peer.agent.drop_answer = lambda answer: chance.random() < 0.3
    served: list[int] = []
    replies: list[tuple[int, int]] = []
    called = requested = answered = 0
    for turn in range(4000):
        if turn % 3 == 0 and requested < 40:
            requested += 1
            peer.request(requested, requested)
        if called < 40 and called == len(replies):
            called += peer.client.call(f"serve_ask 0 {called}").code == 0
        if len(peer.agent.calls) > answered:
            peer.send(peer.agent.reply(answered, 1000 + answered))
            answered += 1
        peer.send(peer.agent.tick())
        if chance.random() < 0.3:
            chance.shuffle(peer.client.queued)
        if chance.random() < 0.1 and peer.client.queued:
            peer.client.queued.append(peer.client.queued[0])
        peer.client.spin(1, 20)
        if len(served) < 40 and peer.client.ok("serve_ready 0").lines == ("ready 1",):
            taken = peer.take()
            if taken:
                served.append(taken[0])
                peer.client.ok(f"serve_answer 0 0 {taken[0]}")
        found = peer.reply()
        replies += [found] if found else []
        if len(served) == len(replies) == len(peer.agent.answered) == 40:
            break
    assert served == list(range(1, 41))
    assert peer.agent.answered == [identity(n) + struct.pack("<i", n) for n in range(1, 41)]
    assert replies == [(1000 + n, n + 1) for n in range(40)]


def test_a_lost_session(bench: Bench) -> None:
    """Outstanding requests are reported once and counted; both sides continue, and a late reply is taken."""
    peer = Peer(bench)
    peer.ask(1)
    peer.ask(2)
    peer.agent.restart()
    peer.client.spin(30, 50)
    assert {REPLIER, REQUESTER} <= set(peer.agent.objects)
    reported = peer.client.call("serve_reply 0")
    assert (reported.code, reported.error) == (
        1,
        "service /far/ask: a session was lost with 2 requests under way",
    )
    assert peer.reply() is None
    assert peer.counted("client") == [0, 0, 0, 2]
    peer.ask(3)
    peer.send(peer.agent.reply(2, 33))
    peer.send(peer.agent.reply(1, 22))
    peer.request(5, 55)
    peer.client.spin(3)
    assert [peer.reply(), peer.reply()] == [(33, 3), (22, 2)]
    assert peer.take() == (55, 5)
    peer.client.ok("serve_answer 0 0 1")
    assert peer.agent.answered == [identity(5) + struct.pack("<i", 1)]


def test_places_names_and_invalid_handles(bench: Bench) -> None:
    peer = Peer(bench)
    assert peer.client.call("serve_init 1 0 other").error == (
        "all 1 services are open: set pools: {services: 2} in microros.yaml"
    )
    assert peer.client.call("serve_client 1 0 9ask").code == NAME_INVALID
    peer.client.ok("serve_client 1 0 ask")
    assert "set pools: {clients: 3}" in peer.client.call("serve_client 2 0 third").error
    peer.client.ok("serve_fini 0 0")
    peer.client.ok("serve_client_fini 0 0")
    assert REPLIER not in peer.agent.objects
    assert REQUESTER not in peer.agent.objects
    assert peer.client.call("serve_take 0 0").code == SERVICE_INVALID
    assert peer.client.call("serve_answer 0 0 1").code == SERVICE_INVALID
    assert peer.client.call("serve_ask 0 1").code == CLIENT_INVALID
    assert peer.client.call("serve_reply 0").code == CLIENT_INVALID
    peer.client.ok("serve_init 0 0 set")
    peer.client.spin(2)
    peer.request(1, 4)
    peer.client.spin()
    assert peer.take() == (4, 1)


@pytest.mark.parametrize("entities", first(["xml", "reference"]))
def test_other_ways_to_describe(bench: Bench, entities: str) -> None:
    peer = Peer(
        bench, changed(SERVER, creation__entities=entities, streams__best_effort_size=512, streams__mtu=512)
    )
    replier, requester = peer.agent.objects[REPLIER], peer.agent.objects[REQUESTER]
    if entities == "reference":
        assert replier[:2] == b"\x08\x01"
        assert replier[8:-2] == b"set__rp\0"
        assert requester[8:-2] == b"far/ask__rq\0"
        return
    assert replier[:2] == b"\x08\x02"
    assert replier[8:-2] == (
        b'<dds><replier profile_name="/set" service_name="/set" request_type="test::srv::dds_::Ask_Request_"'
        b' reply_type="test::srv::dds_::Ask_Response_"><request_topic_name>rq/setRequest</request_topic_name>'
        b"<reply_topic_name>rr/setReply</reply_topic_name>"
        b"<publisher><topic><historyQos><depth>10</depth></historyQos></topic></publisher>"
        b"<subscriber><topic><historyQos><depth>10</depth></historyQos></topic></subscriber></replier></dds>\0"
    )
    assert requester[8:].startswith(b'<dds><requester profile_name="/far/ask"')
