# SPDX-License-Identifier: Apache-2.0
"""Streams both ways under loss, duplication and reordering, with a clock of the test's own."""

from __future__ import annotations

import random

import pytest

from microros_gen.agent.streams_in import BestEffortIn, Reassembly, ReliableIn
from microros_gen.agent.streams_out import HEARTBEAT_PERIOD_S, BestEffortOut, Link, ReliableOut
from microros_gen.agent.wire.entity_messages import Fragment
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.submessages import decode
from tests.support.agent.dialogue import GRAPH, publishing

LINK = Link(0x81, b"\xa1\xb2\xc3\xd4", 64)
KEYED = Link(0x01, b"\xa1\xb2\xc3\xd4", 64)


def sequence_of(message: bytes) -> int:
    return message[2] | message[3] << 8


# Best effort in


@pytest.mark.parametrize(
    ("sequences", "taken"),
    [
        ([0, 1, 2], [0, 1, 2]),
        ([0, 1, 1, 2], [0, 1, 2]),
        ([0, 5, 3, 6], [0, 5, 6]),
        ([0xFFFE, 0xFFFF, 0, 1], [0xFFFE, 0xFFFF, 0, 1]),
        ([10, 0x800A - 1, 0x800A + 9], [10, 0x8009, 0x8013]),
        ([10, 0x800A], [10]),
    ],
)
def test_best_effort_takes_what_is_newer(sequences: list[int], taken: list[int]) -> None:
    stream = BestEffortIn()
    assert [s for s in sequences if stream.accept(s)] == taken


# Reliable in


def test_order_is_restored_and_duplicates_are_dropped() -> None:
    stream = ReliableIn(1000)
    assert stream.push(1, b"1") == ()
    assert stream.push(1, b"1") == ()
    assert stream.push(3, b"3") == ()
    assert stream.missing() == (0, 0b0101)
    assert stream.push(0, b"0") == (b"0", b"1")
    assert stream.missing() == (2, 0b01)
    assert stream.push(0, b"0") == ()
    assert stream.push(2, b"2") == (b"2", b"3")
    assert stream.missing() == (4, 0)


def test_the_acknack_of_a_gap_is_that_of_the_public_agent() -> None:
    stream = ReliableIn(1000)
    for i in range(0x11):
        assert stream.push(i, b"x") == (b"x",)
    assert stream.push(0x14, b"x") == ()
    assert stream.missing() == (0x11, 0x0007)


def test_the_window_ends_after_sixteen() -> None:
    stream = ReliableIn(1000)
    assert stream.push(16, b"too far") == ()
    assert stream.missing() == (0, 0)
    assert stream.push(15, b"last") == ()
    assert stream.missing() == (0, 0x7FFF)


def test_what_a_gap_holds_is_bounded() -> None:
    stream = ReliableIn(10)
    stream.push(1, b"12345678")
    stream.push(2, b"12345678")  # no room: asked for again
    assert stream.missing() == (0, 0b101)
    assert stream.push(0, b"0") == (b"0", b"12345678")
    assert stream.push(2, b"12345678") == (b"12345678",)


def test_a_heartbeat_announces_and_skips() -> None:
    stream = ReliableIn(1000)
    assert stream.announce(0, 3) == ((), False)
    assert stream.missing() == (0, 0b1111)
    stream.push(5, b"5")
    assert stream.announce(5, 6) == ((b"5",), True)
    assert stream.missing() == (6, 0b1)
    assert stream.announce(2, 6) == ((), False), "an old one changes nothing"
    assert stream.announce(7, 6) == ((), True), "nothing left to send: the gap is dropped"
    assert stream.missing() == (7, 0)


def test_reliable_sequence_numbers_wrap() -> None:
    stream = ReliableIn(1000)
    for i in range(0x10000 - 1):
        stream.push(i, b"")
    assert stream.push(0, b"b") == ()
    assert stream.missing() == (0xFFFF, 1)
    assert stream.push(0xFFFF, b"a") == (b"a", b"b")
    assert stream.missing() == (1, 0)


# Reassembly


def test_fragments_join_and_larger_ones_are_refused_once() -> None:
    joined = Reassembly(8)
    assert joined.add(b"1234", False) is None
    assert joined.add(b"5678", True) == b"12345678"
    assert joined.add(b"12345", False) is None
    with pytest.raises(MalformedError, match="fragments_too_large"):
        joined.add(b"6789", False)
    assert joined.add(b"x", False) is None
    assert joined.add(b"x", True) is None, "still part of the refused one"
    assert joined.add(b"ok", True) == b"ok"


def test_a_last_fragment_too_many_does_not_spoil_the_next() -> None:
    joined = Reassembly(4)
    with pytest.raises(MalformedError):
        joined.add(b"12345", True)
    assert joined.add(b"ok", True) == b"ok"


def test_after_a_lost_fragment_the_rest_is_dropped() -> None:
    joined = Reassembly(100)
    joined.add(b"lost ", False)
    joined.drop()
    assert joined.add(b"its end", True) is None
    assert joined.add(b"new", True) == b"new"


# Out


def test_best_effort_out_numbers_and_refuses_what_does_not_fit() -> None:
    stream = BestEffortOut(LINK, 1)
    assert stream.push(b"abcd") == [bytes.fromhex("81010000") + b"abcd"]
    assert stream.push(bytes(61)) is None
    assert stream.push(bytes(60)) == [bytes.fromhex("81010100") + bytes(60)]
    assert BestEffortOut(KEYED, 1).push(b"") == [bytes.fromhex("01010000a1b2c3d4")]


def test_the_window_holds_back_and_an_acknack_releases() -> None:
    stream = ReliableOut(LINK, 0x80, 1000)
    sent = [m for i in range(20) for m in stream.push(bytes([i]), 0.0) or ()]
    assert [sequence_of(m) for m in sent] == list(range(16))
    assert stream.acknowledge(0, 0, 0.0) == []
    released = stream.acknowledge(3, 0b10, 0.0)
    assert [sequence_of(m) for m in released] == [4, 16, 17, 18]
    assert stream.acknowledge(2, 0xFFFF, 0.0) == [], "older than what is known"
    assert stream.acknowledge(300, 0, 0.0) == [], "never sent"


def test_what_was_just_repeated_is_not_repeated_again() -> None:
    """A client that gets messages 1 to 9 says nine times that it lacks 0; forged ones cannot multiply either."""
    stream = ReliableOut(LINK, 0x80, 1000)
    for i in range(10):
        stream.push(bytes([i]), 0.0)
    answers = [stream.acknowledge(0, 0b1, 0.001 * i) for i in range(9)]
    assert [sequence_of(m) for sent in answers for m in sent] == [0]
    assert [sequence_of(m) for m in stream.acknowledge(0, 0b11, 0.009)] == [1]
    assert [sequence_of(m) for m in stream.acknowledge(0, 0b11, 0.011)] == [0]
    assert [sequence_of(m) for m in stream.acknowledge(1, 0b1, 0.1)] == [1]


def test_the_backlog_is_bounded() -> None:
    stream = ReliableOut(LINK, 0x80, 10)
    for _ in range(16):
        assert stream.push(b"12345678", 0.0)
    assert stream.push(b"12345678", 0.0) == []
    assert stream.push(b"123", 0.0) is None


def test_heartbeats_until_acknowledged() -> None:
    stream = ReliableOut(LINK, 0x80, 1000)
    assert stream.heartbeat(0.0) is None
    stream.push(b"a", 0.0)
    stream.push(b"b", 0.1)
    assert stream.heartbeat(0.19) is None
    beat = stream.heartbeat(HEARTBEAT_PERIOD_S)
    assert beat is not None
    assert (beat.first, beat.last, beat.stream) == (0, 1, 0x80)
    assert stream.heartbeat(HEARTBEAT_PERIOD_S + 0.1) is None
    stream.acknowledge(2, 0, 0.3)
    assert stream.heartbeat(10.0) is None
    assert (stream.probe().first, stream.probe().last) == (2, 1)


def test_heartbeats_wait_for_a_slow_client() -> None:
    """Three seconds of round trip: it is not asked for what is on its way, and what was lost goes once more."""
    stream, now, beats, sent = ReliableOut(LINK, 0x80, 1000), 0.0, 0, 0
    coming: list[tuple[float, int, int]] = []
    for step in range(600):
        now = step * 0.1
        if step % 50 == 0:
            stream.push(b"a", now)
            lost = step == 300
            if not lost:
                coming.append((now + 3.0, stream.probe().last + 1, 0))
        if stream.heartbeat(now) is not None:
            beats += step >= 100
            if step > 300:
                coming.append((now + 3.0, stream.probe().first, 1))
        for answer in [answer for answer in coming if answer[0] <= now]:
            coming.remove(answer)
            again = stream.acknowledge(answer[1], answer[2], now)
            sent += len(again)
            coming += [(now + 3.0, stream.probe().last + 1, 0) for _ in again]
        if step == 290:
            assert beats == 0, "each acknowledgement comes in its time"
    assert sent == 1
    assert beats <= 3
    assert stream.probe().first == 12


def test_fragments_fill_the_announced_size() -> None:
    """As the public pair does it: full messages are as large as the MTU, the last one takes the rest."""
    stream = ReliableOut(Link(0x81, b"", 508), 0x80, 65536)
    whole = bytes(range(256)) * 4 + bytes(184)
    sent = stream.push(whole, 0.0)
    assert sent is not None
    assert [len(m) for m in sent] == [508, 508, 4 + 4 + 208]
    chunks = [decode(*span[:2], m, *span[2:]) for m in sent for span in split(m, header_size(m))]
    assert [p.last for p in chunks if isinstance(p, Fragment)] == [False, False, True]
    assert b"".join(p.data for p in chunks if isinstance(p, Fragment)) == whole


# Both ends over a bad line


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("link", [LINK, KEYED], ids=["keyless", "keyed"])
def test_everything_arrives_once_and_in_order_over_a_bad_line(seed: int, link: Link) -> None:
    chance = random.Random(seed)
    sender, receiver, joined = ReliableOut(link, 0x80, 1 << 20), ReliableIn(1 << 16), Reassembly(1 << 16)
    wanted = [b"\x07" + bytes([i]) * chance.choice((3, 19, 47, 199, 899)) for i in range(150)]
    line: list[tuple[float, bytes]] = []
    received: list[bytes] = []
    now = 0.0

    def put(messages: list[bytes]) -> None:
        for message in messages:
            for _ in range(chance.choice((0, 1, 1, 1, 2))):  # lost, sent, or doubled
                line.append((now + chance.uniform(0.0, 0.05), message))

    todo = list(wanted)
    while len(received) < len(wanted) and now < 600:
        now += 0.01
        if todo:
            put(sender.push(todo.pop(0), now) or [])
        for arrival in sorted(a for a in line if a[0] <= now):
            line.remove(arrival)
            for message in receiver.push(sequence_of(arrival[1]), arrival[1]):
                body = message[header_size(message) :]
                is_fragment = body[0] == 0x0D
                fragment = joined.add(body[4:], bool(body[1] & 2)) if is_fragment else body
                received += [fragment] if fragment is not None else []
        if sender.heartbeat(now) and chance.random() < 0.7:
            beat = sender.probe()
            receiver.announce(beat.first, beat.last)
        if chance.random() < 0.5:
            put(sender.acknowledge(*receiver.missing(), now))
    assert received == wanted


def fragments_of(body: bytes, mtu: int, first: int) -> list[bytes]:
    """Return the messages of one WRITE_DATA to writer 0x0015, cut as the public client cuts them."""
    size = len(body) + 4
    whole = bytes((7, 1, size & 0xFF, size >> 8, 0, 0x12, 0, 0x15)) + body
    room = mtu - 8
    chunks = [whole[at : at + room] for at in range(0, len(whole), room)]
    return [
        bytes((0x81, 0x80, (first + i) & 0xFF, (first + i) >> 8 & 0xFF))
        + bytes((13, 3 if i == len(chunks) - 1 else 1, len(chunk) & 0xFF, len(chunk) >> 8))
        + chunk
        for i, chunk in enumerate(chunks)
    ]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("mtu", [64, 512, 2048])
def test_20_kib_in_fragments_through_a_window_of_16(mtu: int, seed: int) -> None:
    """More fragments than the window holds, lost and out of order: each sample arrives whole, once, in order."""
    chance = random.Random(seed)
    bench = publishing()
    samples = [chance.randbytes(20_480), b"short", chance.randbytes(20_480 + 3), chance.randbytes(20_000)]
    messages: list[bytes] = []
    for body in samples:
        messages += fragments_of(body, mtu, len(messages))
    done = rounds = 0
    while done < len(messages):
        rounds += 1
        assert rounds < 50 * len(messages), "it does not come to an end"
        window = messages[done : done + 16]
        chance.shuffle(window)
        answers = [a for m in window if chance.random() < 0.8 for a in bench.say(m)]
        last = min(done + 16, len(messages)) - 1
        beat = bytes((0x81, 0, 0, 0, 11, 1, 5, 0, done & 0xFF, done >> 8, last & 0xFF, last >> 8, 0x80))
        answers += bench.say(beat)
        done = max(int.from_bytes(bytes.fromhex(a)[8:10], "little") for a in answers)
    assert bench.bridge.published == [(GRAPH[1], b"\0\1\0\0" + body) for body in samples]
    assert not bench.log.counters
