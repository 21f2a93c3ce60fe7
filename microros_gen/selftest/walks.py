# SPDX-License-Identifier: Apache-2.0
"""The C functions that visit the members of a message in the order of the wire, one for each type."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

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
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name
from microros_gen.typesupport.plan.size import members

_KINDS = {Primitive.BOOL: "BOOL", Primitive.FLOAT32: "FLOAT", Primitive.FLOAT64: "FLOAT"}
_SIGNED = (Primitive.INT8, Primitive.INT16, Primitive.INT32, Primitive.INT64, Primitive.IDL_CHAR)


@dataclass(frozen=True)
class Walk:
    """The function for one type: the name of its struct, and its statements."""

    name: str
    lines: tuple[str, ...]


def walk_of(message: Message) -> Walk:
    """Return the function that visits the members of `message`; those of nested types have their own."""
    return Walk(c_name(message.name), tuple(line for field in members(message) for line in _field(field)))


def parts_of(name: TypeName, messages: Mapping[TypeName, Message]) -> frozenset[TypeName]:
    """Return the type itself and all that it is made of, at any depth."""
    found = {name}
    waiting = [name]
    while waiting:
        elements = [element_of(field.type) for field in messages[waiting.pop()].fields]
        new = {element.name for element in elements if isinstance(element, NamedType)} - found
        found |= new
        waiting += sorted(new)
    return frozenset(found)


def has_long_double(message: Message) -> bool:
    """Return whether a member is a `long double`, whose bytes differ between processors."""
    return any(element_of(field.type) is Primitive.LONG_DOUBLE for field in message.fields)


def _field(field: Field) -> Iterator[str]:
    member = f"message->{field.name}"
    element = element_of(field.type)
    if isinstance(field.type, ArrayType):
        yield from _elements(element, member, f"{field.type.size}u")
    elif isinstance(field.type, SequenceType):
        yield f"{member}.size = selftest_size(walk, {member}.capacity);"
        yield from _elements(element, f"{member}.data", f"{member}.size")
    else:
        yield from _elements(element, f"&{member}", "1u", single=True)


def _elements(element: ElementType, data: str, count: str, single: bool = False) -> Iterator[str]:
    """Yield the statements for `count` elements from `data` on; `single`: one that is no array."""
    if isinstance(element, Primitive):
        kind = _KINDS.get(element, "SIGNED" if element in _SIGNED else "UNSIGNED")
        yield f"selftest_numbers(walk, {data}, {count}, {element.size}u, SELFTEST_{kind});"
    elif single:
        yield f"{_call(element)}(walk, {data});"
    else:
        yield f"for (size_t i = 0; i < {count}; ++i) {{"
        yield f"  {_call(element)}(walk, &{data}[i]);"
        yield "}"


def _call(element: ElementType) -> str:
    if isinstance(element, StringType):
        return "selftest_wstring" if element.wide else "selftest_string"
    assert isinstance(element, NamedType)
    return f"walk_{c_name(element.name)}"
