# SPDX-License-Identifier: Apache-2.0
"""Interface types: immutable, valid once constructed (names and bounds are checked by the step that builds them).

Source of names and numbers: REP-2011 and type_description_interfaces/msg/FieldType of ROS 2 Jazzy.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import NamedTuple

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class _PrimitiveFacts:
    size: int
    c_type: str
    field_type_id: int


class Primitive(Enum):
    """A primitive type of fixed size; the value is its name in a .msg file (`byte` and `char` are their own).

    The last three exist in .idl files alone: a character of IDL, a wide one, and `long double`.
    """

    BOOL = "bool"
    BYTE = "byte"
    CHAR = "char"
    FLOAT32 = "float32"
    FLOAT64 = "float64"
    INT8 = "int8"
    UINT8 = "uint8"
    INT16 = "int16"
    UINT16 = "uint16"
    INT32 = "int32"
    UINT32 = "uint32"
    INT64 = "int64"
    UINT64 = "uint64"
    IDL_CHAR = "idl char"
    WCHAR = "wchar"
    LONG_DOUBLE = "long double"

    @property
    def in_msg(self) -> bool:
        """Whether .msg, .srv and .action files have it."""
        return self not in (Primitive.IDL_CHAR, Primitive.WCHAR, Primitive.LONG_DOUBLE)

    @property
    def size(self) -> int:
        """Size and alignment in XCDR1, bytes."""
        return _FACTS[self].size

    @property
    def c_type(self) -> str:
        """The type of rosidl_generator_c."""
        return _FACTS[self].c_type

    @property
    def field_type_id(self) -> int:
        """The FIELD_TYPE number of type_description_interfaces/msg/FieldType (scalar)."""
        return _FACTS[self].field_type_id


# `char` is uint8 in .msg files (rosidl_adapter), `byte` is octet.
_FACTS: Mapping[Primitive, _PrimitiveFacts] = {
    Primitive.BOOL: _PrimitiveFacts(1, "bool", 15),
    Primitive.BYTE: _PrimitiveFacts(1, "uint8_t", 16),
    Primitive.CHAR: _PrimitiveFacts(1, "uint8_t", 3),
    Primitive.FLOAT32: _PrimitiveFacts(4, "float", 10),
    Primitive.FLOAT64: _PrimitiveFacts(8, "double", 11),
    Primitive.INT8: _PrimitiveFacts(1, "int8_t", 2),
    Primitive.UINT8: _PrimitiveFacts(1, "uint8_t", 3),
    Primitive.INT16: _PrimitiveFacts(2, "int16_t", 4),
    Primitive.UINT16: _PrimitiveFacts(2, "uint16_t", 5),
    Primitive.INT32: _PrimitiveFacts(4, "int32_t", 6),
    Primitive.UINT32: _PrimitiveFacts(4, "uint32_t", 7),
    Primitive.INT64: _PrimitiveFacts(8, "int64_t", 8),
    Primitive.UINT64: _PrimitiveFacts(8, "uint64_t", 9),
    Primitive.IDL_CHAR: _PrimitiveFacts(1, "signed char", 13),
    Primitive.WCHAR: _PrimitiveFacts(2, "uint16_t", 14),
    Primitive.LONG_DOUBLE: _PrimitiveFacts(16, "long double", 12),
}


@dataclass(frozen=True)
class StringType:
    """`string` or `wstring`; `bound` counts characters without the terminator, None is unbounded."""

    wide: bool = False
    bound: int | None = None


class TypeName(NamedTuple):
    """The full name of an interface type: `sensor_msgs/msg/Imu`. `kind` is msg, srv or action.

    A tuple, because names are compared and hashed more often than anything else.
    """

    package: str
    kind: str
    name: str

    def __str__(self) -> str:
        return f"{self.package}/{self.kind}/{self.name}"


@dataclass(frozen=True)
class NamedType:
    """A field of another message's type."""

    name: TypeName


ElementType = Primitive | StringType | NamedType


@dataclass(frozen=True)
class ArrayType:
    """`T[N]`: exactly `size` elements."""

    element: ElementType
    size: int


@dataclass(frozen=True)
class SequenceType:
    """`T[]` (bound None) or `T[<=N]`."""

    element: ElementType
    bound: int | None = None


FieldType = ElementType | ArrayType | SequenceType
ScalarValue = bool | int | float | str
Value = ScalarValue | tuple[ScalarValue, ...]


@dataclass(frozen=True)
class Constant:
    """A constant: `value` has the Python type of `type` (a string without quotes, escapes resolved)."""

    name: str
    type: Primitive | StringType
    value: ScalarValue
    comment: tuple[str, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class Field:
    """A member; `default` is None where the file gives none; `comment` holds the lines of its documentation."""

    name: str
    type: FieldType
    default: Value | None = None
    comment: tuple[str, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class Message:
    """A message type (also a Request, a Goal, …), as its file declares it; `fields` may be empty."""

    name: TypeName
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...] = ()
    comment: tuple[str, ...] = ()
    span: Span | None = None


@dataclass(frozen=True)
class Service:
    """A service type with what ROS 2 derives from it: `pkg/srv/Name_Request`, `_Response` and `_Event`."""

    name: TypeName
    request: Message
    response: Message
    event: Message
    comment: tuple[str, ...] = ()
    span: Span | None = None

    @property
    def messages(self) -> tuple[Message, ...]:
        """Every message of it; a later one may use an earlier one."""
        return (self.request, self.response, self.event)


@dataclass(frozen=True)
class Action:
    """An action type with what ROS 2 derives from it (rosidl: `_SendGoal`, `_GetResult`, `_FeedbackMessage`)."""

    name: TypeName
    goal: Message
    result: Message
    feedback: Message
    send_goal: Service
    get_result: Service
    feedback_message: Message
    comment: tuple[str, ...] = ()
    span: Span | None = None

    @property
    def messages(self) -> tuple[Message, ...]:
        """Every message of it; a later one may use an earlier one."""
        own = (self.goal, self.result, self.feedback)
        return (*own, *self.send_goal.messages, *self.get_result.messages, self.feedback_message)


Declaration = Message | Service | Action
"""What one interface file declares."""


def element_of(field_type: FieldType) -> ElementType:
    """Return the type of one element (of a scalar: itself)."""
    return field_type.element if isinstance(field_type, (ArrayType, SequenceType)) else field_type
