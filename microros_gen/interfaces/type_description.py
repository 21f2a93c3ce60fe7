# SPDX-License-Identifier: Apache-2.0
"""Type descriptions (REP-2016) as data and the RIHS01 type hash (REP-2011) computed from them.

The result equals the `type_description_msg` and `type_hashes` of the .json files that ROS 2 Jazzy installs.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from microros_gen.interfaces.types import (
    ArrayType,
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

EMPTY_MEMBER = "structure_needs_at_least_one_member"
"""The uint8 member that IDL needs in a structure without members; every message without fields has it."""

_NESTED_TYPE = 1
_STRING, _WSTRING, _BOUNDED_STRING, _BOUNDED_WSTRING = 17, 18, 21, 22
_ARRAY_OFFSET, _BOUNDED_SEQUENCE_OFFSET, _UNBOUNDED_SEQUENCE_OFFSET = 48, 96, 144


def type_hash(message: Message, closure: Mapping[TypeName, Message]) -> str:
    """Return `RIHS01_` and 64 hexadecimal digits; `closure` holds (at least) every type that `message` is
    made of.

    Default values and constants are no part of the hash. Raises KeyError when `closure` lacks a type.
    """
    description = _full_description(message, closure, defaults=False)
    text = json.dumps(description, ensure_ascii=True, separators=(", ", ": "))
    return "RIHS01_" + hashlib.sha256(text.encode("ascii")).hexdigest()


def type_description(message: Message, closure: Mapping[TypeName, Message]) -> dict[str, Any]:
    """Return the message type_description_interfaces/msg/TypeDescription as data, default values included.

    `closure` holds (at least) every type that `message` is made of; KeyError when it lacks one.
    """
    return _full_description(message, closure, defaults=True)


def referenced_types(message: Message, closure: Mapping[TypeName, Message]) -> tuple[TypeName, ...]:
    """Return every type that `message` is made of, directly or not, by name. KeyError when one is missing."""
    found: set[TypeName] = set()
    pending = _direct(message)
    while pending:
        name = pending.pop()
        if name not in found:
            found.add(name)
            pending.extend(_direct(closure[name]))
    return tuple(sorted(found, key=str))


def type_id(field_type: FieldType) -> int:
    """Return the FIELD_TYPE number of type_description_interfaces/msg/FieldType."""
    if isinstance(field_type, ArrayType):
        return type_id(field_type.element) + _ARRAY_OFFSET
    if isinstance(field_type, SequenceType):
        bounded = field_type.bound is not None
        offset = _BOUNDED_SEQUENCE_OFFSET if bounded else _UNBOUNDED_SEQUENCE_OFFSET
        return type_id(field_type.element) + offset
    if isinstance(field_type, Primitive):
        return field_type.field_type_id
    if isinstance(field_type, NamedType):
        return _NESTED_TYPE
    if field_type.bound is None:
        return _WSTRING if field_type.wide else _STRING
    return _BOUNDED_WSTRING if field_type.wide else _BOUNDED_STRING


def _full_description(
    message: Message, closure: Mapping[TypeName, Message], *, defaults: bool
) -> dict[str, Any]:
    references = referenced_types(message, closure)
    return {
        "type_description": individual_type_description(message, defaults),
        "referenced_type_descriptions": [
            individual_type_description(closure[name], defaults) for name in references
        ],
    }


def individual_type_description(message: Message, defaults: bool = True) -> dict[str, Any]:
    """Return type_description_interfaces/msg/IndividualTypeDescription of `message` as data, without its parts."""
    fields = message.fields or (Field(EMPTY_MEMBER, Primitive.UINT8),)
    return {"type_name": str(message.name), "fields": [_field(field, defaults) for field in fields]}


def _field(field: Field, defaults: bool) -> dict[str, Any]:
    entry: dict[str, Any] = {"name": field.name, "type": _type(field.type)}
    if defaults:
        entry["default_value"] = _default(field)
    return entry


def _type(field_type: FieldType) -> dict[str, Any]:
    element = element_of(field_type)
    capacity = 0
    if isinstance(field_type, ArrayType):
        capacity = field_type.size
    elif isinstance(field_type, SequenceType):
        capacity = field_type.bound or 0
    return {
        "type_id": type_id(field_type),
        "capacity": capacity,
        "string_capacity": (element.bound or 0) if isinstance(element, StringType) else 0,
        "nested_type_name": str(element.name) if isinstance(element, NamedType) else "",
    }


def _default(field: Field) -> str:
    """Return the text that ROS 2 gives a default: Python's, for an array that of a tuple."""
    return "" if field.default is None else str(field.default)


def _direct(message: Message) -> list[TypeName]:
    elements = (element_of(field.type) for field in message.fields)
    return [element.name for element in elements if isinstance(element, NamedType)]
