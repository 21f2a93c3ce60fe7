# SPDX-License-Identifier: Apache-2.0
"""Random contents of messages as plain trees, as ROS 2 messages and as C structs (ctypes)."""

from __future__ import annotations

import ctypes
import importlib
import math
import random
import struct
import sys
from collections.abc import Iterator, Mapping
from typing import Any

from microros_gen.interfaces.derived import declaring_name
from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.names import snake_case
from microros_gen.typesupport.plan.size import FieldLimits, TypeLimits, members

C_TYPES: dict[Primitive, Any] = {
    Primitive.BOOL: ctypes.c_bool,
    Primitive.BYTE: ctypes.c_uint8,
    Primitive.CHAR: ctypes.c_uint8,
    Primitive.FLOAT32: ctypes.c_float,
    Primitive.FLOAT64: ctypes.c_double,
    Primitive.INT8: ctypes.c_int8,
    Primitive.UINT8: ctypes.c_uint8,
    Primitive.INT16: ctypes.c_int16,
    Primitive.UINT16: ctypes.c_uint16,
    Primitive.INT32: ctypes.c_int32,
    Primitive.UINT32: ctypes.c_uint32,
    Primitive.INT64: ctypes.c_int64,
    Primitive.UINT64: ctypes.c_uint64,
    Primitive.IDL_CHAR: ctypes.c_int8,
    Primitive.WCHAR: ctypes.c_uint16,
}
FLOAT_EDGES = {
    Primitive.FLOAT32: (0.0, -0.0, -1.5, math.inf, -math.inf, 2.0**-149, -(2.0**-126), 3.4e38),
    Primitive.FLOAT64: (0.0, -0.0, -1.5, math.inf, -math.inf, 5e-324, -(2.0**-1022), sys.float_info.max),
}
"""Zeros, infinities, numbers that are smallest, smallest with all digits, largest (for rclpy, of 32 bits)."""
LETTERS = "abcXYZ 0123'\"\\?éß→ハ"
WIDE_LETTERS = "aZ éハ"
Tree = dict[str, Any]


class Randomizer:
    """Makes trees. `mode`: `empty`, `full` (everything at its limit) or `random`."""

    def __init__(self, messages: Mapping[TypeName, Message], seed: int) -> None:
        self._messages = messages
        self._random = random.Random(seed)

    def tree(self, name: TypeName, limits: TypeLimits | None, mode: str) -> Tree:
        fields = self._messages[name].fields
        entries = limits.fields if limits else (None,) * len(fields)
        return {f.name: self._field(f, e, mode) for f, e in zip(fields, entries, strict=True)}

    def _field(self, field: Field, limits: FieldLimits | None, mode: str) -> Any:
        element = element_of(field.type)
        if isinstance(field.type, ArrayType):
            return [self._element(element, limits, mode) for _ in range(field.type.size)]
        if isinstance(field.type, SequenceType):
            most = limits.sequence or 0 if limits else 0
            count = {"empty": 0, "full": most}.get(mode, self._random.randint(0, most))
            return [self._element(element, limits, mode) for _ in range(count)]
        return self._element(element, limits, mode)

    def _element(self, element: ElementType, limits: FieldLimits | None, mode: str) -> Any:
        if isinstance(element, NamedType):
            return self.tree(element.name, limits.nested if limits else None, mode)
        if isinstance(element, StringType):
            return self._text(element, limits.string or 0 if limits else 0, mode)
        return self._number(element)

    def _text(self, element: StringType, most: int, mode: str) -> str:
        length = {"empty": 0, "full": most}.get(mode, self._random.randint(0, most))
        if element.wide:
            return "".join(self._random.choice(WIDE_LETTERS) for _ in range(length))
        text = "".join(self._random.choice(LETTERS) for _ in range(length))
        while len(text.encode()) > length:
            text = text[:-1]
        return text + "x" * (length - len(text.encode()))

    def _number(self, primitive: Primitive) -> Any:
        if primitive is Primitive.BOOL:
            return self._random.random() < 0.5
        bits = 8 * primitive.size
        if primitive in (Primitive.FLOAT32, Primitive.FLOAT64):
            value = self._random.choice([*FLOAT_EDGES[primitive], self._random.uniform(-1e6, 1e6)])
            return struct.unpack("<f", struct.pack("<f", value))[0] if bits == 32 else value
        signed = primitive.value.startswith("int") or primitive is Primitive.IDL_CHAR
        low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)
        return self._random.choice([low, high, self._random.randint(low, high)])


def to_ros(messages: Mapping[TypeName, Message], name: TypeName, tree: Tree) -> Any:
    """Return the rclpy message with these contents."""
    message = ros_class(name)()
    for field in messages[name].fields:
        element = element_of(field.type)

        def one(value: Any, element: ElementType = element) -> Any:
            if isinstance(element, NamedType):
                return to_ros(messages, element.name, value)
            return bytes([value]) if element is Primitive.BYTE else value

        many = isinstance(field.type, (ArrayType, SequenceType))
        value = tree[field.name]
        setattr(message, field.name, [one(v) for v in value] if many else one(value))
    return message


def from_ros(messages: Mapping[TypeName, Message], name: TypeName, message: Any) -> Tree:
    """Return the contents of an rclpy message."""
    tree: Tree = {}
    for field in messages[name].fields:
        element = element_of(field.type)

        def one(value: Any, element: ElementType = element) -> Any:
            if isinstance(element, NamedType):
                return from_ros(messages, element.name, value)
            if element is Primitive.BYTE:
                return value[0]
            return value.item() if hasattr(value, "item") else value

        value = getattr(message, field.name)
        many = isinstance(field.type, (ArrayType, SequenceType))
        tree[field.name] = [one(v) for v in value] if many else one(value)
    return tree


def ros_class(name: TypeName) -> Any:
    """Return the Python class of a ROS 2 message."""
    module = f"{name.package}.{name.kind}._{snake_case(declaring_name(name).name)}"
    return getattr(importlib.import_module(module), name.name)


class CString(ctypes.Structure):
    _fields_ = (("data", ctypes.c_void_p), ("size", ctypes.c_size_t), ("capacity", ctypes.c_size_t))


class CStructs:
    """ctypes structures of messages, and contents to and from them. It keeps every buffer alive."""

    def __init__(self, messages: Mapping[TypeName, Message]) -> None:
        self._messages = messages
        self._known: dict[TypeName, Any] = {}
        self._alive: list[Any] = []

    def structure(self, name: TypeName) -> Any:
        """Return the ctypes class of the message's struct."""
        if name not in self._known:
            parts = [(f.name, self._type(f)) for f in members(self._messages[name])]
            self._known[name] = type(name.name, (ctypes.Structure,), {"_fields_": parts})
        return self._known[name]

    def fill(self, name: TypeName, tree: Tree) -> Any:
        """Return a struct with these contents; strings end with NUL, capacities equal sizes."""
        value = self.structure(name)()
        self._fill(name, value, tree)
        return value

    def read(self, name: TypeName, value: Any) -> Tree:
        """Return the contents of a struct."""
        tree: Tree = {}
        for field in self._messages[name].fields:
            element = element_of(field.type)
            member = getattr(value, field.name)
            if isinstance(field.type, ArrayType):
                tree[field.name] = [self._read(element, v) for v in member]
            elif isinstance(field.type, SequenceType):
                items = (self._element_type(element) * member.size).from_address(member.data or 0)
                tree[field.name] = [self._read(element, v) for v in items] if member.size else []
            else:
                tree[field.name] = self._read(element, member)
        return tree

    def strings(self, name: TypeName, value: Any, path: str = "") -> Iterator[tuple[str, Any, bool]]:
        """Yield every string and sequence of a struct: path, the C struct of it, whether it is a string."""
        for field in self._messages[name].fields:
            element = element_of(field.type)
            member = getattr(value, field.name)
            here = f"{path}.{field.name}" if path else field.name
            if isinstance(field.type, SequenceType):
                yield here, member, False
                items: Any = (self._element_type(element) * member.size).from_address(member.data or 0)
                items = items if member.size else ()
            else:
                items = member if isinstance(field.type, ArrayType) else (member,)
            many = "[]" if isinstance(field.type, (ArrayType, SequenceType)) else ""
            for item in items:
                if isinstance(element, StringType):
                    yield here + many, item, True
                elif isinstance(element, NamedType):
                    yield from self.strings(element.name, item, here + many)

    def _type(self, field: Field) -> Any:
        if isinstance(field.type, SequenceType):
            return CString
        element = self._element_type(element_of(field.type))
        return element * field.type.size if isinstance(field.type, ArrayType) else element

    def _element_type(self, element: ElementType) -> Any:
        if isinstance(element, Primitive):
            return C_TYPES[element]
        return CString if isinstance(element, StringType) else self.structure(element.name)

    def _fill(self, name: TypeName, value: Any, tree: Tree) -> None:
        for field in self._messages[name].fields:
            element = element_of(field.type)
            content = tree[field.name]
            if isinstance(field.type, ArrayType):
                target = getattr(value, field.name)
                for index, item in enumerate(content):
                    target[index] = self._make(element, item)
            elif isinstance(field.type, SequenceType):
                items = (self._element_type(element) * len(content))(
                    *(self._make(element, c) for c in content)
                )
                setattr(value, field.name, self._buffer(items, len(content)))
            else:
                setattr(value, field.name, self._make(element, content))

    def _make(self, element: ElementType, content: Any) -> Any:
        if isinstance(element, NamedType):
            return self.fill(element.name, content)
        if isinstance(element, StringType):
            if element.wide:
                raw = content.encode("utf-16-le")
                return self._buffer(ctypes.create_string_buffer(raw + b"\0", len(raw) + 2), len(raw) // 2)
            raw = content.encode()
            return self._buffer(ctypes.create_string_buffer(raw), len(raw))
        return content

    def _buffer(self, data: Any, size: int) -> CString:
        self._alive.append(data)
        address = ctypes.addressof(data) if ctypes.sizeof(data) else None
        return CString(address, size, size)

    def _read(self, element: ElementType, value: Any) -> Any:
        if isinstance(element, NamedType):
            return self.read(element.name, value)
        if isinstance(element, StringType):
            width = 2 if element.wide else 1
            raw = ctypes.string_at(value.data, value.size * width) if value.size else b""
            return raw.decode("utf-16-le" if element.wide else "utf-8", "replace")
        return value
