# SPDX-License-Identifier: Apache-2.0
"""Arranges a directed graph without cycles in rows: each arrow leads downwards. The same graph, the same places."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

_SWEEPS = 8


class Places(dict[str, tuple[float, int]]):
    """Column and row of each node; `edges` are the arrows to draw."""

    edges: list[tuple[str, str]]


def arrange(edges: Iterable[tuple[str, str]]) -> Places:
    """Return the places of all nodes; an arrow that a longer way implies is left out of `edges`."""
    arrows = sorted(set(edges))
    below: dict[str, set[str]] = {name: set() for edge in arrows for name in edge}
    for source, successor in arrows:
        below[source].add(successor)
    kept = [(a, b) for a, b in arrows if not any(_leads(below, c, b) for c in below[a] - {b})]
    rows = _rows(below, kept)
    wide = max(map(len, rows))
    places = Places()
    for y, row in enumerate(rows):
        places.update({name: (x + (wide - len(row)) / 2, y) for x, name in enumerate(row)})
    places.edges = kept
    return places


def _leads(below: dict[str, set[str]], start: str, end: str) -> bool:
    return start == end or any(_leads(below, name, end) for name in below[start])


def _rows(below: dict[str, set[str]], edges: list[tuple[str, str]]) -> list[list[str]]:
    """Return the nodes by the longest way to them, those of a row in an order with few crossings."""
    depth = dict.fromkeys(below, 0)
    for _ in depth:
        for source, successor in edges:
            depth[successor] = max(depth[successor], depth[source] + 1)
    rows = [sorted(name for name in depth if depth[name] == y) for y in range(max(depth.values()) + 1)]
    for _ in range(_SWEEPS):
        for direction in (rows, rows[::-1]):
            for row in direction:
                _sort(row, rows, edges)
    return rows


def _sort(row: list[str], rows: list[list[str]], edges: list[tuple[str, str]]) -> None:
    """Sort a row by the mean place of each node's neighbors, its middle being 0."""
    where = {name: x - (len(other) - 1) / 2 for other in rows for x, name in enumerate(other)}

    def mean(name: str) -> float:
        near = list(_neighbors(name, edges))
        return sum(where[other] for other in near) / len(near) if near else where[name]

    row.sort(key=lambda name: (round(mean(name), 6), name))


def _neighbors(name: str, edges: list[tuple[str, str]]) -> Iterator[str]:
    for source, successor in edges:
        if name == source:
            yield successor
        elif name == successor:
            yield source
