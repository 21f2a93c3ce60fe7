# SPDX-License-Identifier: Apache-2.0
"""The encoding steps of each type: positions, runs that are copied at once, computed alignment.

A position is a constant until the first part of variable length, and relative to the C variable `position`
from there on. A nested type of few variable parts is written in place; elements of arrays and sequences, and
larger nested types, have their own function (`called`), which starts at any position.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

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
from microros_gen.typesupport.plan.limits import Homes, LimitMember, limit_members, plan_homes
from microros_gen.typesupport.plan.size import LENGTH_SIZE, TypeLimits, members
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


@dataclass(frozen=True)
class WirePlan:
    """The encoding of one type.

    `root_steps`: the body of the root's encoder, from position 0; None where it calls `encode_at`.
    `at_steps`: the body of `encode_at`; None where no other type and no entity's own limits call it.
    `limit_members`: the type's table of limits, passed to `encode_at` because uses differ; empty: constants.
    """

    root_steps: tuple[Step, ...] | None
    at_steps: tuple[Step, ...] | None
    limit_members: tuple[LimitMember, ...]
    root_limits: TypeLimits | None

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps of all of its functions."""
        return (*(self.root_steps or ()), *(self.at_steps or ()))

    @property
    def calls(self) -> tuple[TypeName, ...]:
        """Types whose functions are called, sorted."""
        return tuple(sorted({s.type for s in self.steps if isinstance(s, (Messages, Part))}))


@dataclass(frozen=True)
class WirePlans:
    """`plans` of the types that have an encoder; `home_limits`: the limits that a type has by itself."""

    plans: Mapping[TypeName, WirePlan]
    home_limits: Mapping[TypeName, TypeLimits | None]


def plan_wire(
    messages: Mapping[TypeName, Message],
    root_limits: Mapping[TypeName, TypeLimits | None],
    own_limits: Mapping[TypeName, Collection[TypeLimits]],
    converts_float64: bool = False,
) -> WirePlans:
    """Plan the encoders of the roots and of every type that they call.

    `own_limits`: those of entities that send a root and have their own limits, which call its `encode_at` too.
    `converts_float64`: a double of the target is no binary64.
    """
    facts = _Facts(messages, plan_homes(messages, root_limits, own_limits), converts_float64)
    called = _called(facts, root_limits) | set(own_limits)
    facts.called = frozenset(called)
    plans = {}
    for name in messages:
        if name in root_limits or name in called:
            plans[name] = _plan_type(facts, name, name in root_limits)
    return WirePlans(plans, facts.homes.limits)


def _plan_type(facts: _Facts, name: TypeName, root: bool) -> WirePlan:
    home = facts.homes.limits.get(name)
    called = name in facts.called
    fixed = facts.fixed(name)
    root_steps = at_steps = None
    table = facts.takes_limits(name)
    if called:
        at_steps = _Emitter(facts, True).type_steps(name, None if table else home)
    if root and (fixed or not called):
        root_steps = _Emitter(facts, False).type_steps(name, home)
    names = limit_members(name, facts.messages, facts.homes, facts.is_inline) if table else ()
    return WirePlan(root_steps, at_steps, names, home if root else None)


def _called(facts: _Facts, roots: Mapping[TypeName, TypeLimits | None]) -> set[TypeName]:
    """Return the types that have an `encode_at`: elements, and large nested types."""
    called: set[TypeName] = set()
    pending = list(roots)
    seen: set[TypeName] = set()
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        for found in _called_by(facts, name):
            called.add(found)
            pending.append(found)
    return called


def _called_by(facts: _Facts, name: TypeName) -> Iterator[TypeName]:
    for field in facts.messages[name].fields:
        element = element_of(field.type)
        if not isinstance(element, NamedType):
            continue
        if isinstance(field.type, NamedType) and facts.is_inline(element.name):
            yield from _called_by(facts, element.name)
        else:
            yield element.name


class _Facts(TypeFacts):
    """What the emitter asks about types: where limits differ, and which types have their own function."""

    def __init__(self, messages: Mapping[TypeName, Message], homes: Homes, converts_float64: bool) -> None:
        super().__init__(messages, converts_float64)
        self.homes = homes
        self.called: frozenset[TypeName] = frozenset()

    def takes_limits(self, name: TypeName) -> bool:
        """Return whether `encode_at` gets a table: its limits differ from use to use."""
        return name in self.called and name in self.homes.differing


class _Emitter:
    """Emits the steps of one function."""

    def __init__(self, facts: _Facts, variable: bool) -> None:
        self._facts = facts
        self._steps: list[Step] = []
        self._run: list[Leaf] = []
        self._run_end = 0
        self._variable = variable
        self._offset = 0
        self._modulus = 1 if variable else 8

    def type_steps(self, name: TypeName, limits: TypeLimits | None) -> tuple[Step, ...]:
        """Return the steps of the whole type; limits None for a type of variable length: from the table."""
        table = limits is None and not self._facts.fixed(name)
        self._type(name, "", "" if table else None, limits, 0)
        self._flush_run()
        return tuple(self._steps)

    def _type(
        self, name: TypeName, member: str, table: str | None, limits: TypeLimits | None, c_offset: int
    ) -> None:
        fields = members(self._facts.messages[name])
        offsets = self._facts.layouts.offsets(name)
        entries = limits.fields if limits else (None,) * len(fields)
        for field, entry in zip(fields, entries, strict=True):
            path = f"{member}.{field.name}" if member else field.name
            here = None if table is None else f"{table}{field.name}"
            at = c_offset + offsets[field.name]
            bound = field.type.bound if isinstance(field.type, SequenceType) else None
            sequence = Limit(entry.sequence if entry else None, here or "", bound)
            element = element_of(field.type)
            text = Limit(
                entry.string if entry else None,
                f"{here}__string" if here and isinstance(field.type, SequenceType) else (here or ""),
                element.bound if isinstance(element, StringType) else None,
            )
            self._field(field, path, here, (sequence, text), entry.nested if entry else None, at)

    def _field(
        self,
        field: Field,
        path: str,
        table: str | None,
        limits: tuple[Limit, Limit],
        nested: TypeLimits | None,
        c_offset: int,
    ) -> None:
        element = element_of(field.type)
        count = field.type.size if isinstance(field.type, ArrayType) else None
        sequence = limits[0] if isinstance(field.type, SequenceType) else None
        if isinstance(element, NamedType) and count is None and sequence is None:
            self._nested(element.name, path, table, nested, c_offset)
        elif isinstance(element, NamedType):
            self._messages(element.name, path, table, nested, count, sequence)
        elif isinstance(element, StringType):
            self._text(element, path, limits[1], count, sequence)
        elif sequence is None:
            self._leaf(path, element, count, c_offset)
        else:
            self._numbers(path, element, sequence)

    def _nested(
        self, name: TypeName, path: str, table: str | None, limits: TypeLimits | None, c_offset: int
    ) -> None:
        if table is not None and name not in self._facts.homes.differing:
            table, limits = None, self._facts.homes.limits.get(name)
        if self._facts.is_inline(name):
            self._type(name, path, None if table is None else f"{table}__", limits, c_offset)
            return
        place = self._here()
        self._emit(Part(place, path, name, *self._argument(name, table, limits)))
        self._after_variable(1)

    def _argument(
        self, name: TypeName, table: str | None, limits: TypeLimits | None
    ) -> tuple[str | None, TypeLimits | None]:
        """Return how a call passes the limits: a member of the own table, or a constant table; None: not at
        all."""
        if not self._facts.takes_limits(name):
            return None, None
        return (table, None) if table is not None else (None, limits)

    def _messages(
        self,
        name: TypeName,
        path: str,
        table: str | None,
        limits: TypeLimits | None,
        count: int | None,
        sequence: Limit | None,
    ) -> None:
        packed = self._facts.packed(name)
        fixed = self._facts.fixed(name)
        if sequence is not None:
            self._align(LENGTH_SIZE)
        if packed and count is not None:
            self._align(packed[1])
        suffix = "" if sequence is None else "__limits"
        argument = self._argument(name, None if table is None else f"{table}{suffix}", limits)
        size, alignment = packed or (0, 1)
        self._emit(Messages(self._here(), path, name, *argument, fixed, size, alignment, count, sequence))
        if packed and count is not None:
            self._offset += size * count
        else:
            self._after_variable(min(alignment, LENGTH_SIZE) if packed else 1)

    def _text(
        self, element: StringType, path: str, limit: Limit, count: int | None, sequence: Limit | None
    ) -> None:
        if count is None and sequence is None:
            self._align(LENGTH_SIZE)
            self._emit(Text(self._here(), path, element.wide, limit))
        else:
            if sequence is not None:
                self._align(LENGTH_SIZE)
            self._emit(Texts(self._here(), path, element.wide, limit, count, sequence))
        self._after_variable(LENGTH_SIZE if element.wide else 1)

    def _numbers(self, path: str, primitive: Primitive, limit: Limit) -> None:
        self._align(LENGTH_SIZE)
        self._emit(Numbers(self._here(), path, primitive, limit, self._facts.form(primitive)))
        self._after_variable(min(primitive.size, LENGTH_SIZE))

    def _leaf(self, path: str, primitive: Primitive, count: int | None, c_offset: int) -> None:
        contiguous = self._run and c_offset == self._run_end
        is_copied = self._facts.is_copied(primitive)
        if not contiguous or not is_copied or not self._is_aligned(primitive.size):
            self._flush_run()
        self._align(primitive.size)
        leaf = Leaf(self._here(), path, primitive, count, self._facts.form(primitive))
        self._offset += leaf.size
        self._run_end = c_offset + leaf.size
        if is_copied:
            self._run.append(leaf)
        else:
            self._steps.append(leaf)

    def _is_aligned(self, alignment: int) -> bool:
        return self._offset % alignment == 0 and (not self._variable or self._modulus >= alignment)

    def _align(self, alignment: int) -> None:
        if self._is_aligned(alignment):
            return
        self._flush_run()
        if self._variable and self._modulus < alignment:
            self._steps.append(Align(self._here(), alignment))
            self._offset, self._modulus = 0, alignment
            return
        padding = -self._offset % alignment
        self._steps.append(Zeros(self._here(), padding))
        self._offset += padding

    def _after_variable(self, modulus: int) -> None:
        self._variable, self._offset, self._modulus = True, 0, modulus

    def _here(self) -> Place:
        return Place(self._variable, self._offset)

    def _emit(self, step: Step) -> None:
        self._flush_run()
        self._steps.append(step)

    def _flush_run(self) -> None:
        if len(self._run) == 1:
            self._steps.append(self._run[0])
        elif self._run:
            self._steps.append(Run(self._run[0].place, tuple(self._run)))
        self._run = []
