# SPDX-License-Identifier: Apache-2.0
"""Constant tables of the members of each type, for functions that work on any type: what is in them, and where."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.interfaces.types import (
    ArrayType,
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
from microros_gen.typesupport.plan.names import TypeFiles, c_name
from microros_gen.typesupport.plan.size import members

TABLES_HEADER = "include/microros/type_tables.h"
"""Declares the table of every type."""

TABLES_SOURCE = "src/micro_ros_utilities/utilities_tables.c"
"""Lists the tables of types that have a handle."""

SEQUENCE = "microros_type_sequence_t"
"""The C type that every string and sequence is taken for."""

_PRIMITIVES = {
    Primitive.BOOL: "BOOLEAN",
    Primitive.BYTE: "OCTET",
    Primitive.CHAR: "UINT8",
    Primitive.FLOAT32: "FLOAT",
    Primitive.FLOAT64: "DOUBLE",
    Primitive.IDL_CHAR: "CHAR",
}


@dataclass(frozen=True)
class TableMember:
    """One member. `type` and `shape` are the ends of the names of enumerators in microros/type_members.h.

    `count`: elements of an array, 1 of a value, the bound of a bounded sequence, 0 of one without;
    `string_bound`: bytes or UTF-16 units, 0 without; `element`: the C type of one value, which a table takes a
    string for too.
    """

    name: str
    nested: TypeName | None
    count: int
    string_bound: int
    type: str
    shape: str
    element: str


def members_source(files: TypeFiles) -> str:
    """Return the path of a type's table below the output folder."""
    return files.type_support_source.replace("__type_support.c", "__members.c")


def table_members(message: Message) -> tuple[TableMember, ...]:
    """Return the members of the C struct, in its order."""
    return tuple(_member(field) for field in members(message))


def nesting_depth(messages: Mapping[TypeName, Message]) -> int:
    """Return how many types lie inside one another at most, the outermost included; `messages` is in dependency
    order."""
    depths: dict[TypeName, int] = {}
    for name, message in messages.items():
        elements = (element_of(field.type) for field in message.fields)
        nested = (depths[e.name] for e in elements if isinstance(e, NamedType))
        depths[name] = 1 + max(nested, default=0)
    return max(depths.values(), default=1)


def _member(field: Field) -> TableMember:
    element = element_of(field.type)
    count, shape = 1, "VALUE"
    if isinstance(field.type, ArrayType):
        count, shape = field.type.size, "ARRAY"
    elif isinstance(field.type, SequenceType):
        count, shape = field.type.bound or 0, "BOUNDED" if field.type.bound else "SEQUENCE"
    bound = element.bound or 0 if isinstance(element, StringType) else 0
    if isinstance(element, NamedType):
        return TableMember(field.name, element.name, count, bound, "MESSAGE", shape, c_name(element.name))
    if isinstance(element, StringType):
        kind = "WSTRING" if element.wide else "STRING"
        return TableMember(field.name, None, count, bound, kind, shape, SEQUENCE)
    kind = _PRIMITIVES.get(element, element.value.upper())
    return TableMember(field.name, None, count, bound, kind, shape, element.c_type)
