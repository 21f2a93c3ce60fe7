# SPDX-License-Identifier: Apache-2.0
"""Strings and sequences without a limit: their messages, and the lines that would set all limits."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from microros_gen.application.limit_tree import (
    PROPOSED_LIMITS,
    LimitTree,
    limit_text,
    put_limit,
    tree_of_rules,
)
from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostic, Diagnostics, Span
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

_NAMED = 4


@dataclass(frozen=True)
class Unset:
    """A member of a message without a limit; `kind` is `string` or `sequence`."""

    path: tuple[str, ...]
    kind: str


@dataclass(frozen=True)
class UnsetRoot:
    """A declared type with its unset members. `size` returns the largest body under two numbers for all of them.

    `room` is the largest body that its stream takes, bytes; None: it follows the message.
    """

    type: TypeName
    span: Span | None
    unset: tuple[Unset, ...]
    room: int | None
    size: Callable[[int, int], int]


def report_unset(roots: Sequence[UnsetRoot], rules: Sequence[LimitRule], diagnostics: Diagnostics) -> None:
    """Report each root with unset members at its place, and with the last one the lines that set all of them.

    `rules` are what `limits:` of the application says already.
    """
    if not roots:
        return
    string, sequence = next((pair for pair in PROPOSED_LIMITS if _fit(roots, pair)), PROPOSED_LIMITS[-1])
    kinds = {unset.kind for root in roots for unset in root.unset}
    values = {kind: number for kind, number in (("string", string), ("sequence", sequence)) if kind in kinds}
    hint = _hint(values, rules)
    for index, root in enumerate(roots):
        block = _block(roots, values, rules) if index == len(roots) - 1 else ()
        diagnostics.add(Diagnostic(_message(root), root.span, hint, block=block, id="MG-5013"))


def _hint(values: Mapping[str, int], rules: Sequence[LimitRule]) -> str:
    """Return the short form: one rule for everything."""
    if any(rule.path == ("*",) for rule in rules):
        return f'Add {" and ".join(f"`{kind}: {number}`" for kind, number in values.items())} to the rule for "*"'
    star = f'"*": {limit_text(values)}'
    return f"Add `{star}` to `limits:`" if rules else f"Add `limits: {{{star}}}`"


def _fit(roots: Iterable[UnsetRoot], pair: tuple[int, int]) -> bool:
    return all(root.room is None or root.size(*pair) <= root.room for root in roots)


def _message(root: UnsetRoot) -> str:
    paths = list(dict.fromkeys(".".join(unset.path) for unset in root.unset))
    shown = ", ".join(paths[:_NAMED]) + (f" and {len(paths) - _NAMED} more" if len(paths) > _NAMED else "")
    return f"{root.type} has no limit for {shown}"


def _block(
    roots: Iterable[UnsetRoot], values: Mapping[str, int], rules: Sequence[LimitRule]
) -> tuple[str, ...]:
    """Return the lines that set each member by itself, to be changed one by one.

    A type that has a line already gets one that says both.
    """
    lines = ["Or for each of them, below `limits:`" if rules else "Or for each of them:"]
    lines += [] if rules else ["limits:"]
    members: dict[TypeName, LimitTree] = {}
    places: dict[TypeName, str] = {}
    for root in roots:
        if root.type not in members:
            known = [rule for rule in rules if rule.path[0] == str(root.type)]
            members[root.type] = tree_of_rules(known)
            places[root.type] = _instead(known)
        for unset in root.unset:
            put_limit(members[root.type], unset.path, unset.kind, values[unset.kind])
    lines += [
        f"  {name}: {limit_text(own_rules)}{places[name] and f'  # {places[name]}'}"
        for name, own_rules in members.items()
    ]
    return tuple(lines)


def type_line(name: str, before: Iterable[LimitRule], after: Iterable[LimitRule]) -> tuple[str, str]:
    """Return the line of a type below `limits:` that says what `after` says, and which line of `before` it replaces."""
    own_rules, known = ([rule for rule in rules if rule.path[0] == name] for rules in (after, before))
    return f"  {name}: {limit_text(tree_of_rules(own_rules))}", _instead(known)


def _instead(rules: Sequence[LimitRule]) -> str:
    lines = sorted({rule.span.line for rule in rules if rule.span is not None})
    return f"instead of line {lines[0]}" if lines else ""
