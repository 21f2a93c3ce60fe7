# SPDX-License-Identifier: Apache-2.0
"""A client that does everything wrong, and one next to it that is served meanwhile.

Whatever it says: nothing raises, it is answered as the standard says, the tables stay within their limits, and no
single message takes long.
"""

from __future__ import annotations

import gc
import io
import random
import time
import tracemalloc
from collections.abc import Callable, Iterator

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.log import BURST, BYTES_AT_ONCE, BYTES_PER_SECOND, EventLog, Level
from microros_gen.agent.objects import LARGEST_REPRESENTATION
from microros_gen.agent.wire.cdr import MOST_ELEMENTS
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import (
    Acknack,
    Create,
    Delete,
    Fragment,
    Heartbeat,
    Reset,
    StatusReply,
)
from microros_gen.agent.wire.message import MOST_REQUESTS, Header, header_size, join, split
from microros_gen.agent.wire.session_messages import CreateClient, GetInfo, Info, Timestamp
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent import captured
from tests.support.agent.client import (
    dds_type,
    int32_body,
    participant_blob,
    reader_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench, FakeSource
from tests.support.agent.readers import FOREVER, reader_entities, sample
from tests.support.agent.storm import services

LIMITS = Limits(
    clients=8,
    objects=40,
    streams=4,
    message_bytes=50_000,
    backlog_bytes=4_000,
    requests=16,
    client_timeout_s=5,
    sleep_timeout_s=20,
)
VICTIM = "victim"
VICTIM_CREATE = captured.CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 00 77")
SLOWEST_S = 0.5
"""Processor time for one message, on a slow machine; each of these takes a tenth of it."""
DATA_SEQ, SAMPLE_SEQ, PACKED = 8, 10, 14


class Stage:
    """The attacker `a` and the victim at one agent."""

    def __init__(self, limits: Limits = LIMITS) -> None:
        self.bench = Bench(limits)
        self.sequence: dict[int, int] = {}
        self.slowest = 0.0
        self._expected = 0
        self.bench.say(VICTIM_CREATE, VICTIM)
        for create in (*entities(2, topic="v"), *reader_entities(3, topic="w")):
            self.bench.say(message(create, stream=0), VICTIM)
        self.bench.say(message(ReadData(7, 0x36, 1, delivery=FOREVER), stream=0), VICTIM)
        self.connect()

    def connect(self) -> None:
        """Let the attacker begin (again), with one object of each kind."""
        self.sequence = {}
        self.bench.say(captured.CREATE_CLIENT)
        for create in (*entities(), *reader_entities(), *services()):
            self.bench.say(message(create, stream=0))

    def say(self, *submessages: Submessage, stream: int = 0x80, little: bool = True) -> list[Submessage]:
        """Send one message of the attacker, next in its stream; return the answers."""
        return self.send(join(self.next(stream), [encode(s, little) for s in submessages]))

    def next(self, stream: int) -> Header:
        number = self.sequence.get(stream, 0)
        self.sequence[stream] = number + 1 & 0xFFFF
        return Header(0x81, stream, number if stream else 0)

    def send(self, data: bytes, address: str = "a") -> list[Submessage]:
        began = time.process_time()
        answers = self.bench.say(data, address)
        self.slowest = max(self.slowest, time.process_time() - began)
        return [s for answer in answers for s in submessages_of(bytes.fromhex(answer))]

    def whole(self, content: bytes) -> list[Submessage]:
        """Send submessages in fragments; return the answers to the last of them."""
        answers: list[Submessage] = []
        for at in range(0, len(content), 20_000):
            chunk = content[at : at + 20_000]
            answers = self.say(Fragment(chunk, at + 20_000 >= len(content)))
        return answers

    def serve(self) -> None:
        """Both ways of the victim work, at once and in order."""
        bench = self.bench
        del bench.bridge.published[:]
        self._expected += 1
        bench.say(message(WriteData(1, 0x25, int32_body(self._expected)), stream=0), VICTIM)
        assert bench.bridge.published == [
            ("/v [std_msgs/msg/Int32]", b"\0\1\0\0" + int32_body(self._expected))
        ]
        bench.bridge.source("/w [std_msgs/msg/Int32]").put(sample(self._expected))
        del bench.transport.sent[:]
        bench.agent.take()
        to_victim = [data for address, data in bench.transport.sent if address == VICTIM]
        found = [s for data in to_victim for s in submessages_of(data)]
        assert [s.data for s in found if isinstance(s, Data)] == [int32_body(self._expected)]

    def source(self) -> FakeSource:
        """Return the attacker's subscription."""
        return next(s for s in self.bench.bridge.sources if s.label.startswith("/a "))

    def unharmed(self) -> None:
        counters = self.bench.log.counters
        assert not [k for k in counters if k.startswith("internal_")], self.bench.text.getvalue()
        assert self.slowest < SLOWEST_S
        self.bounded()
        self.serve()

    def bounded(self) -> None:
        """Count what the agent holds."""
        limits, agent = self.bench.agent._limits, self.bench.agent
        assert len(agent.clients) <= limits.clients
        for client in agent.clients:
            session = client.session
            assert len(client.objects) <= limits.objects
            assert len(client.objects._gone_with_container) <= 0x1000 * 16
            assert len(client.readings) <= limits.objects
            assert len(client.ready) == 0
            assert all(len(e.outstanding) <= limits.requests for e in client.objects)
            assert len(session._reliable_in) <= limits.streams
            assert len(session._best_effort_in) <= limits.streams
            assert len(session._outputs) <= 2 * limits.streams + 2
            for stream in session._reliable_in.values():
                assert stream._held_bytes == sum(map(len, stream._held.values()))
                assert stream._held_bytes <= limits.message_bytes + 70_000
            for gathered in session._reassembly.values():
                assert len(gathered._received) <= limits.message_bytes


def submessages_of(data: bytes) -> list[Submessage]:
    return [decode(i, flags, data, at, end) for i, flags, at, end in split(data, header_size(data))]


@pytest.fixture
def stage() -> Iterator[Stage]:
    stage = Stage()
    yield stage
    stage.unharmed()
    stage.bench.agent.close()
    assert stage.bench.bridge.graph == []


def statuses(answers: list[Submessage]) -> list[int]:
    return [a.status for a in answers if isinstance(a, StatusReply)]


# Wrong orders


def test_everything_before_the_session(stage: Stage) -> None:
    for submessage in (
        entities()[0],
        Delete(1, 0x11),
        ReadData(1, 0x16, 0x80, delivery=FOREVER),
        WriteData(1, 0x15, b"1234"),
        Acknack(0, 0xFFFF, 0x80),
        Heartbeat(0, 5, 0x80),
        Reset(),
        Fragment(b"1234", True),
        Timestamp((1, 2)),
    ):
        for session, key in ((0x81, b""), (0x05, b"\1\2\3\4"), (0x80, b""), (0, b"\1\2\3\4")):
            assert stage.send(join(Header(session, 0x80, 0, key), [encode(submessage)]), "nobody") == []
    assert stage.bench.log.counters["no_session"] == 36


def test_children_before_parents_and_parents_deleted_first(stage: Stage) -> None:
    stage.say(Delete(1, 0x11))
    before = stage.bench.bridge.graph.copy()
    for create in reversed((*entities(4), *reader_entities(5))):
        if create.kind != 1:
            assert statuses(stage.say(create, stream=0)) == [0x84]
    assert stage.bench.bridge.graph == before


@pytest.mark.parametrize("object_id", [0x25, 0x36, 0x32, 0x21])
def test_objects_of_others_are_not_there(stage: Stage, object_id: int) -> None:
    """Ids are a client's own: the victim's, taken by the attacker, name nothing."""
    assert statuses(stage.say(ReadData(1, object_id, 0x80, delivery=FOREVER))) == [0x84]
    assert statuses(stage.say(Delete(1, object_id), stream=0)) == [0x84]
    (info,) = stage.say(GetInfo(1, object_id, 3), stream=0)
    assert isinstance(info, Info)
    assert info.status == 0x84
    assert stage.say(WriteData(1, object_id, b"1234"), stream=0) == []
    assert stage.bench.log.counters["unknown_writer"] == 1


# Deletes while it reads


@pytest.mark.parametrize("object_id", [0x16, 0x14, 0x12, 0x11])
def test_what_is_read_is_deleted(stage: Stage, object_id: int) -> None:
    stage.say(ReadData(1, 0x16, 0x80, delivery=DeliveryControl(0xFFFF, 0, 1, 1)))
    source = stage.source()
    source.put(*map(sample, range(300)))
    stage.bench.agent.take()
    stage.say(Delete(2, object_id))
    for number in range(40):
        stage.bench.wait(0.2)
        stage.say(Acknack(number, 0, 0x80), stream=0)
    assert stage.bench.agent.due() is not None


def test_one_message_that_creates_reads_and_deletes(stage: Stage) -> None:
    for _ in range(50):
        stage.connect()
        stage.say(
            *reader_entities(4, topic="x"),
            ReadData(1, 0x46, 0x81, delivery=DeliveryControl(0xFFFF, 0, 0xFFFF, 0xFFFF)),
            Delete(2, 0x41),
            ReadData(3, 0x46, 0x80),
            Delete(4, 0xFFFE),
            ReadData(5, 0x16, 0x80),
        )
        assert stage.bench.agent.clients.at("a") is None


# Numbers that lie


@pytest.mark.parametrize("form", [DATA_SEQ, SAMPLE_SEQ, PACKED])
@pytest.mark.parametrize("count", [0x7FFFFFFF, 0xFFFFFFFF, 1_000_000, 3])
def test_counts_beyond_what_is_there(stage: Stage, form: int, count: int) -> None:
    head = b"\0\0" if form == PACKED else b""
    body = head + bytes(-len(head) % 4) + count.to_bytes(4, "little") + b"12345678901"
    before = len(stage.bench.bridge.published)
    stage.say(WriteData(1, 0x15, body, form))
    assert len(stage.bench.bridge.published) == before
    assert sum(stage.bench.log.counters.values()) == 1


def test_a_sequence_of_very_many_samples(stage: Stage) -> None:
    """65,000 samples of a byte in one message would keep all others waiting."""
    body = (45_000).to_bytes(4, "little") + bytes(45_000)
    before = len(stage.bench.bridge.published)
    stage.whole(bytes((7, 1 | DATA_SEQ, 0, 0)) + b"\0\1\0\x15" + body)
    assert stage.bench.log.counters["data_sequence"] == 1
    empty = MOST_ELEMENTS + 1
    stage.whole(
        bytes((7, 1 | DATA_SEQ, 0, 0)) + b"\0\1\0\x15" + empty.to_bytes(4, "little") + bytes(4 * empty)
    )
    assert len(stage.bench.bridge.published) == before


@pytest.mark.parametrize(
    "submessage",
    [Delete(1, 0x555), GetInfo(1, 0x15, 3), entities()[3], Timestamp((1, 2)), ReadData(1, 0x16, 0x80)],
    ids=lambda submessage: submessage.ID.name,
)
def test_very_many_requests_in_one_message(stage: Stage, submessage: Submessage) -> None:
    padded = encode(submessage) + bytes(-len(encode(submessage)) % 4)
    assert statuses(stage.whole(padded * (MOST_REQUESTS + 1))) == []
    assert stage.bench.log.counters["too_many_requests"] == 1
    stage.whole(padded * MOST_REQUESTS)
    assert stage.bench.log.counters["too_many_requests"] == 1


def test_very_many_samples_in_one_message_are_taken(stage: Stage) -> None:
    """Only requests are counted: a message of 50,000 bytes may be full of small samples."""
    before = len(stage.bench.bridge.published)
    stage.whole(encode(WriteData(1, 0x15, int32_body(1))) * 4_000)
    assert len(stage.bench.bridge.published) == before + 4_000


def test_a_representation_as_large_as_a_message() -> None:
    """Its INFO would be larger than a submessage can be."""
    stage = Stage(Limits())
    text = captured.PARTICIPANT_XML
    for size in (LARGEST_REPRESENTATION, 65_518, 65_519):
        stage.connect()
        stage.say(Delete(1, 0x21))
        content = encode(Create(1, 0x21, 1, Format.XML, text.ljust(size - 1).encode(), 0, 0, True, True))
        stage.whole(content)
        stage.say(GetInfo(1, 0x21, 3))
    stage.unharmed()


@pytest.mark.parametrize(
    "control",
    [
        DeliveryControl(0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF),
        DeliveryControl(0xFFFF, 0xFFFF, 1, 0),
        DeliveryControl(0, 0, 0, 0),
        DeliveryControl(0xFFFE, 1, 0, 0xFFFF),
    ],
)
@pytest.mark.parametrize("form", [0, DATA_SEQ, PACKED])
def test_delivery_control_at_its_ends(stage: Stage, control: DeliveryControl, form: int) -> None:
    for request in range(400):  # each replaces the one before, which has a moment noted
        stage.say(ReadData(request, 0x16, 0x80, form, delivery=control), stream=0)
        source = stage.source()
        source.put(sample(request))
        stage.bench.agent.take()
    assert len(stage.bench.agent._deliveries._later) <= 2 * 256
    stage.bench.wait(3)


# Streams


def test_a_sequence_is_replayed(stage: Stage) -> None:
    """What was taken once is not taken again, on either kind of stream, until the numbers are far ahead."""
    writes = [
        message(WriteData(1, 0x15, int32_body(i)), stream=s, sequence=i) for s in (1, 0x80) for i in range(9)
    ]
    before = len(stage.bench.bridge.published)
    for data in writes * 20:
        stage.send(data)
    assert len(stage.bench.bridge.published) == before + len(writes)


def test_fragments_that_overlap_never_end_or_nest(stage: Stage) -> None:
    chance = random.Random(4)
    for _ in range(2_000):
        inner = chance.choice(
            (
                b"",
                bytes(1_000),
                encode(Fragment(bytes(40), True)) * 10,
                encode(entities()[0]),
                b"\x07\1\xff\xff1234",
            )
        )
        number = chance.choice((stage.sequence.get(0x80, 0), chance.randrange(16), chance.randrange(0x10000)))
        header = Header(0x81, chance.choice((0x80, 0x80, 0x81, 0, 1)), number)
        stage.send(join(header, [encode(Fragment(inner, chance.random() < 0.1))]))
        if number == stage.sequence.get(0x80, 0):
            stage.next(0x80)
        stage.bounded()


def test_gaps_that_never_close(stage: Stage) -> None:
    for stream in range(0x80, 0x100):
        for sequence in range(1, 40):
            stage.send(join(Header(0x81, stream, sequence), [encode(WriteData(1, 0x15, bytes(6_000)))]))
    assert stage.bench.log.counters["too_many_streams"] > 0
    stage.bounded()


def test_heartbeats_and_acknacks_from_nowhere(stage: Stage) -> None:
    chance = random.Random(7)
    stage.say(ReadData(1, 0x16, 0x80, delivery=FOREVER))
    source = stage.source()
    for number in range(3_000):
        first, last = chance.randrange(0x10000), chance.randrange(0x10000)
        stream = chance.choice((0, 1, 0x7F, 0x80, 0x81, 0xFF))
        stage.say(
            chance.choice((Heartbeat(first, last, stream), Acknack(first % 20, last, stream), Reset())),
            stream=0,
        )
        if number % 10 == 0:
            source.put(sample(number))
            stage.bench.agent.take()
        stage.bench.now += 0.01


# Sessions


def test_storms_of_clients(stage: Stage) -> None:
    """As many as there is room for; no more, and those that are there stay."""
    for number in range(3_000):
        key = (number % 500 + 0x1000).to_bytes(4, "big")
        head = Header(0x80, 0, 0)
        hello = CreateClient(key, 0x81 + number % 3, 512)
        stage.send(join(head, [encode(hello)]), f"storm {number % 50}")
        stage.bench.now += 0.001
    assert stage.bench.log.counters["client_resources"] > 0
    assert len(stage.bench.agent.clients) == LIMITS.clients


def test_storms_of_objects(stage: Stage) -> None:
    """RESOURCES beyond the limit; what was made before can be deleted, and then there is room again."""
    answers = [s for n in range(4, 200) for s in statuses(stage.say(*entities(n, topic=f"t{n}"), stream=0))]
    assert 0 in answers
    assert 0x87 in answers
    stage.bounded()
    for number in range(200):
        stage.say(Delete(1, number << 4 | 1), stream=0)
    assert statuses(stage.say(entities(7)[0], stream=0)) == [0]


def test_replacing_all_the_time(stage: Stage) -> None:
    """As fast as it may: see `Limits.operations_per_second`."""
    for number in range(300):
        stage.bench.now += 0.1
        name = participant_blob(f"n{number}")
        stage.say(Create(1, 0x11, 1, Format.BINARY, name, 0, 0, True, True), stream=0)
        for create in (*entities()[1:], *reader_entities()[1:]):
            stage.say(create, stream=0)
    assert stage.bench.bridge.graph.count("0:/n299") == 1
    assert len(stage.bench.bridge.graph) < 12


def test_hijacking(stage: Stage) -> None:
    """Without authentication a key is enough (howto/agent.md); but its owner can take it back, and both are named."""
    keyed = captured.CREATE_CLIENT_KEYED.replace("a1 b2 c3 d4", "00 00 00 88")
    stage.bench.say(keyed, "owner")
    key = b"\0\0\0\x88"
    for number in range(20):
        stage.bench.now += 2
        stage.send(
            join(Header(1, 0, 0, key), [encode(GetInfo(1, 0x15, 1))]), "thief" if number % 2 else "owner"
        )
    assert stage.bench.text.getvalue().count("two clients use the key 00000088") == 1
    stage.send(join(Header(1, 0, 0, key), [encode(Delete(1, 0xFFFE))]), "thief")
    assert stage.bench.say(keyed, "owner")[0].endswith("0f 00")


def test_guessing_session_ids_from_elsewhere(stage: Stage) -> None:
    """A session without a key in its header belongs to its address: nobody else reaches it."""
    before = len(stage.bench.bridge.published)
    for session in range(0x80, 0x100):
        for submessage in (WriteData(1, 0x25, b"1234"), Delete(1, 0x25), Delete(1, 0xFFFE), Reset()):
            stage.send(join(Header(session, 0, 0), [encode(submessage)]), "elsewhere")
    assert len(stage.bench.bridge.published) == before
    assert stage.bench.agent.clients.at(VICTIM) is not None


def test_a_port_reused_by_another_client_is_no_conflict(stage: Stage) -> None:
    """Systems give a port to one after another; only who goes on in the session had the key."""
    crashed = captured.CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 00 99")
    stage.bench.say(crashed, "port 1")
    stage.bench.now += 1
    stage.bench.say(crashed, "port 2")
    stage.bench.now += 3
    stage.bench.say(captured.PING, "port 1")
    stage.bench.say(captured.CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 00 98"), "port 1")
    assert "two clients use the key" not in stage.bench.text.getvalue()


# Memory


def mischief(stage: Stage, chance: random.Random) -> Callable[[], object]:
    """Return one thing done wrong."""
    any_id = chance.choice((0x11, 0x12, 0x13, 0x15, 0x16, 0x17, 0x18, 0x21, 0x25, 0xFFFE, 0x7FF1))
    stream = chance.choice((0, 1, 2, 0x80, 0x81, 0x90))
    flags = chance.random() < 0.5, chance.random() < 0.5
    form = chance.choice((0, 2, 8, 10, 14))
    number = chance.randrange(0x1000)
    kind = chance.choice((2, 3, 4, 5, 6, 7, 8))
    topic = topic_blob(f"rt/t{number}", dds_type("std_msgs/msg/Int32"))
    node = participant_blob(f"n{number}")
    body = chance.choice((node, topic, b"\0\0", writer_blob(0x12, 3, 5)))
    wrong: tuple[Submessage, ...] = (
        Create(1, number << 4 | kind, kind, Format.BINARY, body, 0x11, 0, *flags),
        Create(1, 0x11, 1, Format.BINARY, node, 0, 0, *flags),
        Create(1, 0x16, 6, Format.BINARY, reader_blob(0x12, 3, 10), 0x14, 0, True, True),
        Delete(1, any_id),
        ReadData(number, any_id, stream, form, delivery=FOREVER),
        WriteData(number, any_id, chance.randbytes(chance.choice((0, 4, 30, 4_000))), form),
        Fragment(bytes(3_000), chance.random() < 0.2),
        Heartbeat(number, number + 5 & 0xFFFF, stream),
        Acknack(number & 31, number, stream),
        GetInfo(1, any_id, 3),
    )
    return lambda: stage.say(chance.choice(wrong), stream=stream, little=chance.random() < 0.9)


@pytest.mark.system
def test_memory_stays_where_it_is() -> None:
    """Many rounds of everything, with crashes and sleep between them, leave what the first rounds left."""
    stage = Stage()
    chance = random.Random(11)

    def rounds(count: int) -> int:
        for number in range(count):
            for _ in range(60):
                mischief(stage, chance)()
            if number % 3 == 0:
                for source in stage.bench.bridge.sources:
                    if source.label.startswith("/a "):
                        source.waiting.clear()
                        source.put(sample(number))
                stage.bench.agent.take()
            if number % 7 == 0:
                stage.bench.wait(6, step=0.5)
                stage.serve()
            stage.connect()
        stage.serve()
        for _ in range(3):
            stage.connect()
        del stage.bench.transport.sent[:], stage.bench.bridge.published[:]
        stage.bench.text.seek(0)
        stage.bench.text.truncate()
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        warm = rounds(20)
        assert rounds(30) - warm < 100_000
    finally:
        tracemalloc.stop()
    stage.unharmed()


# Log and faults


def test_the_log_is_bounded_and_says_so(stage: Stage) -> None:
    """A line for each refusal would fill disks, and delay the agent where nobody reads."""
    for number in range(3 * BURST):
        stage.say(ReadData(1, 0x1000 + number, 0x80), stream=0)
    refused = stage.bench.text.getvalue().count("reading from 0x")
    assert BURST <= refused < 3 * BURST


def test_a_refusal_that_is_repeated_is_counted(stage: Stage) -> None:
    for _ in range(3 * BURST):
        stage.say(Delete(1, 0x99), ReadData(1, 0x99, 0x80), stream=0)
    stage.say(ReadData(1, 0x98, 0x80), stream=0)
    lines = [line for line in stage.bench.text.getvalue().splitlines() if "reading from" in line]
    assert lines[0] == lines[1] == lines[2]
    assert lines[3] == f"{lines[0]} … repeated {3 * BURST - 3} times"
    assert "0x0098" in lines[4]


def test_lines_are_short_and_not_too_many_bytes() -> None:
    """S8: refused CREATEs with filters of 60 kB, all different, were 14.5 MB/s of log."""
    out, now = io.StringIO(), [0.0]
    log = EventLog(out, clock=lambda: now[0])
    for number in range(20_000):
        now[0] += 0.001
        for event in ("create_refused", "read_refused"):
            log.emit(Level.WARNING, event, "refused: {reason}", reason=f"{number} " + "x" * 60_000)
    assert max(map(len, out.getvalue().splitlines())) < 500
    assert len(out.getvalue()) < BYTES_AT_ONCE + 20 * BYTES_PER_SECOND + 10_000
    assert f"x… ({60_000 + len('0 ')} characters) …x" in out.getvalue().splitlines()[0]
    log.emit(Level.INFO, "stopped", "the last words are said")
    assert "the last words are said" in out.getvalue()


def test_suppressed_reports_are_counted() -> None:
    out, now = io.StringIO(), [0.0]
    log = EventLog(out, clock=lambda: now[0])
    for number in range(BURST + 7):
        log.emit(Level.INFO, "created", "{number}", number=number)
    log.emit(Level.INFO, "deleted", "other events are not meant")
    assert out.getvalue().splitlines()[BURST - 1 :] == [str(BURST - 1), "other events are not meant"]
    now[0] += 1.0
    log.emit(Level.INFO, "created", "again")
    reported = "warning: 7 events 'created' before this one were not written: too many at once"
    assert out.getvalue().splitlines()[-2:] == [reported, "again"]


@pytest.mark.parametrize("when", ["time-out", "end"])
def test_a_fault_with_one_client_is_not_the_concern_of_others(
    monkeypatch: pytest.MonkeyPatch, when: str
) -> None:
    """ROS 2 may refuse to let go of an entity: all others leave, and the agent goes on."""
    stage = Stage()
    others = [label for label in stage.bench.bridge.graph if label.startswith(("/v ", "/w "))]
    assert len(others) == 2

    def broken() -> None:
        raise RuntimeError("ROS 2 has lost its mind")

    monkeypatch.setattr(stage.source(), "destroy", broken)
    if when == "time-out":
        stage.bench.wait(6)
        stage.bench.wait(20)
        assert len(stage.bench.agent.clients) == 0
    else:
        stage.bench.agent.close()
        assert stage.bench.bridge.closed
    assert not set(others) & set(stage.bench.bridge.graph)
    assert stage.bench.log.counters["internal_RuntimeError"] > 0
