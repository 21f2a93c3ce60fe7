# SPDX-License-Identifier: Apache-2.0
"""Capacities as `limits:` of the application file nests them below a type, and the numbers that are proposed there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.application.limit_rule import LimitRule

PROPOSED_LIMITS: tuple[tuple[int, int], ...] = ((32, 8), (32, 4), (16, 4), (16, 2), (8, 2), (8, 1), (4, 1))
"""Characters of strings and elements of sequences, the largest first: proposed are the first that fit."""

LimitTree = dict[str, "int | LimitTree"]


def put_limit(
    tree: LimitTree, path: tuple[str, ...], kind: str, number: int, *, by_kind: bool = False
) -> None:
    """Write a number at `path`: alone where the member has one kind of limit, else (or `by_kind`) by its kind.

    `kind` is `string` or `sequence`.
    """
    for name in path[:-1]:
        below = tree.setdefault(name, {})
        if isinstance(below, int):  # how many elements, and now something in each of them
            below = tree[name] = {"sequence": below}
        tree = below
    known = tree.get(path[-1])
    if isinstance(known, dict):
        known[kind] = number
    elif known is None or known == number:
        tree[path[-1]] = {kind: number} if by_kind else number
    else:
        other = "sequence" if kind == "string" else "string"
        tree[path[-1]] = {other: known, kind: number}


def tree_of_rules(rules: Iterable[LimitRule]) -> LimitTree:
    """Return what rules of one type, or the own limits of one endpoint, say: a tree of members."""
    members: LimitTree = {}
    for rule in rules:
        for kind, number in (("string", rule.string), ("sequence", rule.sequence)):
            if number is None:
                continue
            if len(rule.path) == 1:
                members[kind] = number
            else:
                put_limit(members, rule.path[1:], kind, number, by_kind=not rule.single)
    return members


def limit_text(tree: Mapping[str, object]) -> str:
    """Return a tree in YAML's flow style: `{name: {sequence: 6, string: 32}, position: 6}`."""
    parts = (
        f"{key}: {limit_text(value) if isinstance(value, Mapping) else value}" for key, value in tree.items()
    )
    return "{" + ", ".join(parts) + "}"
