# SPDX-License-Identifier: Apache-2.0
"""Capacities that sources give → the table `limits`: bytes of strings without terminator, elements of sequences."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from microros_gen.application.limit_tree import PROPOSED_LIMITS, LimitTree, limit_text, put_limit
from microros_gen.interfaces.types import (
    FieldType,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.migrate.capacities import Capacity, Fact, MemoryRules
from microros_gen.migrate.draft import DraftValue, Flow, place
from microros_gen.records import dataclass

DEFAULT_LIMITS = DraftValue(Flow("{string: 64, sequence: 16}"), "what nothing else says")
"""The rule for "*" that is proposed."""

LOWER_LIMITS = tuple(
    DraftValue(
        Flow(limit_text({"string": string, "sequence": sequence})),
        "what nothing else says, and fits a message",
    )
    for string, sequence in PROPOSED_LIMITS
)
"""What is proposed instead, where a message would be larger than a stream takes."""


@dataclass(frozen=True)
class Leaf:
    """A string or sequence without a bound: its path from a type, and what it holds.

    `within`: the types on the way with the rest of the path below each. `of_messages`: a sequence of messages.
    """

    path: tuple[str, ...]
    is_string: bool
    of_messages: bool
    within: tuple[tuple[TypeName, tuple[str, ...]], ...]


_Key = tuple[TypeName, tuple[str, ...], bool]


def limits_of(
    facts: Iterable[Fact], roots: Iterable[TypeName], messages: Mapping[TypeName, Message]
) -> Mapping[str, DraftValue]:
    """Return the table; its last line holds for what the facts say nothing of, where there is such a member."""
    numbers: dict[_Key, int] = {}
    notes: dict[TypeName, str] = {}
    for fact in facts:
        if fact.type in messages:
            for key, number in _numbers(fact, messages):
                numbers[key] = max(number, numbers.get(key, 0))
                notes.setdefault(fact.type, place(fact.span))
    table = {
        str(kind): DraftValue(Flow(limit_text(_tree(kind, numbers, _texts(kind, messages)))), notes[kind])
        for kind in sorted({kind for kind, _, _ in numbers})
    }
    open_leaves = [
        leaf
        for root in roots
        for leaf in leaves(root, messages)
        if not any((kind, path, leaf.is_string) in numbers for kind, path in leaf.within)
    ]
    return {**table, "*": DEFAULT_LIMITS} if open_leaves else table


def leaves(root: TypeName, messages: Mapping[TypeName, Message]) -> Iterator[Leaf]:
    """Yield every string and sequence without a bound below `root`."""
    yield from _leaves(root, (), ((root, 0),), messages)


def _leaves(
    kind: TypeName,
    path: tuple[str, ...],
    types: tuple[tuple[TypeName, int], ...],
    messages: Mapping[TypeName, Message],
) -> Iterator[Leaf]:
    for field in messages[kind].fields:
        here = (*path, field.name)
        element = element_of(field.type)
        within = tuple((name, here[depth:]) for name, depth in types)
        if isinstance(field.type, SequenceType) and field.type.bound is None:
            yield Leaf(here, False, isinstance(element, NamedType), within)
        if isinstance(element, StringType) and element.bound is None:
            yield Leaf(here, True, False, within)
        if isinstance(element, NamedType):
            yield from _leaves(element.name, here, (*types, (element.name, len(here))), messages)


def _numbers(fact: Fact, messages: Mapping[TypeName, Message]) -> Iterator[tuple[_Key, int]]:
    if isinstance(fact, MemoryRules):
        rules = dict(reversed(fact.rules))
        for leaf in leaves(fact.type, messages):
            name = ".".join(leaf.path)
            of_kind = fact.defaults[0] if leaf.is_string else fact.defaults[1 if leaf.of_messages else 2]
            number = (
                rules.get(f"{name}.data", rules.get(name, of_kind))
                if leaf.is_string
                else rules.get(name, of_kind)
            )
            yield (fact.type, leaf.path, leaf.is_string), max(1, number - leaf.is_string)
        return
    found = _follow(fact, messages)
    if found is not None and fact.number > 0:
        path, is_string = found
        less = 1 if is_string and fact.terminated else 0
        yield (fact.type, path, is_string), max(1, fact.number - less)


def _follow(fact: Capacity, messages: Mapping[TypeName, Message]) -> tuple[tuple[str, ...], bool] | None:
    """Return the path of the member that a capacity is of, and whether it is a string; None where it has a bound."""
    kind: TypeName | None = fact.type
    path: list[str] = []
    parts = list(fact.parts)
    while parts and kind is not None and kind in messages:
        name = parts.pop(0).removesuffix("[]")
        fields = {field.name: field.type for field in messages[kind].fields}
        if name not in fields:
            return None
        path.append(name)
        field_type: FieldType = fields[name]
        if isinstance(field_type, SequenceType) and not parts:
            return (tuple(path), False) if field_type.bound is None else None
        if isinstance(field_type, SequenceType):
            parts.pop(0)  # `.data[i]`
        element = element_of(field_type)
        if isinstance(element, StringType) and not parts:
            return (tuple(path), True) if element.bound is None else None
        kind = element.name if isinstance(element, NamedType) else None
    return None


def _texts(kind: TypeName, messages: Mapping[TypeName, Message]) -> frozenset[tuple[str, ...]]:
    """Return the paths of sequences of strings: there one number could be either."""
    found = list(leaves(kind, messages))
    strings, sequences = (
        {leaf.path for leaf in found if leaf.is_string is wanted} for wanted in (True, False)
    )
    return frozenset(strings & sequences)


def _tree(kind: TypeName, numbers: Mapping[_Key, int], texts: frozenset[tuple[str, ...]]) -> LimitTree:
    """Return the numbers of one type as the application file nests them; those of `texts` with their kind."""
    root: LimitTree = {}
    for path, is_string in sorted((path, is_string) for name, path, is_string in numbers if name == kind):
        number = numbers[kind, path, is_string]
        put_limit(root, path, "string" if is_string else "sequence", number, by_kind=path in texts)
    return root
