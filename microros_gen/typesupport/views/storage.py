# SPDX-License-Identifier: Apache-2.0
"""Views of the static storage and its bind functions."""

from __future__ import annotations

import math
from collections.abc import Mapping

from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name, element_c_type, guard, include_path, type_files
from microros_gen.typesupport.plan.size import PLACEHOLDER
from microros_gen.typesupport.plan.storage import text_length
from microros_gen.typesupport.plan.storage_units import (
    BindMessages,
    BindNumbers,
    BindStep,
    BindText,
    BindTexts,
    InitMessages,
    SetNumber,
    StorageMember,
    StorageUnit,
)
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.notes import characters_note, storage_note
from microros_gen.typesupport.views.steps import cdr_size
from microros_gen.typesupport.views.struct import WideDefault, wide_name
from microros_gen.typesupport.views.text import number, string, wide_units


@dataclass(frozen=True)
class BindView:
    """Statements, then a loop over i below `count`, then statements."""

    lines: tuple[str, ...] = ()
    count: int = 0
    loop: tuple[str, ...] = ()
    after: tuple[str, ...] = ()


@dataclass(frozen=True)
class MemberView:
    """A member of a storage struct, and what its characters have room for (empty: it has none)."""

    declaration: str
    note: str


@dataclass(frozen=True)
class UnitView:
    """One storage struct and its bind function."""

    name: str
    comment: str
    type: str
    bind: str
    linkage: str
    members: tuple[MemberView, ...]
    wide_defaults: tuple[WideDefault, ...]
    is_unused: bool
    steps: tuple[BindView, ...]
    topic: str
    size_assertion: str


@dataclass(frozen=True)
class StorageView:
    """storage.h.j2 and storage.c.j2."""

    guard: str
    ros_name: str
    name: str
    storage_header: str
    header_includes: tuple[str, ...]
    includes: tuple[str, ...]
    system_includes: tuple[str, ...]
    size_assertion: str
    units: tuple[UnitView, ...]


def storage_view(plan: TypePlan, plans: Mapping[TypeName, TypePlan]) -> StorageView:
    """Return the view of a type that has storage."""
    units = tuple(_unit(unit, plan) for unit in plan.storage)
    steps = [step for unit in plan.storage for step in unit.steps]
    uses = sorted({name for unit in plan.storage for name in unit.uses})
    shared = {include_path(type_files(name).storage) for name in uses if plans[name].storage}
    structs = {include_path(type_files(name).struct) for name in uses if not plans[name].storage}
    functions = {
        include_path(type_files(s.type).functions)
        for s in steps
        if isinstance(s, InitMessages) or (isinstance(s, BindMessages) and s.init)
    }
    defaults = (v for s in steps if isinstance(s, BindNumbers) for v in s.defaults)
    values = (*defaults, *(s.value for s in steps if isinstance(s, SetNumber)))
    needs_math = any(isinstance(v, float) and not math.isfinite(v) for v in values)
    assertion = f"sizeof({plan.c_name}__Storage) == {cdr_size(plan.storage_sizes)}"
    return StorageView(
        guard=guard(plan.files.storage),
        ros_name=str(plan.name),
        name=plan.c_name,
        storage_header=include_path(plan.files.storage),
        header_includes=tuple(sorted({include_path(plan.files.struct), *shared, *structs})),
        includes=tuple(sorted({*functions, "microros/cdr.h"})),
        system_includes=("math.h", "string.h") if needs_math else ("string.h",),
        size_assertion=assertion,
        units=units,
    )


def _unit(unit: StorageUnit, plan: TypePlan) -> UnitView:
    sizes = plan.topic_sizes.get(unit.name)
    on = f" on {unit.topic}" if unit.topic else ""
    comment = f"Storage of {unit.path} of {plan.c_name}{on}."
    if not unit.private:
        size = storage_note(plan.models, sizes or plan.storage_sizes)
        comment = f"Storage of one message{on}: {size}."
    is_unused = [member.name for member in unit.members] == [PLACEHOLDER.name]
    return UnitView(
        name=unit.name,
        comment=comment,
        type=c_name(unit.type),
        bind=unit.bind,
        linkage="static " if unit.private else "",
        members=tuple(_member(member) for member in unit.members),
        wide_defaults=tuple(wide for step in unit.steps for wide in _wide(step)),
        is_unused=is_unused,
        steps=tuple(_step(step) for step in unit.steps),
        topic="" if unit.private else unit.topic,
        size_assertion=f"sizeof({unit.name}) == {cdr_size(sizes)}" if sizes else "",
    )


def _member(member: StorageMember) -> MemberView:
    dimensions = "".join(f"[{d}]" for d in member.dimensions)
    note = "" if member.characters is None else characters_note(member.dimensions, member.characters.wide)
    return MemberView(f"{_member_type(member)} {member.name}{dimensions}", note)


def _member_type(member: StorageMember) -> str:
    if member.unit is not None:
        return member.unit
    if member.message is not None:
        return c_name(member.message)
    if member.strings is not None:
        return element_c_type(member.strings)
    if member.primitive is not None:
        return member.primitive.c_type
    return "uint_least16_t" if member.characters is not None and member.characters.wide else "char"


def _wide(step: BindStep) -> tuple[WideDefault, ...]:
    texts: tuple[str, ...] = ()
    if isinstance(step, BindText) and step.wide:
        texts = (step.default,)
    elif isinstance(step, BindTexts) and step.wide:
        texts = step.defaults
    if not isinstance(step, (BindText, BindTexts)):
        return ()
    return tuple(
        WideDefault(wide_name(step.member, i), ", ".join(wide_units(text)))
        for i, text in enumerate(texts)
        if text
    )


def _step(step: BindStep) -> BindView:
    if isinstance(step, SetNumber):
        place = step.member if step.index is None else f"{step.member}[{step.index}]"
        return BindView((f"message->{place} = {number(step.primitive, step.value)}",))
    if isinstance(step, InitMessages):
        init = f"(void){c_name(step.type)}__init(&message->{step.member}[i])"
        return BindView(count=step.count, loop=(init,))
    if isinstance(step, BindText):
        return BindView(_text(f"message->{step.member}", f"storage->{step.storage}", step, 0, step.default))
    if isinstance(step, BindTexts):
        return _texts(step)
    if isinstance(step, BindNumbers):
        return _numbers(step)
    if isinstance(step, BindMessages):
        return _messages(step)
    return BindView((f"{step.bind}(&message->{step.member}, &storage->{step.storage})",))


def _text(
    target: str, characters: str, step: BindText | BindTexts, index: int, default: str
) -> tuple[str, ...]:
    """Return the statements that bind one string (characters are already zero where there is no default)."""
    length = text_length(default, step.wide)
    item = "sizeof(uint_least16_t)" if step.wide else "1U"
    lines = [f"{target}.data = {characters}"]
    lines.append(f"{target}.capacity = sizeof({characters})" + (f" / {item}" if step.wide else ""))
    if not default:
        return (*lines, f"{characters}[0] = 0")
    source = wide_name(step.member, index) if step.wide else string(default)
    size = f"sizeof({source})" if step.wide else f"{length + 1}U"
    return (*lines, f"(void)memcpy({characters}, {source}, {size})", f"{target}.size = {length}U")


def _texts(step: BindTexts) -> BindView:
    member = f"message->{step.member}"
    lines: tuple[str, ...] = ()
    strings = member
    if step.sequence:
        strings = f"storage->{step.storage}"
        lines = (f"(void)memset({strings}, 0, sizeof({strings}))", *_sequence(member, strings, step.count))
    loop = _text(f"{strings}[i]", f"storage->{step.characters}[i]", step, 0, "")
    after: tuple[str, ...] = (f"{member}.size = {len(step.defaults)}U",) if _sized(step) else ()
    for index, text in enumerate(step.defaults):
        if text:
            characters = f"storage->{step.characters}[{index}]"
            after += _text(f"{strings}[{index}]", characters, step, index, text)[2:]
    return BindView(lines, step.count, loop, after)


def _sized(step: BindTexts) -> bool:
    return step.sequence and bool(step.defaults)


def _sequence(member: str, storage: str, count: int) -> tuple[str, ...]:
    return (f"{member}.data = {storage}", f"{member}.capacity = {count}U")


def _numbers(step: BindNumbers) -> BindView:
    member = f"message->{step.member}"
    storage = f"storage->{step.storage}"
    lines = _sequence(member, storage, step.count)
    if step.defaults:
        lines += (f"{member}.size = {len(step.defaults)}U",)
        lines += tuple(f"{storage}[{i}] = {number(step.primitive, v)}" for i, v in enumerate(step.defaults))
    return BindView(lines)


def _messages(step: BindMessages) -> BindView:
    member = f"message->{step.member}"
    lines: tuple[str, ...] = ()
    target = f"{member}[i]"
    if step.sequence:
        target = f"storage->{step.storage}[i]"
        lines = _sequence(member, f"storage->{step.storage}", step.count)
    loop: tuple[str, ...] = ()
    if step.bind is not None:
        loop = (f"{step.bind}(&{target}, &storage->{step.unit}[i])",)
    elif step.init:
        loop = (f"(void){c_name(step.type)}__init(&{target})",)
    elif step.sequence:
        lines += (f"(void)memset(storage->{step.storage}, 0, sizeof(storage->{step.storage}))",)
    return BindView(lines, step.count, loop)
