# SPDX-License-Identifier: Apache-2.0
"""Views of the type support: each step of an encoder with its C expressions spelled out."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.decode import decode_files
from microros_gen.typesupport.plan.facts import DOUBLE
from microros_gen.typesupport.plan.limits import LimitMember, limit_value
from microros_gen.typesupport.plan.names import c_name, guard, include_path, type_files
from microros_gen.typesupport.plan.own_limits import LimitSet
from microros_gen.typesupport.plan.size import TypeLimits
from microros_gen.typesupport.plan.steps import (
    Align,
    Leaf,
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
from microros_gen.typesupport.views.largest import LargestSizes
from microros_gen.typesupport.views.steps import StepView, StepViews, cdr_size, position

DOUBLE_ENCODERS = "microros/cdr_double.h"
"""The header of what writes a float64 where a double is no binary64."""


@dataclass(frozen=True)
class FunctionView:
    """One function: `encodes` says whether its steps write or only move on."""

    head: str
    prologue: tuple[str, ...]
    encodes: bool
    steps: tuple[StepView, ...]
    result: str


@dataclass(frozen=True)
class TableView:
    """A constant table of limits."""

    comment: str
    type: str
    name: str
    value: str


@dataclass(frozen=True)
class AtView:
    """Declarations of the functions that start at any position."""

    refusal: str
    encode_parameters: str
    end_parameters: str


@dataclass(frozen=True)
class LimitSetView:
    """The type under the limits of some entities: a constant microros_message_type_t that begins with `name`.

    `largest`: the conditions that show its largest size.
    """

    name: str
    max_encoded_size: int
    entities: str
    largest: tuple[str, ...]


@dataclass(frozen=True)
class TypeSupportView:
    """type_support.h.j2 and type_support.c.j2."""

    guard: str
    ros_name: str
    name: str
    dds_name: str
    type_hash: str
    handle: str
    root: bool
    max_encoded_size: int
    type_support_header: str
    header_includes: tuple[str, ...]
    includes: tuple[str, ...]
    size_assertion: str
    largest: tuple[str, ...]
    at: AtView | None
    table: tuple[str, ...]
    tables: tuple[TableView, ...]
    functions: tuple[FunctionView, ...]
    decode: str
    limit_sets: tuple[LimitSetView, ...]


class EncoderViews:
    """Makes the views; it knows the plans of all types, because a call depends on the callee's plan."""

    def __init__(self, plans: Mapping[TypeName, TypePlan]) -> None:
        self._plans = plans
        self._largest = LargestSizes(plans)

    def view(self, plan: TypePlan) -> TypeSupportView:
        """Return the view of a type that has an encoder (`plan.wire` is not None)."""
        wire = plan.wire
        if wire is None:
            raise ValueError(f"{plan.name} has no encoder")
        builder = _Builder(self._plans, plan, self._largest)
        at = builder.at_view() if wire.at_steps is not None else None
        functions = builder.functions()
        largest = builder.largest(plan.c_name, plan.limits) if plan.root else ()
        limit_sets = tuple(builder.limit_set(own) for own in plan.limit_sets if own.sends)
        handle = f"rosidl_typesupport_c__get_message_type_support_handle__{plan.c_name}"
        return TypeSupportView(
            guard=guard(plan.files.type_support),
            ros_name=str(plan.name),
            name=plan.c_name,
            dds_name=plan.dds_name,
            type_hash=plan.type_hash,
            handle=handle,
            root=plan.root,
            max_encoded_size=plan.max_encoded_size,
            type_support_header=include_path(plan.files.type_support),
            header_includes=builder.header_includes(),
            includes=builder.includes(),
            size_assertion=builder.size_assertion(),
            largest=largest,
            at=at,
            table=tuple(_table_declaration(member) for member in wire.limit_members),
            tables=tuple(builder.tables),
            functions=functions,
            decode=f"{plan.c_name}__decode" if plan.received else "NULL",
            limit_sets=limit_sets,
        )


class _Builder:
    """Builds the functions of one type."""

    def __init__(self, plans: Mapping[TypeName, TypePlan], plan: TypePlan, largest: LargestSizes) -> None:
        self.tables: list[TableView] = []
        self._largest = largest
        self._named: set[TypeName] = set()
        self._plans = plans
        self._plan = plan
        self._name = plan.c_name

    def at_view(self) -> AtView:
        """Return the declarations of `encode_at` and `end_at`."""
        if self._plan.fixed_size:
            encode = f"const {self._name} * message, uint8_t * body, uint32_t position"
            return AtView("", encode, "uint32_t position")
        table = f"const {self._name}__Limits * limits, " if self._takes_limits(self._plan) else ""
        encode = (
            f"const {self._name} * message, uint8_t * body, uint32_t position,\n  {table}cdr_fault_t * fault"
        )
        end = f"const {self._name} * message, uint32_t position, {table}cdr_fault_t * fault"
        return AtView(", or 0 with `fault` filled", encode, end)

    def header_includes(self) -> tuple[str, ...]:
        """Return what the header includes."""
        wire = self._plan.wire
        found = {include_path(self._plan.files.struct), "rosidl_runtime_c/message_type_support_struct.h"}
        if wire is not None and wire.at_steps is not None:
            found.add("microros/message_type.h")
        for member in wire.limit_members if wire else ():
            if member.type is not None:
                found.add(include_path(type_files(member.type).type_support))
        return tuple(sorted(found))

    def includes(self) -> tuple[str, ...]:
        """Return what the source includes, besides its own header."""
        found = {"microros/cdr.h"}
        if self._plan.root or self._plan.limit_sets:
            found.add("microros/cdr_sizes.h")
        for name in (*(self._plan.wire.calls if self._plan.wire else ()), *self._named):
            found.add(include_path(type_files(name).type_support))
        if self._plan.wire is not None and any(map(_converts_double, self._plan.wire.steps)):
            found.add(DOUBLE_ENCODERS)
        if self._plan.received:
            found.add(include_path(decode_files(self._plan.files)[0]))
        return tuple(sorted(found))

    def size_assertion(self) -> str:
        """Return the condition that shows that the plan's size of the struct is the compiler's."""
        return f"sizeof({self._name}) == {cdr_size(self._plan.struct_sizes)}"

    def largest(self, name: str, limits: TypeLimits | None) -> tuple[str, ...]:
        """Return the conditions that show the size that begins with `name`; `includes` has what they need then."""
        found = self._largest.of(self._plan.name, limits, name)
        self._named.update(found.types)
        return found.conditions

    def limit_set(self, own: LimitSet) -> LimitSetView:
        """Return the view of the type under the limits of some entities."""
        return LimitSetView(
            own.name, own.max_encoded_size, _entities(own), self.largest(own.name, own.limits)
        )

    def functions(self) -> tuple[FunctionView, ...]:
        """Return the functions of the source, callees first."""
        wire = self._plan.wire
        found: list[FunctionView] = []
        if wire is not None and wire.at_steps is not None:
            found += self._at_functions(wire.at_steps)
        if wire is not None and self._plan.root:
            found += self._root_functions(wire.root_steps)
        for own in self._plan.limit_sets:
            found += self._limited_functions(own) if own.sends else []
        return tuple(found)

    def _limited_functions(self, own: LimitSet) -> list[FunctionView]:
        """Return the encoder and the size under the limits of some entities."""
        suffix = own.name.removeprefix(f"{self._name}__")
        comment = f"Limits of {_entities(own)}."
        table = self._constant_table(self._plan.name, own.limits, comment, f"{suffix}__limits")
        return self._wrappers(own.name, f"&{table}, ")

    def _wrappers(self, name: str, limits: str) -> list[FunctionView]:
        """Return `encode` and `encoded_size` that call the functions that start at any position."""
        message = (self._message(),)
        at = f"{self._name}__encode_at(message, body, 0U, {limits}fault)"
        end = f"{self._name}__end_at(message, 0U, {limits}fault)"
        return [
            FunctionView(_encode_head(name), message, True, (), at),
            FunctionView(_size_head(name), message, False, (), end),
        ]

    def _message(self) -> str:
        return f"const {self._name} * const message = (const {self._name} *)untyped"

    def _at_functions(self, steps: tuple[Step, ...]) -> list[FunctionView]:
        at = self.at_view()
        views = self._views(steps)
        end = _end_of(steps, Place(True, 0))
        return [
            FunctionView(
                f"uint32_t {self._name}__encode_at(\n  {at.encode_parameters})",
                (),
                True,
                views,
                end,
            ),
            FunctionView(f"uint32_t {self._name}__end_at(\n  {at.end_parameters})", (), False, views, end),
        ]

    def _root_functions(self, steps: tuple[Step, ...] | None) -> list[FunctionView]:
        if steps is None:
            takes_limits = self._takes_limits(self._plan)
            return self._wrappers(self._name, f"&{self._root_table()}, " if takes_limits else "")
        encode, size = _encode_head(self._name), _size_head(self._name)
        message = self._message()
        views = self._views(steps)
        result = _end_of(steps, Place(False, 0))
        if self._plan.fixed_size:
            unused = ("(void)untyped", "(void)fault")
            moves = ("uint32_t position",) if _moves(steps) else ()
            return [
                FunctionView(encode, (message, *moves, "(void)fault"), True, views, result),
                FunctionView(size, unused, False, (), f"{self._name}__MAX_ENCODED_SIZE"),
            ]
        prologue = (message, "uint32_t position")
        return [
            FunctionView(encode, prologue, True, views, result),
            FunctionView(size, prologue, False, views, result),
        ]

    def _root_table(self) -> str:
        limits = self._plan.wire.root_limits if self._plan.wire else None
        return self._constant_table(self._plan.name, limits, "Limits of the declared type itself.", "limits")

    def _constant_table(self, name: TypeName, limits: TypeLimits | None, comment: str, suffix: str) -> str:
        table = f"{self._name}__{suffix}"
        if limits is not None and all(view.name != table for view in self.tables):
            value = self._table_value(name, limits)
            self.tables.append(TableView(comment, f"{c_name(name)}__Limits", table, value))
        return table

    def _table_value(self, name: TypeName, limits: TypeLimits) -> str:
        wire = self._plans[name].wire
        parts = []
        for member in wire.limit_members if wire else ():
            value = limit_value(limits, member)
            if isinstance(value, TypeLimits) and member.type is not None:
                parts.append(f".{member.name} = {self._table_value(member.type, value)}")
            elif not isinstance(value, TypeLimits):
                parts.append(f".{member.name} = {value or 0}U")
        return "{" + ", ".join(parts) + "}"

    def _takes_limits(self, plan: TypePlan) -> bool:
        return plan.wire is not None and bool(plan.wire.limit_members)

    def _views(self, steps: tuple[Step, ...]) -> tuple[StepView, ...]:
        return StepViews(self._name, self._constant_table).of(steps)


def _encode_head(name: str) -> str:
    return f"static uint32_t {name}__encode(\n  const void * untyped, uint8_t * body, cdr_fault_t * fault)"


def _size_head(name: str) -> str:
    return f"static uint32_t {name}__encoded_size(\n  const void * untyped, cdr_fault_t * fault)"


def _converts_double(step: Step) -> bool:
    return isinstance(step, (Leaf, Numbers)) and step.form == DOUBLE


def _entities(own: LimitSet) -> str:
    """Return who has these limits: `the publisher on /text of /leg`."""
    return ", ".join(f"the {e.kind} on {e.topic} of {e.node}" for e in own.entities)


def _end_of(steps: tuple[Step, ...], place: Place) -> str:
    """Return the expression of the position after the last step."""
    for step in steps:
        if isinstance(step, Zeros):
            place = Place(step.place.variable, step.place.offset + step.count)
        elif isinstance(step, (Leaf, Run)):
            place = Place(step.place.variable, step.place.offset + step.size)
        elif isinstance(step, Messages) and step.count is not None and step.packed:
            place = Place(step.place.variable, step.place.offset + step.count * step.packed)
        else:
            place = Place(True, 0)
    return position(place)


def _moves(steps: tuple[Step, ...]) -> bool:
    return any(
        isinstance(s, (Align, Part, Text, Texts, Numbers))
        or (isinstance(s, Messages) and not (s.packed and s.count is not None))
        for s in steps
    )


def _table_declaration(member: LimitMember) -> str:
    kind = "uint32_t" if member.type is None else f"{c_name(member.type)}__Limits"
    return f"{kind} {member.name}"
