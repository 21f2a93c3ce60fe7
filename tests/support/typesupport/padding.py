# SPDX-License-Identifier: Apache-2.0
"""Which bytes of a CDR body are padding: a walk over the contents, from the standard (OMG CDR, 9.3)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

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


def padding(
    messages: Mapping[TypeName, Message], name: TypeName, tree: dict[str, Any]
) -> tuple[int, list[int]]:
    """Return the length of the body and the positions in it that no value covers."""
    walk = _Walk(messages)
    walk.message(name, tree)
    return walk.position, walk.gaps


class _Walk:
    def __init__(self, messages: Mapping[TypeName, Message]) -> None:
        self._messages = messages
        self.position = 0
        self.gaps: list[int] = []

    def message(self, name: TypeName, tree: dict[str, Any]) -> None:
        fields = self._messages[name].fields
        if not fields:
            self.position += 1
        for field in fields:
            value = tree[field.name]
            if isinstance(field.type, SequenceType):
                self._value(4, 4)
            many = isinstance(field.type, (ArrayType, SequenceType))
            for item in value if many else [value]:
                self._element(element_of(field.type), item)

    def _element(self, element: ElementType, value: Any) -> None:
        if isinstance(element, NamedType):
            self.message(element.name, value)
        elif isinstance(element, StringType):
            self._value(4, 4)
            self.position += 2 * len(value.encode("utf-16-le")) if element.wide else len(value.encode()) + 1
        else:
            assert isinstance(element, Primitive)
            self._value(element.size, element.size)

    def _value(self, size: int, alignment: int) -> None:
        while self.position % alignment:
            self.gaps.append(self.position)
            self.position += 1
        self.position += size
