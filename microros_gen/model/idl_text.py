# SPDX-License-Identifier: Apache-2.0
"""Prints interface types as the text of .idl files, with the content of those that ROS 2 Jazzy installs.

Reading the text again gives the same model, but for units: as in ROS 2 they become annotations.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from microros_gen.model.type_description import EMPTY_MEMBER
from microros_gen.model.types import (
    Action,
    ArrayType,
    Constant,
    Declaration,
    ElementType,
    Field,
    FieldType,
    Message,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    Service,
    StringType,
    Value,
    element_of,
)

_PRIMITIVES = {
    Primitive.BOOL: "boolean",
    Primitive.BYTE: "octet",
    Primitive.CHAR: "uint8",
    Primitive.FLOAT32: "float",
    Primitive.FLOAT64: "double",
    Primitive.IDL_CHAR: "char",
}
# rosidl_parser resolves escapes and then takes away one backslash of two once more.
_ESCAPES = {"\\": "\\" * 4, '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
_UNIT = re.compile(r"(\s*\[([^,\]]+)\])")
_INDENT = "  "


def idl_text(declaration: Declaration) -> str:
    """Return the .idl file of `declaration`; of a service or action its own structs, not the derived ones."""
    messages = _structs(declaration)
    name = declaration.name
    lines = [f'#include "{path}"' for path in _includes(messages)]
    lines += [""] if lines else []
    lines += [f"module {name.package} {{", f"{_INDENT}module {name.kind} {{"]
    known: set[str] = set()
    for message in messages:
        lines.extend(2 * _INDENT + line if line else "" for line in _struct(message, known))
    lines += [f"{_INDENT}}};", "};", ""]
    return "\n".join(lines)


def idl_type_text(field_type: ElementType | SequenceType) -> str:
    """Return the type as an .idl file names it; an array has its size behind the name that it declares."""
    if isinstance(field_type, SequenceType):
        bound = "" if field_type.bound is None else f", {field_type.bound}"
        return f"sequence<{idl_type_text(field_type.element)}{bound}>"
    if isinstance(field_type, Primitive):
        return _PRIMITIVES.get(field_type, field_type.value)
    if isinstance(field_type, NamedType):
        return str(field_type.name).replace("/", "::")
    bound = "" if field_type.bound is None else f"<{field_type.bound}>"
    return f"{'wstring' if field_type.wide else 'string'}{bound}"


def idl_string_text(value: str) -> str:
    """Return a string as a literal of an .idl file."""
    return '"' + "".join(_ESCAPES.get(c) or (c if c >= " " else f"\\x{ord(c):02x}") for c in value) + '"'


def idl_value_text(value: Value) -> str:
    """Return a constant or default as an .idl file writes it; a list stands in a string, as Python's tuple."""
    return idl_string_text(repr(value)) if isinstance(value, tuple) else _scalar_text(value)


def _structs(declaration: Declaration) -> tuple[Message, ...]:
    if isinstance(declaration, Service):
        return (declaration.request, declaration.response)
    if isinstance(declaration, Action):
        return (declaration.goal, declaration.result, declaration.feedback)
    return (declaration,)


def _includes(messages: Iterable[Message]) -> list[str]:
    elements = (element_of(field.type) for message in messages for field in message.fields)
    return sorted({f"{element.name}.idl" for element in elements if isinstance(element, NamedType)})


def _struct(message: Message, known: set[str]) -> Iterator[str]:
    for field in message.fields:
        if isinstance(field.type, ArrayType):
            new = [line for line in _typedefs(field.type) if line not in known]
            known.update(new)
            yield from new
    if message.constants:
        yield f"module {message.name.name}_Constants {{"
        for constant in message.constants:
            yield from (_INDENT + line for line in _constant(constant))
        yield "};"
    yield from _comment(message.comment)
    yield f"struct {message.name.name} {{"
    for index, field in enumerate(message.fields):
        if index:
            yield ""
        yield from (_INDENT + line for line in _member(field))
    if not message.fields:
        yield f"{_INDENT}uint8 {EMPTY_MEMBER};"
    yield "};"


def _typedefs(array: ArrayType) -> list[str]:
    element = idl_type_text(array.element)
    alias = element.replace("::", "__")
    lines = [] if alias == element else [f"typedef {element} {alias};"]
    return [*lines, f"typedef {alias} {_array_name(array)}[{array.size}];"]


def _array_name(array: ArrayType) -> str:
    element = idl_type_text(array.element).replace("::", "__").replace(" ", "_")
    return f"{element.replace('<', '__').replace('>', '')}__{array.size}"


def _constant(constant: Constant) -> Iterator[str]:
    yield from _comment(constant.comment)
    kind = StringType(constant.type.wide) if isinstance(constant.type, StringType) else constant.type
    yield f"const {idl_type_text(kind)} {constant.name} = {_scalar_text(constant.value)};"


def _member(field: Field) -> Iterator[str]:
    comment, unit = _without_unit(field.comment)
    yield from _comment(comment)
    if field.default is not None:
        yield f"@default (value={idl_value_text(field.default)})"
    if unit is not None:
        yield f"@unit (value={idl_string_text(unit)})"
    yield f"{_member_type(field.type)} {field.name};"


def _member_type(field_type: FieldType) -> str:
    return _array_name(field_type) if isinstance(field_type, ArrayType) else idl_type_text(field_type)


def _without_unit(comment: tuple[str, ...]) -> tuple[tuple[str, ...], str | None]:
    """Return the comment and the unit in it: what stands in the only brackets, without a comma."""
    found = _UNIT.findall("\n".join(comment))
    if len(found) != 1:
        return comment, None
    whole, unit = found[0]
    lines = [line.replace(whole, "") for line in comment]
    return (tuple(lines) if any(lines) else ()), unit


def _comment(lines: tuple[str, ...]) -> Iterator[str]:
    if lines:
        yield '@verbatim (language="comment", text='
        for line in lines[:-1]:
            yield f'{_INDENT}{idl_string_text(line)} "\\n"'
        yield f"{_INDENT}{idl_string_text(lines[-1])})"


def _scalar_text(value: ScalarValue) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return idl_string_text(value) if isinstance(value, str) else repr(value)
