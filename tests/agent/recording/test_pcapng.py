# SPDX-License-Identifier: Apache-2.0
"""Blocks of pcapng: written and read again; files of other programs, damaged and incomplete ones."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from io import BytesIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.pcapng import Packet, PcapngError

START = pcapng.section("tests") + pcapng.interface("udp4 127.0.0.1:8888", "XRCE")


def read_packets(content: bytes) -> Iterator[Packet]:
    return pcapng.read_packets(BytesIO(content))


@given(
    data=st.binary(max_size=70),
    time_ns=st.integers(0, 2**63 - 1),
    direction=st.sampled_from((0, pcapng.INBOUND, pcapng.OUTBOUND)),
    comment=st.text(max_size=20),
    dropped=st.integers(0, 2**64 - 1),
)
def test_a_packet_is_read_as_written(
    data: bytes, time_ns: int, direction: int, comment: str, dropped: int
) -> None:
    (found,) = read_packets(START + pcapng.packet(0, time_ns, data, direction, comment, dropped))
    assert (found.data, found.time_ns, found.direction) == (data, time_ns, direction)
    assert (found.comment, found.dropped) == (comment, dropped)
    assert found.interface.name == "udp4 127.0.0.1:8888"


def test_a_file_that_ends_anywhere_is_read_up_to_its_last_whole_packet() -> None:
    packets = [pcapng.packet(0, number, bytes(number), pcapng.INBOUND) for number in range(5)]
    whole = START + b"".join(packets)
    ends = [len(START) + sum(map(len, packets[:count])) for count in range(6)]
    for size in range(len(pcapng.section("tests")), len(whole) + 1):
        wanted = max((count for count, end in enumerate(ends) if end <= size), default=0)
        assert len(list(read_packets(whole[:size]))) == wanted


def test_a_file_of_another_machine() -> None:
    """Big endian, times in microseconds (the default) or in powers of two, unknown blocks, two sections."""

    def block(kind: int, body: bytes) -> bytes:
        return struct.pack(">II", kind, len(body) + 12) + body + struct.pack(">I", len(body) + 12)

    section = block(0x0A0D0D0A, struct.pack(">IHHq", 0x1A2B3C4D, 1, 0, -1))
    plain = block(1, struct.pack(">HHI", 1, 0, 0))
    fine = block(1, struct.pack(">HHI", 1, 0, 0) + struct.pack(">HHB3x", 9, 1, 0x8A) + bytes(4))
    first = block(6, struct.pack(">IIIII", 0, 0, 7, 2, 2) + b"ab\0\0")
    second = block(6, struct.pack(">IIIII", 1, 1, 0, 1, 1) + b"c\0\0\0" + struct.pack(">HHI", 2, 4, 2))
    found = list(read_packets(section + plain + block(0x55, b"") + fine + first + second + START))
    assert [(packet.data, packet.time_ns, packet.direction) for packet in found] == [
        (b"ab", 7_000, 0),
        (b"c", (1 << 32) * 1_000_000_000 >> 10, pcapng.OUTBOUND),
    ]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "does not begin"),
        (b"GIF89a and more bytes", "does not begin"),
        (START[:8] + b"abcd" + START[12:], "another magic number"),
        (START + struct.pack("<III", 6, 10, 10), "has a length of 10"),
        (START + pcapng.packet(1, 0, b"", 0), "unknown interface"),
        (START + struct.pack("<IIII", 6, 16, 0, 16), "incomplete"),
        (START + struct.pack("<IIII", 1, 16, 0, 16), "incomplete"),
    ],
)
def test_other_files_are_refused(content: bytes, reason: str) -> None:
    with pytest.raises(PcapngError, match=reason):
        list(read_packets(content))


@given(st.binary(max_size=200))
def test_any_bytes_are_packets_or_no_pcapng(tail: bytes) -> None:
    try:
        for packet in read_packets(START + tail):
            assert packet.interface.ticks_per_s > 0
    except PcapngError:
        pass


class Watched(BytesIO):
    """A file that knows the largest number of bytes that was read at once."""

    largest = 0

    def read(self, size: int | None = -1, /) -> bytes:
        found = super().read(size)
        self.largest = max(self.largest, len(found))
        return found


def test_a_file_is_read_block_by_block() -> None:
    file = Watched(START + b"".join(pcapng.packet(0, n, bytes(1000), pcapng.INBOUND) for n in range(100)))
    packets = pcapng.read_packets(file)
    assert next(packets).time_ns == 0
    assert file.tell() < 3000
    assert len(list(packets)) == 99
    assert file.largest < 1100
