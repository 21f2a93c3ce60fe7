# SPDX-License-Identifier: Apache-2.0
"""Frames of serial lines, written from captured bytes: shares nothing with the C code or the agent."""

from __future__ import annotations

import re
from dataclasses import dataclass

CLIENT, AGENT = 1, 0
STUFFED = {0x7E: b"\x7d\x5e", 0x7D: b"\x7d\x5d"}


def _reversed(value: int, bits: int) -> int:
    return int(f"{value:0{bits}b}"[::-1], 2)


def _entry(index: int) -> int:
    """Divide by x^16 + x^15 + x^2 + 1 as polynomials are written, the first bit on the left."""
    rest = _reversed(index, 8) << 8
    for _ in range(8):
        rest = ((rest << 1) ^ 0x18005) if rest & 0x8000 else rest << 1
    return _reversed(rest & 0xFFFF, 16)


_TABLE = [_entry(index) for index in range(256)]


def crc16(payload: bytes) -> int:
    """Return the CRC-16/ARC; 0xBB3D for b"123456789"."""
    crc = 0
    for byte in payload:
        crc = (crc >> 8) ^ _TABLE[(crc ^ byte) & 0xFF]
    return crc


def stuffed(data: bytes) -> bytes:
    return b"".join(STUFFED.get(byte, bytes([byte])) for byte in data)


def frame(payload: bytes, source: int = AGENT, destination: int = CLIENT) -> bytes:
    """Return the frame around `payload`, by default one of the agent."""
    header = bytes([source, destination]) + len(payload).to_bytes(2, "little")
    return b"\x7e" + stuffed(header + payload + crc16(payload).to_bytes(2, "little"))


@dataclass(frozen=True)
class Event:
    """A message, or None for a frame that is none."""

    message: bytes | None


def events(
    stream: bytes, capacity: int = 65535, source: int = AGENT, destination: int = CLIENT
) -> list[Event]:
    """Return what a receiver at `destination` makes of a whole stream; a frame that has not ended counts for nothing.

    Cuts the stream at its flags first and looks at each part as a whole.
    """
    parts = stream.split(b"\x7e")[1:]
    found = [_event(part, capacity, bytes([source, destination])) for part in parts]
    if found and found[-1] == Event(None) and _unfinished(parts[-1], capacity, bytes([source, destination])):
        found.pop()
    return [event for event in found if event is not None]


def _event(part: bytes, capacity: int, addresses: bytes) -> Event | None:
    if not part:
        return None
    right = re.match(rb"(?:\x7d[\x5d\x5e]|[^\x7d])*", part, re.DOTALL)
    assert right is not None
    plain = re.sub(rb"\x7d(.)", lambda pair: bytes([pair[1][0] ^ 0x20]), right[0], flags=re.DOTALL)
    size = int.from_bytes(plain[2:4], "little")
    if plain[:2] != addresses or len(plain) < size + 6 or not 0 < size <= capacity:
        return Event(None)
    payload, crc = plain[4 : size + 4], int.from_bytes(plain[size + 4 : size + 6], "little")
    return Event(payload if crc == crc16(payload) else None)


def _unfinished(part: bytes, capacity: int, addresses: bytes) -> bool:
    """Whether more bytes could still make a frame of this part."""
    if re.fullmatch(rb"(?:\x7d[\x5d\x5e]|[^\x7d])*\x7d?", part, re.DOTALL) is None:
        return False
    plain = re.sub(rb"\x7d(.)", lambda pair: bytes([pair[1][0] ^ 0x20]), part, flags=re.DOTALL)
    plain = plain.removesuffix(b"\x7d") if part.endswith(b"\x7d") else plain
    size = int.from_bytes(plain[2:4], "little")
    if not addresses.startswith(plain[:2]) or (len(plain) >= 4 and not 0 < size <= capacity):
        return False
    return len(plain) < 4 or len(plain) < size + 6
