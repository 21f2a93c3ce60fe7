# SPDX-License-Identifier: Apache-2.0
"""Plans of decoders → their C files. A file holds the decoders of all messages that share one header."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from jinja2 import Environment

from microros_gen.interfaces.derived import declaring_name
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.decode import (
    Converted,
    DecodeStep,
    Messages,
    Number,
    NumberSequence,
    Part,
    Row,
    Strings,
    decode_files,
)
from microros_gen.typesupport.plan.facts import DOUBLE
from microros_gen.typesupport.plan.names import c_name, guard, include_path, type_files
from microros_gen.typesupport.plan.types import TypePlan

DOUBLE_DECODERS = "microros/cdr_decode_double.h"
"""The header of what reads a float64 where a double is no binary64."""


@dataclass(frozen=True)
class StepView:
    """One step: `lines` are its statements; `shown` is what must be true of the layout in memory, or empty."""

    lines: tuple[str, ...]
    shown: str = ""


@dataclass(frozen=True)
class DecoderView:
    """The functions of one message."""

    ros_name: str
    name: str
    steps: tuple[StepView, ...]


def render_decoders(type_plans: Sequence[TypePlan], environment: Environment) -> dict[str, bytes]:
    """Return path → contents of the decoders' files, in the order of the plans; none where none is received."""
    files: dict[tuple[str, str], list[TypePlan]] = {}
    for plan in type_plans:
        if plan.decoder is not None:
            files.setdefault(decode_files(plan.files), []).append(plan)
    rendered = {}
    for (header, source), plans in files.items():
        view = {
            "title": str(declaring_name(plans[0].name)),
            "guard": guard(header),
            "header": include_path(header),
            "struct": include_path(plans[0].files.struct),
            "includes": _includes(plans),
            "decoders": [_decoder_view(plan) for plan in plans],
        }
        for path, template in ((header, "decode.h"), (source, "decode.c")):
            rendered[path] = environment.get_template(f"types/{template}.j2").render(view).encode()
    return rendered


def _includes(plans: Iterable[TypePlan]) -> list[str]:
    """Return the headers of the functions that are called, besides the file's own."""
    found = {
        include_path(decode_files(type_files(name))[0])
        for plan in plans
        if plan.decoder is not None
        for name in plan.decoder.calls
    }
    if any(_converts_double(plan.decoder.steps) for plan in plans if plan.decoder is not None):
        found.add(DOUBLE_DECODERS)
    own = {include_path(decode_files(plan.files)[0]) for plan in plans}
    return sorted(found - own)


def _converts_double(steps: Iterable[DecodeStep]) -> bool:
    return any(isinstance(step, (Converted, NumberSequence)) and step.form == DOUBLE for step in steps)


def _decoder_view(plan: TypePlan) -> DecoderView:
    assert plan.decoder is not None
    steps = tuple(_VIEWS[type(step)](plan.c_name, step) for step in plan.decoder.steps)
    return DecoderView(str(plan.name), plan.c_name, steps)


def _row(owner: str, row: Row) -> StepView:
    if len(row.numbers) == 1:
        return StepView((_number(row.width, row.numbers[0]),))
    first, last = row.numbers[0].member, row.numbers[-1].member
    start = f"(uint8_t *)message + offsetof({owner}, {first})"
    call = _call(f"get_{row.width}", start, f"{row.count}U", first)
    return StepView((call,), f"CDR_IS_ROW({owner}, {first}, {last}, {row.count * row.width}U)")


def _number(width: int, number: Number) -> str:
    if number.count is None:
        return _call(f"get_{width}", f"&message->{number.member}", "1U", number.member)
    return _call(f"get_{width}", f"message->{number.member}", f"{number.count}U", number.member)


def _converted(_owner: str, step: Converted) -> StepView:
    address = "&" if step.count is None else ""
    count = 1 if step.count is None else step.count
    to = f"{address}message->{step.member}"
    return StepView((_call(f"get_{step.form}", to, f"{count}U", step.member),))


def _number_sequence(_owner: str, step: NumberSequence) -> StepView:
    to = f"&message->{step.member}"
    call = _call(f"get_sequence_{step.form}", to, _bound(step.bound), step.member)
    return StepView((call,))


def _strings(_owner: str, step: Strings) -> StepView:
    wide = "w" if step.wide else ""
    member = f"message->{step.member}"
    bound = _bound(step.bound)
    each = f"{step.member}[]"
    if step.sequence:
        size = _call("get_size", f"&{member}", _bound(step.sequence_bound), step.member)
        rest = _call(f"get_{wide}strings", f"{member}.data", f"{member}.size", bound, each)
        return StepView((size, rest))
    if step.count is not None:
        return StepView((_call(f"get_{wide}strings", member, f"{step.count}U", bound, each),))
    return StepView((_call(f"get_{wide}string", f"&{member}", bound, step.member),))


def _messages(_owner: str, step: Messages) -> StepView:
    member = f"message->{step.member}"
    sequence = step.count is None
    data = f"{member}.data" if sequence else member
    count = f"{member}.size" if sequence else f"{step.count}U"
    name = c_name(step.type)
    start = (_call("get_size", f"&{member}", _bound(step.bound), step.member),) if sequence else ()
    if step.row is None:
        call = _nested(f"{name}__decode(in, &{data}[i]);", step.member, "i")
        loop = (f"for (size_t i = 0U; i < {count}; ++i) {{", *(f"  {line}" for line in call), "}")
        return StepView((*(start or _UNLESS_FAILED), *loop))
    width, numbers = step.row
    total = f"{(step.count or 0) * numbers}U"
    if sequence:
        total = f"{count} * {numbers}U" if numbers > 1 else count
    whole = _call(f"get_{width}", data, total, f"{step.member}[]")
    return StepView((*start, whole), f"CDR_IS_ROW_OF({name}, {width * numbers}U)")


def _part(_owner: str, step: Part) -> StepView:
    call = f"{c_name(step.type)}__decode(in, &message->{step.member});"
    return StepView((*_UNLESS_FAILED, *_nested(call, step.member, "CDR_NO_INDEX")))


_UNLESS_FAILED = ("if (in->failed) {", "  return;", "}")
"""A member before a nested message may have been refused; it is not one of that message. A sequence has no elements
then."""


def _nested(call: str, member: str, index: str) -> tuple[str, ...]:
    """Return a call of another decoder; what it refuses is within this message's member."""
    return call, "if (in->failed) {", f'  cdr_in_within(in, "{member}", {index});', "  return;", "}"


_VIEWS: Mapping[type, Callable[[str, Any], StepView]] = {
    Row: _row,
    Converted: _converted,
    NumberSequence: _number_sequence,
    Strings: _strings,
    Messages: _messages,
    Part: _part,
}


def _call(function: str, *arguments: str) -> str:
    *others, field = arguments
    return f'cdr_{function}(in, {", ".join(others)}, "{field}");'


def _bound(bound: int | None) -> str:
    return "CDR_UNBOUNDED" if bound is None else f"{bound}U"
