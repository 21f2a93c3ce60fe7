# SPDX-License-Identifier: Apache-2.0
"""What a generated header says of a type and its members besides the comments of the interface file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from microros_gen.interfaces.types import (
    ArrayType,
    Field,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    element_of,
)
from microros_gen.typesupport.plan.layout import ILP32, LP64, DataModel
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.text import comment_lines, number, string

_LONGEST_DEFAULT = 90


def member_comment(field: Field) -> tuple[str, ...]:
    """Return the lines above a member of the struct: its comment, then bounds and default value."""
    return comment_lines((*comment_lines(field.comment), *_bounds(field), *_default(field)))


def message_note(plan: TypePlan) -> str:
    """Return what a message takes: its struct and storage with 32-bit (and 64-bit) pointers, its body; bytes."""
    note = f"{plan.c_name}: {_sizes(plan.models, plan.struct_sizes)}"
    if plan.storage:
        note += f", storage {_sizes(plan.models, plan.storage_sizes)}"
    if plan.root:
        low, high = plan.min_encoded_size, plan.max_encoded_size
        note += f", body {high}" if low == high else f", body {low} to {high}"
    return note


def storage_note(models: Sequence[DataModel], sizes: Sequence[int]) -> str:
    """Return the size of a storage struct as a comment says it, from that for each of the data models."""
    least, most = _least_and_most(models, sizes)
    return f"{least} bytes" if least == most else f"{least} bytes, {most} with 64-bit pointers"


def characters_note(dimensions: Sequence[int], wide: bool) -> str:
    """Return what the characters of a string, or of each of several, have room for."""
    each = "each " if len(dimensions) > 1 else ""
    unit = "UTF-16 units" if wide else "bytes"
    return f"{each}{dimensions[-1] - 1} {unit} and the terminator"


def _sizes(models: Sequence[DataModel], sizes: Sequence[int]) -> str:
    least, most = _least_and_most(models, sizes)
    return f"{least}" if least == most else f"{least} ({most})"


def _least_and_most(models: Sequence[DataModel], sizes: Sequence[int]) -> tuple[int, int]:
    """Return the sizes with 32-bit and 64-bit pointers; the only one twice where the output is for one data model."""
    if len(models) == 1:
        return sizes[0], sizes[0]
    return sizes[models.index(ILP32)], sizes[models.index(LP64)]


def _bounds(field: Field) -> Iterator[str]:
    if isinstance(field.type, SequenceType) and field.type.bound is not None:
        yield f"At most {field.type.bound} element{'' if field.type.bound == 1 else 's'}."
    element = element_of(field.type)
    if isinstance(element, StringType) and element.bound is not None:
        each = "Each at" if isinstance(field.type, (ArrayType, SequenceType)) else "At"
        unit = "UTF-16 units" if element.wide else "bytes of UTF-8"
        yield f"{each} most {element.bound} {unit}, without the terminator."


def _default(field: Field) -> Iterator[str]:
    element = element_of(field.type)
    if field.default is None or isinstance(element, NamedType):
        return
    if not isinstance(field.default, tuple):
        yield f"Default: {_literal(element, field.default)}"
        return
    text = ", ".join(_literal(element, value) for value in field.default)
    yield f"Default: {{{text}}}" if len(text) < _LONGEST_DEFAULT else f"Default: {len(field.default)} values"


def _literal(element: Primitive | StringType, value: ScalarValue) -> str:
    return _text(str(value)) if isinstance(element, StringType) else number(element, value)


def _text(text: str) -> str:
    """Return `text` in quotes for readers: as in C, but letters of every script are shown."""
    shown = "".join(c if ord(c) > 0x7F and c.isprintable() else string(c)[1:-1] for c in text)
    return f'"{shown}"'
