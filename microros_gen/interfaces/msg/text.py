# SPDX-License-Identifier: Apache-2.0
"""Prints interface types as the text of .msg, .srv and .action files; reading it again gives the same model."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.interfaces.derived import parts_of
from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    Declaration,
    Field,
    FieldType,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    Value,
)

# A string passes two readers (see interfaces/msg/values.py); each halves its backslashes, the second one twice.
_STRING_ESCAPES = {"\\": "\\" * 8, "\n": "\\\\n", "\r": "\\\\r"}
# In an array a backslash before the quote would hide it, so it is written by its number.
_ELEMENT_ESCAPES = {"\\": "\\x5c", "\n": "\\n", "\r": "\\r", "\t": "\\t"}
# What a line of a .msg file cannot hold: '#' begins a comment, '=' makes a constant of it, a tab is a space.
_NEVER_PLAIN = "#=\t"


def type_text(field_type: FieldType, package: str | None = None) -> str:
    """Return the type as a .msg file of `package` names it (None: with every package)."""
    if isinstance(field_type, ArrayType):
        return f"{type_text(field_type.element, package)}[{field_type.size}]"
    if isinstance(field_type, SequenceType):
        bound = "" if field_type.bound is None else f"<={field_type.bound}"
        return f"{type_text(field_type.element, package)}[{bound}]"
    if isinstance(field_type, Primitive):
        return field_type.value
    if isinstance(field_type, NamedType):
        name = field_type.name
        return name.name if name.package == package else f"{name.package}/{name.name}"
    bound = "" if field_type.bound is None else f"<={field_type.bound}"
    return f"{'wstring' if field_type.wide else 'string'}{bound}"


def value_text(value: Value) -> str:
    """Return a value as a .msg file writes it; strings are always in quotes."""
    if isinstance(value, tuple):
        return "[" + ", ".join(_element_text(v) if isinstance(v, str) else value_text(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _string_text(value)
    return repr(value)


def message_text(message: Message) -> str:
    """Return the .msg file of `message`: its comment, then constants, then fields, each below its comment."""
    head = "".join(_comment_lines(message.comment))
    constants = "".join(_constant_text(constant) for constant in message.constants)
    fields = "".join(_field_text(field, message.name.package) for field in message.fields)
    body = "\n".join(block for block in (constants, fields) if block)
    # Comment lines at the very top are the message's own, so those of a declaration come below an empty line.
    return f"{head}\n{body}" if head or body.startswith("#") else body


def declaration_text(declaration: Declaration) -> str:
    """Return the file of a declaration; that of a service or action has a line `---` between its parts."""
    if isinstance(declaration, Message):
        return message_text(declaration)
    return "---\n".join(message_text(message) for _, message in parts_of(declaration))


def _constant_text(constant: Constant) -> str:
    declaration = f"{type_text(constant.type)} {constant.name} = {value_text(constant.value)}\n"
    return "".join(_comment_lines(constant.comment)) + declaration


def _field_text(field: Field, package: str) -> str:
    default = "" if field.default is None else f" {value_text(field.default)}"
    declaration = f"{type_text(field.type, package)} {field.name}{default}"
    if len(field.comment) == 1 and len(field.comment[0]) <= 60:
        return f"{declaration}  # {field.comment[0]}\n"
    return "".join(_comment_lines(field.comment)) + declaration + "\n"


def _comment_lines(lines: Iterable[str]) -> list[str]:
    return [f"# {line}\n" if line else "#\n" for line in lines]


def _string_text(value: str) -> str:
    text = "".join(_STRING_ESCAPES.get(c) or (c if _plain(c) else _octets(c)) for c in value)
    quote = "'" if '"' in text and "'" not in text else '"'
    return quote + text.replace(quote, "\\" + quote) + quote


def _element_text(value: str) -> str:
    text = "".join(_ELEMENT_ESCAPES.get(c) or (c if _plain_element(c) else _code_point(c)) for c in value)
    # The space at both ends of an element is dropped even inside of quotes.
    lead = len(text) - len(text.lstrip(" "))
    tail = len(text.strip(" ")) and len(text) - len(text.rstrip(" "))
    return '"' + "\\x20" * lead + text.strip(" ") + "\\x20" * tail + '"'


def _plain(character: str) -> bool:
    return character.isprintable() and character not in _NEVER_PLAIN


def _plain_element(character: str) -> bool:
    return character.isascii() and _plain(character) and character not in "\"'"


def _octets(character: str) -> str:
    return "".join(f"\\x{octet:02x}" for octet in character.encode("utf-8"))


def _code_point(character: str) -> str:
    code = ord(character)
    return f"\\x{code:02x}" if code <= 0xFF else f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}"
