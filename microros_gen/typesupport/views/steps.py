# SPDX-License-Identifier: Apache-2.0
"""Views of the steps of an encoder, each with its C expressions spelled out, for the macros in steps.j2."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from microros_gen.interfaces.types import TypeName
from microros_gen.typesupport.plan.layout import WIDE_MODELS
from microros_gen.typesupport.plan.names import c_name
from microros_gen.typesupport.plan.size import LENGTH_SIZE, TypeLimits
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

StepView = Mapping[str, object]
"""`kind` and what the macro of that kind in steps.j2 prints."""


class StepViews:
    """Makes the views of the steps of `owner` (its C name).

    `constant_table` returns the name of the constant that holds the limits of one use of a nested type.
    """

    def __init__(self, owner: str, constant_table: Callable[[TypeName, TypeLimits, str, str], str]) -> None:
        self._owner = owner
        self._constant_table = constant_table

    def of(self, steps: tuple[Step, ...]) -> tuple[StepView, ...]:
        """Return the views of `steps`."""
        return tuple(_VIEWS[type(step)](self, step) for step in steps)

    def zeros(self, step: Zeros) -> StepView:
        """View of constant padding."""
        return {"kind": "zeros", "at": position(step.place), "count": step.count}

    def align(self, step: Align) -> StepView:
        """View of padding that depends on the position."""
        return {"kind": "align", "at": position(step.place), "to": step.to}

    def leaf(self, step: Leaf) -> StepView:
        """View of a number or an array of numbers."""
        return {"kind": "leaf", "put": _put(step)}

    def run(self, step: Run) -> StepView:
        """View of a run."""
        return {
            "kind": "run",
            "type": self._owner,
            "first": step.leaves[0].member,
            "last": step.leaves[-1].member,
            "bytes": step.size,
            "at": position(step.place),
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
            "at": position(step.place),
            "data": f"message->{step.member}.data",
            "size": size,
            "end": f"cdr_{wide}string_end({position(step.place)}, {size})",
        }

    def numbers(self, step: Numbers) -> StepView:
        """View of a sequence of numbers."""
        size = f"message->{step.member}.size"
        width = step.primitive.size
        return {
            "kind": "numbers",
            "check": _check(step.member, step.limit),
            "put": f"cdr_put_sequence_{step.form}",
            "at": position(step.place),
            "data": f"message->{step.member}.data",
            "size": size,
            "end": f"cdr_sequence_end_{max(width, 4)}({position(step.place)}, {size}, {width}U)",
        }

    def texts(self, step: Texts) -> StepView:
        """View of an array or a sequence of strings."""
        member = f"message->{step.member}"
        wide = "w" if step.wide else ""
        return {
            "kind": "texts",
            "check": _check(step.member, step.sequence) if step.sequence else "",
            "at": position(step.place),
            "start": _start(step),
            "count": f"{step.count}U" if step.count is not None else f"{member}.size",
            "data": member if step.count is not None else f"{member}.data",
            "type": f"rosidl_runtime_c__{'U16String' if step.wide else 'String'}",
            "text_check": _fits("text->", f"{step.member}[]", step.limit),
            "put": f"cdr_put_{wide}string",
            "text_end": f"cdr_{wide}string_end",
        }

    def messages(self, step: Messages) -> StepView:
        """View of an array or a sequence of messages."""
        member = f"message->{step.member}"
        data = member if step.count is not None else f"{member}.data"
        count = f"{step.count}U" if step.count is not None else f"{member}.size"
        return {
            "kind": "messages",
            "member": step.member,
            "check": _check(step.member, step.sequence) if step.sequence else "",
            "at": position(step.place),
            "start": _start(step),
            "count": count,
            "type": c_name(step.type),
            "packed": step.packed,
            "moves": step.count is None or not step.packed,
            "may_refuse": not step.fixed,
            **self._whole(step, data, count),
            **self._each(step, f"&{data}[i]"),
        }

    def _whole(self, step: Messages, data: str, count: str) -> StepView:
        """Return how all elements are written at once, and where they end."""
        at = position(step.place)
        if step.count is not None:
            return {"put_packed": f"cdr_copy(&body[{at}], {data}, {step.count * step.packed}U)"}
        width = max(step.alignment, LENGTH_SIZE)
        return {
            "put_packed": f"position = cdr_put_packed_{width}(body, {at}, {data}, {count}, {step.packed}U)",
            "end_packed": f"cdr_sequence_end_{width}({at}, {count}, {step.packed}U)",
        }

    def _each(self, step: Messages, element: str) -> StepView:
        """Return how one element is written, and where it ends."""
        name = c_name(step.type)
        passed = self._passed(step.type, step.member, step.table, step.limits, step.fixed)
        at = "position"
        target = "position = "
        if step.packed and step.count is not None:
            target = "(void)"
            at = f"{position(step.place)} + ((uint32_t)i * {step.packed}U)"
        return {
            "encode": f"{target}{name}__encode_at(\n      {element}, body, {at}{passed})",
            "end": f"{name}__end_at({'' if step.fixed else element + ', '}position{passed})",
        }

    def part(self, step: Part) -> StepView:
        """View of a nested message with its own encoder."""
        passed = self._passed(step.type, step.member, step.table, step.limits, False)
        name = c_name(step.type)
        at = position(step.place)
        return {
            "kind": "part",
            "member": step.member,
            "encode": f"{name}__encode_at(\n    &message->{step.member}, body, {at}{passed})",
            "end": f"{name}__end_at(\n    &message->{step.member}, {at}{passed})",
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


_VIEWS: Mapping[type, Callable[[StepViews, Any], StepView]] = {
    Zeros: StepViews.zeros,
    Align: StepViews.align,
    Leaf: StepViews.leaf,
    Run: StepViews.run,
    Text: StepViews.text,
    Texts: StepViews.texts,
    Numbers: StepViews.numbers,
    Messages: StepViews.messages,
    Part: StepViews.part,
}


def position(place: Place) -> str:
    """Return the C expression of a place."""
    if not place.variable:
        return f"{place.offset}U"
    return f"position + {place.offset}U" if place.offset else "position"


def _start(step: Messages | Texts) -> str:
    """Return the position of the first element: after the length of a sequence."""
    offset = LENGTH_SIZE if step.sequence else 0
    return position(Place(step.place.variable, step.place.offset + offset))


def _put(leaf: Leaf) -> str:
    target = f"&body[{position(leaf.place)}], "
    if leaf.count is not None:
        return f"cdr_put_array_{leaf.form}({target}message->{leaf.member}, {leaf.count}U)"
    address = "&" if leaf.form.isdigit() else ""
    return f"cdr_put_{leaf.form}({target}{address}message->{leaf.member})"


def _limit(limit: Limit) -> str:
    return f"limits->{limit.table}" if limit.value is None else f"{limit.value}U"


def _check(member: str, limit: Limit) -> str:
    return _fits(f"message->{member}.", member, limit)


def _fits(place: str, member: str, limit: Limit) -> str:
    """Return the call that compares what is at `place` with its limit."""
    function, numbers = "cdr_fits", _limit(limit)
    if limit.bound is not None:
        function, numbers = "cdr_fits_bound", f"{numbers}, {limit.bound}U"
    return f'{function}({place}data, {place}size, {numbers}, "{member}", fault)'


def cdr_size(sizes: tuple[int, ...]) -> str:
    """Return the C expression of a size that depends on the data model."""
    if len(set(sizes)) == 1:
        return f"{sizes[0]}U"
    macro = "CDR_SIZE" if len(sizes) == len(WIDE_MODELS) else "CDR_SIZE_ANY"
    return f"{macro}({', '.join(f'{size}U' for size in sizes)})"
