# SPDX-License-Identifier: Apache-2.0
"""Blocks of pcapng files (draft-ietf-opsawg-pcapng, "PCAP Now Generic Dump File Format").

A file is a list of blocks. Each begins and ends with its length, so a file whose last block is incomplete can be read
up to there. Written here: a section header, a description of each interface, and enhanced packet blocks.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from typing import BinaryIO, Literal

from microros_gen.records import dataclass

LINKTYPE_ETHERNET = 1
"""Packets begin with the header of Ethernet (link types of tcpdump.org)."""
INBOUND, OUTBOUND = 1, 2
"""Direction of a packet, bits 0 and 1 of its flags (section 4.3.1)."""

_SECTION, _INTERFACE, _PACKET = 0x0A0D0D0A, 1, 6
_MAGIC = 0x1A2B3C4D
_COMMENT, _USER_APPLICATION, _NAME, _DESCRIPTION, _FLAGS, _DROPPED, _RESOLUTION = 1, 4, 2, 3, 2, 4, 9
_NANOSECONDS = b"\x09"
_NS = 1_000_000_000
_HEAD, _PACKET_HEAD, _SHORTEST_BLOCK = 8, 20, 12
_LARGEST_BLOCK = 1 << 24
"""Bytes; a longer one is taken for damage."""

Option = tuple[int, bytes]


class PcapngError(Exception):
    """A file that is not pcapng, with the reason."""


@dataclass(frozen=True)
class Interface:
    """An interface of a file: its link type, name (`udp4 127.0.0.1:8888`) and ticks per second."""

    linktype: int
    name: str
    ticks_per_s: int


@dataclass(frozen=True)
class Packet:
    """A packet of a file: its interface, time since 1970 in nanoseconds, bytes, and what its options say.

    `at` is the place of its bytes in the file, in bytes from its beginning.
    """

    interface: Interface
    time_ns: int
    data: bytes
    direction: int = 0
    comment: str = ""
    dropped: int = 0
    at: int = 0


def section(application: str) -> bytes:
    """Return the section header block, the first one of a file; its length is open."""
    body = struct.pack("<IHHq", _MAGIC, 1, 0, -1)
    return _block(_SECTION, body + _options([(_USER_APPLICATION, application.encode())]))


def interface(name: str, description: str) -> bytes:
    """Return the description of an interface of LINKTYPE_ETHERNET whose times are nanoseconds."""
    options = [
        (_NAME, name.encode()),
        (_DESCRIPTION, description.encode()),
        (_RESOLUTION, _NANOSECONDS),
    ]
    return _block(_INTERFACE, struct.pack("<HHI", LINKTYPE_ETHERNET, 0, 0) + _options(options))


def packet(
    number: int, time_ns: int, data: bytes, direction: int, comment: str = "", dropped: int = 0
) -> bytes:
    """Return the block of a packet of interface `number`; `dropped` packets before it were not written."""
    size = len(data)
    head = struct.pack("<IIIII", number, time_ns >> 32, time_ns & 0xFFFF_FFFF, size, size)
    options: list[Option] = [(_FLAGS, direction.to_bytes(4, "little"))]
    if comment:
        options.append((_COMMENT, comment.encode()))
    if dropped:
        options.append((_DROPPED, dropped.to_bytes(8, "little")))
    return _block(_PACKET, head + data + bytes(-size & 3) + _options(options))


def read_packets(file: BinaryIO) -> Iterator[Packet]:
    """Return the packets of a file of either byte order, of which one block at a time is in memory.

    An incomplete block at the end is ignored, as a writer that was killed may leave one. Blocks of other kinds are
    skipped. Raises PcapngError if it is not pcapng, or damaged; OSError.
    """
    order = ""
    interfaces: list[Interface] = []
    at = 0
    while len(head := file.read(_SHORTEST_BLOCK)) == _SHORTEST_BLOCK:
        if head[:4] == _SECTION.to_bytes(4, "little"):
            order = _order(head[8:12])
            interfaces = []
        elif not order:
            raise PcapngError("it does not begin with a section header")
        kind, size = struct.unpack_from(f"{order}II", head)
        if size < _SHORTEST_BLOCK or size & 3 or size > _LARGEST_BLOCK:
            raise PcapngError(f"the block at byte {at} has a length of {size}")
        block = head + file.read(size - _SHORTEST_BLOCK)
        if len(block) < size:
            return
        body = block[_HEAD : size - 4]
        if kind == _INTERFACE:
            interfaces.append(_interface(order, body))
        elif kind == _PACKET:
            yield _packet(order, body, interfaces, at)
        at += size
    if not order:
        raise PcapngError("it does not begin with a section header")


def _order(magic: bytes) -> str:
    for order in "<>":
        if magic == struct.pack(f"{order}I", _MAGIC):
            return order
    raise PcapngError("its section header has another magic number")


def _interface(order: str, body: bytes) -> Interface:
    if len(body) < 8:
        raise PcapngError("the description of an interface is incomplete")
    (linktype,) = struct.unpack_from(f"{order}H", body)
    found = dict(_read_options(order, body, 8))
    return Interface(
        linktype, _text(found.get(_NAME, b"")), _ticks_per_s(found.get(_RESOLUTION, b"\x06")[:1])
    )


def _ticks_per_s(resolution: bytes) -> int:
    """Return what if_tsresol says: a power of ten, or of two if its highest bit is set."""
    value = resolution[0] if resolution else 6
    return 1 << (value & 0x7F) if value & 0x80 else int(10**value)


def _packet(order: str, body: bytes, interfaces: Sequence[Interface], at: int) -> Packet:
    if len(body) < _PACKET_HEAD:
        raise PcapngError(f"the packet at byte {at} is incomplete")
    number, high, low, size, _ = struct.unpack_from(f"{order}IIIII", body)
    if number >= len(interfaces) or _PACKET_HEAD + size > len(body):
        raise PcapngError(f"the packet at byte {at} has an unknown interface or length")
    found = dict(_read_options(order, body, _PACKET_HEAD + size + (-size & 3)))
    flags = int.from_bytes(found.get(_FLAGS, b"\0\0\0\0"), _byteorder(order))
    return Packet(
        interfaces[number],
        (high << 32 | low) * _NS // interfaces[number].ticks_per_s,
        body[_PACKET_HEAD : _PACKET_HEAD + size],
        flags & 3,
        _text(found.get(_COMMENT, b"")),
        int.from_bytes(found.get(_DROPPED, b""), _byteorder(order)),
        at + _HEAD + _PACKET_HEAD,
    )


def _byteorder(order: str) -> Literal["little", "big"]:
    return "little" if order == "<" else "big"


def _text(raw: bytes) -> str:
    return raw.decode("utf-8", "replace")


def _read_options(order: str, body: bytes, at: int) -> Iterator[Option]:
    while at + 4 <= len(body):
        code, size = struct.unpack_from(f"{order}HH", body, at)
        if code == 0:
            return
        yield code, body[at + 4 : at + 4 + size]
        at += 4 + size + (-size & 3)


def _options(options: Sequence[Option]) -> bytes:
    written = (struct.pack("<HH", code, len(raw)) + raw + bytes(-len(raw) & 3) for code, raw in options)
    return b"".join(written) + bytes(4)


def _block(kind: int, body: bytes) -> bytes:
    size = len(body) + 12
    return struct.pack("<II", kind, size) + body + struct.pack("<I", size)
