# SPDX-License-Identifier: Apache-2.0
"""Prints interface types as the text of .idl files, with the content of those that ROS 2 Jazzy installs.

Reading the text again gives the same model, but for units: as in ROS 2 those of fields become annotations, and what
looks like one in the comment of a message or constant is left out.

Two forms: that of ROS 2, whose reader takes no directives but `#include`, takes keywords of IDL as names and keeps an
underscore as part of a name; and a portable one for other compilers, which need include guards and an underscore before
a name that is a keyword (IDL 4.2, 7.2.3.2.1).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from microros_gen.interfaces.omg_idl.keywords import is_keyword
from microros_gen.interfaces.type_description import EMPTY_MEMBER
from microros_gen.interfaces.types import (
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
    TypeName,
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


def idl_text(declaration: Declaration, portable: bool = False) -> str:
    """Return the .idl file of `declaration`; of a service or action its own structs, not the derived ones."""
    messages = _structs(declaration)
    name = declaration.name
    lines = [f'#include "{included}.idl"' for included in included_types(declaration)]
    lines += [""] if lines else []
    lines += [f"module {name.package} {{", f"{_INDENT}module {name.kind} {{"]
    known: set[str] = set()
    for message in messages:
        struct = _struct(_escaped(message), known, f"{name.name}__") if portable else _struct(message, known)
        lines.extend(2 * _INDENT + line if line else "" for line in struct)
    lines += [f"{_INDENT}}};", "};", ""]
    text = "\n".join(lines)
    return _guarded(text, name) if portable else text


def included_types(declaration: Declaration) -> tuple[TypeName, ...]:
    """Return the types whose .idl files that of `declaration` includes, sorted."""
    elements = (element_of(field.type) for message in _structs(declaration) for field in message.fields)
    return tuple(sorted({element.name for element in elements if isinstance(element, NamedType)}))


def names_to_escape(declaration: Declaration) -> tuple[str, ...]:
    """Return the constants and members whose names are keywords of IDL."""
    messages = _structs(declaration)
    names = [c.name for m in messages for c in m.constants] + [f.name for m in messages for f in m.fields]
    return tuple(dict.fromkeys(name for name in names if is_keyword(name)))


def idl_type_text(field_type: ElementType | SequenceType) -> str:
    """Return the type as an .idl file names it; an array has its size after the name that it declares."""
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


def _guarded(text: str, name: TypeName) -> str:
    guard = str(name).replace("/", "__").upper() + "_IDL"
    return f"#ifndef {guard}\n#define {guard}\n\n{text}\n#endif\n"


def _escaped(message: Message) -> Message:
    """Return `message` with an underscore before each name that is a keyword."""

    def fitting(name: str) -> str:
        return f"_{name}" if is_keyword(name) else name

    return replace(
        message,
        constants=tuple(replace(constant, name=fitting(constant.name)) for constant in message.constants),
        fields=tuple(replace(field, name=fitting(field.name)) for field in message.fields),
    )


def _struct(message: Message, known: set[str], prefix: str = "") -> Iterator[str]:
    """Yield the lines of one struct; `prefix` makes the names of its typedefs differ from those of other files."""
    for field in message.fields:
        if isinstance(field.type, ArrayType):
            new = [line for line in _typedefs(field.type, prefix) if line not in known]
            known.update(new)
            yield from new
    if message.constants:
        yield f"module {message.name.name}_Constants {{"
        for constant in message.constants:
            yield from (_INDENT + line for line in _constant(constant))
        yield "};"
    yield from _comment(_without_unit(message.comment)[0])
    yield f"struct {message.name.name} {{"
    for index, field in enumerate(message.fields):
        if index:
            yield ""
        yield from (_INDENT + line for line in _member(field, prefix))
    if not message.fields:
        yield f"{_INDENT}uint8 {EMPTY_MEMBER};"
    yield "};"


def _typedefs(array: ArrayType, prefix: str) -> list[str]:
    element = idl_type_text(array.element)
    alias = element.replace("::", "__")
    lines = [] if alias == element else [f"typedef {element} {prefix}{alias};"]
    alias = element if alias == element else prefix + alias
    return [*lines, f"typedef {alias} {prefix}{_array_name(array)}[{array.size}];"]


def _array_name(array: ArrayType) -> str:
    element = idl_type_text(array.element).replace("::", "__").replace(" ", "_")
    return f"{element.replace('<', '__').replace('>', '')}__{array.size}"


def _constant(constant: Constant) -> Iterator[str]:
    yield from _comment(_without_unit(constant.comment)[0])
    kind = StringType(constant.type.wide) if isinstance(constant.type, StringType) else constant.type
    yield f"const {idl_type_text(kind)} {constant.name} = {_scalar_text(constant.value)};"


def _member(field: Field, prefix: str) -> Iterator[str]:
    comment, unit = _without_unit(field.comment)
    yield from _comment(comment)
    if field.default is not None:
        yield f"@default (value={idl_value_text(field.default)})"
    if unit is not None:
        yield f"@unit (value={idl_string_text(unit)})"
    is_array = isinstance(field.type, ArrayType)
    yield f"{prefix if is_array else ''}{_member_type(field.type)} {field.name};"


def _member_type(field_type: FieldType) -> str:
    return _array_name(field_type) if isinstance(field_type, ArrayType) else idl_type_text(field_type)


def _without_unit(comment: tuple[str, ...]) -> tuple[tuple[str, ...], str | None]:
    """Return the comment and the unit in it: what is in the only brackets, without a comma."""
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
