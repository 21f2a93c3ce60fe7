# SPDX-License-Identifier: Apache-2.0
"""Capacities as `limits:` of the application file nests them below a type, and the numbers that are proposed there."""

from __future__ import annotations

from collections.abc import Mapping

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


def limit_text(tree: Mapping[str, object]) -> str:
    """Return a tree in YAML's flow style: `{name: {sequence: 6, string: 32}, position: 6}`."""
    parts = (
        f"{key}: {limit_text(value) if isinstance(value, Mapping) else value}" for key, value in tree.items()
    )
    return "{" + ", ".join(parts) + "}"
