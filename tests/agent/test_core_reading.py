# SPDX-License-Identifier: Apache-2.0
"""READ_DATA and DATA: delivery control, flow control, streams, fragments, sleep (DDS-XRCE 1.0, 7.8.5 and 8.3.5.9)."""

from __future__ import annotations

from typing import Any

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData
from microros_gen.agent.wire.entity_messages import Create, Delete, Fragment, StatusReply
from tests.support.agent import captured
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import reader_blob
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import (
    FOREVER,
    LABEL,
    READER,
    Listener,
    put,
    reader_entities,
    sample,
    subscribing,
    values,
)


def test_data_as_the_public_agent_sends_it() -> None:
    """xrce-facts 5: the request id is that of READ_DATA, the body has no encapsulation header; no STATUS."""
    bench = subscribing()
    assert (
        bench.say("81 01 10 00" + captured.SUBMESSAGES["READ_DATA"].replace("80 00 00 01", "01 00 00 01"))
        == []
    )
    put(bench, 42, 43)
    assert bench.take() == [
        "81 01 04 00 09 01 08 00 00 11 00 16 2a 00 00 00",
        "81 01 05 00 09 01 08 00 00 11 00 16 2b 00 00 00",
    ]
    assert bench.take() == []
    assert bench.agent.delivered == 2


def test_a_subscription_is_reported() -> None:
    text = subscribing().text.getvalue()
    assert "subscription /a [std_msgs/msg/Int32] (reliable, volatile, keep_last 10)" in text


def test_a_big_endian_sample_says_so() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    bench.bridge.source(LABEL).put(sample(5, little=False))
    listener.take()
    assert bench.transport.sent[0][1].hex() == "81010400" + "09000800" + "00200016" + "00000005"


def test_earlier_samples_are_delivered_with_the_request() -> None:
    bench = subscribing()
    put(bench, 1, 2)
    assert Listener(bench).take() == []
    assert values(Listener(bench).read()) == [1, 2]


@pytest.mark.parametrize(
    ("control", "wanted"), [(None, [0]), (DeliveryControl(3), [0, 1, 2]), (FOREVER, [0, 1, 2, 3, 4])]
)
def test_max_samples(control: DeliveryControl | None, wanted: list[int]) -> None:
    """7.8.5.1, table 9; without delivery control it is one."""
    bench = subscribing()
    listener = Listener(bench)
    listener.read(control=control)
    put(bench, *range(5))
    assert values(listener.take()) == wanted
    assert values(listener.read()) == list(range(5))[len(wanted) :], "the rest stayed in DDS"


def test_cancel_and_replace() -> None:
    """MAX_SAMPLES_ZERO ends the running read; a new READ_DATA of the same object takes its place (8.3.5.9)."""
    bench = subscribing()
    listener = Listener(bench)
    listener.read(request=0x20)
    assert listener.read(request=0x21) == []
    put(bench, 1)
    (data,) = listener.take()
    assert isinstance(data, Data)
    assert data.request == 0x21
    assert listener.say(ReadData(0x22, READER, 0, delivery=DeliveryControl(0))) == []
    put(bench, 2)
    assert listener.take() == []
    assert values(listener.read()) == [2]


def test_max_elapsed_time() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(control=DeliveryControl(0xFFFF, max_elapsed_time=2))
    put(bench, 1)
    bench.now += 1.9
    assert values(listener.take()) == [1]
    put(bench, 2)
    bench.now += 0.1
    assert listener.take() == []
    assert values(listener.read()) == [2]


def test_max_bytes_per_second() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(control=DeliveryControl(0xFFFF, max_bytes_per_second=120))  # a DATA has 12 bytes
    put(bench, *range(100))
    received = len(values(listener.take())) + len(values(listener.pass_time(5.0)))
    assert received in (50, 51)
    received += len(values(listener.pass_time(5.0)))
    assert received == 100


def test_min_pace_period() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(control=DeliveryControl(0xFFFF, min_pace_period=250))
    put(bench, *range(10))
    assert values(listener.take()) == [0]
    start = bench.now
    times: list[float] = []
    while len(times) < 9:
        bench.transport.sent.clear()
        due = bench.agent.due()
        assert due is not None
        bench.now = max(due, bench.now)
        bench.agent.tick()
        times += [bench.now - start] * len(values(listener.answers()))
    assert times == pytest.approx([0.25 * i for i in range(1, 10)])


def test_an_unpaced_read_is_never_due() -> None:
    bench = Bench()
    assert bench.agent.due() is None
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    put(bench, 1)
    listener.take()
    due = bench.agent.due()
    assert due is not None
    assert due > bench.now, "the look at time-outs only"


def test_one_that_floods_lets_others_have_their_turn() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    put(bench, *range(1000))
    first = values(listener.take())
    assert 0 < len(first) < 1000
    assert bench.agent.due() == bench.now
    assert first + values(listener.pass_time(0.0)) == list(range(1000))


@pytest.mark.parametrize(
    ("more", "status", "reason"),
    [
        ({"content_filter": "x > 5"}, "86", "cannot filter by content: 'x > 5'"),
        ({"format": 3}, "85", "unknown data format 0x03"),
    ],
)
def test_what_cannot_be_read_is_refused(more: dict[str, Any], status: str, reason: str) -> None:
    bench = subscribing()
    (answer,) = Listener(bench).read(**more)
    assert isinstance(answer, StatusReply)
    assert f"{answer.status:02x}" == status
    assert reason in bench.text.getvalue()


@pytest.mark.parametrize("object_id", [0x11, 0x12, 0x14, 0x26, 0x17, 0x00, 0xFFFE])
def test_only_what_is_there_and_has_data_is_read(object_id: int) -> None:
    (answer,) = Listener(subscribing()).say(ReadData(1, object_id, 1, delivery=FOREVER))
    assert isinstance(answer, StatusReply)
    assert (answer.request, answer.object, answer.status) == (1, object_id, 0x84)


def test_an_empty_filter_is_no_filter() -> None:
    bench = subscribing()
    put(bench, 1)
    assert values(Listener(bench).read(content_filter="")) == [1]


@pytest.mark.parametrize(
    ("asked_on", "preferred", "used"), [(1, 0, 1), (0x80, 0, 0x80), (1, 0x83, 0x83), (0x80, 5, 5), (0, 0, 1)]
)
def test_the_stream(asked_on: int, preferred: int, used: int) -> None:
    """Table 9: the preferred stream; for STREAMID_NONE the agent chooses."""
    bench = subscribing()
    put(bench, 1)
    listener = Listener(bench)
    listener.say(ReadData(1, READER, preferred, delivery=FOREVER), stream=asked_on)
    assert [data[1] for data, s in listener.messages() if isinstance(s, Data)] == [used]


def test_more_streams_than_the_limit_are_not_opened() -> None:
    bench = subscribing(Limits(streams=2))
    listener = Listener(bench)
    used = []
    for stream in (0x80, 0x81, 0x82, 0x83):
        put(bench, 1)
        listener.read(stream=stream)
        used += [data[1] for data, s in listener.messages() if isinstance(s, Data)]
    assert used == [0x80, 0x81, 0x80, 0x80]


# Reliable


def test_only_what_the_window_holds_is_taken() -> None:
    """Flow control: what is not acknowledged yet bounds what is taken out of DDS."""
    bench = subscribing()
    listener = Listener(bench)
    listener.read(stream=0x80)
    put(bench, *range(50))
    assert values(listener.take()) == list(range(16))
    source = bench.bridge.source(LABEL)
    assert len(source.waiting) == 34
    assert listener.take() == []
    assert values(listener.acknowledge(3)) == [16, 17, 18]
    assert values(listener.acknowledge(3, missing=0b101)) == [3, 5], "sent again, and nothing new"
    assert values(listener.acknowledge(19)) == list(range(19, 35))
    assert len(source.waiting) == 15


def test_readings_that_wait_take_turns() -> None:
    bench = subscribing()
    for sequence, create in enumerate(reader_entities(2, topic="b")):
        bench.say(message(create, sequence=10 + sequence))
    listener = Listener(bench)
    listener.read(stream=0x80)
    listener.say(ReadData(0x30, 0x26, 0x80, delivery=FOREVER))
    put(bench, *range(100))
    bench.bridge.source("/b [std_msgs/msg/Int32]").put(*map(sample, range(1000, 1100)))
    listener.take()
    seen = []
    for acknowledged in range(1, 60):
        seen += values(listener.acknowledge(acknowledged))
    late = seen[20:]
    assert 0.4 < sum(v >= 1000 for v in late) / len(late) < 0.6


def test_large_samples_go_in_fragments_or_not_at_all() -> None:
    bench = subscribing()
    listener = Listener(bench)
    source = bench.bridge.source(LABEL)
    body = bytes(range(256)) * 5
    listener.read(stream=0x80)
    source.put(b"\0\1\0\0" + body)
    listener.take()
    sizes = [len(data) for _, data in bench.transport.sent]
    assert sizes[:-1] == [508, 508]
    chunks = b"".join(a.data for a in listener.answers() if isinstance(a, Fragment))
    assert chunks == bytes.fromhex("09010405 00200016") + body
    listener.read(stream=1)
    source.put(b"\0\1\0\0" + body, sample(1), b"\0\1\0\0" + body)
    assert values(listener.take()) == [1]
    assert bench.log.counters == {"sample_too_large": 2}
    assert bench.text.getvalue().count("has 1288 bytes and was dropped") == 1


def test_a_sample_beyond_64_kib() -> None:
    bench = subscribing(mtu=0xFFFF)
    listener = Listener(bench)
    listener.read(stream=0x80)
    body = bytes(100_000)
    bench.bridge.source(LABEL).put(b"\0\1\0\0" + body)
    listener.take()
    chunks = b"".join(a.data for a in listener.answers() if isinstance(a, Fragment))
    assert chunks == bytes.fromhex("09010000 00200016") + body
    bench.bridge.source(LABEL).put(b"\0\1\0\0" + bytes(300_000))
    assert listener.take() == []
    assert bench.log.counters == {"sample_too_large": 1}


def test_reset_lets_waiting_ones_go_on() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(stream=0x80)
    put(bench, *range(30))
    listener.take()
    bench.say("81 00 00 00 0c 01 00 00")
    assert values(listener.answers()) == list(range(16, 30))
    assert bench.transport.sent[0][1][2:4] == b"\0\0", "numbers begin again"


def test_numbers_wrap() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(stream=0x80)
    total = 0x10000 + 100
    source = bench.bridge.source(LABEL)
    received = 0
    for start in range(0, total, 16):
        source.put(*(sample(i) for i in range(start, min(start + 16, total))))
        received += len(values(listener.take()))
        listener.acknowledge(received & 0xFFFF)
    assert received == total


# What ends a reading, or interrupts it


@pytest.mark.parametrize("object_id", [0x16, 0x14, 0x11])
def test_with_its_reader_a_reading_ends(object_id: int) -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    source = bench.bridge.source(LABEL)
    listener.say(Delete(9, object_id))
    assert bench.bridge.sources == []
    source.put(sample(1))
    assert listener.take() == []


def test_a_replaced_reader_needs_a_new_request() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    *_, create = reader_entities()
    other = Create(20, READER, 6, Format.BINARY, reader_blob(0x12, 0, 5), 0x14, 0, False, True)
    assert create.body != other.body
    listener.say(other)
    put(bench, 1)
    assert listener.take() == []
    assert values(listener.read()) == [1]


def test_a_reading_outlives_sleep() -> None:
    bench = subscribing(Limits(client_timeout_s=2.0))
    listener = Listener(bench)
    listener.read()
    bench.wait(2.5)
    assert bench.bridge.sources == []
    bench.transport.sent.clear()
    bench.say("81 00 00 00 06 01 04 00 00 00 ff fe")
    put(bench, 7)
    assert values(listener.take()) == [7]


def test_who_connects_again_has_to_ask_again() -> None:
    """The same key and session id: entities stay, numbers restart; a restarted client is not ready for data."""
    bench = subscribing()
    listener = Listener(bench)
    listener.read(stream=0x80)
    put(bench, *range(20))
    listener.take()
    assert len(bench.say(CREATE_CLIENT)) == 1
    put(bench, 20)
    assert listener.take() == []
    listener.sequence = 0
    assert values(listener.read(stream=0x80)) == list(range(16)), (
        "what it had not acknowledged, and no more at once"
    )


def test_a_client_that_leaves_or_times_out_leaves_no_state() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(control=DeliveryControl(0xFFFF, min_pace_period=100))
    put(bench, 1, 2, 3)
    listener.take()
    bench.say("81 00 00 00 03 01 04 00 00 07 ff fe")
    assert bench.agent.due() is None
    bench.agent.tick()
    assert bench.agent._deliveries._by_source == {}


def test_a_bridge_that_fails_is_counted_and_asked_again() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read()
    source = bench.bridge.source(LABEL)
    source.failing = True
    source.put(sample(1))
    assert listener.take() == []
    assert bench.log.counters == {"take": 1}
    source.failing = False
    assert values(listener.pass_time(0.2)) == [1]


def test_a_time_based_filter_leaves_out_samples() -> None:
    """OBJK_DataReader_Binary_Qos, timebasedfilter_msec: ROS 2 has none, so the agent keeps the distance."""
    bench = subscribing(separation_ms=100)
    listener = Listener(bench)
    listener.read()
    put(bench, 1, 2)
    assert values(listener.take()) == [1]
    bench.now += 0.1
    put(bench, 3, 4)
    assert values(listener.take()) == [3]


def test_the_descriptor_is_readable_while_ros_has_something() -> None:
    import select

    bench = subscribing()
    descriptor = bench.agent.fileno()
    assert select.select([descriptor], [], [], 0)[0] == []
    put(bench, 1)
    assert select.select([descriptor], [], [], 0)[0] == [descriptor]
    bench.take()
    assert select.select([descriptor], [], [], 0)[0] == []
    bench.agent.close()


def test_a_fault_of_the_bridge_is_survived(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = subscribing()

    def broken() -> None:
        raise KeyError("broken")

    monkeypatch.setattr(bench.bridge, "ready", broken)
    assert bench.take() == []
    assert bench.log.counters == {"internal_KeyError": 1}


def test_replaced_readings_leave_no_state() -> None:
    """READ_DATA over and over, never acknowledged, or with the longest pace: nothing grows."""
    bench = subscribing(Limits(client_timeout_s=1_000.0))
    listener = Listener(bench)
    put(bench, *range(2_000))
    (client,) = bench.agent.clients
    for _ in range(500):
        listener.read(stream=0x80)
        listener.read(stream=0x81, control=DeliveryControl(0xFFFF, min_pace_period=0xFFFF))
    assert len(client.readings) == 1
    assert len(client.waiting) <= 1
    for _ in range(1_000):
        listener.read(stream=1, control=DeliveryControl(0xFFFF, min_pace_period=0xFFFF))
    assert len(bench.agent._deliveries._later) <= 300
    assert values(listener.pass_time(66.0)) != [], "the last one goes on"


def test_a_fault_with_one_source_leaves_the_others_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = subscribing()
    for sequence, create in enumerate(reader_entities(2, topic="b")):
        bench.say(message(create, sequence=10 + sequence))
    listener = Listener(bench)
    source, other = bench.bridge.sources

    def broken() -> None:
        raise KeyError("broken")

    monkeypatch.setattr(source, "take", broken)
    listener.read()
    listener.say(ReadData(0x30, 0x26, 1, delivery=FOREVER))
    source.put(sample(1))
    other.put(sample(2))
    assert values(listener.take()) == [2]
    assert set(bench.log.counters) == {"internal_KeyError"}


def test_an_acknowledgement_counts_like_every_message() -> None:
    bench = subscribing()
    listener = Listener(bench)
    listener.read(0x80)
    (client,) = bench.agent.clients
    put(bench, *range(20))
    assert values(listener.take()) == list(range(16))
    before = client.received, client.received_bytes, client.account.messages
    assert values(listener.acknowledge(2)) == [16, 17]
    assert (client.received, client.received_bytes, client.account.messages) == (
        before[0] + 1,
        before[1] + 13,
        before[2] + 1,
    )
    assert client.last_received == bench.now
    client.messages_per_second = client.account.messages
    assert listener.acknowledge(4) == []
    assert "too_many_messages" in bench.log.counters
    bench.wait(1.1)
    assert values(listener.acknowledge(4)) == [18, 19]
