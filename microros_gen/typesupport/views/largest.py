# SPDX-License-Identifier: Apache-2.0
"""Largest encoded sizes, spelled out for static assertions: the encoder's own steps with everything full.

typesupport/plan/size.py has the size from the members of the type; here it follows from the steps that are generated,
and the compiler works it out once more. A line is one part of variable length: where it ends, which is where the next
line begins. Elements of a sequence after its first have one stride, so two of them are listed at most; and what was
listed from a position of the same alignment is not listed again, be it in the assertion of a type that is part of
this one. So the text grows with the members.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from microros_gen.interfaces.types import FieldType, Primitive, SequenceType, StringType, TypeName, element_of
from microros_gen.typesupport.plan.limits import limit_value
from microros_gen.typesupport.plan.size import LENGTH_SIZE, WIDE_CHARACTER_SIZE, TypeLimits, align, members
from microros_gen.typesupport.plan.steps import (
    Align,
    Leaf,
    Limit,
    Messages,
    Numbers,
    Part,
    Place,
    Run,
    Step,
    Text,
    Texts,
    Zeros,
)
from microros_gen.typesupport.plan.types import TypePlan

LARGEST_UNSIGNED = 0xFFFF
"""What `unsigned int` holds at least: sums of larger numbers need a suffix."""


class _At(NamedTuple):
    """A position: `offset` bytes after `base`, which is `computed` by an expression in C or, None, a number."""

    base: int
    computed: str | None = None
    offset: int = 0

    @property
    def value(self) -> int:
        """The position itself."""
        return self.base + self.offset

    @property
    def literal(self) -> bool:
        """Whether the expression is just a number."""
        return self.computed is None and (self.offset == 0 or self.base == 0)

    @property
    def text(self) -> str:
        """The expression in C."""
        if self.literal:
            return f"{self.value}U"
        suffix = "UL" if self.value > LARGEST_UNSIGNED else "U"
        start = self.computed if self.computed is not None else f"{self.base}{suffix}"
        return f"{start} + {self.offset}U" if self.offset else start

    def plus(self, count: int) -> _At:
        """Return the position `count` bytes after it."""
        return _At(self.base, self.computed, self.offset + count)


class _Alignments:
    """The largest alignment in each type on the wire."""

    def __init__(self, plans: Mapping[TypeName, TypePlan]) -> None:
        self._plans = plans
        self._known: dict[TypeName, int] = {}

    def of(self, name: TypeName) -> int:
        """Return it: 1, 2, 4 or 8."""
        if name not in self._known:
            fields = members(self._plans[name].message)
            self._known[name] = max(self._field(field.type) for field in fields)
        return self._known[name]

    def _field(self, kind: FieldType) -> int:
        element = element_of(kind)
        if isinstance(element, StringType):
            return LENGTH_SIZE
        own = element.size if isinstance(element, Primitive) else self.of(element.name)
        return max(own, LENGTH_SIZE if isinstance(kind, SequenceType) else 1)


_Use = tuple[TypeName, "TypeLimits | None"]
"""A type under the limits that its table has; None where it has no table."""

_Passed = dict[tuple[int, int], tuple[_At, _At]]
"""A step of a type, at a position modulo the largest alignment: that position, and where the type ended."""


class LargestSize(NamedTuple):
    """The conditions that show a largest size, and the types whose own sizes they name."""

    conditions: tuple[str, ...]
    types: tuple[TypeName, ...]


class LargestSizes:
    """Makes the conditions of the types of one plan; a root is listed once, for itself and for types it is in."""

    def __init__(self, plans: Mapping[TypeName, TypePlan]) -> None:
        self.plans = plans
        self.alignments = _Alignments(plans)
        self._roots: dict[TypeName, tuple[LargestSize, _Passed]] = {}

    def of(self, name: TypeName, limits: TypeLimits | None, c_name: str) -> LargestSize:
        """Return the conditions, in C, that hold where `c_name`__MAX_ENCODED_SIZE is the largest body of a type.

        `limits`: those of a root itself, or of an entity with its own names that begin with `c_name`.
        """
        if c_name == self.plans[name].c_name:
            return self._root(name)[0]
        return _Listing(self).of(name, limits, c_name)[0]

    def passed(self, name: TypeName, limits: TypeLimits | None) -> _Passed:
        """Return what the conditions of the type itself say of a use; nothing where limits differ or it is no root."""
        plan = self.plans[name]
        if not plan.root or plan.fixed_size or (limits is not None and limits != plan.limits):
            return {}
        return dict(self._root(name)[1])

    def _root(self, name: TypeName) -> tuple[LargestSize, _Passed]:
        if name not in self._roots:
            plan = self.plans[name]
            self._roots[name] = _Listing(self).of(name, plan.limits, plan.c_name)
        return self._roots[name]


class _Listing:
    """Walks through the steps of one body, from its first byte.

    `_base` is where the encoder's variable `position` stands, `_end` the position after the last step, `_table`
    the limits that the present function is given.
    """

    def __init__(self, sizes: LargestSizes) -> None:
        self._sizes = sizes
        self._lines: list[str] = []
        self._named: set[TypeName] = set()
        self._known: dict[_Use, _Passed] = {}
        self._base = self._end = _At(0)
        self._table: Mapping[str, int | TypeLimits | None] = {}

    def of(self, name: TypeName, limits: TypeLimits | None, c_name: str) -> tuple[LargestSize, _Passed]:
        """Return the conditions, the last one about the size; and what they say, for types that this one is in."""
        wire = self._sizes.plans[name].wire
        size = f"{c_name}__MAX_ENCODED_SIZE"
        passed: _Passed = {}
        if wire is not None and wire.root_steps is not None:
            for step in wire.root_steps:
                self._step(step)
        else:
            self._known[name, limits if wire is not None and wire.limit_members else None] = passed
            self._message(name, limits, _At(0))
        self._lines.append(f"((uint32_t){size} == {_whole(self._end)})")
        largest = LargestSize(tuple(self._lines), tuple(sorted(self._named)))
        return largest, {key: (at, _At(end.value, size)) for key, (at, end) in passed.items()}

    def _step(self, step: Step) -> None:
        _STEPS[type(step)](self, step, self._place(step.place))

    def _place(self, place: Place) -> _At:
        return (self._base if place.variable else _At(0)).plus(place.offset)

    def _message(self, name: TypeName, limits: TypeLimits | None, at: _At) -> _At:
        """Move after a message that begins at `at`; return that position."""
        wire = self._sizes.plans[name].wire
        if wire is None or wire.at_steps is None:
            raise ValueError(f"no encoder of {name} starts at any position")
        table = wire.limit_members if limits is not None else ()
        outer = self._table
        self._table = {m.name: limit_value(limits, m) for m in table} if limits is not None else {}
        self._moved(self._settled(at))
        end = self._from(wire.at_steps, (name, limits if table else None))
        self._table = outer
        return self._moved(end)

    def _from(self, steps: tuple[Step, ...], use: _Use) -> _At:
        """Pass the steps of a type, until the rest of it was listed from a position of the same alignment."""
        if use not in self._known:
            self._known[use] = self._sizes.passed(*use)
        known = self._known[use]
        largest = self._sizes.alignments.of(use[0])
        passed: dict[tuple[int, int], _At] = {}
        for index, step in enumerate(steps):
            if self._base.literal and self._end is self._base:
                key = (index, self._base.value % largest)
                if key in known:
                    end = self._like(use[0], *known[key])
                    break
                passed[key] = self._base
            self._step(step)
        else:
            end = self._settled(self._end)
        known.update({key: (at, end) for key, at in passed.items()})
        return end

    def _like(self, name: TypeName, from_: _At, to: _At) -> _At:
        """Pass what takes the same bytes as the end of another message of a type, between two positions."""
        at = self._base
        if to.computed is not None:
            self._named.add(name)
        alignment = self._sizes.alignments.of(name)
        text = f"CDR_END_LIKE({at.text}, {from_.text}, {to.text}, {alignment}U)"
        return self._line(text, at.value + to.value - from_.value)

    def _settled(self, at: _At) -> _At:
        """Return `at` as a number, with a line that says so."""
        return at if at.literal else self._line(at.text, at.value)

    def _line(self, expression: str, value: int) -> _At:
        """Add a line: something ends at `value`."""
        end = _At(value)
        self._lines.append(f"({expression} == {end.text})")
        return self._moved(end)

    def _moved(self, end: _At) -> _At:
        self._base = self._end = end
        return end

    def _limit(self, limit: Limit) -> int:
        value = limit.value if limit.value is not None else self._table[limit.table]
        return value if isinstance(value, int) else 0

    def _argument(self, step: Messages | Part) -> TypeLimits | None:
        """Return the limits that a call passes on."""
        value = self._table[step.table] if step.table is not None else step.limits
        return value if isinstance(value, TypeLimits) else None

    def zeros(self, step: Zeros, at: _At) -> None:
        """Pass constant padding."""
        self._end = at.plus(step.count)

    def align(self, step: Align, at: _At) -> None:
        """Pass padding that depends on the position."""
        self._moved(_At(align(at.value, step.to), f"CDR_ALIGNED({at.text}, {step.to}U)"))

    def numbers(self, step: Leaf | Run, at: _At) -> None:
        """Pass numbers."""
        self._end = at.plus(step.size)

    def text(self, step: Text, at: _At) -> None:
        """Pass a string."""
        limit = self._limit(step.limit)
        kind = "WSTRING" if step.wide else "STRING"
        self._line(f"CDR_END_OF_{kind}({at.text}, {limit}U)", at.value + _text_size(step.wide, limit))

    def texts(self, step: Texts, at: _At) -> None:
        """Pass an array or a sequence of strings."""
        start, count = self._elements(step.count, step.sequence, at)
        if count == 0:
            self._moved(start)
            return
        limit = self._limit(step.limit)
        size = _text_size(step.wide, limit)
        kind = "WSTRINGS" if step.wide else "STRINGS"
        end = align(start.value, LENGTH_SIZE) + (count - 1) * align(size, LENGTH_SIZE) + size
        self._line(f"CDR_END_OF_{kind}({start.text}, {count}U, {limit}U)", end)

    def sequence(self, step: Numbers, at: _At) -> None:
        """Pass a sequence of numbers."""
        width = step.primitive.size
        self._packed(at, self._limit(step.limit), width, width)

    def messages(self, step: Messages, at: _At) -> None:
        """Pass an array or a sequence of messages."""
        if step.packed and step.count is not None:
            self._end = at.plus(step.count * step.packed)
            return
        start, count = self._elements(step.count, step.sequence, at)
        if step.packed:
            self._packed(at, count, step.packed, step.alignment)
            return
        self._moved(start)
        limits = self._argument(step)
        ends = [self._message(step.type, limits, self._end) for _ in range(min(count, 2))]
        if count > 2:
            first, second = ends
            value = first.value + (count - 1) * (second.value - first.value)
            self._line(f"CDR_END_OF_MESSAGES({count}U, {first.text}, {second.text})", value)

    def part(self, step: Part, at: _At) -> None:
        """Pass a nested message that has its own encoder."""
        self._message(step.type, self._argument(step), at)

    def _elements(self, count: int | None, sequence: Limit | None, at: _At) -> tuple[_At, int]:
        """Return where the first element may be, and how many there are."""
        if sequence is None:
            return at, count or 0
        return at.plus(LENGTH_SIZE), self._limit(sequence)

    def _packed(self, at: _At, count: int, size: int, alignment: int) -> None:
        if count == 0:
            self._moved(at.plus(LENGTH_SIZE))
            return
        end = align(at.value + LENGTH_SIZE, alignment) + count * size
        self._line(f"CDR_END_OF_SEQUENCE({at.text}, {count}U, {size}U, {alignment}U)", end)


_STEPS: Mapping[type, Callable[[_Listing, Any, _At], None]] = {
    Zeros: _Listing.zeros,
    Align: _Listing.align,
    Leaf: _Listing.numbers,
    Run: _Listing.numbers,
    Text: _Listing.text,
    Texts: _Listing.texts,
    Numbers: _Listing.sequence,
    Messages: _Listing.messages,
    Part: _Listing.part,
}


def _text_size(wide: bool, limit: int) -> int:
    return LENGTH_SIZE + (limit * WIDE_CHARACTER_SIZE if wide else limit + 1)


def _whole(at: _At) -> str:
    return at.text if at.literal else f"({at.text})"
