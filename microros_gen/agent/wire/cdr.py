# SPDX-License-Identifier: Apache-2.0
"""Bounds-checked reader and writer of XCDR1; alignment is relative to the first byte of the payload."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Final, TypeVar

from microros_gen.agent.wire.errors import MalformedError

T = TypeVar("T")
MOST_ELEMENTS: Final = 8_192
"""Maximum number of elements of a sequence: a message of 64 KiB holds no more samples with their lengths."""


class Reader:
    """Reader of one payload, `data[start:end]`. Every method raises MalformedError rather than read beyond its end."""

    def __init__(self, data: bytes, start: int, end: int, little: bool) -> None:
        self._data = data
        self._origin = start
        self._at = start
        self._end = min(end, len(data))
        self._order = "<" if little else ">"
        self.little = little

    def remaining(self) -> int:
        """Return the number of bytes not yet read."""
        return self._end - self._at

    def raw(self, size: int) -> bytes:
        """Return the next `size` bytes, unaligned."""
        if size > self._end - self._at:
            raise MalformedError("truncated", f"{size} bytes wanted, {self._end - self._at} left")
        start = self._at
        self._at += size
        return bytes(self._data[start : self._at])

    def rest(self) -> bytes:
        """Return all remaining bytes."""
        return self.raw(self._end - self._at)

    def u8(self) -> int:
        """Return an unsigned byte."""
        return self.raw(1)[0]

    def identifier(self) -> int:
        """Return a request or object id: two bytes, always high byte first."""
        pair = self.raw(2)
        return pair[0] << 8 | pair[1]

    def u16(self) -> int:
        """Return an unsigned 16-bit number, aligned to 2."""
        return self._number("H", 2)

    def i16(self) -> int:
        """Return a signed 16-bit number, aligned to 2."""
        return self._number("h", 2)

    def u32(self) -> int:
        """Return an unsigned 32-bit number, aligned to 4."""
        return self._number("I", 4)

    def u64(self) -> int:
        """Return an unsigned 64-bit number, aligned to 4 as in XCDR2 (XCDR1 would align it to 8)."""
        low, high = self.u32(), self.u32()
        return low | high << 32 if self.little else low << 32 | high

    def i32(self) -> int:
        """Return a signed 32-bit number, aligned to 4."""
        return self._number("i", 4)

    def flag(self) -> bool:
        """Return a boolean. Raises MalformedError for bytes other than 0 and 1."""
        value = self.u8()
        if value > 1:
            raise MalformedError("boolean", f"byte {value:#04x}")
        return value == 1

    def string(self) -> str:
        """Return a string: u32 length including the terminating NUL, then UTF-8. Length 0 means the empty string."""
        size = self.u32()
        if size == 0:
            return ""
        text = self.raw(size)
        if text[-1] != 0:
            raise MalformedError("string", "not terminated by NUL")
        try:
            return text[:-1].decode("utf-8")
        except UnicodeDecodeError as error:
            raise MalformedError("string", "invalid UTF-8") from error

    def octets(self) -> bytes:
        """Return a sequence of bytes: u32 count, then the bytes."""
        return self.raw(self.u32())

    def optional(self, read: Callable[[], T]) -> T | None:
        """Return None if the flag byte that comes first is 0, else what `read` returns."""
        return read() if self.flag() else None

    def sequence(self, read: Callable[[], T]) -> tuple[T, ...]:
        """Return a sequence: u32 count, then that many elements, each read by `read` and at least one byte long."""
        return tuple(read() for _ in range(self.count()))

    def count(self) -> int:
        """Return the u32 count of elements that follow, each at least one byte long; at most MOST_ELEMENTS."""
        count = self.u32()
        if count > self.remaining():
            raise MalformedError("truncated", f"{count} elements announced, {self.remaining()} bytes left")
        if count > MOST_ELEMENTS:
            raise MalformedError("too_many_elements", f"{count}; at most {MOST_ELEMENTS} are taken")
        return count

    def _number(self, code: str, size: int) -> int:
        self._at += -(self._at - self._origin) % size
        if self._at + size > self._end:
            raise MalformedError("truncated", f"{size} bytes wanted, {max(0, self._end - self._at)} left")
        (value,) = struct.unpack_from(self._order + code, self._data, self._at)
        self._at += size
        return int(value)


class Writer:
    """Writer of one payload; every method returns the writer. Padding bytes are 0."""

    def __init__(self, little: bool = True) -> None:
        self._out = bytearray()
        self._order = "<" if little else ">"
        self.little = little

    def content(self) -> bytes:
        """Return the bytes written so far."""
        return bytes(self._out)

    def raw(self, value: bytes) -> Writer:
        """Append bytes, unaligned."""
        self._out += value
        return self

    def u8(self, value: int) -> Writer:
        """Append an unsigned byte."""
        self._out.append(value)
        return self

    def identifier(self, value: int) -> Writer:
        """Append a request or object id, high byte first."""
        return self.raw(value.to_bytes(2, "big"))

    def u16(self, value: int) -> Writer:
        """Append an unsigned 16-bit number, aligned to 2."""
        return self._number("H", 2, value)

    def i16(self, value: int) -> Writer:
        """Append a signed 16-bit number, aligned to 2."""
        return self._number("h", 2, value)

    def u32(self, value: int) -> Writer:
        """Append an unsigned 32-bit number, aligned to 4."""
        return self._number("I", 4, value)

    def u64(self, value: int) -> Writer:
        """Append an unsigned 64-bit number, aligned to 4 as in XCDR2."""
        halves = value & 0xFFFFFFFF, value >> 32 & 0xFFFFFFFF
        first, second = halves if self.little else halves[::-1]
        return self.u32(first).u32(second)

    def i32(self, value: int) -> Writer:
        """Append a signed 32-bit number, aligned to 4."""
        return self._number("i", 4, value)

    def flag(self, value: bool) -> Writer:
        """Append a boolean."""
        return self.u8(1 if value else 0)

    def string(self, value: str) -> Writer:
        """Append a string: u32 length including the terminating NUL, then UTF-8 and the NUL."""
        text = value.encode("utf-8") + b"\0"
        return self.u32(len(text)).raw(text)

    def octets(self, value: bytes) -> Writer:
        """Append a sequence of bytes: u32 count, then the bytes."""
        return self.u32(len(value)).raw(value)

    def optional(self, write: Callable[[T], object], value: T | None) -> Writer:
        """Append the flag byte, followed by `value`, written by `write`, unless it is None."""
        self.flag(value is not None)
        if value is not None:
            write(value)
        return self

    def sequence(self, write: Callable[[T], object], values: tuple[T, ...]) -> Writer:
        """Append the u32 count, then each of `values`, written by `write`."""
        self.u32(len(values))
        for value in values:
            write(value)
        return self

    def _number(self, code: str, size: int, value: int) -> Writer:
        self._out += bytes(-len(self._out) % size)
        self._out += struct.pack(self._order + code, value)
        return self
