# SPDX-License-Identifier: Apache-2.0
"""Sizes on the wire: XCDR1 as ROS 2 Jazzy writes it (OMG CDR, 8-byte alignment, origin 0 at the body).

Found in Jazzy's bytes, and kept here: an empty message is one byte; a sequence without elements does not
align for its element type; a wstring has no terminator and writes each of its UTF-16 units as four bytes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

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

LENGTH_SIZE = 4
WIDE_CHARACTER_SIZE = 4
LARGEST_ALIGNMENT = 8

PLACEHOLDER = Field("structure_needs_at_least_one_member", Primitive.UINT8)
"""The member of a message without members (rosidl_generator_c), one byte on the wire."""


@dataclass(frozen=True)
class FieldLimits:
    """Limits of one field: elements of a sequence, characters of each string, and those of a nested type."""

    sequence: int | None
    string: int | None
    nested: TypeLimits | None


@dataclass(frozen=True)
class TypeLimits:
    """Limits of a type, one entry for each of its fields (None: fixed size)."""

    fields: tuple[FieldLimits | None, ...]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """The digest of all levels below: they are many, and each is looked up by it several times."""
        return hash(self.fields)


def members(message: Message) -> tuple[Field, ...]:
    """Return the fields of the C struct: those of the message, or the placeholder."""
    return message.fields or (PLACEHOLDER,)


def align(position: int, alignment: int) -> int:
    """Return `position` rounded up to a multiple of `alignment`."""
    return -(-position // alignment) * alignment


def is_fixed(message: Message, messages: Mapping[TypeName, Message]) -> bool:
    """Return whether nothing in the message has a variable length."""
    return all(is_fixed_field(field, messages) for field in message.fields)


def is_fixed_field(field: Field, messages: Mapping[TypeName, Message]) -> bool:
    """Return whether nothing in the field has a variable length."""
    element = element_of(field.type)
    if isinstance(field.type, SequenceType) or isinstance(element, StringType):
        return False
    return not isinstance(element, NamedType) or is_fixed(messages[element.name], messages)


class WireSizes:
    """Largest and smallest encoded sizes; results are kept, so one object serves a whole plan."""

    def __init__(self, messages: Mapping[TypeName, Message]) -> None:
        self._messages = messages
        self._known: dict[tuple[TypeName, TypeLimits | None, int], int] = {}

    def largest(self, name: TypeName, limits: TypeLimits | None) -> int:
        """Return the size of a message with everything full, bytes.

        Every step of the encoding grows with what went before, so no shorter content gives a longer body.
        """
        return self._type_end(name, limits, 0)

    def smallest(self, name: TypeName) -> int:
        """Return the size of a message with every string and sequence empty, bytes."""
        return self._type_end(name, None, 0)

    def _type_end(self, name: TypeName, limits: TypeLimits | None, position: int) -> int:
        phase = position % LARGEST_ALIGNMENT
        key = (name, limits, phase)
        if key not in self._known:
            end = phase
            fields = members(self._messages[name])
            for field, entry in zip(fields, limits.fields if limits else (None,) * len(fields), strict=True):
                end = self._field_end(field, entry, end)
            self._known[key] = end - phase
        return position + self._known[key]

    def _field_end(self, field: Field, limits: FieldLimits | None, position: int) -> int:
        element = element_of(field.type)
        if isinstance(field.type, ArrayType):
            return self._elements_end(element, limits, field.type.size, position)
        if isinstance(field.type, SequenceType):
            count = (limits.sequence or 0) if limits else 0
            return self._elements_end(element, limits, count, align(position, LENGTH_SIZE) + LENGTH_SIZE)
        return self._element_end(element, limits, position)

    def _elements_end(
        self, element: ElementType, limits: FieldLimits | None, count: int, position: int
    ) -> int:
        if isinstance(element, Primitive):
            return align(position, element.size) + count * element.size if count else position
        return _repeat(lambda at: self._element_end(element, limits, at), count, position)

    def _element_end(self, element: ElementType, limits: FieldLimits | None, position: int) -> int:
        if isinstance(element, Primitive):
            return align(position, element.size) + element.size
        if isinstance(element, StringType):
            length = (limits.string or 0) if limits else 0
            text = length * WIDE_CHARACTER_SIZE if element.wide else length + 1
            return align(position, LENGTH_SIZE) + LENGTH_SIZE + text
        return self._type_end(element.name, limits.nested if limits else None, position)


def _repeat(step: Callable[[int], int], count: int, position: int) -> int:
    """Apply `step` `count` times; a step depends on the position modulo 8 only, so cycles are skipped."""
    seen: dict[int, tuple[int, int]] = {}
    done = 0
    while done < count:
        phase = position % LARGEST_ALIGNMENT
        if phase in seen:
            period, growth = done - seen[phase][0], position - seen[phase][1]
            cycles = (count - done) // period
            position += cycles * growth
            done += cycles * period
            for _ in range(count - done):
                position = step(position)
            return position
        seen[phase] = (done, position)
        position = step(position)
        done += 1
    return position
