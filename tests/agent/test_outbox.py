# SPDX-License-Identifier: Apache-2.0
"""What waits for a slow line or connection: bounded, newest samples first to stay, whole frames in order."""

from __future__ import annotations

import os
import random
import select
from collections.abc import Iterator

import pytest

from microros_gen.agent.framing import FrameDecoder
from microros_gen.agent.transport.outbox import SHARE, Outbox, is_sample
from microros_gen.agent.transport.serial import serial_line
from microros_gen.agent.wire.data_messages import Data
from microros_gen.agent.wire.entity_messages import StatusReply
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.cable import Cable
from tests.support.agent.client import int32_body
from tests.support.agent.fakes import Bench
from tests.support.agent.tcp_agent import _received, tcp
from tests.support.agent.tcp_link import TcpLink

LIMIT = 800
KEY = bytes(4)


@pytest.fixture
def pipe() -> Iterator[tuple[int, int]]:
    ends = os.pipe()
    os.set_blocking(ends[1], False)
    yield ends
    for end in ends:
        os.close(end)


def sample(number: int, stream: int = 1, session: int = 0x81) -> bytes:
    """Return a message with a DATA, whose number is in the header and in the sample."""
    key = KEY if session < 0x80 else b""
    return join(Header(session, stream, number, key), [encode(Data(1, 6, int32_body(number)))])


@pytest.mark.parametrize(
    ("message", "wanted"),
    [
        (sample(1), True),
        (sample(1, 0x7F), True),
        (sample(1, 1, 0x01), True),
        (sample(1, 0x80), False),
        (sample(1, 0x80, 0x01), False),
        (join(Header(0x81, 1, 0), [encode(StatusReply(1, 1, 0))]), False),
        (b"\x81\x01\0\0", False),
    ],
)
def test_what_a_newer_one_replaces(message: bytes, wanted: bool) -> None:
    assert is_sample(message) is wanted


def test_the_oldest_samples_are_dropped_and_others_stay(pipe: tuple[int, int]) -> None:
    dropped: list[int] = []
    outbox = Outbox(LIMIT, lambda: dropped.append(1))
    for number in range(20):
        assert outbox.put(b"s%09d" % number, sample=True)
        assert outbox.put(b"r%09d" % number)
    assert outbox.write(pipe[1])
    received = os.read(pipe[0], 10_000)
    frames = [received[at : at + 10].decode() for at in range(0, len(received), 10)]
    room = LIMIT // SHARE // 10
    assert [f for f in frames if f[0] == "s"] == [f"s{n:09d}" for n in range(20 - room, 20)]
    assert [f for f in frames if f[0] == "r"] == [f"r{n:09d}" for n in range(20)]
    assert [int(f[1:]) for f in frames] == sorted(int(f[1:]) for f in frames)
    assert len(dropped) == 20 - room
    assert not outbox


def test_samples_make_room_for_what_is_no_sample() -> None:
    dropped: list[int] = []
    outbox = Outbox(LIMIT, lambda: dropped.append(1))
    assert outbox.put(bytes(90), sample=True)
    assert outbox.put(bytes(LIMIT - 90))
    assert outbox.put(bytes(90))
    assert dropped == [1]
    assert not outbox.put(bytes(1))
    assert not outbox.put(bytes(1), sample=True)
    outbox.clear()
    assert outbox.put(bytes(LIMIT), sample=True)  # larger than the share, and alone
    assert outbox.put(bytes(1), sample=True)
    assert len(dropped) == 2


def test_a_frame_that_is_half_sent_is_finished(pipe: tuple[int, int]) -> None:
    size = 1_000_000
    outbox = Outbox(SHARE * size, lambda: None)
    assert outbox.put(b"a" * size, sample=True)
    assert outbox.write(pipe[1])
    assert outbox.put(b"b" * size, sample=True)
    assert outbox.put(b"c" * size, sample=True)  # takes the place of b, not of the rest of a
    received = bytearray()
    while outbox:
        received += os.read(pipe[0], 65_536)
        outbox.write(pipe[1])
    while len(received) < 2 * size:
        received += os.read(pipe[0], 65_536)
    assert received == b"a" * size + b"c" * size


def test_bytes_are_never_more_than_the_limit(pipe: tuple[int, int]) -> None:
    """Whatever is put in and taken out: what waits is counted right, and comes out whole."""
    chance = random.Random(5)
    outbox = Outbox(LIMIT, lambda: None)
    received = b""
    for number in range(3000):
        outbox.put(bytes([number % 255 + 1]) * chance.randrange(1, 300) + b"\0", chance.random() < 0.7)
        assert sum(map(len, outbox._frames)) == outbox._bytes <= LIMIT
        if chance.random() < 0.3:
            outbox.write(pipe[1])
            received += os.read(pipe[0], 1 << 20)
    for frame in received.split(b"\0")[:-1]:
        assert len(set(frame)) == 1


def test_a_slow_line_is_reported() -> None:
    bench = Bench()
    cable = Cable()
    line = serial_line(cable.device, 115_200, bench.log)
    for number in range(20_000):
        line.send(sample(number), (line.label, 1))
    line.send(join(Header(0x81, 0x80, 7), [encode(StatusReply(1, 1, 0))]), (line.label, 1))
    decoder = FrameDecoder(lambda kind, found: pytest.fail(f"{kind}: {found}"), address=1)
    received: list[bytes] = []
    while not received or received[-1][1] != 0x80:
        assert select.select([cable.end], [], [], 5)[0]
        received += [payload for _, payload in decoder.feed(os.read(cable.end, 4096))]
        line.pump(lambda *_: None)
    line.close()
    cable.pull()
    assert set(bench.log.counters) == {"line_slow"}
    numbers = [message[2] | message[3] << 8 for message in received[:-1]]
    assert numbers == sorted(set(numbers))
    assert numbers[-1] == 19_999
    assert len(numbers) == 20_000 - bench.log.counters["line_slow"]


@pytest.mark.system
def test_a_slow_connection_is_reported() -> None:
    bench = Bench()
    transport = tcp(bench)
    link = TcpLink("127.0.0.1", transport.port)
    link.send(b"\x01")
    (connection,) = _received(transport)
    for number in range(60_000):
        transport.send(sample(number & 0xFFFF), connection)
    transport.close()
    assert set(bench.log.counters) == {"tcp_slow"}
