# SPDX-License-Identifier: Apache-2.0
"""Which types have the same limits wherever they are used, and the tables for those that have not.

The limits of a type belong to a use of it (a root and a path). Where all uses agree, they are constants in
its encoder. Where they differ, its `encode_at` takes a table (`pkg__msg__Type__Limits`), and each user passes
its own. An entity that has lower limits than its type is a further use of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from microros_gen.interfaces.types import Message, NamedType, SequenceType, StringType, TypeName, element_of
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import FieldLimits, TypeLimits


@dataclass(frozen=True)
class Homes:
    """`limits`: those of a root's own use, or the only ones; `differing`: types whose uses do not agree."""

    limits: Mapping[TypeName, TypeLimits | None]
    differing: frozenset[TypeName]


@dataclass(frozen=True)
class LimitMember:
    """A member of a table of limits: a number, or the table of a nested type.

    `path` leads to its value: indices of fields, then `sequence`, `string` or (a table) nothing.
    """

    name: str
    type: TypeName | None
    path: tuple[int, ...]
    kind: str


def plan_homes(
    messages: Mapping[TypeName, Message],
    roots: Mapping[TypeName, TypeLimits | None],
    own: Mapping[TypeName, Iterable[TypeLimits]],
) -> Homes:
    """Gather every use below the roots, and below the entities that have limits of their `own`.

    The latter make a type differ, but they change no limits: those of a root and of the types in it stay.
    """
    uses: dict[TypeName, set[TypeLimits]] = {}
    for name, limits in roots.items():
        if limits is not None:
            _gather(messages, name, limits, uses)
    home = dict(roots)
    for name, found in uses.items():
        if name not in home and len(found) == 1:
            home[name] = next(iter(found))
    for name, sets in own.items():
        for limits in sets:
            _gather(messages, name, limits, uses)
    return Homes(home, frozenset(name for name, found in uses.items() if len(found) > 1))


def _gather(
    messages: Mapping[TypeName, Message],
    name: TypeName,
    limits: TypeLimits,
    uses: dict[TypeName, set[TypeLimits]],
) -> None:
    found = uses.setdefault(name, set())
    if limits in found:
        return
    found.add(limits)
    for field, entry in zip(messages[name].fields, limits.fields, strict=True):
        element = element_of(field.type)
        if entry is not None and entry.nested is not None and isinstance(element, NamedType):
            _gather(messages, element.name, entry.nested, uses)


def limit_members(
    name: TypeName,
    messages: Mapping[TypeName, Message],
    homes: Homes,
    is_inline: Callable[[TypeName], bool],
    prefix: str = "",
    path: tuple[int, ...] = (),
) -> tuple[LimitMember, ...]:
    """Return the members of the table of `name`; nested types written in place share it."""
    found: list[LimitMember] = []
    for index, field in enumerate(messages[name].fields):
        element = element_of(field.type)
        here = (*path, index)
        is_sequence = isinstance(field.type, SequenceType)
        if is_sequence:
            found.append(LimitMember(f"{prefix}{field.name}", None, here, "sequence"))
        if isinstance(element, StringType):
            suffix = "__string" if is_sequence else ""
            found.append(LimitMember(f"{prefix}{field.name}{suffix}", None, here, "string"))
        if isinstance(element, NamedType) and element.name in homes.differing:
            if isinstance(field.type, NamedType) and is_inline(element.name):
                found += limit_members(
                    element.name, messages, homes, is_inline, f"{prefix}{field.name}__", here
                )
            else:
                suffix = "__limits" if is_sequence else ""
                found.append(LimitMember(f"{prefix}{field.name}{suffix}", element.name, here, "table"))
    return tuple(found)


def limit_value(limits: TypeLimits, member: LimitMember) -> int | TypeLimits | None:
    """Return the value of a member of a table for a use with these limits."""
    table: TypeLimits | None = limits
    entry: FieldLimits | None = None
    for index in member.path:
        entry = table.fields[index] if table is not None else None
        table = entry.nested if entry is not None else None
    if entry is None:
        return None
    return {"sequence": entry.sequence, "string": entry.string, "table": entry.nested}[member.kind]
