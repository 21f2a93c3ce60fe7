# SPDX-License-Identifier: Apache-2.0
"""The steps of a program: each writes and reads one member, or a run of adjacent numbers."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from microros_gen.interfaces.types import Primitive
from microros_gen.records import dataclass
from microros_gen.ros.errors import CodecError
from microros_gen.ros.texts import PADDING, check_room, read_count, write_count

CODES: Mapping[Primitive, str] = {
    Primitive.BOOL: "?",
    Primitive.BYTE: "B",
    Primitive.CHAR: "B",
    Primitive.FLOAT32: "f",
    Primitive.FLOAT64: "d",
    Primitive.INT8: "b",
    Primitive.UINT8: "B",
    Primitive.INT16: "h",
    Primitive.UINT16: "H",
    Primitive.INT32: "i",
    Primitive.UINT32: "I",
    Primitive.INT64: "q",
    Primitive.UINT64: "Q",
    Primitive.IDL_CHAR: "b",
    Primitive.WCHAR: "H",
}
"""Formats of `struct`; long double has none."""
OCTETS = (Primitive.BYTE, Primitive.CHAR, Primitive.UINT8)
"""Element types whose arrays and sequences are bytes in Python."""
_FLOATS = (Primitive.FLOAT32, Primitive.FLOAT64)
_UNPACKABLE = (struct.error, OverflowError, TypeError, ValueError)


@dataclass(frozen=True)
class Place:
    """A member: the number of its container, its name there, its path in the message, and its default."""

    container: int
    name: str
    path: str
    default: Any

    def value(self, containers: Sequence[Mapping[str, Any]]) -> Any:
        """Return the value of the member, or its default if the message omits it."""
        return containers[self.container].get(self.name, self.default)


class Step(Protocol):
    """A part of a message, in the order of the wire."""

    def write(self, containers: Sequence[Mapping[str, Any]], out: bytearray) -> None:
        """Append the member to `out`, from whose start alignment counts. Raises CodecError for an invalid value."""

    def read(self, data: memoryview, at: int, order: str, containers: Sequence[dict[str, Any]]) -> int:
        """Read the member at position `at` into its container; return the position after it.

        `order` is `<` or `>`, as in `struct`. Raises CodecError if the data end too early or exceed a bound.
        """


class Element(Protocol):
    """The element type of an array or sequence: a string or a message."""

    def write(self, value: Any, out: bytearray) -> None:
        """Append one element to `out`. Raises CodecError for an invalid value."""

    def read(self, data: memoryview, at: int, order: str) -> tuple[Any, int]:
        """Return the element at position `at`, and the position after it. Raises CodecError for invalid data."""


class Run:
    """Adjacent numbers, written and read in one call; the place None is the placeholder member of an empty message."""

    def __init__(self, members: Sequence[tuple[Place | None, Primitive]]) -> None:
        self._members = [member for member in members if member[0] is not None]
        self._layout = [(CODES[kind] if place else "x", kind.size) for place, kind in members]
        places = [place for place, _ in members if place is not None]
        self._reads = [(place.container, place.name, place.default) for place in places]
        self._bools = [i for i, (_, kind) in enumerate(self._members) if kind is Primitive.BOOL]
        self._structs: dict[tuple[str, int], struct.Struct] = {}

    def write(self, containers: Sequence[Mapping[str, Any]], out: bytearray) -> None:
        """Append the member; see `Step.write`."""
        values = [containers[number].get(name, default) for number, name, default in self._reads]
        for i in self._bools:
            if not isinstance(values[i], bool):
                raise self._refused(values)
        try:
            out += self._struct("<", len(out)).pack(*values)
        except _UNPACKABLE:
            raise self._refused(values) from None

    def read(self, data: memoryview, at: int, order: str, containers: Sequence[dict[str, Any]]) -> int:
        """Read the member; see `Step.read`."""
        layout = self._struct(order, at)
        end = at + layout.size
        if end > len(data):
            raise self._missing(at, len(data))
        values = layout.unpack_from(data, at)
        for (number, name, _), value in zip(self._reads, values, strict=True):
            containers[number][name] = value
        return end

    def _struct(self, order: str, at: int) -> struct.Struct:
        """Return the layout of a run at position `at`: padding depends on the position modulo 8."""
        key = (order, at & 7)
        found = self._structs.get(key)
        if found is None:
            text, position = order, at & 7
            for code, size in self._layout:
                padding = -position % size
                text += "x" * padding + code
                position += padding + size
            found = self._structs[key] = struct.Struct(text)
        return found

    def _refused(self, values: Sequence[Any]) -> CodecError:
        for (place, kind), value in zip(self._members, values, strict=True):
            if place is not None and not fits(kind, value):
                return CodecError(unfit(kind, value), place.path)
        raise AssertionError("every number fits, and together they do not")

    def _missing(self, at: int, end: int) -> CodecError:
        """Return the error that names the first number beyond the end of the data."""
        members = iter(self._members)
        for code, size in self._layout:
            at += -at % size + size
            place = None if code == "x" else next(members)[0]
            if at > end:
                break
        return CodecError(
            f"the data end before it does: {at} bytes are needed, there are {end}",
            place.path if place else "",
        )


class _Several:
    """An array of `size` elements, or a sequence with a bound or none."""

    def __init__(self, place: Place, size: int | None, bound: int | None) -> None:
        self.place = place
        self.size = size
        self.bound = bound

    def write(self, containers: Sequence[Mapping[str, Any]], out: bytearray) -> None:
        """Append the member; see `Step.write`."""
        try:
            elements = self._elements(self.place.value(containers))
            self._check_count(len(elements))
            if self.size is None:
                write_count(len(elements), out)
            if elements:
                self._write(elements, out)
        except CodecError as error:
            raise error.within(self.place.path) from None

    def read(self, data: memoryview, at: int, order: str, containers: Sequence[dict[str, Any]]) -> int:
        """Read the member; see `Step.read`."""
        try:
            count = self.size
            if count is None:
                count, at = read_count(data, at, order)
                self._check_count(count)
            check_room(data, at, count)  # each takes a byte, or more
            value, at = self._read(data, at, order, count)
        except CodecError as error:
            raise error.within(self.place.path) from None
        containers[self.place.container][self.place.name] = value
        return at

    def _check_count(self, count: int) -> None:
        if self.size is not None and count != self.size:
            raise CodecError(f"{count} elements are not {self.size}")
        if self.bound is not None and count > self.bound:
            raise CodecError(f"{count} elements are more than its bound, {self.bound}")

    def _elements(self, value: Any) -> Sequence[Any]:
        if isinstance(value, (str, Mapping)) or not hasattr(value, "__len__"):
            raise CodecError(f"{value!r:.60} is not a list")
        return value if isinstance(value, (list, tuple)) else list(value)

    def _write(self, elements: Sequence[Any], out: bytearray) -> None:
        raise NotImplementedError

    def _read(self, data: memoryview, at: int, order: str, count: int) -> tuple[Any, int]:
        raise NotImplementedError


class Numbers(_Several):
    """An array or sequence of numbers of one type."""

    def __init__(self, place: Place, kind: Primitive, size: int | None, bound: int | None) -> None:
        super().__init__(place, size, bound)
        self._kind = kind
        self._code = CODES[kind]

    def _write(self, elements: Sequence[Any], out: bytearray) -> None:
        if self._code == "?" and not all(isinstance(element, bool) for element in elements):
            raise _refused_element(self._kind, elements)
        out += PADDING[-len(out) % self._kind.size]
        try:
            out += struct.pack(f"<{len(elements)}{self._code}", *elements)
        except _UNPACKABLE:
            raise _refused_element(self._kind, elements) from None

    def _read(self, data: memoryview, at: int, order: str, count: int) -> tuple[list[Any], int]:
        if not count:  # nothing is aligned for what is not there
            return [], at
        at += -at % self._kind.size
        check_room(data, at, count * self._kind.size)
        values = struct.unpack_from(f"{order}{count}{self._code}", data, at)
        return list(values), at + count * self._kind.size


class Octets(_Several):
    """An array or sequence of `byte`, `char` or `uint8`: bytes in Python."""

    def __init__(self, place: Place, kind: Primitive, size: int | None, bound: int | None) -> None:
        super().__init__(place, size, bound)
        self._kind = kind

    def _elements(self, value: Any) -> Sequence[Any]:
        if isinstance(value, (bytes, bytearray)):
            return value
        elements = super()._elements(value)
        try:
            return bytes(elements)
        except (TypeError, ValueError):
            raise _refused_element(self._kind, elements) from None

    def _write(self, elements: Sequence[Any], out: bytearray) -> None:
        out += bytes(elements)

    def _read(self, data: memoryview, at: int, order: str, count: int) -> tuple[bytes, int]:
        return bytes(data[at : at + count]), at + count


class Many(_Several):
    """An array or sequence of strings or messages."""

    def __init__(self, place: Place, element: Element, size: int | None, bound: int | None) -> None:
        super().__init__(place, size, bound)
        self._element = element

    def _write(self, elements: Sequence[Any], out: bytearray) -> None:
        write = self._element.write
        for i, element in enumerate(elements):
            try:
                write(element, out)
            except CodecError as error:
                raise error.within(f"[{i}]") from None

    def _read(self, data: memoryview, at: int, order: str, count: int) -> tuple[list[Any], int]:
        values: list[Any] = []
        read = self._element.read
        try:
            for _ in range(count):
                value, at = read(data, at, order)
                values.append(value)
        except CodecError as error:
            raise error.within(f"[{len(values)}]") from None
        return values, at


class Text:
    """A string member."""

    def __init__(self, place: Place, element: Element) -> None:
        self._place = place
        self._element = element

    def write(self, containers: Sequence[Mapping[str, Any]], out: bytearray) -> None:
        """Append the member; see `Step.write`."""
        try:
            self._element.write(self._place.value(containers), out)
        except CodecError as error:
            raise error.within(self._place.path) from None

    def read(self, data: memoryview, at: int, order: str, containers: Sequence[dict[str, Any]]) -> int:
        """Read the member; see `Step.read`."""
        try:
            value, at = self._element.read(data, at, order)
        except CodecError as error:
            raise error.within(self._place.path) from None
        containers[self._place.container][self._place.name] = value
        return at


def fits(kind: Primitive, value: Any) -> bool:
    """Return whether `value` is a number of this type."""
    if kind is Primitive.BOOL:
        return isinstance(value, bool)
    try:
        struct.pack(f"<{CODES[kind]}", value)
    except _UNPACKABLE:
        return False
    return True


def unfit(kind: Primitive, value: Any) -> str:
    """Return why `value` is not a number of this type, as a reason for CodecError."""
    if kind is Primitive.BOOL:
        wanted = "True or False"
    elif kind in _FLOATS:
        wanted = f"a {kind.value}"
    else:
        bits = 8 * kind.size
        signed = CODES[kind].islower()
        low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)
        article = "an" if kind.value.startswith("int") else "a"
        wanted = f"{article} {kind.value} ({low} to {high})"
    return f"{value!r:.60} is not {wanted}"


def _refused_element(kind: Primitive, elements: Sequence[Any]) -> CodecError:
    wrong = next(i for i, element in enumerate(elements) if not fits(kind, element))
    return CodecError(unfit(kind, elements[wrong]), f"[{wrong}]")
