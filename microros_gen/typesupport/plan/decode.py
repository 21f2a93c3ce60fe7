# SPDX-License-Identifier: Apache-2.0
"""The decoding steps of each type that is received: which members are read by one call, and which by another type.

Positions are counted when the program runs (padding depends on what was read before), so a step says what is
read, not where. Capacities are those of the message that is read into; only bounds of the interface file are
constants here.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Union

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
from microros_gen.typesupport.plan.facts import TypeFacts
from microros_gen.typesupport.plan.names import TypeFiles
from microros_gen.typesupport.plan.size import members


@dataclass(frozen=True)
class Number:
    """A number, or an array of `count` numbers; `member` is its path in the C struct."""

    member: str
    count: int | None


@dataclass(frozen=True)
class Row:
    """Numbers of one size, `width` bytes, that follow each other on the wire and, as the C code asserts, in C."""

    width: int
    numbers: tuple[Number, ...]

    @property
    def count(self) -> int:
        """How many numbers these are."""
        return sum(1 if n.count is None else n.count for n in self.numbers)


@dataclass(frozen=True)
class Converted:
    """A number that differs in memory, or an array of `count`; `form` is that of TypeFacts."""

    member: str
    count: int | None
    form: str


@dataclass(frozen=True)
class NumberSequence:
    """A sequence of numbers or bools; `form` is that of TypeFacts; `bound` None: without."""

    member: str
    form: str
    bound: int | None


@dataclass(frozen=True)
class Strings:
    """A string; an array (`count`) or a sequence (`sequence`, of at most `sequence_bound`) of strings."""

    member: str
    wide: bool
    bound: int | None
    count: int | None
    sequence: bool
    sequence_bound: int | None


@dataclass(frozen=True)
class Messages:
    """An array (`count`) or a sequence (`bound`) of messages.

    `row`: size and count of an element's numbers, where all have one size and none is converted; they are read at
    once then.
    """

    member: str
    type: TypeName
    count: int | None
    bound: int | None
    row: tuple[int, int] | None


@dataclass(frozen=True)
class Part:
    """A nested message with a separate decoder."""

    member: str
    type: TypeName


DecodeStep = Union[Row, Converted, NumberSequence, Strings, Messages, Part]  # noqa: UP007


@dataclass(frozen=True)
class DecodePlan:
    """The decoder of one type, for its handle and for the decoders of types that contain it."""

    steps: tuple[DecodeStep, ...]

    @property
    def calls(self) -> tuple[TypeName, ...]:
        """Types whose decoders are called, sorted."""
        return tuple(sorted(set(_called(self.steps))))


def decode_files(files: TypeFiles) -> tuple[str, str]:
    """Return the paths of a type's decoder below the output folder: header and source."""
    return (
        files.type_support.replace("__type_support.h", "__decode.h"),
        files.type_support_source.replace("__type_support.c", "__decode.c"),
    )


def plan_decoders(
    messages: Mapping[TypeName, Message], received: Collection[TypeName], converts_float64: bool = False
) -> dict[TypeName, DecodePlan]:
    """Plan the decoders of the `received` types and of every type that they call.

    `converts_float64`: a double of the target is no binary64.
    """
    facts = TypeFacts(messages, converts_float64)
    steps: dict[TypeName, tuple[DecodeStep, ...]] = {}
    pending = sorted(received)
    while pending:
        name = pending.pop()
        if name in steps:
            continue
        steps[name] = tuple(_Reader(facts).steps(name))
        pending += sorted(set(_called(steps[name])))
    return {n: DecodePlan(steps[n]) for n in messages if n in steps}


def _called(steps: Iterable[DecodeStep]) -> Iterator[TypeName]:
    """Yield the types whose decoders the steps call."""
    for step in steps:
        if isinstance(step, Part) or (isinstance(step, Messages) and step.row is None):
            yield step.type


class _Reader:
    """Makes the steps of one function."""

    def __init__(self, facts: TypeFacts) -> None:
        self._facts = facts
        self._steps: list[DecodeStep] = []
        self._row: list[Number] = []
        self._width = 0
        self._end = 0

    def steps(self, name: TypeName) -> list[DecodeStep]:
        """Return the steps of the whole type."""
        self._type(name, "", 0)
        self._end_row()
        return self._steps

    def _type(self, name: TypeName, prefix: str, offset: int) -> None:
        offsets = self._facts.layouts.offsets(name)
        for field in members(self._facts.messages[name]):
            self._field(field, prefix + field.name, offset + offsets[field.name])

    def _field(self, field: Field, path: str, offset: int) -> None:
        element = element_of(field.type)
        count = field.type.size if isinstance(field.type, ArrayType) else None
        sequence = isinstance(field.type, SequenceType)
        bound = field.type.bound if isinstance(field.type, SequenceType) else None
        if isinstance(element, NamedType) and count is None and not sequence:
            self._nested(element.name, path, offset)
        elif isinstance(element, NamedType):
            self._emit(Messages(path, element.name, count, bound, row_of(self._facts, element.name)))
        elif isinstance(element, StringType):
            self._emit(Strings(path, element.wide, element.bound, count, sequence, bound))
        elif sequence:
            self._emit(NumberSequence(path, self._facts.form(element), bound))
        elif not self._facts.is_copied(element):
            self._emit(Converted(path, count, self._facts.form(element)))
        else:
            self._number(path, element.size, count, offset)

    def _nested(self, name: TypeName, path: str, offset: int) -> None:
        if self._facts.is_inline(name):
            self._type(name, f"{path}.", offset)
        else:
            self._emit(Part(path, name))

    def _number(self, path: str, width: int, count: int | None, offset: int) -> None:
        if self._row and (width != self._width or offset != self._end):
            self._end_row()
        self._row.append(Number(path, count))
        self._width = width
        self._end = offset + width * (1 if count is None else count)

    def _emit(self, step: DecodeStep) -> None:
        self._end_row()
        self._steps.append(step)

    def _end_row(self) -> None:
        if self._row:
            self._steps.append(Row(self._width, tuple(self._row)))
        self._row = []


def row_of(facts: TypeFacts, name: TypeName) -> tuple[int, int] | None:
    """Return size and count of the numbers of a type that has nothing else, all of one size; else None."""
    if not facts.fixed(name):
        return None
    leaves = list(facts.leaves(name))
    sizes = set(_sizes(facts, leaves))
    if len(sizes) != 1 or 0 in sizes:
        return None
    (width,) = sizes
    return width, sum(leaf[1] for leaf in leaves if leaf is not None)


def _sizes(facts: TypeFacts, leaves: list[tuple[Primitive, int] | None]) -> Iterator[int]:
    """Yield the size of each number; 0 for what is none, or is converted."""
    for leaf in leaves:
        yield leaf[0].size if leaf is not None and facts.is_copied(leaf[0]) else 0
