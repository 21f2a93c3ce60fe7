# SPDX-License-Identifier: Apache-2.0
"""Tells rosbags every interface file of the wheels, so that it is an oracle for services and actions too.

It parses the texts of the files itself. What ROS 2 derives from services and actions is written here as the text of a
message, in rosbags' own terms: a type `pkg/srv/Name_Request` is `pkg/msg/Name_Request` there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.base import normalize_fieldname

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
from tests.support.typesupport.values import Tree

DTYPES = {
    Primitive.BOOL: numpy.bool_,
    Primitive.BYTE: numpy.uint8,
    Primitive.CHAR: numpy.uint8,
    Primitive.FLOAT32: numpy.float32,
    Primitive.FLOAT64: numpy.float64,
    Primitive.INT8: numpy.int8,
    Primitive.UINT8: numpy.uint8,
    Primitive.INT16: numpy.int16,
    Primitive.UINT16: numpy.uint16,
    Primitive.INT32: numpy.int32,
    Primitive.UINT32: numpy.uint32,
    Primitive.INT64: numpy.int64,
    Primitive.UINT64: numpy.uint64,
}
NOTHING = "uint8 structure_needs_at_least_one_member\n"
GOAL_ID = "unique_identifier_msgs/UUID goal_id\n"


def derived_texts(path: Path) -> Iterator[tuple[str, str]]:
    """Yield names and texts of the messages that come from an interface file."""
    name, package = path.stem, path.parents[1].name
    parts = re.split(r"^---\s*$", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    if path.suffix == ".msg":
        yield name, parts[0]
    elif path.suffix == ".srv":
        yield from zip((f"{name}_Request", f"{name}_Response"), parts, strict=True)
        yield event(package, name)
    else:
        yield from zip((f"{name}_Goal", f"{name}_Result", f"{name}_Feedback"), parts, strict=True)
        yield f"{name}_SendGoal_Request", f"{GOAL_ID}{package}/{name}_Goal goal\n"
        yield f"{name}_SendGoal_Response", "bool accepted\nbuiltin_interfaces/Time stamp\n"
        yield f"{name}_GetResult_Request", GOAL_ID
        yield f"{name}_GetResult_Response", f"int8 status\n{package}/{name}_Result result\n"
        yield f"{name}_FeedbackMessage", f"{GOAL_ID}{package}/{name}_Feedback feedback\n"
        yield event(package, f"{name}_SendGoal")
        yield event(package, f"{name}_GetResult")


def event(package: str, name: str) -> tuple[str, str]:
    """Return name and text of the event of a service."""
    calls = f"{package}/{name}_Request[<=1] request\n{package}/{name}_Response[<=1] response\n"
    return f"{name}_Event", f"service_msgs/ServiceEventInfo info\n{calls}"


class Oracle:
    """rosbags with every .msg, .srv and .action file below `share`."""

    def __init__(self, share: Path) -> None:
        self.store: Any = get_typestore(Stores.EMPTY)
        known: dict[str, Any] = {}
        for kind in ("msg", "srv", "action"):
            for path in sorted(share.glob(f"*/{kind}/*.{kind}")):
                for name, text in derived_texts(path):
                    known.update(parsed(f"{path.parents[1].name}/msg/{name}", text))
        self.store.register(known)

    def knows(self, messages: Mapping[TypeName, Message], name: TypeName) -> bool:
        """Whether rosbags has the type: not where only an .idl file declares it, nor with wide strings."""
        return key(name) in self.store.types and not has_wide_text(messages, name)

    def message(self, messages: Mapping[TypeName, Message], name: TypeName, tree: Tree) -> Any:
        """Return rosbags' message with these contents."""
        values = {}
        for field in messages[name].fields:
            element = element_of(field.type)
            value = tree[field.name]
            many = isinstance(field.type, (ArrayType, SequenceType))
            if many and isinstance(element, Primitive):
                built: Any = numpy.array(value, dtype=DTYPES[element])
            elif many:
                built = [self._one(messages, element, item) for item in value]
            else:
                built = self._one(messages, element, value)
            values[normalize_fieldname(field.name)] = built
        if not values:
            values["structure_needs_at_least_one_member"] = 0
        return self.store.types[key(name)](**values)

    def _one(self, messages: Mapping[TypeName, Message], element: ElementType, value: Any) -> Any:
        if isinstance(element, NamedType):
            return self.message(messages, element.name, value)
        return value - 256 if element is Primitive.BYTE and value > 127 else value  # it is signed there

    def tree(self, messages: Mapping[TypeName, Message], name: TypeName, message: Any) -> Tree:
        """Return the contents of rosbags' message."""
        tree = {}
        for field in messages[name].fields:
            element = element_of(field.type)
            value = getattr(message, normalize_fieldname(field.name))
            if isinstance(value, numpy.ndarray):
                assert isinstance(element, Primitive)
                value = value.view(DTYPES[element]).tolist()  # bytes are int8 there
            elif isinstance(element, NamedType) and isinstance(value, list):
                value = [self.tree(messages, element.name, item) for item in value]
            elif isinstance(element, NamedType):
                value = self.tree(messages, element.name, value)
            elif element is Primitive.BYTE:
                value &= 0xFF
            tree[field.name] = value
        return tree

    def write(self, name: TypeName, message: Any, big: bool) -> bytes:
        """Return encapsulation and body."""
        return bytes(self.store.serialize_cdr(message, key(name), little_endian=not big))

    def read(self, name: TypeName, data: bytes) -> Any:
        """Return rosbags' message of encapsulation and body."""
        return self.store.deserialize_cdr(data, key(name))


def key(name: TypeName) -> str:
    """Return the name that a type has in rosbags here."""
    return f"{name.package}/msg/{name.name}"


def parsed(name: str, text: str) -> dict[str, Any]:
    """Return rosbags' definition; of a message without members with the one that ROS 2 adds."""
    found = get_types_from_msg(text, name)
    if not found[name][1]:
        return dict(get_types_from_msg(f"{text}\n{NOTHING}", name))
    return dict(found)


def has_wide_text(messages: Mapping[TypeName, Message], name: TypeName) -> bool:
    """Whether a wide string is anywhere in a type."""
    for field in messages[name].fields:
        element = element_of(field.type)
        if isinstance(element, StringType) and element.wide:
            return True
        if isinstance(element, NamedType) and has_wide_text(messages, element.name):
            return True
    return False
