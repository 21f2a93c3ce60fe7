# SPDX-License-Identifier: Apache-2.0
"""What one client makes the agent do delays nobody else: turns, their order, and the time for changes of the graph.

Time is counted: what ROS 2 does costs milliseconds of the bench's clock.
"""

from __future__ import annotations

import random
import struct
from typing import Any

import pytest

from microros_gen.agent.fairness import REFUSED, TURN_S, Account
from microros_gen.agent.graph_work import BURST_S, MEMORY_S, GraphWork
from microros_gen.agent.limits import Limits
from microros_gen.agent.turns import INBOX_BYTES
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import DataFormat, Format
from microros_gen.agent.wire.data_messages import ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Create, Delete, Heartbeat
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.samples import Sample, SampleInfo, write_samples
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import Submessage, encode
from tests.support.agent import captured
from tests.support.agent.client import dds_type, int32_body, writer_blob
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities, sample
from tests.support.agent.stream_messages import acknacks

LIMITS = Limits(operations_per_second=1_000_000)
TURN = LIMITS.turn_ms / 1000
CHANGE_S, SAMPLE_S = 0.001, 0.0001
"""What a change of the graph, and a sample, cost here."""
OTHER_CREATE = captured.CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 00 77")
WRITERS = 100


class Costly(list[Any]):
    """A list of the fake bridge; to change it takes time."""

    def __init__(self, bench: Bench, seconds: float) -> None:
        super().__init__()
        self.bench, self.seconds, self.changes = bench, seconds, 0

    def append(self, what: Any) -> None:
        self._change()
        super().append(what)

    def remove(self, what: Any) -> None:
        self._change()
        super().remove(what)

    def _change(self) -> None:
        self.changes += 1
        self.bench.now += self.seconds


def costly(limits: Limits = LIMITS, change_s: float = CHANGE_S) -> Bench:
    """Return an agent with a client `b` that publishes and reads, and an attacker `a` in session."""
    bench = Bench(limits)
    bench.bridge.graph = Costly(bench, change_s)
    bench.bridge.published = Costly(bench, SAMPLE_S)
    bench.say(OTHER_CREATE, "b")
    for create in (*entities(2, topic="v"), *reader_entities(3, topic="w")):
        bench.say(message(create, stream=0), "b")
        turns(bench)
    bench.say(message(ReadData(7, 0x36, 1, delivery=FOREVER), stream=0), "b")
    bench.say(captured.CREATE_CLIENT)
    bench.bridge.graph.changes = 0
    return bench


def changes(bench: Bench) -> int:
    """Return how often the graph changed."""
    graph = bench.bridge.graph
    assert isinstance(graph, Costly)
    return graph.changes


def turns(bench: Bench, seconds: float = 60.0) -> list[bytes]:
    """Let the agent go on until it has nothing to do at once; return what it sent."""
    del bench.transport.sent[:]
    end = bench.now + seconds
    while bench.agent._turns._waiting and bench.now < end:
        before = bench.now
        bench.agent.tick()
        bench.agent.flush()
        bench.now += 0.001 if bench.now == before else 0
    return [data for _, data in bench.transport.sent]


def is_served(bench: Bench, value: int) -> None:
    """Both ways of `b` work, at once."""
    before = bench.now
    del bench.bridge.published[:]
    bench.say(message(WriteData(1, 0x25, int32_body(value)), stream=0), "b")
    assert [body for label, body in bench.bridge.published if label.startswith("/v ")] == [sample(value)]
    bench.bridge.source("/w [std_msgs/msg/Int32]").put(sample(value))
    assert len(bench.take()) == 1
    assert bench.now - before <= SAMPLE_S + 1e-9


def application(writers: int, last: str, last_type: str = "std_msgs/msg/Int32") -> Create:
    """Return the CREATE of an application with so many writers; the last one has its own topic."""
    many = "".join(f'<data_writer name="w{n}" topic_ref="rt/s10"/>' for n in range(writers - 1))
    type_name = dds_type("std_msgs/msg/Int32")
    text = (
        '<application_library name="l"><application name="a"><domain_participant name="s10" domain_id="0">'
        f'<topic name="rt/s10" register_type_ref="{type_name}"/>'
        f'<topic name="{last}" register_type_ref="{dds_type(last_type)}"/>'
        f'<publisher name="p">{many}<data_writer name="z" topic_ref="{last}"/></publisher>'
        "</domain_participant></application></application_library>"
    )
    return Create(9, 0x101C, 0x0C, Format.XML, text.encode(), 0, 0, True, True)


def statuses(sent: list[bytes]) -> list[int]:
    """Return the statuses of all STATUS among messages."""
    return [data[12] for data in sent if data[4] == 5]


# Changes of the graph


def test_one_client_alone_gets_half_of_the_time_for_changes() -> None:
    graph, account, now, elapsed = GraphWork(200), Account(), 0.0, 0.0
    for _ in range(60_000):
        now += 0.001
        if graph.allows(account, now):
            graph.charge(account, 0.002, now)
            elapsed += 0.002
    assert elapsed / now == pytest.approx(0.2 * BURST_S / MEMORY_S, rel=0.1)


def test_all_together_get_the_time_for_changes_and_a_new_one_is_served_at_once() -> None:
    graph, clients, now, elapsed = GraphWork(200), [Account() for _ in range(16)], 0.0, 0.0
    each, chance = dict.fromkeys(range(16), 0.0), random.Random(3)
    for _ in range(20_000):
        now += 0.001
        for place in chance.sample(range(16), 16):
            if graph.allows(clients[place], now):
                graph.charge(clients[place], 0.0005, now)
                each[place] += 0.0005
                elapsed += 0.0005
    assert elapsed / now == pytest.approx(0.2, rel=0.2)
    assert max(each.values()) < 1.2 * min(each.values())
    new = Account()
    for _ in range(20):
        assert graph.allows(new, now)
        graph.charge(new, 0.0005, now)


def test_flooders_of_creates_wait_and_a_client_that_begins_does_not() -> None:
    """S3"""
    bench = costly(Limits(operations_per_second=1_000_000, clients=32, graph_ms_per_second=200))
    flooders = [f"f{n}" for n in range(16)]
    for number, place in enumerate(flooders):
        bench.say(captured.CREATE_CLIENT.replace("a1 b2 c3 d4", f"00 00 01 {number:02x}"), place)
    sequence = 0
    began, before = bench.now, changes(bench)
    while bench.now < began + 4:
        sequence += 1
        for place in flooders:
            for create in entities(sequence % 50 + 1, topic=f"{place}_{sequence % 50}"):
                bench.agent.receive(
                    message(create, sequence=sequence & 0xFFFF, stream=0), place, bench.transport
                )
        bench.now += 0.05
        turns(bench, 1)
    share = (changes(bench) - before) * CHANGE_S / (bench.now - began)
    assert share < 0.2 + 0.2 * BURST_S / 4 + 0.02
    bench.say(captured.CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 02 00"), "n")
    for create in entities(1, topic="new"):
        (answer,) = bench.say(message(create, stream=0), "n")
        assert answer.endswith(" 00 00"), answer
    is_served(bench, 1)


def test_a_client_that_reconnects_is_charged_for_its_entities() -> None:
    """S4: a time-out of 1 ms, and 480 writers that leave and come back with each message."""
    bench = costly(Limits(operations_per_second=1_000_000, graph_ms_per_second=200))
    hello = CreateClient(bytes(3) + b"\x09", 0x81, 512, (("uxr_hl", "1"),))
    bench.say(join(Header(0x80, 0, 0), [encode(hello)]), "s")
    many = [
        Create(9, n << 4 | 5, 5, Format.BINARY, writer_blob(0x12, 3, 10), 0x13, 0, True, True)
        for n in range(2, 482)
    ]
    for create in (*entities(1, topic="s"), *many):
        bench.say(message(create, stream=0), "s")
        while turns(bench):
            continue
        bench.now += 2 * CHANGE_S / 0.1
    before, began = changes(bench), bench.now
    longest = 0.0
    while bench.now < began + 10:
        bench.now += 0.02
        at = bench.now
        bench.say(message(WriteData(1, 0x155, int32_body(1)), stream=0), "s")
        longest = max(longest, bench.now - at)
        is_served(bench, 1)
        at = bench.now
        bench.agent.tick()
        longest = max(longest, bench.now - at)
        is_served(bench, 2)
    assert (changes(bench) - before) * CHANGE_S / 10 < 0.2 * BURST_S / MEMORY_S + 0.06
    assert longest <= TURN_S + TURN + 2 * CHANGE_S


# Turns


def test_what_takes_long_goes_on_in_turns_and_others_are_served_between() -> None:
    bench = costly()
    at = bench.now
    assert (
        statuses([bytes.fromhex(a) for a in bench.say(message(application(WRITERS, "rt/z"), stream=0))]) == []
    )
    assert bench.now - at <= TURN + 2 * CHANGE_S
    value, sent = 0, []
    while bench.agent._turns._waiting:
        value += 1
        is_served(bench, value)
        at = bench.now
        del bench.transport.sent[:]
        bench.agent.tick()
        sent += [data for _, data in bench.transport.sent]
        assert bench.now - at <= TURN_S + TURN + CHANGE_S
    assert value > WRITERS * CHANGE_S / (TURN_S + TURN) / 2
    assert statuses(sent) == [0]
    assert len([label for label in bench.bridge.graph if label.startswith("/s10 ")]) == WRITERS - 1


def test_messages_after_a_long_operation_wait_in_order_and_are_acknowledged_when_done() -> None:
    bench = costly()
    bench.say(message(*entities(1), stream=0x80, sequence=0))
    turns(bench)
    answers = bench.say(message(application(WRITERS, "rt/z"), stream=0x80, sequence=1))
    for number in range(2, 6):
        answers += bench.say(message(WriteData(1, 0x15, int32_body(number)), stream=0x80, sequence=number))
    assert not [body for label, body in bench.bridge.published if label.startswith("/a ")]
    assert {first for first, _ in acknacks(answers)} == {1}
    sent = turns(bench)
    assert [body for label, body in bench.bridge.published if label.startswith("/a ")] == [
        sample(number) for number in range(2, 6)
    ]
    assert acknacks([data.hex() for data in sent])[-1] == (6, 0)


def test_waiting_messages_are_bounded_and_reliable_ones_are_repeated() -> None:
    bench = costly()
    for place, create in enumerate(entities(1)):
        bench.say(message(create, stream=0x80, sequence=place))
        turns(bench)
    bench.say(message(application(WRITERS, "rt/z"), stream=0))
    body = bytes(30_000)
    for number in range(4, 4 + 5):
        bench.say(message(WriteData(1, 0x15, body), stream=0x80, sequence=number))
    (client,) = (c for c in bench.agent.clients if c.address == "a")
    assert sum(len(ready[0]) for ready in client.ready) < INBOX_BYTES + len(body) + 50_000
    assert bench.log.counters == {"turn_full": 2}
    turns(bench)
    assert acknacks(bench.say(message(Heartbeat(4, 8, 0x80), stream=0))) == [(7, 3)]


def test_a_long_sequence_is_published_once_each_and_in_order() -> None:
    """S12, S5: 3,000 samples in one message."""
    bench = costly()
    for create in entities(1):
        bench.say(message(create, stream=0))
    turns(bench)
    count = 3_000
    body = struct.pack("<I", count) + b"".join(struct.pack("<II", 4, n) for n in range(count))
    at = bench.now
    bench.say(message(WriteData(1, 0x15, body, DataFormat.DATA_SEQ), stream=0x80, sequence=0))
    assert bench.now - at <= TURN + 17 * SAMPLE_S
    is_served(bench, 7)
    turns(bench)
    assert bench.agent.samples == count + 1
    seen = [data for label, data in bench.bridge.published if label.startswith("/a ")]
    assert seen == [sample(n) for n in range(count - len(seen), count)]


class Passing:
    """A clock that goes on whenever it is read: as if each look cost a tenth of a millisecond."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.looks = bench, 0

    def __call__(self) -> float:
        self.looks += 1
        self.bench.now += 0.0001
        return self.bench.now


@pytest.mark.parametrize("form", [DataFormat.DATA_SEQ, DataFormat.SAMPLE_SEQ, DataFormat.PACKED_SAMPLES])
def test_a_long_sequence_is_cut_in_turns_and_nothing_of_a_broken_one_is_published(form: DataFormat) -> None:
    """S5: to cut 3,750 samples took 11 ms, in which nobody else was served."""
    bench = costly()
    for create in entities(1):
        bench.say(message(create, stream=0))
    turns(bench)
    writer = Writer(True)
    write_samples(writer, form, [Sample(int32_body(n), SampleInfo(0, n & 0xFF, 0)) for n in range(2_000)])
    bench.bridge.published = []
    bench.agent._turns.clock = Passing(bench)
    whole = writer.content()
    for body, samples in ((whole[:-4], 0), (whole, 2_000)):
        at = bench.now
        bench.say(message(WriteData(1, 0x15, body, form), stream=0))
        assert bench.now - at <= TURN + 0.001
        turns(bench)
        assert len(bench.bridge.published) == samples
    assert bench.log.counters.total() == 1
    assert [body for _, body in bench.bridge.published] == [sample(n) for n in range(2_000)]


def test_a_waiting_client_gets_unacknowledged_messages_again() -> None:
    bench = costly(Limits(graph_ms_per_second=60))
    for create in reader_entities(1, topic="r"):
        bench.say(message(create, stream=0))
        turns(bench)
    bench.say(message(ReadData(7, 0x16, 0x80, delivery=FOREVER), stream=0))
    bench.bridge.source("/r [std_msgs/msg/Int32]").put(sample(1))
    assert len(bench.take()) == 1
    bench.say(message(application(WRITERS, "rt/z"), stream=0))
    bench.wait(0.5)
    assert bench.agent._turns._waiting, "it may not change the graph so much at once"
    assert any(sent.startswith("81 00 00 00 0b") for sent in bench.wait(2)), "no HEARTBEAT"


@pytest.mark.parametrize("stream", [1, 0x80], ids=["best effort", "reliable"])
@pytest.mark.parametrize("change_s", [0.03, 0.15, 0.4])
def test_a_slow_machine_refuses_no_entities(stream: int, change_s: float) -> None:
    """Each change may take longer than the share of a second has; a client waits a second for each."""
    bench = costly(Limits(), change_s)
    bench.now += 10.0
    creates = (*entities(1, topic="slow"), *reader_entities(4, topic="slower"))
    for sequence, create in enumerate(creates):
        requested_at = bench.now
        answers = bench.say(message(create, stream=stream, sequence=sequence))
        while not any(" 05 01 " in answer for answer in answers):
            answers = bench.wait(0.01, 0.01)
            assert bench.now - requested_at < 1.0 + change_s
    assert bench.log.counters.keys() <= {"operations_wait"}
    assert len([label for label in bench.bridge.graph if "slow" in label]) == 2


def test_who_leaves_in_the_middle_leaves_nothing() -> None:
    bench = costly()
    bench.say(message(application(WRITERS, "rt/z"), stream=0))
    bench.say(message(Delete(9, 0xFFFE), stream=0))
    turns(bench)
    assert bench.agent.clients.at("a") is None
    assert not [label for label in bench.bridge.graph if "s10" in label]


def test_a_returning_client_waits_for_its_unfinished_work() -> None:
    bench = costly(Limits(graph_ms_per_second=1_000))
    bench.say(message(application(WRITERS, "rt/z"), stream=0))
    turns(bench)
    bench.say(captured.CREATE_CLIENT.replace("81 00 fc", "82 00 fc"))
    assert [label for label in bench.bridge.graph if "s10" in label], "it takes more than a turn"
    node = join(Header(0x82, 0, 0), [encode(entities(1)[0])])
    bench.say(node)
    assert bench.bridge.graph.count("0:/a") == 2, "those of the other client"
    turns(bench)
    assert not [label for label in bench.bridge.graph if "s10" in label]
    assert bench.bridge.graph.count("0:/a") == 3


# Refused before it costs


@pytest.mark.parametrize(
    ("create", "status"),
    [
        (application(400, "rt/bad name"), 0x85),
        (application(512, "rt/z"), 0x87),
        (application(400, "rt/s10", "std_msgs/msg/String"), 0x86),
    ],
    ids=["a name", "too many", "a topic with two types"],
)
def test_an_application_that_cannot_be_costs_nothing(create: Create, status: int) -> None:
    """S10"""
    bench = costly()
    answers = bench.say(message(create, stream=0))
    assert statuses([bytes.fromhex(answer) for answer in answers]) == [status]
    assert changes(bench) == 0


@pytest.mark.parametrize(
    ("submessage", "factor"),
    [
        (entities(1)[0], 1),
        (Create(9, 0x0015, 5, Format.BINARY, writer_blob(0x72, 3, 10), 0x73, 0, True, True), REFUSED),
        (ReadData(7, 0x7776, 1), REFUSED),
        (Delete(9, 0x7775), REFUSED),
    ],
    ids=["done", "CREATE", "READ_DATA", "DELETE"],
)
def test_what_is_refused_counts_more(submessage: Submessage, factor: int) -> None:
    bench = costly()
    slow_sends(bench, 0.001)
    (client,) = (client for client in bench.agent.clients if client.address == "a")
    client.account.used, at = 0.0, bench.now
    bench.say(message(submessage, stream=0))
    assert bench.now > at
    assert client.account.used == pytest.approx(factor * (bench.now - at))


def test_malformed_messages_count_more_and_those_of_strangers_do_not() -> None:
    """Strangers are one account: who comes would wait for those who say nothing right."""
    bench = costly()
    (client,) = (client for client in bench.agent.clients if client.address == "a")
    bench.agent.receive(bytes((0x81, 0, 0, 0, 99, 1, 0, 0)), "a", bench.transport)
    assert bench.agent._strangers.refused is False
    bench.agent.receive(bytes((0x81, 0, 0, 0, 99, 1, 0, 0)), "nobody", bench.transport)
    assert bench.agent._strangers.refused is False
    assert bench.log.counters == {"submessage_id": 2}
    assert client.account.refused is False, "it is paid"


# Deliveries


def test_a_client_that_reads_much_is_served_after_one_that_reads_little() -> None:
    bench = costly()
    for number in range(4, 34):
        for create in reader_entities(number, topic=f"n{number}"):
            bench.say(message(create, stream=0))
        turns(bench)
        bench.say(message(ReadData(number, number << 4 | 6, 1, delivery=FOREVER), stream=0))
    slow_sends(bench, 0.0005)
    for number in range(4, 34):
        bench.bridge.source(f"/n{number} [std_msgs/msg/Int32]").put(*[sample(1)] * 20)
    bench.agent.take()
    bench.bridge.source("/w [std_msgs/msg/Int32]").put(sample(2))
    del bench.transport.sent[:]
    bench.agent.take()
    assert bench.transport.sent[0][0] == "b"
    for _ in range(200):
        bench.agent.tick()
    assert bench.agent.delivered == 30 * 20 + 1


def slow_sends(bench: Bench, seconds: float) -> None:
    """Let a message take time."""
    sent = Costly(bench, seconds)
    bench.transport.sent = sent
