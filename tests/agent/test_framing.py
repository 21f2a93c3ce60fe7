# SPDX-License-Identifier: Apache-2.0
"""Frames on a stream: captured bytes, an encoder of the tests' own, and streams that lie."""

from __future__ import annotations

import random
import time
import tracemalloc
from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.agent.framing import FrameDecoder, crc16, encode_frame
from tests.support.agent.captured_frames import CREATE_CLIENT_FRAME, STATUS_AGENT_FRAME
from tests.support.agent.serial_link import crc_arc, frame
from tests.support.examples import examples

CREATE_CLIENT = "80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f a1 7e c3 7d 81 00 fc 01"
STATUS_AGENT = "81 00 00 00 04 01 0b 00 00 00 58 52 43 45 01 00 01 0f 00"


class Listener:
    """A decoder, its faults and what it found."""

    def __init__(self, largest: int = 0xFFFF) -> None:
        self.faults: Counter[str] = Counter()
        self.reported: list[str] = []
        self.decoder = FrameDecoder(self._fault, largest=largest)

    def _fault(self, kind: str, found: str) -> None:
        self.faults[kind] += 1
        self.reported.append(found)

    def hear(self, *chunks: bytes) -> list[bytes]:
        return [payload for chunk in chunks for _, payload in self.decoder.feed(chunk)]


def test_captured_frames() -> None:
    """Bytes of the public client and agent; the key of the client has to be stuffed."""
    listener = Listener()
    assert listener.hear(bytes.fromhex(CREATE_CLIENT_FRAME)) == [bytes.fromhex(CREATE_CLIENT)]
    assert encode_frame(bytes.fromhex(STATUS_AGENT), 1) == bytes.fromhex(STATUS_AGENT_FRAME)
    assert not listener.faults


def test_checksum() -> None:
    assert crc16(b"123456789") == 0xBB3D  # the check value of CRC-16/ARC
    assert crc16(b"") == 0


@given(st.binary(max_size=300))
def test_checksum_against_one_bit_at_a_time(data: bytes) -> None:
    assert crc16(data) == crc_arc(data)


payloads = st.lists(
    st.binary(min_size=1, max_size=80)
    | st.lists(st.sampled_from(b"\x7d\x7e\x5d\x5e\0"), min_size=1).map(bytes),
    max_size=6,
)


@given(payloads, st.integers(0, 255), st.integers(0, 255))
def test_encoder(found: list[bytes], destination: int, source: int) -> None:
    for payload in found:
        assert encode_frame(payload, destination, source) == frame(payload, source, destination)


@given(payloads, st.data())
def test_the_size_of_reads_makes_no_difference(found: list[bytes], data: st.DataObject) -> None:
    stream = b"".join(frame(payload, source=i) for i, payload in enumerate(found))
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=12)))
    ends = [0, *cuts, len(stream)]
    listener = Listener()
    decoded = [f for a, b in pairwise(ends) for f in listener.decoder.feed(stream[a:b])]
    assert decoded == list(enumerate(found))
    assert not listener.faults


def test_a_byte_at_a_time() -> None:
    stream = bytes.fromhex(CREATE_CLIENT_FRAME) * 2
    assert len(Listener().hear(*(bytes((b,)) for b in stream))) == 2


GOOD = frame(b"good")


@pytest.mark.parametrize(
    ("kind", "bad"),
    [
        ("frame_noise", b"rst:0x1 (POWERON)\r\n"),
        ("frame_noise", bytes(40)),
        ("frame_truncated", frame(b"a long message")[:9]),
        ("frame_truncated", b"\x7e"[:1] + b"\x01"),
        ("frame_truncated", frame(b"abc\x7e")[:9]),  # ends with an escape
        ("frame_escape", b"\x7e\x01\x00\x05\x00ab\x7d\x11cdefgh"),
        ("frame_escape", b"\x7e\x01\x00\x05\x00ab\x7d\x7dcdefgh"),
        ("frame_crc", frame(b"abcd")[:-1] + b"\0"),
        ("frame_crc", frame(b"abcd").replace(b"bc", b"cb")),
        ("frame_crc", frame(b"a message that is longer").replace(b"\x18", b"\x10", 1)),
        ("frame_address", frame(b"abcd", source=0, destination=1)),  # an echo of the agent's own
        ("frame_empty", b"\x7e\x01\x00\x00\x00\x00\x00"),
        ("frame_too_large", frame(bytes(101))),
    ],
)
def test_a_fault_costs_only_its_own_frame(kind: str, bad: bytes) -> None:
    for chunks in ([GOOD + bad + GOOD], [GOOD, bad, GOOD], [bytes((b,)) for b in GOOD + bad + GOOD]):
        listener = Listener(largest=100)
        assert listener.hear(*chunks) == [b"good", b"good"]
        assert listener.faults == {kind: 1}


def test_half_a_frame_of_an_older_run() -> None:
    listener = Listener()
    assert listener.hear(frame(b"older")[5:], GOOD) == [b"good"]
    assert listener.faults == {"frame_noise": 1}


def test_flags_in_a_row_only_separate() -> None:
    listener = Listener()
    assert listener.hear(b"\x7e\x7e" + GOOD + b"\x7e", b"\x7e" + GOOD) == [b"good", b"good"]
    assert not listener.faults


def test_a_reset_forgets_what_was_begun() -> None:
    listener = Listener()
    listener.hear(GOOD[:6])
    listener.decoder.reset()
    assert listener.hear(GOOD[6:], GOOD) == [b"good"]


def test_the_largest_frame() -> None:
    payload = bytes(range(256)) * 255 + bytes(255)
    assert Listener().hear(frame(payload)) == [payload]


def test_memory_is_bounded() -> None:
    """A frame whose length is never reached, noise without end, and escapes without end."""
    listener = Listener()
    tracemalloc.start()
    try:
        for start in (b"\x7e\x01\x00\xff\xff", b"noise", b"\x7e\x01\x00\xff\xff\x7d"):
            listener.hear(start)
            for _ in range(300):
                listener.hear(b"\x5e\x7d" * 2_000)
        assert tracemalloc.get_traced_memory()[0] < 300_000
    finally:
        tracemalloc.stop()


@settings(max_examples=examples(300), deadline=None)
@given(st.lists(st.binary(max_size=60) | st.just(GOOD) | st.just(b"\x7e") | st.just(b"\x7d"), max_size=20))
def test_any_stream(chunks: list[bytes]) -> None:
    listener = Listener(largest=200)
    listener.hear(*chunks)
    assert listener.hear(GOOD, GOOD)[-1] == b"good"


def corrupt(stream: bytes, chance: random.Random, faults: int) -> bytes:
    """Return a stream with bytes flipped, lost and put in."""
    out = bytearray(stream)
    for _ in range(faults):
        at = chance.randrange(len(out))
        match chance.randrange(4):
            case 0:
                out[at] ^= 1 << chance.randrange(8)
            case 1:
                del out[at : at + chance.randrange(1, 20)]
            case 2:
                out[at:at] = chance.randbytes(chance.randrange(1, 20))
            case _:
                out[at:at] = b"\x7e"
    return bytes(out)


def noisy_line(frames: int, seed: int) -> None:
    """Every fault costs two frames at most: the one that it hits, and one that it joins with it."""
    chance = random.Random(seed)
    sent = [chance.randbytes(chance.randrange(1, 200)) + i.to_bytes(4, "big") for i in range(frames)]
    faults = frames // 20
    stream = corrupt(b"".join(map(frame, sent)), chance, faults)
    listener = Listener()
    decoded, at = [], 0
    while at < len(stream):
        step = chance.randrange(1, 300)
        decoded += listener.hear(stream[at : at + step])
        at += step
    known = set(sent)
    assert sum(payload not in known for payload in decoded) <= 1, "a checksum of 16 bits may hold by chance"
    assert len(decoded) >= frames - 2 * faults
    assert sum(listener.faults.values()) > 0


def test_a_noisy_line() -> None:
    noisy_line(2_000, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(30))
def test_a_noisy_line_at_length(seed: int) -> None:
    noisy_line(20_000, seed)


def test_it_keeps_up_with_the_fastest_line() -> None:
    """12 Mbit/s (USB full speed) is 1.2 MB/s; measured are 24 MB/s on an idle core."""
    stream = frame(random.Random(1).randbytes(500)) * 2_000
    listener = Listener()
    start = time.process_time()
    assert len(listener.hear(*(stream[at : at + 4096] for at in range(0, len(stream), 4096)))) == 2_000
    assert len(stream) / (time.process_time() - start) > 1.2e6
