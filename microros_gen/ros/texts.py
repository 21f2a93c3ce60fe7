# SPDX-License-Identifier: Apache-2.0
"""Strings in CDR (OMG DDS-XTypes 1.3, 7.4.1) as rmw_fastrtps_cpp of ROS 2 Jazzy encodes them."""

from __future__ import annotations

import struct
from typing import Any

from microros_gen.ros.errors import CodecError

_COUNTS = {"<": struct.Struct("<I"), ">": struct.Struct(">I")}
COUNT_BYTES = 4
PADDING = tuple(bytes(count) for count in range(8))
_LARGEST_UNIT = 0xFFFF


def write_count(count: int, out: bytearray) -> None:
    """Append a 32-bit count after padding to a multiple of 4."""
    out += PADDING[-len(out) % COUNT_BYTES]
    out += _COUNTS["<"].pack(count)


def read_count(data: memoryview, at: int, order: str) -> tuple[int, int]:
    """Return a 32-bit count and the position after it."""
    at += -at % COUNT_BYTES
    check_room(data, at, COUNT_BYTES)
    return _COUNTS[order].unpack_from(data, at)[0], at + COUNT_BYTES


def check_room(data: memoryview, at: int, needed: int) -> None:
    """Raise CodecError if `data` has fewer than `needed` bytes from `at` on."""
    left = max(0, len(data) - at)
    if needed > left:
        raise CodecError(f"the data end before it does: {needed} bytes are needed, {left} are left")


class Characters:
    """`string`: byte count including the NUL, UTF-8, NUL. The bound counts bytes without the NUL, as on the device."""

    def __init__(self, bound: int | None) -> None:
        self.bound = bound

    def write(self, value: Any, out: bytearray) -> None:
        """Append a string. Raises CodecError for other types, a NUL, a lone surrogate, or a string above the bound."""
        content = self._encoded(value, "utf-8")
        if b"\0" in content:
            raise CodecError("a NUL would end the string")
        self.check_bound(len(content), "bytes")
        write_count(len(content) + 1, out)
        out += content
        out += b"\0"

    def read(self, data: memoryview, at: int, order: str) -> tuple[str, int]:
        """Return a string and the position after it. A count of 0 and a missing NUL are accepted, as in ROS 2."""
        count, at = read_count(data, at, order)
        check_room(data, at, count)
        content = bytes(data[at : at + count]).partition(b"\0")[0]
        self.check_bound(len(content), "bytes")
        return content.decode("utf-8", "replace"), at + count

    def check_bound(self, count: int, unit: str) -> None:
        """Raise CodecError if a string exceeds the bound of its type."""
        if self.bound is not None and count > self.bound:
            raise CodecError(f"{count} {unit} are more than its bound, {self.bound}")

    @staticmethod
    def _encoded(value: Any, encoding: str) -> bytes:
        if not isinstance(value, str):
            raise CodecError(f"{value!r:.60} is not a string")
        try:
            return value.encode(encoding)
        except UnicodeEncodeError as error:
            raise CodecError(f"its character {error.start} is half of a surrogate pair") from None


class WideCharacters(Characters):
    """`wstring`: count of UTF-16 units, then each unit in four bytes; no NUL (rmw_fastrtps_cpp of Jazzy)."""

    def write(self, value: Any, out: bytearray) -> None:
        """Append a wide string. Raises CodecError for other types, a lone surrogate, or a string above the bound."""
        content = self._encoded(value, "utf-16-le")
        units = struct.unpack(f"<{len(content) // 2}H", content)
        self.check_bound(len(units), "UTF-16 units")
        write_count(len(units), out)
        out += struct.pack(f"<{len(units)}I", *units)

    def read(self, data: memoryview, at: int, order: str) -> tuple[str, int]:
        """Return a wide string and the position after it. Raises CodecError for a unit above 0xFFFF."""
        count, at = read_count(data, at, order)
        check_room(data, at, 4 * count)
        self.check_bound(count, "UTF-16 units")
        units = struct.unpack_from(f"{order}{count}I", data, at)
        if any(unit > _LARGEST_UNIT for unit in units):
            raise CodecError(f"{max(units):#x} is not a unit of UTF-16")
        text = struct.pack(f"<{count}H", *units).decode("utf-16-le", "replace")
        return text, at + 4 * count
