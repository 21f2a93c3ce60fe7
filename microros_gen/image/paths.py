# SPDX-License-Identifier: Apache-2.0
"""The longest path through a graph whose loops have a largest number of rounds.

A loop is a strongly connected part that is entered at one place. Without the edges to that place it may contain others
(Bourdoncle, "Efficient chaotic iteration strategies with widenings", 1993). What its place is reached with grows by its
longest round for each round.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import TypeVar

from microros_gen.records import dataclass

Node = TypeVar("Node", bound=Hashable)


@dataclass(frozen=True)
class Length:
    """At most `count` instructions, but for what is in `open`: why it is no bound."""

    count: int
    open: frozenset[str] = frozenset()

    def __add__(self, other: Length) -> Length:
        """Return both, one after the other."""
        return Length(self.count + other.count, self.open | other.open)


NOTHING = Length(0)
Edges = Mapping[Node, Mapping[Node, Length]]
Rounds = Callable[[Node, frozenset[Node]], Length]
"""Of a loop, by the place where it is entered and all of its places: the most rounds, or why nobody knows."""


def longer(known: Length | None, other: Length) -> Length:
    """Return the longer of two paths, with what is open in either."""
    return other if known is None else Length(max(known.count, other.count), known.open | other.open)


def longest(edges: Edges[Node], begins: Mapping[Node, Length], rounds: Rounds[Node]) -> dict[Node, Length]:
    """Return the longest path to each place that one of `begins` leads to, from what each of those begins with."""
    return _longest(_reached(edges, begins), edges, begins, rounds)


def _reached(edges: Edges[Node], begins: Iterable[Node]) -> set[Node]:
    seen = set(begins)
    waiting = list(seen)
    while waiting:
        for after in edges.get(waiting.pop(), {}):
            if after not in seen:
                seen.add(after)
                waiting.append(after)
    return seen


def _longest(
    nodes: set[Node], edges: Edges[Node], begins: Mapping[Node, Length], rounds: Rounds[Node]
) -> dict[Node, Length]:
    found: dict[Node, Length] = {}
    coming: dict[Node, Length] = {node: value for node, value in begins.items() if node in nodes}
    for part in _parts(nodes, edges):
        if len(part) == 1 and part[0] not in edges.get(part[0], {}):
            if part[0] in coming:
                found[part[0]] = coming[part[0]]
        else:
            found.update(_loop(frozenset(part), edges, coming, frozenset(begins), rounds))
        for node in part:
            for after, length in edges.get(node, {}).items():
                if after in nodes and after not in part and node in found:
                    coming[after] = longer(coming.get(after), found[node] + length)
    return found


def _loop(
    part: frozenset[Node],
    edges: Edges[Node],
    coming: Mapping[Node, Length],
    begins: frozenset[Node],
    rounds: Rounds[Node],
) -> dict[Node, Length]:
    """Return the longest paths into a loop; one that begins in its middle counts as one from its entry."""
    entered = [node for node in part if node in coming]
    if not entered:
        return {}
    outside = [node for node in entered if node not in begins]
    head = min(outside or entered, key=str)
    value: Length | None = None
    for node in entered:
        value = longer(value, coming[node])
    assert value is not None
    within = {
        node: {n: w for n, w in edges.get(node, {}).items() if n in part and n != head} for node in part
    }
    inner = _longest(set(part), within, {head: NOTHING}, rounds)
    cycle = NOTHING
    for node in part:
        back = edges.get(node, {}).get(head)
        if back is not None and node in inner:
            cycle = longer(cycle, inner[node] + back)
    most = rounds(head, part)
    more = Length(cycle.count * most.count, cycle.open | most.open)
    if len(outside) > 1:
        more += Length(0, frozenset({"a loop with several entries"}))
    return {node: value + more + length for node, length in inner.items()}


def _parts(nodes: set[Node], edges: Edges[Node]) -> Sequence[tuple[Node, ...]]:
    """Return the strongly connected parts in an order in which edges lead (Kosaraju)."""
    order: list[Node] = []
    seen: set[Node] = set()
    for start in sorted(nodes, key=str):
        if start in seen:
            continue
        seen.add(start)
        stack = [(start, iter(edges.get(start, {})))]
        while stack:
            node, following = stack[-1]
            after = next((n for n in following if n in nodes and n not in seen), None)
            if after is None:
                order.append(node)
                stack.pop()
            else:
                seen.add(after)
                stack.append((after, iter(edges.get(after, {}))))
    back: dict[Node, list[Node]] = {}
    for node in nodes:
        for after in edges.get(node, {}):
            if after in nodes:
                back.setdefault(after, []).append(node)
    found, taken = [], set[Node]()
    for start in reversed(order):
        if start in taken:
            continue
        part, waiting = [], [start]
        taken.add(start)
        while waiting:
            node = waiting.pop()
            part.append(node)
            for earlier in back.get(node, ()):
                if earlier not in taken:
                    taken.add(earlier)
                    waiting.append(earlier)
        found.append(tuple(part))
    return found
