# SPDX-License-Identifier: Apache-2.0
"""Subscriptions: creation, READ_DATA as flow control, the queues, loss, order, reconnection, what is refused."""

from __future__ import annotations

import random
import struct

import pytest

from microros_gen.application.names import expand_topic_name
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan, SubscriptionPlan
from tests.support.plans import DECLARED, INT32, POOL, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import STRING
from tests.support.runtime.reading_agent import READ_DATA, UNLIMITED, ReadingAgent

TAKE_FAILED = 401
FIRST = POOL.entities.publishers.max
"""The first subscription's index among the endpoints."""
DECLARED_READER = changed(
    DECLARED,
    entities__subscriptions__declared=(
        SubscriptionPlan(0, 0, "/arm/go", "rt/arm/go", INT32, True),
        SubscriptionPlan(1, 0, "/arm/words", "rt/arm/words", STRING, False),
    ),
    entities__subscriptions__max=2,
    input__queues=(QueuePlan(2, 4), QueuePlan(1, 16)),
    input__reliable_slots=1,
    input__reliable_slot_size=64,
)
ONLY_READER = changed(
    DECLARED_READER,
    entities__publishers__declared=(),
    entities__publishers__max=1,
    streams__reliable_slots=0,
    streams__reliable_slot_size=0,
)
PRECONFIGURED = changed(DECLARED_READER, creation__entities="preconfigured")


class Reader:
    """A client with subscription 0, its agent, and what was taken."""

    def __init__(
        self, bench: Bench, plan: RuntimePlan = READER, qos: str = "reliable", type_name: str = "Int32"
    ) -> None:
        self.agent = ReadingAgent(preconfigured=plan.creation.entities == "preconfigured")
        self.client: Client = bench.start(plan, agent=self.agent)
        name = (
            f"{plan.entities.nodes.declared[0].name} {plan.entities.nodes.declared[0].namespace}"
            if plan.entities.declared
            else "listener -"
        )
        self.index = plan.entities.publisher_places
        self.client.ok("init")
        self.client.ok(f"node 0 {name}")
        self.client.ok(f"read_init 0 0 {type_name} go {qos}")
        self.client.spin(2)

    def number(self, *values: int, index: int | None = None) -> None:
        self.send(self.agent.numbers(self.index if index is None else index, *values))

    def send(self, datagrams: list[bytes]) -> None:
        self.client.queued += datagrams

    def take(self, index: int = 0) -> int | None:
        result = self.client.call(f"read_take {index}")
        assert result.code in (0, TAKE_FAILED), result
        return int(result.lines[0].split()[1]) if result.code == 0 else None

    def take_all(self, index: int = 0) -> list[int]:
        found = []
        while (value := self.take(index)) is not None:
            found.append(value)
        return found

    def counted(self, index: int = 0) -> tuple[int, int]:
        (line,) = self.client.ok(f"read_statistics {index}").lines
        _, dropped, refused = line.split()
        return int(dropped), int(refused)


def test_what_a_subscription_creates(bench: Bench) -> None:
    """Bytes as the public client sends them: topic, subscriber, data reader with its QoS."""
    reader = Reader(bench)
    created = [datagram for datagram in reader.client.sent if datagram[4] == 0x01]
    topic, subscriber, data_reader = (d[8:] for d in created[1:])
    assert topic[2:4] == bytes.fromhex("0032")
    assert b"rt/go\0" in topic
    assert b"std_msgs::msg::dds_::Int32_\0" in topic
    assert subscriber[2:] == bytes.fromhex("0034 0403 0000 02000000 0000 0001")
    blob = bytes.fromhex("0032 0100 0300 0100 0a00 000000 0000")
    assert data_reader[2:] == bytes.fromhex("0036 0603 0000 0f000000") + blob + bytes.fromhex("0034")
    assert reader.client.ok("read_name 0").lines == ("name /go",)


def test_read_data_as_the_public_client_sends_it(bench: Bench) -> None:
    """On a separate reliable stream; micro-ROS asks with the same submessage."""
    reader = Reader(bench, qos="best_effort")
    (sent,) = (d for d in reader.client.sent if d[4] == READ_DATA)
    request = sent[8:10].hex()
    assert sent == bytes.fromhex(f"81810000 08011000 {request} 0036 01 00 00 01 ffff 0000 0000 0000")
    reader.client.spin(20, 50)
    assert len(reader.agent.reads) == 1


def test_samples_are_delivered_in_order(bench: Bench) -> None:
    reader = Reader(bench)
    assert reader.take() is None
    reader.number(1, 2, 3, 4, 5, 6, 7)
    found = []
    for _ in range(12):
        reader.client.spin()
        value = reader.take()
        found += [] if value is None else [value]
    assert found == [1, 2, 3, 4, 5, 6, 7]
    assert reader.counted() == (0, 0)


def test_a_reliable_subscription_asks_for_what_it_has_room_for(bench: Bench) -> None:
    reader = Reader(bench)
    assert [r.samples for r in reader.agent.reads] == [3]
    reader.number(*range(10))
    reader.client.spin(4)
    assert reader.agent.reads[-1].left == 0
    assert len(reader.agent.history[reader.agent.reads[0].reader]) == 7, "the rest waits in DDS"
    assert reader.take() == 0
    reader.client.spin(2)
    assert len(reader.agent.reads) == 1, "not for one sample at a time"
    assert reader.take() == 1
    reader.client.spin(2)
    assert [r.samples for r in reader.agent.reads] == [3, 2]
    assert reader.take_all() == list(range(2, 10))
    assert reader.counted() == (0, 0)


def test_never_two_grants_at_a_time(bench: Bench) -> None:
    reader = Reader(bench)
    reader.number(1)
    reader.client.spin()
    assert reader.take() == 1
    reader.client.spin(10, 50)
    assert len(reader.agent.reads) == 1, "two of the first grant are still to come"


def test_a_best_effort_subscription_keeps_the_newest(bench: Bench) -> None:
    reader = Reader(bench, qos="best_effort")
    assert [(r.stream, r.samples) for r in reader.agent.reads] == [(1, UNLIMITED)]
    reader.number(1, 2, 3, 4, 5)
    reader.client.spin()
    assert reader.counted() == (2, 0)
    assert reader.client.statistics()["dropped"] == 2
    assert reader.take_all() == [3, 4, 5]
    reader.number(6)
    assert reader.take_all() == [6]


def test_an_agent_that_sends_more_than_it_was_asked_for(bench: Bench) -> None:
    """A reliable queue keeps what it has; the surplus is counted."""
    reader = Reader(bench)
    reader.agent.reads[0].left = 100
    reader.number(1, 2, 3, 4, 5)
    reader.client.spin()
    assert reader.counted() == (2, 0)
    assert reader.take_all() == [1, 2, 3]


@pytest.mark.parametrize("seed", range(3))
def test_nothing_is_lost_doubled_or_out_of_order_at_30_percent_loss(bench: Bench, seed: int) -> None:
    chance = random.Random(seed)
    reader = Reader(bench)
    reader.agent.drop = lambda datagram: chance.random() < 0.3
    reader.agent.drop_answer = lambda answer: chance.random() < 0.3
    found: list[int] = []
    offered = 0
    for _ in range(4000):
        if offered < 120 and chance.random() < 0.5:
            reader.number(offered)
            offered += 1
        reader.send(reader.agent.tick())
        if chance.random() < 0.3 and len(reader.client.queued) > 1:
            chance.shuffle(reader.client.queued)
        if chance.random() < 0.1 and reader.client.queued:
            reader.client.queued.append(reader.client.queued[0])
        reader.client.spin(1, 20)
        if chance.random() < 0.5:
            found += reader.take_all()
        if len(found) == 120:
            break
    assert found == list(range(120))
    assert reader.counted() == (0, 0)


def test_best_effort_under_loss_and_disorder_is_in_order(bench: Bench) -> None:
    chance = random.Random(3)
    reader = Reader(bench, qos="best_effort")
    found = []
    for value in range(300):
        reader.number(value)
        if chance.random() < 0.3:
            chance.shuffle(reader.client.queued)
            reader.client.queued.append(reader.client.queued[0])
            del reader.client.queued[chance.randrange(len(reader.client.queued))]
        if chance.random() < 0.6:
            reader.client.spin()
            found += reader.take_all()
    assert found == sorted(set(found))
    assert len(found) > 150


@pytest.mark.parametrize("jump", [1, 40, 63, 64, 1000, 0x4401, 0x7FFF, 0x8000, 0xFFC0])
def test_a_number_that_jumps_costs_little_of_a_best_effort_stream(bench: Bench, jump: int) -> None:
    """By a forged or stale datagram: at most 64 samples, and no answer, so nothing is asked twice."""
    reader = Reader(bench, qos="best_effort")
    reader.number(1)
    assert reader.take_all() == [1]
    number = (reader.agent.answers + jump) & 0xFFFF
    reader.send([b"\x81\x01" + struct.pack("<H", number) + bytes.fromhex("09 01 08 00 4444 0036 01000000")])
    reader.client.spin()
    reader.client.sent.clear()
    reader.client.ok("read_init 1 0 Int32 more best_effort")
    assert len([d for d in reader.client.sent if d[4] == 0x01]) == 3
    assert len(set(reader.client.sent)) == len(reader.client.sent)
    found = []
    for value in range(2, 102):
        reader.number(value)
        found += reader.take_all()
    assert found == list(range(102 - len(found), 102))
    assert 100 - len(found) <= min(jump, 64)


def test_read_data_is_sent_again_until_it_is_acknowledged(bench: Bench) -> None:
    reader = Reader(bench)
    reader.agent.drop_answer = lambda answer: answer[4] == 0x0A
    reader.client.ok("read_init 1 0 Int32 more reliable")
    reader.client.spin(10, POOL.times.retry_first_ms)
    sent = [d for d in reader.client.sent if d[4] == READ_DATA][1:]
    assert len(sent) > 5
    assert len(set(sent)) == 1
    assert len(reader.agent.reads) == 2, "the agent acts on it once"
    reader.number(7, index=FIRST + 1)
    assert reader.take(1) == 7, "a sample says as well that it has arrived"
    count = len(reader.client.sent)
    reader.client.spin(3, POOL.times.retry_first_ms)
    assert not [d for d in reader.client.sent[count:] if d[4] == READ_DATA]


def test_a_refused_read_is_reported_and_repeated(bench: Bench) -> None:
    reader = Reader(bench)
    reader.agent.read_status = 0x84
    reader.client.ok("read_init 1 0 Int32 more reliable")
    reader.client.spin(3)
    result = reader.client.call("read_take 1")
    assert (result.code, result.error) == (1, "/more: the agent refuses READ_DATA: UNKNOWN_REFERENCE")
    assert reader.client.call("read_take 1").code == TAKE_FAILED, "told once"
    reader.agent.read_status = 0
    reader.client.spin(4, POOL.times.retry_most_ms)
    reader.number(5, index=FIRST + 1)
    assert reader.take(1) == 5
    assert reader.client.statistics()["refused"] == 1


@pytest.mark.parametrize("qos", ["reliable", "best_effort"])
@pytest.mark.parametrize(
    "plan", [READER, DECLARED_READER, ONLY_READER, PRECONFIGURED], ids=lambda p: p.entities
)
def test_a_subscription_goes_on_after_the_agent_restarts(bench: Bench, plan: RuntimePlan, qos: str) -> None:
    reader = Reader(bench, plan, qos)
    reader.number(1)
    assert reader.take() == 1
    reader.agent.restart()
    reader.client.spin(plan.times.liveliness_attempts + 25, 50)
    assert reader.client.statistics()["reconnects"] == 1
    reader.number(2)
    assert reader.take() == 2


def test_what_waits_here_stays_over_a_lost_session(bench: Bench) -> None:
    reader = Reader(bench)
    reader.number(1, 2)
    reader.client.spin()
    reader.agent.restart()
    reader.client.spin(30, 50)
    assert len(reader.agent.reads) == 1, "there is room for one, which is less than half"
    reader.number(3)
    assert reader.take() == 1
    reader.client.spin(2)
    assert reader.agent.reads[-1].samples == 2
    assert reader.take_all() == [2, 3]


def test_an_agent_that_lives_on_while_the_client_reconnects(bench: Bench) -> None:
    reader = Reader(bench, qos="best_effort")
    reader.agent.silent = True
    reader.client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    reader.agent.silent = False
    reader.client.spin(20, 50)
    reader.number(4, 5)
    assert reader.take_all() == [4, 5]


def test_a_closed_subscription_and_a_new_one_in_its_place(bench: Bench) -> None:
    reader = Reader(bench)
    reader.number(1)
    reader.client.spin()
    late = reader.agent.numbers(FIRST, 2)
    reader.client.ok("read_fini 0 0")
    assert bytes.fromhex("0036") not in reader.agent.objects
    assert reader.client.call("read_take 0").code == 400
    reader.client.ok("read_init 0 0 Int32 other reliable")
    reader.send(late)
    reader.client.spin(3)
    assert reader.take() is None, "what was for the former owner"
    assert bytes.fromhex("0036") in reader.agent.objects


def test_closing_a_preconfigured_one_stops_the_agent(bench: Bench) -> None:
    reader = Reader(bench, PRECONFIGURED)
    reader.client.ok("read_fini 0 0")
    reader.client.spin(2)
    assert (reader.agent.reads[-1].stream, reader.agent.reads[-1].samples) == (0, 0)
    reader.client.ok("read_init 0 0 Int32 go reliable")
    reader.client.spin(2)
    reader.number(3)
    assert reader.take() == 3


def test_two_subscriptions_do_not_mix(bench: Bench) -> None:
    reader = Reader(bench)
    reader.client.ok("read_init 1 0 String words best_effort")
    reader.client.spin(2)
    reader.number(1)
    reader.send(reader.agent.offer(FIRST + 1, struct.pack("<I", 3) + b"hi\0"))
    result = reader.client.ok("read_text 1 9")
    assert result.lines == ("text hi",)
    assert reader.take_all() == [1]


def test_larger_than_a_slot_is_refused_and_reported(bench: Bench) -> None:
    reader = Reader(bench, type_name="String")
    reader.send(reader.agent.offer(FIRST, struct.pack("<I", 20) + b"x" * 19 + b"\0"))
    reader.send(reader.agent.offer(FIRST, struct.pack("<I", 2) + b"y\0"))
    result = reader.client.call("read_text 0 9")
    expected = "/go: received 24 bytes, 16 fit: raise limits of std_msgs/msg/String in microros.yaml"
    assert (result.code, result.error) == (1, expected)
    assert reader.client.ok("read_text 0 9").lines == ("text y",)
    assert reader.counted() == (0, 1)
    assert reader.client.statistics()["dropped"] == 1


def test_what_does_not_decode_is_an_error_of_the_take(bench: Bench) -> None:
    reader = Reader(bench, type_name="String")
    reader.send(reader.agent.offer(FIRST, struct.pack("<I", 9) + b"eight ch\0"))
    reader.send(reader.agent.offer(FIRST, struct.pack("<I", 100) + b"a\0"))
    reader.send(reader.agent.offer(FIRST, struct.pack("<I", 2) + b"y\0"))
    result = reader.client.call("read_text 0 4")
    assert (
        result.error
        == "capacity for 3: set limits: {std_msgs/msg/String: {data: 8}} in microros.yaml, or that of your buffer"
    )
    result = reader.client.call("read_text 0 4")
    assert (result.code, result.error.split(":")[0]) == (1, "std_msgs/msg/String.data")
    assert reader.client.ok("read_text 0 4").lines == ("text y",)
    assert reader.counted() == (0, 2)


def test_either_byte_order(bench: Bench) -> None:
    reader = Reader(bench)
    reader.agent.flags = 0
    reader.send(reader.agent.offer(FIRST, struct.pack(">i", 1)))
    reader.send(reader.agent.offer(FIRST, struct.pack(">i", 2)))
    assert reader.take() == 1
    assert reader.client.ok("read_raw 0 64").lines == ("bytes 0000000000000002",)


def test_serialized_messages(bench: Bench) -> None:
    reader = Reader(bench)
    reader.number(258)
    assert reader.client.call("read_raw 0 7").code == 10, "BAD_ALLOC: the buffer has no allocator"
    assert reader.client.ok("read_raw 0 8").lines == ("bytes 0001000002010000",)


def test_when_a_sample_arrived(bench: Bench) -> None:
    reader = Reader(bench)
    reader.number(1)
    reader.client.spin()
    reader.client.wait(250)
    result = reader.client.ok("read_take 0 info")
    assert result.lines == ("value 1", "info 0 0 0"), "nobody has set the time of day"
    reader.client.tell("epoch 1790000000000")
    reader.number(2)
    reader.client.spin(2)
    reader.client.wait(250)
    result = reader.client.ok("read_take 0 info")
    assert result.lines == ("value 2", "info 0 1789999999750000000 0")


MALFORMED = [
    "81 00 0000 0a 01 0400 0100 0000",
    "81 00 0000 05 01 0300 {request} 00",
    "81 00 0000 09 01 0400 {request} 0036",
    "81 00 0000 09 01 0200 {request}",
    "81 00 0000 09 03 0800 {request} 0036 01000000",
    "81 00 0000 09 01 0900 {request} 0036 01000000",
]
IGNORED = [
    "81 00 0000 09 01 0800 0000 0036 01000000",
    "81 00 0000 09 01 0800 7777 0036 01000000",
    "81 00 0000 09 01 0800 {request} 0035 01000000",
    "81 00 0000 09 01 0800 {request} 0046 01000000",
    "81 00 0000 09 01 0800 {request} 0016 01000000",
    "81 00 0000 09 01 0800 {request} fff6 01000000",
    "81 00 0000 05 01 0600 {request} 0036 00 00",
    "81 00 0000 0a 01 0500 0500 0000 81",
]


@pytest.mark.parametrize("text", MALFORMED + IGNORED)
def test_what_is_no_sample(bench: Bench, text: str) -> None:
    reader = Reader(bench)
    before = reader.client.statistics()["malformed"]
    reader.send([bytes.fromhex(text.format(request=reader.agent.reads[0].request.hex()))])
    assert reader.take() is None
    malformed = reader.client.statistics()["malformed"] - before
    assert malformed == (text in MALFORMED)
    reader.number(9)
    assert reader.take() == 9


def test_any_bytes_leave_it_sound(bench: Bench) -> None:
    """Mutated datagrams of the agent; the sanitizers watch."""
    chance = random.Random(11)
    reader = Reader(
        bench,
        changed(
            READER, input__queues=(QueuePlan(3, 100), QueuePlan(3, 16)), input__arrives_in_fragments=True
        ),
    )
    reader.agent.mtu = 40
    for value in range(400):
        datagrams = reader.agent.offer(FIRST, chance.randbytes(chance.randrange(1, 120)))
        for datagram in datagrams:
            broken = bytearray(datagram)
            for _ in range(chance.randrange(3)):
                broken[chance.randrange(len(broken))] = chance.randrange(256)
            reader.send([bytes(broken)[: chance.randrange(1, len(broken) + 1)]])
        reader.client.spin()
        reader.client.call("read_take 0")
        assert value >= 0


LARGE = changed(
    READER,
    input__queues=(QueuePlan(2, 400), QueuePlan(2, 16)),
    input__arrives_in_fragments=True,
)


def _text(size: int, letter: str = "z") -> bytes:
    return struct.pack("<I", size + 1) + letter.encode() * size + b"\0"


@pytest.mark.parametrize("size", [40, 47, 48, 49, 100, 300, 395])
def test_fragments(bench: Bench, size: int) -> None:
    reader = Reader(bench, LARGE, type_name="String")
    reader.send(reader.agent.offer(FIRST, _text(size), _text(3, "a")))
    reader.client.spin()
    assert reader.client.ok("read_text 0 1000").lines == ("text " + "z" * size,)
    assert reader.client.ok("read_text 0 1000").lines == ("text aaa",)


def test_fragments_under_loss(bench: Bench) -> None:
    chance = random.Random(7)
    reader = Reader(bench, LARGE, type_name="String")
    reader.agent.drop_answer = lambda answer: chance.random() < 0.3
    found: list[str] = []
    sizes = [chance.randrange(1, 390) for _ in range(30)]
    reader.send(reader.agent.offer(FIRST, *(_text(size) for size in sizes)))
    for _ in range(3000):
        reader.send(reader.agent.tick())
        reader.client.spin(1, 20)
        result = reader.client.call("read_text 0 1000")
        found += result.lines
        if len(found) == len(sizes):
            break
    assert [len(line) - len("text ") for line in found] == sizes


def test_fragments_of_more_than_there_is_room_for(bench: Bench) -> None:
    """The first piece tells; the others are passed over, and what follows is not affected."""
    reader = Reader(bench, LARGE, type_name="String")
    reader.agent.offer(FIRST)
    reader.send(reader.agent.offer(FIRST, _text(600), _text(5)))
    reader.client.spin()
    result = reader.client.call("read_text 0 1000")
    assert (
        result.error
        == "/go: received 605 bytes, 400 fit: raise limits of std_msgs/msg/String in microros.yaml"
    )
    assert reader.client.ok("read_text 0 1000").lines == ("text zzzzz",)
    assert reader.counted() == (0, 1)


def test_fragments_where_none_are_planned(bench: Bench) -> None:
    reader = Reader(bench, type_name="String")
    reader.send(reader.agent.offer(FIRST, _text(100), _text(5)))
    result = reader.client.call("read_text 0 1000")
    assert (
        result.error
        == "/go: received 105 bytes, 16 fit: raise limits of std_msgs/msg/String in microros.yaml"
    )
    assert reader.client.ok("read_text 0 1000").lines == ("text zzzzz",)


def test_a_missing_fragment(bench: Bench) -> None:
    """A HEARTBEAT reports it: received fragments of that sample are discarded up to its last one."""
    reader = Reader(bench, LARGE, type_name="String")
    chunks = reader.agent.offer(FIRST, _text(200))
    number = struct.unpack_from("<H", chunks[1], 2)[0]
    reader.send([chunks[0]])
    reader.client.spin()
    skip = b"\x81\0\0\0\x0b\x01\x05\0" + struct.pack("<HH", number + 1, number + 3) + b"\x80"
    reader.send([skip, *chunks[2:]])
    reader.client.spin(2)
    assert reader.client.call("read_text 0 1000").code == TAKE_FAILED
    reader.send(reader.agent.offer(FIRST, _text(150, "b")))
    assert reader.client.ok("read_text 0 1000").lines == ("text " + "b" * 150,)


def test_declared_subscriptions(bench: Bench) -> None:
    reader = Reader(bench, DECLARED_READER)
    result = reader.client.call("read_init 1 0 Int32 other reliable")
    assert result.code == 1
    expected = (
        "subscription not declared: add to its node's subscriptions: in microros.yaml: {topic: other, type: "
    )
    assert result.error == expected + "std_msgs/msg/Int32}"
    result = reader.client.call("read_init 1 0 Int32 go reliable")
    assert (result.code, result.error) == (1, "subscription go is open already")
    reader.client.ok("read_init 1 0 String words best_effort")
    assert expand_topic_name("words", "imu", "/arm") == "/arm/words"


def test_a_pool_that_is_full_and_what_is_refused(bench: Bench) -> None:
    reader = Reader(bench)
    reader.client.ok("read_init 1 0 Int32 more reliable")
    result = reader.client.call("read_init 2 0 Int32 third reliable")
    expected = "all 2 subscriptions are open: set pools: {subscriptions: 3} in microros.yaml"
    assert (result.code, result.error) == (1, expected)
    result = reader.client.call("read_init 2 0 Int32 third deadline")
    assert (result.code, result.error) == (
        3,
        "subscription third: XRCE carries no such QoS: deadline",
    )
    assert reader.client.call("read_init 2 0 Int32 1x reliable").code == 103
    assert reader.client.call("read_init 2 3 Int32 x reliable").code == 200
    assert reader.client.call("read_init 0 0 Int32 go again").code == 100


def test_a_reader_that_the_agent_refuses(bench: Bench) -> None:
    reader = Reader(bench)
    reader.agent.refuse = {"datareader": 0x80}
    result = reader.client.call("read_init 1 0 Int32 more reliable")
    expected = "datareader /more: the agent refuses it: DDS_ERROR (entities in microros.yaml)"
    assert (result.code, result.error) == (1, expected)


def test_a_node_takes_its_subscriptions_with_it(bench: Bench) -> None:
    reader = Reader(bench)
    reader.client.ok("node_fini 0")
    assert not reader.agent.objects
    assert reader.client.call("read_take 0").code == 400


def test_publishing_and_receiving_together(bench: Bench) -> None:
    reader = Reader(bench)
    reader.client.ok("publisher 0 0 Int32 chatter reliable")
    for value in range(50):
        reader.number(value)
        reader.client.ok(f"publish 0 {value}")
        assert reader.take() == value
    reader.client.ok("flush 1000")
    assert reader.agent.values() == list(range(50))
