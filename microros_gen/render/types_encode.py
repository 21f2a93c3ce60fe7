# SPDX-License-Identifier: Apache-2.0
"""Views of the type support: each step of an encoder with its C expressions spelt out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from microros_gen.model.types import Primitive, TypeName
from microros_gen.plan.types import TypePlan
from microros_gen.plan.types_limits import LimitMember, limit_value
from microros_gen.plan.types_names import c_name, guard, include_path, type_files
from microros_gen.plan.types_size import TypeLimits
from microros_gen.plan.types_steps import (
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

StepView = Mapping[str, object]
"""`kind` and what the macro of that kind in steps.j2 prints."""


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
    at: AtView | None
    table: tuple[str, ...]
    tables: tuple[TableView, ...]
    functions: tuple[FunctionView, ...]
    decode: str


class EncoderViews:
    """Makes the views; it knows the plans of all types, because a call depends on the callee's plan."""

    def __init__(self, plans: Mapping[TypeName, TypePlan]) -> None:
        self._plans = plans

    def view(self, plan: TypePlan) -> TypeSupportView:
        """Return the view of a type that has an encoder (`plan.wire` is not None)."""
        wire = plan.wire
        if wire is None:
            raise ValueError(f"{plan.name} has no encoder")
        builder = _Builder(self._plans, plan)
        at = builder.at_view() if wire.at_steps is not None else None
        functions = builder.functions()
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
            at=at,
            table=tuple(_table_declaration(member) for member in wire.limit_members),
            tables=tuple(builder.tables),
            functions=functions,
            decode="NULL",
        )


class _Builder:
    """Builds the functions of one type."""

    def __init__(self, plans: Mapping[TypeName, TypePlan], plan: TypePlan) -> None:
        self.tables: list[TableView] = []
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
        for name in self._plan.wire.calls if self._plan.wire else ():
            found.add(include_path(type_files(name).type_support))
        return tuple(sorted(found))

    def size_assertion(self) -> str:
        """Return the condition that shows that the plan's sizes are the compiler's."""
        if self._plan.struct_size is not None:
            return f"sizeof({self._name}) == {self._plan.struct_size}U"
        return f"sizeof({self._name}) >= 1U"

    def functions(self) -> tuple[FunctionView, ...]:
        """Return the functions of the source, callees first."""
        wire = self._plan.wire
        found: list[FunctionView] = []
        if wire is not None and wire.at_steps is not None:
            found += self._at_functions(wire.at_steps)
        if wire is not None and self._plan.root:
            found += self._root_functions(wire.root_steps)
        return tuple(found)

    def _at_functions(self, steps: tuple[Step, ...]) -> list[FunctionView]:
        at = self.at_view()
        views = self._views(steps)
        end = _end_of(steps, Place(True, 0))
        unused = "(void)position" if _ignores_position(steps) else None
        prologue = (unused,) if unused else ()
        return [
            FunctionView(
                f"uint32_t {self._name}__encode_at(\n  {at.encode_parameters})", prologue, True, views, end
            ),
            FunctionView(
                f"uint32_t {self._name}__end_at(\n  {at.end_parameters})", prologue, False, views, end
            ),
        ]

    def _root_functions(self, steps: tuple[Step, ...] | None) -> list[FunctionView]:
        encode = (
            f"static uint32_t {self._name}__encode(const void * untyped, uint8_t * body, cdr_fault_t * fault)"
        )
        size = f"static uint32_t {self._name}__encoded_size(const void * untyped, cdr_fault_t * fault)"
        message = f"const {self._name} * const message = (const {self._name} *)untyped"
        if steps is None:
            limits = f"&{self._root_table()}, " if self._takes_limits(self._plan) else ""
            at = f"{self._name}__encode_at(message, body, 0U, {limits}fault)"
            end = f"{self._name}__end_at(message, 0U, {limits}fault)"
            return [
                FunctionView(encode, (message,), True, (), at),
                FunctionView(size, (message,), False, (), end),
            ]
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
        return tuple(_VIEWS[type(step)](self, step) for step in steps)

    def zeros(self, step: Zeros) -> StepView:
        """View of constant padding."""
        return {"kind": "zeros", "at": _at(step.place), "count": step.count}

    def align(self, step: Align) -> StepView:
        """View of padding that depends on the position."""
        return {"kind": "align", "at": _at(step.place), "to": step.to}

    def leaf(self, step: Leaf) -> StepView:
        """View of a number or an array of numbers."""
        return {"kind": "leaf", "put": _put(step)}

    def run(self, step: Run) -> StepView:
        """View of a run."""
        return {
            "kind": "run",
            "type": self._name,
            "first": step.leaves[0].member,
            "last": step.leaves[-1].member,
            "bytes": step.size,
            "at": _at(step.place),
            "puts": [_put(leaf) for leaf in step.leaves],
        }

    def text(self, step: Text) -> StepView:
        """View of a string."""
        size = f"message->{step.member}.size"
        wide = "w" if step.wide else ""
        return {
            "kind": "text",
            "check": _check(step.member, step.limit),
            "put": f"cdr_put_{wide}string",
            "at": _at(step.place),
            "data": f"message->{step.member}.data",
            "size": size,
            "end": f"cdr_{wide}string_end({_at(step.place)}, {size})",
        }

    def numbers(self, step: Numbers) -> StepView:
        """View of a sequence of numbers."""
        size = f"message->{step.member}.size"
        suffix = "bool" if step.primitive is Primitive.BOOL else str(step.primitive.size)
        width = step.primitive.size
        return {
            "kind": "numbers",
            "check": _check(step.member, step.limit),
            "put": f"cdr_put_sequence_{suffix}",
            "at": _at(step.place),
            "data": f"message->{step.member}.data",
            "size": size,
            "end": f"cdr_sequence_end_{max(width, 4)}({_at(step.place)}, {size}, {width}U)",
        }

    def texts(self, step: Texts) -> StepView:
        """View of an array or a sequence of strings."""
        member = f"message->{step.member}"
        wide = "w" if step.wide else ""
        limit = _limit(step.limit)
        return {
            "kind": "texts",
            "check": _check(step.member, step.sequence) if step.sequence else "",
            "at": _at(step.place),
            "start": _at(Place(step.place.variable, step.place.offset + (4 if step.sequence else 0))),
            "count": f"{step.count}U" if step.count is not None else f"{member}.size",
            "data": member if step.count is not None else f"{member}.data",
            "type": f"rosidl_runtime_c__{'U16String' if step.wide else 'String'}",
            "text_check": f'text->data, text->size, {limit}, "{step.member}[]"',
            "put": f"cdr_put_{wide}string",
            "text_end": f"cdr_{wide}string_end",
        }

    def messages(self, step: Messages) -> StepView:
        """View of an array or a sequence of messages."""
        member = f"message->{step.member}"
        data = member if step.count is not None else f"{member}.data"
        count = f"{step.count}U" if step.count is not None else f"{member}.size"
        at = _at(step.place)
        moves = step.count is None or not step.packed
        element = c_name(step.type)
        width = max(step.alignment, 4)
        passed = self._passed(step.type, step.member, step.table, step.limits, step.fixed)
        packed = packed_end = ""
        if step.packed and step.count is not None:
            packed = f"cdr_copy(&body[{at}], {data}, {step.count * step.packed}U)"
        elif step.packed:
            packed = f"position = cdr_put_packed_{width}(body, {at}, {data}, {count}, {step.packed}U)"
            packed_end = f"cdr_sequence_end_{width}({at}, {count}, {step.packed}U)"
        if moves:
            encode = f"position = {element}__encode_at(&{data}[i], body, position{passed})"
        else:
            encode = (
                f"(void){element}__encode_at(&{data}[i], body, {at} + ((uint32_t)i * {step.packed}U){passed})"
            )
        end = (
            f"{element}__end_at(position)"
            if step.fixed
            else f"{element}__end_at(&{data}[i], position{passed})"
        )
        return {
            "kind": "messages",
            "check": _check(step.member, step.sequence) if step.sequence else "",
            "at": at,
            "start": _at(Place(step.place.variable, step.place.offset + (4 if step.sequence else 0))),
            "count": count,
            "type": element,
            "packed": step.packed,
            "put_packed": packed,
            "end_packed": packed_end,
            "moves": moves,
            "encode": encode,
            "end": end,
            "may_refuse": not step.fixed,
        }

    def part(self, step: Part) -> StepView:
        """View of a nested message with an encoder of its own."""
        passed = self._passed(step.type, step.member, step.table, step.limits, False)
        name = c_name(step.type)
        at = _at(step.place)
        return {
            "kind": "part",
            "encode": f"{name}__encode_at(&message->{step.member}, body, {at}{passed})",
            "end": f"{name}__end_at(&message->{step.member}, {at}{passed})",
        }

    def _passed(
        self, name: TypeName, member: str, table: str | None, limits: TypeLimits | None, fixed: bool
    ) -> str:
        """Return the last arguments of a call: the limits where the callee takes them, and the fault."""
        if fixed:
            return ""
        if table is not None:
            return f", &limits->{table}, fault"
        if limits is not None:
            suffix = f"{member.replace('.', '__')}__limits"
            constant = self._constant_table(name, limits, f"Limits of {member}.", suffix)
            return f", &{constant}, fault"
        return ", fault"


_VIEWS: Mapping[type, Callable[[_Builder, Any], StepView]] = {
    Zeros: _Builder.zeros,
    Align: _Builder.align,
    Leaf: _Builder.leaf,
    Run: _Builder.run,
    Text: _Builder.text,
    Texts: _Builder.texts,
    Numbers: _Builder.numbers,
    Messages: _Builder.messages,
    Part: _Builder.part,
}


def _at(place: Place) -> str:
    if not place.variable:
        return f"{place.offset}U"
    return f"position + {place.offset}U" if place.offset else "position"


def _put(leaf: Leaf) -> str:
    target = f"&body[{_at(leaf.place)}], "
    suffix = "bool" if leaf.primitive is Primitive.BOOL else str(leaf.primitive.size)
    if leaf.count is not None:
        return f"cdr_put_array_{suffix}({target}message->{leaf.member}, {leaf.count}U)"
    address = "" if leaf.primitive is Primitive.BOOL else "&"
    return f"cdr_put_{suffix}({target}{address}message->{leaf.member})"


def _limit(limit: Limit) -> str:
    return f"limits->{limit.table}" if limit.value is None else f"{limit.value}U"


def _check(member: str, limit: Limit) -> str:
    return f'message->{member}.data, message->{member}.size, {_limit(limit)}, "{member}"'


def _end_of(steps: tuple[Step, ...], place: Place) -> str:
    """Return the expression of the position behind the last step."""
    for step in steps:
        if isinstance(step, Zeros):
            place = Place(step.place.variable, step.place.offset + step.count)
        elif isinstance(step, (Leaf, Run)):
            place = Place(step.place.variable, step.place.offset + step.size)
        elif isinstance(step, Messages) and step.count is not None and step.packed:
            place = Place(step.place.variable, step.place.offset + step.count * step.packed)
        else:
            place = Place(True, 0)
    return _at(place)


def _moves(steps: tuple[Step, ...]) -> bool:
    return any(
        isinstance(s, (Align, Part, Text, Texts, Numbers))
        or (isinstance(s, Messages) and not (s.packed and s.count is not None))
        for s in steps
    )


def _ignores_position(steps: tuple[Step, ...]) -> bool:
    return not steps


def _table_declaration(member: LimitMember) -> str:
    kind = "uint32_t" if member.type is None else f"{c_name(member.type)}__Limits"
    return f"{kind} {member.name}"
