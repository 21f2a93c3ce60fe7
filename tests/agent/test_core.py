# SPDX-License-Identifier: Apache-2.0
"""The agent as a client sees it, byte for byte; dialogues are those recorded with the public agent."""

from __future__ import annotations

import itertools
import json
import time

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Create, Fragment, Heartbeat, Reset
from microros_gen.agent.wire.message import split
from microros_gen.agent.wire.submessages import Submessage, encode
from tests.support.agent import captured
from tests.support.agent.captured import CREATE_CLIENT, PING, PONG_OUTSIDE, STATUS_AGENT
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import GRAPH, WRITE, connected, entities, message, publishing
from tests.support.agent.fakes import Bench

PONG_INSIDE = PONG_OUTSIDE.replace("ff fd 00 00", "ff fd 00 01")


def same(answer: str) -> str:
    return bytes.fromhex(answer).hex(" ")


# Session


def test_create_client() -> None:
    bench = Bench()
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]
    assert bench.say(captured.CREATE_CLIENT_KEYED, "b") == [captured.STATUS_AGENT_KEYED]


@pytest.mark.parametrize(
    ("before", "after", "status"),
    [
        ("a1 b2 c3 d4", "00 00 00 00", "85"),
        ("58 52 43 45", "58 52 43 46", "85"),
        ("45 01 00", "45 02 00", "86"),
        ("45 01 00", "45 01 09", "00"),  # the minor version does not matter
        ("01 0f a1", "ff ff a1", "00"),  # nor does the vendor
        ("fc 01", "10 00", "85"),  # no STATUS fits
        ("d4 81", "d4 80", "85"),
    ],
)
def test_create_client_is_checked(before: str, after: str, status: str) -> None:
    bench = Bench()
    (answer,) = bench.say(CREATE_CLIENT.replace(before, after))
    assert answer[3 * 8 : 3 * 8 + 2] == status
    assert len(bench.agent.clients) == (status == "00")


def test_create_client_in_big_endian() -> None:
    big = CREATE_CLIENT.replace("00 01 10 00", "00 00 10 00").replace("fc 01", "01 fc")
    bench = Bench()
    assert bench.say(big) == [STATUS_AGENT]
    assert "MTU 508" in bench.text.getvalue()


def test_create_client_without_mtu_gets_no_answer() -> None:
    short = bytes.fromhex(CREATE_CLIENT.replace("01 10 00", "01 0e 00"))[:-2]
    assert Bench().say(short) == []


def test_ping_outside_and_inside_of_a_session() -> None:
    bench = Bench()
    assert bench.say(PING) == [PONG_OUTSIDE]
    assert bench.say(PING.replace("80", "81", 1)) == [PONG_OUTSIDE.replace("80", "81", 1)]
    assert bench.say("81 80 03 00" + PING[11:]) == ["81 80 03 00" + PONG_OUTSIDE[11:]]
    bench.say(CREATE_CLIENT)
    assert bench.say(PING) == [PONG_INSIDE]
    assert bench.say(PING.replace("80", "81", 1)) == [PONG_INSIDE.replace("80", "81", 1)]
    assert bench.say(PING.replace("80", "81", 1), "b") == [PONG_OUTSIDE.replace("80", "81", 1)]


def test_ping_with_the_key_in_the_header() -> None:
    bench = Bench()
    ask = "00 00 00 00 a1 b2 c3 d4" + PING[11:]
    assert bench.say(ask) == ["00 00 00 00 a1 b2 c3 d4" + PONG_OUTSIDE[11:]]
    bench.say(captured.CREATE_CLIENT_KEYED)
    assert bench.say(ask) == ["00 00 00 00 a1 b2 c3 d4" + PONG_INSIDE[11:]]
    assert bench.say("01" + ask[2:]) == ["01 00 00 00 a1 b2 c3 d4" + PONG_INSIDE[11:]]


@pytest.mark.parametrize(
    "submessage",
    [
        "81 01 00 00" + WRITE,
        "81 80 00 00" + WRITE,
        "81 00 00 00 0b 01 05 00 00 00 00 00 80",
        "81 00 00 00 03 01 04 00 00 07 00 12",
        "82 00 00 00 0c 01 00 00",
    ],
)
def test_without_a_session_there_is_no_answer(submessage: str) -> None:
    bench = Bench()
    assert bench.say(submessage) == []
    assert bench.log.counters["no_session"] == 1


def test_delete_client() -> None:
    bench = publishing()
    delete = "81 00 00 00 03 01 04 00 00 07 ff fe"
    answer = "81 00 00 00 05 01 06 00 00 07 ff fe 00 00"
    assert bench.say(delete) == [answer]
    assert bench.bridge.graph == []
    assert bench.say(delete) == [answer], "an unknown client gets OK too"
    assert bench.say(PING) == [PONG_OUTSIDE]


def test_the_same_client_again_keeps_its_entities() -> None:
    bench = publishing()
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]
    assert bench.bridge.graph == GRAPH
    answers = [bench.say(message(c, sequence=i)) for i, c in enumerate(entities())]
    assert [a[0][-5:] for a in answers] == ["01 00"] * 4
    assert [a[0][6:8] for a in answers] == ["00", "01", "02", "03"], "streams begin again"
    refused = [bench.say(message(c, sequence=4 + i)) for i, c in enumerate(entities(mode=""))]
    assert [a[0][-5:] for a in refused] == ["82 00"] * 4


def test_another_session_id_drops_the_entities() -> None:
    bench = publishing()
    other = CREATE_CLIENT.replace("d4 81", "d4 82")
    assert bench.say(other) == [STATUS_AGENT.replace("81", "82", 1)]
    assert bench.bridge.graph == []
    assert len(bench.agent.clients) == 1


def test_from_another_port_the_session_moves() -> None:
    bench = publishing()
    assert bench.say(CREATE_CLIENT, "b") == [STATUS_AGENT]
    assert bench.bridge.graph == GRAPH
    assert bench.say("81 01 00 00" + WRITE, "b") == []
    assert bench.say("81 01 01 00" + WRITE, "a") == []
    assert len(bench.bridge.published) == 1, "the old port is ignored"
    assert "moved from a to b" in bench.text.getvalue()


def test_with_the_key_in_the_header_any_port_will_do() -> None:
    bench = Bench()
    bench.say(captured.CREATE_CLIENT_KEYED)
    answer = bench.say("01 00 00 00 a1 b2 c3 d4" + PING[11:], "b")
    assert answer == ["01 00 00 00 a1 b2 c3 d4" + PONG_INSIDE[11:]]


def test_another_client_at_the_same_address_replaces_the_first() -> None:
    bench = publishing()
    bench.say(CREATE_CLIENT.replace("a1 b2", "a1 b3"))
    assert bench.bridge.graph == []
    assert len(bench.agent.clients) == 1


def test_several_clients_have_objects_of_their_own() -> None:
    bench = publishing()
    bench.say(CREATE_CLIENT.replace("a1 b2", "a1 b3"), "b")
    for sequence, create in enumerate(entities(topic="b")):
        bench.say(message(create, sequence=sequence), "b")
    bench.say("81 01 04 00" + WRITE, "a")
    bench.say("81 01 04 00" + WRITE, "b")
    assert [topic for topic, _ in bench.bridge.published] == [
        "/a [std_msgs/msg/Int32]",
        "/b [std_msgs/msg/Int32]",
    ]


# Objects: the statuses and streams of the public agent


@pytest.mark.parametrize(
    ("stream", "answer_stream"), [(0x00, "01"), (0x01, "01"), (0x80, "80"), (0x83, "80")]
)
def test_status_uses_the_same_kind_of_stream(stream: int, answer_stream: str) -> None:
    bench = connected()
    answers = bench.say(message(entities()[0], stream=stream))
    assert answers[-1] == f"81 {answer_stream} 00 00 05 01 06 00 00 0a 00 11 00 00"
    if stream >= 0x80:
        assert answers[:-1] == [f"81 00 00 00 0a 01 05 00 01 00 00 00 {stream:02x}"]


def test_a_recorded_dialogue() -> None:
    """Statuses that the public agent gave for these creation modes, in XML on a best-effort stream."""
    bench = connected()
    bodies = {
        1: (captured.PARTICIPANT_XML, 0),
        2: (captured.TOPIC_XML, 0x11),
        3: ("", 0x11),
        5: (captured.WRITER_XML, 0x13),
    }
    sequence = 0
    for kind, (text, parent) in bodies.items():
        for flags, status in ((0, "00"), (6, "01"), (2, "01"), (0, "82")) + (
            ((4, "00"),) if kind == 5 else ()
        ):
            create = Create(
                sequence + 1,
                0x10 | kind,
                kind,
                Format.XML,
                text.encode(),
                parent,
                0,
                bool(flags & 2),
                bool(flags & 4),
            )
            wanted = f"81 01 {sequence:02x} 00 05 01 06 00 00 {sequence + 1:02x} 00 1{kind} {status} 00"
            assert bench.say(message(create, sequence=sequence)) == [wanted]
            sequence += 1


@pytest.mark.parametrize(
    ("submessage", "kind"),
    [
        ("01 07 08 00 00 0a 00 1d 0d 03 00 00", "truncated"),
        ("01 07 0c 00 00 0a 00 1d 0d 03 00 00 00 00 00 00", "object_kind"),
        ("01 07 0c 00 00 0a 00 1d 09 02 00 00 00 00 00 00", "object_kind"),
        ("01 07 06 00 00 0a 00 1d 01 07", "representation"),
        ("08 01 05 00 00 0a 00 1d 01", "truncated"),
        ("08 01 08 00 00 0a 00 1d 01 00 02 00", "boolean"),
    ],
)
def test_a_request_that_cannot_be_read_is_answered(submessage: str, kind: str) -> None:
    """Table 2: STATUS_ERR_INVALID_DATA; whoever created or read something waits for a STATUS."""
    bench = publishing()
    assert bench.say("81 01 04 00" + submessage) == ["81 01 04 00 05 01 06 00 00 0a 00 1d 85 00"]
    assert bench.log.counters == {kind: 1}


def test_delete_of_objects() -> None:
    bench = publishing()
    assert bench.say("81 01 04 00 03 01 04 00 00 20 00 15") == ["81 01 04 00 05 01 06 00 00 20 00 15 00 00"]
    assert bench.say("81 01 05 00 03 01 04 00 00 21 00 15") == ["81 01 05 00 05 01 06 00 00 21 00 15 84 00"]


def test_reading_what_is_not_there_is_refused_aloud() -> None:
    bench = publishing()
    assert bench.say("81 80 00 00" + captured.SUBMESSAGES["READ_DATA"]) == [
        "81 00 00 00 0a 01 05 00 01 00 00 00 80",  # first: see acknowledge
        "81 80 00 00 05 01 06 00 00 11 00 16 84 00",
    ]
    assert "reading from 0x0016 refused (UNKNOWN_REFERENCE)" in bench.text.getvalue()


# Samples


def test_a_sample_goes_to_ros_as_it_is() -> None:
    bench = publishing()
    assert bench.say("81 01 04 00" + WRITE) == [], "no STATUS for samples"
    assert bench.bridge.published == [(GRAPH[1], bytes.fromhex("00 01 00 00 2a 00 00 00"))]


def test_a_big_endian_sample_says_so() -> None:
    bench = publishing()
    bench.say("81 01 04 00 07 00 08 00 00 05 00 15 00 00 00 2a")
    assert bench.bridge.published == [(GRAPH[1], bytes.fromhex("00 00 00 00 00 00 00 2a"))]


def test_several_samples_in_one_message() -> None:
    bench = publishing()
    bench.say(message(*(WriteData(1, 0x15, bytes([i])) for i in range(5)), sequence=4))
    assert [data[4:] for _, data in bench.bridge.published] == [bytes([i]) for i in range(5)]
    assert bench.agent.samples == 5


@pytest.mark.parametrize(
    ("submessage", "kind"),
    [
        ("07 01 08 00 00 05 00 25 2a 00 00 00", "unknown_writer"),
        ("07 01 08 00 00 05 00 13 2a 00 00 00", "unknown_writer"),
        ("07 05 08 00 00 05 00 15 2a 00 00 00", "data_format"),
        ("07 01 02 00 00 05", "truncated"),
    ],
)
def test_samples_without_a_reader_are_counted(submessage: str, kind: str) -> None:
    bench = publishing()
    assert bench.say("81 01 04 00" + submessage) == []
    assert bench.bridge.published == []
    assert bench.log.counters == {kind: 1}


def test_fragments_are_joined() -> None:
    bench = publishing()
    body = bytes(range(256)) * 5
    whole = encode(WriteData(1, 0x15, body))
    chunks = [whole[:500], whole[500:1000], whole[1000:]]
    for i, chunk in enumerate(chunks):
        fragment = Fragment(chunk, i == 2)
        answer = f"81 00 00 00 0a 01 05 00 {i + 1:02x} 00 00 00 80"
        assert bench.say(message(fragment, stream=0x80, sequence=i)) == [answer]
    assert bench.bridge.published == [(GRAPH[1], b"\0\1\0\0" + body)]


def test_more_than_65535_bytes_have_length_zero() -> None:
    bench = publishing(Limits(message_bytes=100_000))
    body = bytes(70_000)
    whole = bytes.fromhex("07 01 00 00 00 01 00 15") + body
    for i, at in enumerate(range(0, len(whole), 10_000)):
        last = at + 10_000 >= len(whole)
        bench.say(message(Fragment(whole[at : at + 10_000], last), stream=0x80, sequence=i))
    assert [len(data) for _, data in bench.bridge.published] == [70_004]


@pytest.mark.parametrize(
    ("submessage", "stream", "kind"),
    [
        (Fragment(b"x", True), 1, "fragment_stream"),
        (Fragment(encode(Fragment(b"x", True)), True), 0x80, "nested_fragment"),
        (Fragment(bytes(300_000 - 240_000), False), 0x80, "fragments_too_large"),
        (Heartbeat(0, 1, 1), 0, "heartbeat_stream"),
    ],
)
def test_misused_streams_are_counted(submessage: Submessage, stream: int, kind: str) -> None:
    bench = publishing(Limits(message_bytes=50_000))
    bench.say(message(submessage, stream=stream, sequence=9 if stream == 1 else 0))
    assert bench.log.counters == {kind: 1}


def test_reliable_samples_out_of_order_are_put_in_order() -> None:
    bench = publishing()
    sample = [message(WriteData(1, 0x15, int32_body(i)), stream=0x80, sequence=i) for i in range(4)]
    assert bench.say(sample[0]) == ["81 00 00 00 0a 01 05 00 01 00 00 00 80"]
    assert bench.say(sample[3]) == ["81 00 00 00 0a 01 05 00 01 00 00 03 80"]
    assert bench.say(sample[2]) == ["81 00 00 00 0a 01 05 00 01 00 00 01 80"]
    assert bench.say(sample[1]) == ["81 00 00 00 0a 01 05 00 04 00 00 00 80"]
    assert bench.say(sample[1]) == ["81 00 00 00 0a 01 05 00 04 00 00 00 80"]
    assert [data[4] for _, data in bench.bridge.published] == [0, 1, 2, 3]


def test_a_malformed_message_does_not_take_its_successors_along() -> None:
    bench = publishing()
    good = [message(WriteData(1, 0x15, b"1234"), stream=0x80, sequence=n) for n in (0, 2)]
    bad = bytes.fromhex("81 80 01 00 07 01 02 00 00 01")
    bench.say(good[1])
    bench.say(bad)
    bench.say(good[0])
    assert len(bench.bridge.published) == 2
    assert sum(bench.log.counters.values()) == 1


def test_a_truncated_message_is_not_received() -> None:
    """On a reliable stream it is not acknowledged, whatever is left of it, and comes again."""
    bench = publishing()
    whole = message(WriteData(1, 0x15, b"1234"), stream=0x80, sequence=0)
    for size in range(4, len(whole)):
        assert bench.say(whole[:size]) == []
    assert bench.bridge.published == []
    assert bench.log.counters == {"cut_message": len(whole) - 4}
    assert bench.say(whole) == ["81 00 00 00 0a 01 05 00 01 00 00 00 80"]
    assert len(bench.bridge.published) == 1


def test_a_heartbeat_is_answered_and_skips_a_gap() -> None:
    bench = publishing()
    late = message(WriteData(1, 0x15, b"1234"), stream=0x80, sequence=5)
    bench.say(late)
    assert bench.say("81 00 00 00 0b 01 05 00 05 00 05 00 80") == ["81 00 00 00 0a 01 05 00 06 00 00 00 80"]
    assert len(bench.bridge.published) == 1
    assert bench.say("81 00 00 00 0b 01 05 00 07 00 06 00 80") == ["81 00 00 00 0a 01 05 00 07 00 00 00 80"]


def test_reset_begins_again_without_an_answer() -> None:
    bench = publishing()
    assert bench.say("81 00 00 00 0c 01 00 00") == []
    assert bench.say("81 01 00 00" + WRITE) == []
    assert len(bench.bridge.published) == 1


def test_timestamp() -> None:
    bench = connected()
    (answer,) = bench.say("81 00 00 00 0e 01 08 00 01 02 03 04 05 06 07 08")
    assert answer.startswith("81 00 00 00 0f 01 18 00")
    assert answer.endswith("01 02 03 04 05 06 07 08")
    raw = bytes.fromhex(answer.replace(" ", ""))
    sent, received = (
        int.from_bytes(raw[at : at + 4], "little") * 10**9 + int.from_bytes(raw[at + 4 : at + 8], "little")
        for at in (8, 16)
    )
    assert received <= sent < received + 10**9
    assert int.from_bytes(raw[8:12], "little") > 1_600_000_000


@pytest.mark.parametrize("year_2038", [0x7FFF_FFFF, 0x8000_0000, 0xFFFF_FFFF, 0x1_0000_0000])
def test_timestamps_after_2038_go_on_modulo_2_32(monkeypatch: pytest.MonkeyPatch, year_2038: int) -> None:
    bench = connected()
    monkeypatch.setattr(time, "time_ns", lambda: year_2038 * 10**9 + 5)
    (answer,) = bench.say("81 00 00 00 0e 01 08 00 ff ff ff ff 05 06 07 08")
    wire_time = (year_2038 & 0xFFFF_FFFF).to_bytes(4, "little") + bytes((5, 0, 0, 0))
    assert bytes.fromhex(answer)[8:] == wire_time * 2 + bytes.fromhex("ff ff ff ff 05 06 07 08")
    assert not bench.log.counters


# The agent's own reliable stream


def test_answers_are_announced_and_repeated_until_acknowledged() -> None:
    bench = connected()
    bench.say(message(entities()[0], stream=0x80))
    beat = "81 00 00 00 0b 01 05 00 00 00 00 00 80"
    assert bench.wait(0.5) == [beat, beat]
    status = "81 80 00 00 05 01 06 00 00 0a 00 11 00 00"
    assert bench.say("81 00 00 00 0a 01 05 00 00 00 00 01 80") == [status]
    assert bench.say("81 00 00 00 0a 01 05 00 01 00 00 00 80") == []
    assert bench.wait(0.5) == []


def test_a_client_that_never_acknowledges_does_not_fill_the_memory() -> None:
    bench = connected(Limits(backlog_bytes=100))
    for i in range(100):
        bench.say(message(entities()[0], stream=0x80, sequence=i))
    assert bench.log.counters["output_full"] > 50


# Time-outs and limits


def test_a_silent_client_is_asked_then_leaves_the_graph_and_returns() -> None:
    bench = publishing(Limits(client_timeout_s=2.0))
    sent = bench.wait(1.9)
    assert 2 <= len(sent) <= 5
    assert set(sent) == {"81 00 00 00 02 01 08 00 00 00 ff fe 02 00 00 00"}
    assert bench.bridge.graph == GRAPH
    bench.wait(0.3)
    assert bench.bridge.graph == []
    assert bench.wait(5.0) == []
    bench.say("81 01 04 00" + WRITE)
    assert bench.bridge.graph == GRAPH
    assert len(bench.bridge.published) == 1
    text = bench.text.getvalue()
    assert "was silent for 2.0 s" in text
    assert "sent a message again" in text


def test_a_client_with_reliable_streams_is_asked_by_heartbeat() -> None:
    bench = connected(Limits(client_timeout_s=2.0))
    bench.say("81 80 00 00 0c 01 00 00")
    bench.say("81 00 00 00 0b 01 05 00 00 00 00 00 80")
    assert set(bench.wait(1.9)) == {"81 00 00 00 0b 01 05 00 00 00 ff ff 80"}


@pytest.mark.parametrize("kind", ["best effort", "reliable", "unacknowledged"])
def test_what_a_silent_client_is_sent_over_time(kind: str) -> None:
    """The profile of heartbeats and questions: few, evenly, and none any more when it has left the graph."""
    bench = publishing()
    if kind != "best effort":
        bench.say(message(entities()[0], stream=0x80))
    if kind == "reliable":
        bench.say("81 00 00 00 0a 01 05 00 01 00 00 00 80")
    began, times = bench.now, []
    while bench.now < began + 60:
        times += [bench.now - began] * len(bench.wait(0.05))
    apart = [later - earlier for earlier, later in itertools.pairwise(times)]
    if kind == "unacknowledged":
        assert 0.15 <= times[0] <= 0.3
        assert 30 <= len(times) <= 50, "heartbeats that grow apart, up to a second, and questions"
    else:
        assert 14.9 <= times[0] <= 18.2
        assert len(times) in (4, 5)
        assert all(2.9 <= gap <= 3.2 for gap in apart)
    assert times[-1] <= 30.1
    assert bench.bridge.graph == []


def test_a_client_that_answers_stays() -> None:
    bench = publishing(Limits(client_timeout_s=1.0))
    for _ in range(10):
        bench.wait(0.6)
        bench.say("81 00 00 00 06 01 04 00 00 00 ff fe")
    assert bench.bridge.graph == GRAPH


def test_a_client_may_ask_for_a_separate_time_out() -> None:
    bench = Bench()
    properties = bytes.fromhex("01 0000 01000000 07000000") + b"uxr_hl\0" + b"\0"
    properties = bytes.fromhex("01000000") + b"\x07\0\0\0uxr_hl\0\0" + b"\x05\0\0\x00" + b"0500\0"
    head = bytes.fromhex("58524345 0100 010f a1b2c3d4 81 01 0000") + properties
    payload = head + bytes(len(head) % 2) + b"\xfc\x01"
    submessage = bytes((0, 1, len(payload), 0)) + payload
    assert bench.say(bytes.fromhex("80000000") + submessage) == [STATUS_AGENT]
    bench.wait(0.7)
    assert "was silent for 0.5 s" in bench.text.getvalue()


def test_a_sleeper_is_forgotten_in_the_end() -> None:
    bench = publishing(Limits(client_timeout_s=1.0, sleep_timeout_s=10.0))
    bench.wait(11)
    assert len(bench.agent.clients) == 0
    assert bench.say(PING) == [PONG_OUTSIDE]


def test_the_number_of_clients_is_limited_and_sleepers_give_way() -> None:
    bench = Bench(Limits(clients=2, client_timeout_s=1.0))
    keys = ["a1 b2", "a1 b3", "a1 b4"]
    answers = [bench.say(CREATE_CLIENT.replace("a1 b2", key), key) for key in keys]
    assert [a[0][24:26] for a in answers] == ["00", "00", "87"]
    bench.wait(1.5)
    assert bench.say(CREATE_CLIENT.replace("a1 b2", keys[2]), keys[2])[0][24:26] == "00"
    assert len(bench.agent.clients) == 2


def test_streams_are_limited() -> None:
    bench = connected(Limits(streams=2))
    for stream in (1, 2, 3, 0x80, 0x81, 0x82):
        bench.say(message(Heartbeat(0, 0, 0x80), stream=stream))
    assert bench.log.counters == {"too_many_streams": 2}


# Faults


def test_a_kind_of_fault_is_reported_once_and_counted() -> None:
    bench = Bench()
    for _ in range(100):
        bench.say("ff")
    assert bench.log.counters == {"short_header": 100}
    assert bench.text.getvalue().count("\n") == 1


def test_a_fault_of_the_program_is_reported_and_survived(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = publishing()

    def broken(*_arguments: object) -> None:
        raise KeyError("broken")

    monkeypatch.setattr(bench.agent._operations, "_handlers", {Reset: broken})
    assert bench.say("81 00 00 00 0c 01 00 00") == []
    assert "internal error: KeyError('broken') at test_core.py:" in bench.text.getvalue()
    assert bench.say("81 01 04 00" + WRITE) == []
    assert len(bench.bridge.published) == 1


def test_closing_empties_the_graph() -> None:
    bench = publishing()
    bench.agent.close()
    assert bench.bridge.graph == []
    assert bench.bridge.closed


# Log


def test_what_a_person_reads() -> None:
    bench = publishing()
    bench.say("81 01 04 00 01 01 10 00 00 0c 00 23 03 03 00 00 02 00 00 00 00 00 00 21")
    assert bench.text.getvalue().splitlines() == [
        "client A1B2C3D4 connected from a (session 0x81, MTU 508)",
        "client A1B2C3D4: node 0:/a in ROS domain 0",
        "client A1B2C3D4: publisher /a [std_msgs/msg/Int32] (reliable, volatile, keep_last 10)",
        "warning: client A1B2C3D4: publisher 0x0023 refused (UNKNOWN_REFERENCE): "
        "the client has no participant 0x002",
    ]


def test_json_lines(capsys: pytest.CaptureFixture[str]) -> None:
    import sys

    from microros_gen.agent.log import EventLog, Level

    log = EventLog(sys.stdout, as_json=True, clock=lambda: 12.5)
    log.emit(Level.WARNING, "thing", "a {name}", name="\x1b[31mred")
    assert json.loads(capsys.readouterr().out) == {
        "time": 12.5,
        "level": "warning",
        "event": "thing",
        "name": "\x1b[31mred",
        "message": "a ?[31mred",
    }


def test_a_log_that_is_gone_does_not_stop_the_agent() -> None:
    bench = Bench()
    bench.text.close()
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]


def test_every_answer_is_aligned_and_complete() -> None:
    bench = publishing()
    for answer in bench.say(PING):
        raw = bytes.fromhex(answer)
        assert split(raw, 4)[-1][3] == len(raw)
