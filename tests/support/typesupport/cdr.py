# SPDX-License-Identifier: Apache-2.0
"""CDR in either byte order to and from a tree of contents, written from the standard (OMG CDR, 9.3).

It shares nothing with the generator but the model of the types. What ROS 2 Jazzy does besides the standard: a wide
string has no terminator and four bytes for each unit, a message without members is one byte, and a string ends at its
first NUL or where its length says.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import Any

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)

FORMATS = {
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
Tree = Mapping[str, Any]


def encode(messages: Mapping[TypeName, Message], name: TypeName, tree: Tree, big: bool) -> bytes:
    """Return the body, big or little endian, padding zero; every NaN as the same one."""
    writer = _Writer(messages, ">" if big else "<")
    writer.message(name, tree)
    return bytes(writer.body)


class _Writer:
    def __init__(self, messages: Mapping[TypeName, Message], order: str) -> None:
        self._messages = messages
        self._order = order
        self.body = bytearray()

    def message(self, name: TypeName, tree: Tree) -> None:
        fields = self._messages[name].fields
        if not fields:
            self.body.append(0)
        for field in fields:
            element = element_of(field.type)
            value = tree[field.name]
            if isinstance(field.type, SequenceType):
                self._number(Primitive.UINT32, len(value))
            many = isinstance(field.type, (ArrayType, SequenceType))
            for item in value if many else (value,):
                self._element(element, item)

    def _element(self, element: ElementType, value: Any) -> None:
        if isinstance(element, NamedType):
            self.message(element.name, value)
        elif isinstance(element, StringType) and element.wide:
            units = value.encode("utf-16-le", "surrogatepass")
            self._number(Primitive.UINT32, len(units) // 2)
            for (unit,) in struct.iter_unpack("<H", units):
                self._number(Primitive.UINT32, unit)
        elif isinstance(element, StringType):
            text = value.encode() + b"\0"
            self._number(Primitive.UINT32, len(text))
            self.body += text
        else:
            assert isinstance(element, Primitive)
            self._number(element, value)

    def _number(self, primitive: Primitive, value: Any) -> None:
        value = math.nan if isinstance(value, float) and math.isnan(value) else value
        self.body += bytes(-len(self.body) % primitive.size)
        self.body += struct.pack(self._order + FORMATS[primitive], value)


class RefusedError(Exception):
    """The bytes are no message of the type: they end early, or a wide character has more than 16 bits."""


def decode(messages: Mapping[TypeName, Message], name: TypeName, body: bytes, big: bool) -> dict[str, Any]:
    """Return the contents; what is after them is ignored. Raises RefusedError."""
    return _Reader(messages, body, ">" if big else "<").message(name)


class _Reader:
    def __init__(self, messages: Mapping[TypeName, Message], body: bytes, order: str) -> None:
        self._messages = messages
        self._body = body
        self._order = order
        self._position = 0

    def message(self, name: TypeName) -> dict[str, Any]:
        fields = self._messages[name].fields
        if not fields:
            self._bytes(1)
        tree: dict[str, Any] = {}
        for field in fields:
            element = element_of(field.type)
            if isinstance(field.type, SequenceType):
                tree[field.name] = [self._element(element) for _ in range(self._length(1))]
            elif isinstance(field.type, ArrayType):
                tree[field.name] = [self._element(element) for _ in range(field.type.size)]
            else:
                tree[field.name] = self._element(element)
        return tree

    def _element(self, element: ElementType) -> Any:
        if isinstance(element, NamedType):
            return self.message(element.name)
        if isinstance(element, StringType) and element.wide:
            units = [self._number(Primitive.UINT32) for _ in range(self._length(4))]
            if any(unit > 0xFFFF for unit in units):
                raise RefusedError
            return struct.pack(f"<{len(units)}H", *units).decode("utf-16-le", "replace")
        if isinstance(element, StringType):
            return self._bytes(self._length(1)).split(b"\0")[0].decode("utf-8", "replace")
        assert isinstance(element, Primitive)
        return self._number(element)

    def _length(self, width: int) -> int:
        length: int = self._number(Primitive.UINT32)
        if length * width > len(self._body) - self._position:
            raise RefusedError
        return length

    def _number(self, primitive: Primitive) -> Any:
        self._bytes(-self._position % primitive.size)
        return struct.unpack(self._order + FORMATS[primitive], self._bytes(primitive.size))[0]

    def _bytes(self, count: int) -> bytes:
        found = self._body[self._position : self._position + count]
        if len(found) < count:
            raise RefusedError
        self._position += count
        return found
