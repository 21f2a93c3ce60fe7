# SPDX-License-Identifier: Apache-2.0
"""Messages as text: YAML, comma-separated values, and one line as rclpy prints it.

Messages are dicts (see `ros.codec`). The output is that of the ros2 command line of Jazzy for the same message.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import Any

import yaml

from microros_gen.interfaces.types import (
    ArrayType,
    ElementType,
    Field,
    FieldType,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.records import dataclass

Messages = Mapping[TypeName, Message]
"""Message types by name, with all nested ones."""
Value = Mapping[str, Any]

DEFAULT_LENGTH = 128
"""Elements and characters after which `topic echo` writes `...`."""
_TYPE_NAMES = {
    Primitive.BOOL: "boolean",
    Primitive.BYTE: "octet",
    Primitive.CHAR: "uint8",
    Primitive.FLOAT32: "float",
    Primitive.FLOAT64: "double",
    Primitive.IDL_CHAR: "char",
    Primitive.LONG_DOUBLE: "long double",
}
"""Names of IDL (rosidl_parser), where they differ from those of .msg files."""
_CHARACTERS = (Primitive.IDL_CHAR, Primitive.WCHAR)


@dataclass(frozen=True)
class Style:
    """What of a message is shown.

    `length`: the most characters of a string and elements of an array, None for all. Without `arrays` or `strings`,
    their type and length replace the content.
    """

    length: int | None = None
    arrays: bool = True
    strings: bool = True


ALL = Style()


class Texts:
    """Turns messages of one set of interfaces into text."""

    def __init__(self, messages: Messages, style: Style = ALL) -> None:
        """Use `messages`, which contain every type that is shown."""
        self._messages = messages
        self._style = style

    def yaml(self, name: TypeName, value: Value, flow: bool = False) -> str:
        """Return a message as YAML with a line end; `flow`: on one line, in braces."""
        return dump(self.plain(name, value), flow)

    def csv(self, name: TypeName, value: Value) -> str:
        """Return the values of all members, nested ones too, separated by commas, without a line end."""
        return ",".join(self._cells(self._messages[name], value))

    def line(self, name: TypeName, value: Value) -> str:
        """Return a message on one line, as rclpy's messages print themselves: `std_msgs.msg.Int32(data=7)`."""
        members = (
            f"{field.name}={self._literal(field.type, value[field.name])}"
            for field in self._messages[name].fields
        )
        return f"{name.package}.{name.kind}.{name.name}({', '.join(members)})"

    def plain(self, name: TypeName, value: Value) -> dict[str, Any]:
        """Return a message as plain data for YAML: dicts, lists, texts, numbers."""
        return {field.name: self._field(field, value[field.name]) for field in self._messages[name].fields}

    def _field(self, field: Field, value: Any) -> Any:
        if not isinstance(field.type, (ArrayType, SequenceType)):
            return self._element(field.type, value)
        if not self._style.arrays:
            return array_summary(field.type, len(value))
        return self._many(field.type.element, value)

    def _many(self, element: ElementType, values: Any) -> list[Any]:
        length = self._style.length
        shown = [self._element(element, item) for item in values[:length]]
        return shown if length is None or len(values) <= length else [*shown, "..."]

    def _element(self, element: ElementType, value: Any) -> Any:
        if isinstance(element, NamedType):
            return self.plain(element.name, value)
        if isinstance(element, StringType):
            return self._text(value)
        return chr(value) if element is Primitive.BYTE or element in _CHARACTERS else value

    def _text(self, value: str) -> str:
        if not self._style.strings:
            return f"<string length: <{len(value)}>>"
        length = self._style.length
        return value if length is None or len(value) <= length else f"{value[:length]}..."

    def _cells(self, message: Message, value: Value) -> Iterable[str]:
        for field in message.fields:
            found = value[field.name]
            if not isinstance(field.type, (ArrayType, SequenceType)):
                yield from self._cell(field.type, found)
            elif not self._style.arrays:
                yield array_summary(field.type, len(found))
            else:
                length = self._style.length
                for item in found[:length]:
                    yield from self._cell(field.type.element, item)
                if length is not None and len(found) > length:
                    yield "..."

    def _cell(self, element: ElementType, value: Any) -> Iterable[str]:
        if isinstance(element, NamedType):
            yield from self._cells(self._messages[element.name], value)
        elif element is Primitive.BYTE:
            yield str(bytes((value,)))
        else:
            yield str(self._element(element, value))

    def _literal(self, kind: FieldType, value: Any) -> str:
        if isinstance(kind, (ArrayType, SequenceType)):
            return f"[{', '.join(self._literal(kind.element, item) for item in value)}]"
        if isinstance(kind, NamedType):
            return self.line(kind.name, value)
        if kind is Primitive.BYTE:
            return repr(bytes((value,)))
        return repr(chr(value) if kind in _CHARACTERS else value)


def dump(data: Any, flow: bool = False) -> str:
    """Return plain data as YAML with a line end, members in their order."""
    text: str = yaml.safe_dump(
        data, allow_unicode=True, width=sys.maxsize, default_flow_style=flow, sort_keys=False
    )
    return text


def array_summary(kind: ArrayType | SequenceType, length: int) -> str:
    """Return what replaces an array that is not shown."""
    name = _type_name(element_of(kind))
    if isinstance(kind, ArrayType):
        return f"<array type: {name}[{kind.size}]>"
    bound = "" if kind.bound is None else f"[{kind.bound}]"
    return f"<sequence type: {name}{bound}, length: {length}>"


def _type_name(element: ElementType) -> str:
    if isinstance(element, NamedType):
        return str(element.name)
    if isinstance(element, StringType):
        return "wstring" if element.wide else "string"
    return _TYPE_NAMES.get(element, element.value)
