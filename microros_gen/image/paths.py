# SPDX-License-Identifier: Apache-2.0
"""The longest path through a graph whose loops have a largest number of rounds.

A loop is a strongly connected part that is entered at one place. Without the edges to that place it may contain others
(Bourdoncle, "Efficient chaotic iteration strategies with widenings", 1993). What its place is reached with grows by its
longest round for each round. A place of a loop may be reached in few of its rounds only: the others then grow by the
longest one without it.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import Generic, TypeVar

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
Limits = Callable[[Node], int | None]
"""Of a place: in how many rounds of its innermost loop it is reached at most, each time that the loop is entered.
None: in all of them."""


Anywhere = Callable[[Node], bool]
"""Of a place of a loop: whether it does not matter where the loop is entered, as each way round counts as a round."""


def _everywhere(node: Hashable) -> int | None:
    """Limit no place."""
    return None


def _nowhere(node: Hashable) -> bool:
    """Let no loop be entered in several places."""
    return False


@dataclass(frozen=True)
class _Bounds(Generic[Node]):
    """What is known of loops besides their places."""

    rounds: Rounds[Node]
    limits: Limits[Node]
    anywhere: Anywhere[Node]


def longer(known: Length | None, other: Length) -> Length:
    """Return the longer of two paths, with what is open in either."""
    return other if known is None else Length(max(known.count, other.count), known.open | other.open)


def longest(
    edges: Edges[Node],
    begins: Mapping[Node, Length],
    rounds: Rounds[Node],
    limits: Limits[Node] = _everywhere,
    anywhere: Anywhere[Node] = _nowhere,
) -> dict[Node, Length]:
    """Return the longest path to each place that one of `begins` leads to, from what each of those begins with."""
    return _longest(_reached(edges, begins), edges, begins, _Bounds(rounds, limits, anywhere))


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
    nodes: set[Node],
    edges: Edges[Node],
    begins: Mapping[Node, Length],
    bounds: _Bounds[Node],
) -> dict[Node, Length]:
    found: dict[Node, Length] = {}
    coming: dict[Node, Length] = {node: value for node, value in begins.items() if node in nodes}
    for part in _parts(nodes, edges):
        if len(part) == 1 and part[0] not in edges.get(part[0], {}):
            if part[0] in coming:
                found[part[0]] = coming[part[0]]
        else:
            found.update(_loop(frozenset(part), edges, coming, frozenset(begins), bounds))
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
    bounds: _Bounds[Node],
) -> dict[Node, Length]:
    """Return the longest paths into a loop; one that begins in its middle counts as one from its entry.

    From another entry than the first one a path has a part of a round before that, which counts as a further one.
    """
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
    several = len(outside) > 1 and bounds.anywhere(head)
    inner = _longest(set(part), within, dict.fromkeys(outside if several else (head,), NOTHING), bounds)
    most = bounds.rounds(head, part)
    if several:
        most += Length(1)
    more = _rounds(part, head, edges, inner, most)
    limited = _limited(part, within, bounds.limits)
    few = sum(limited.values())
    if limited and few < most.count and not several:
        others = {node: {} if node in limited else after for node, after in within.items()}
        shorter = _longest(set(part), others, {head: NOTHING}, bounds)
        free = {node: edges.get(node, {}) if node not in limited else {} for node in part}
        rest = _rounds(part, head, free, shorter, Length(most.count - few))
        more = _rounds(part, head, edges, inner, Length(few, most.open)) + rest
    if len(outside) > 1 and not several:
        more += Length(0, frozenset({"a loop with several entries"}))
    return {node: value + more + length for node, length in inner.items()}


def _rounds(
    part: frozenset[Node], head: Node, edges: Edges[Node], inner: Mapping[Node, Length], most: Length
) -> Length:
    """Return `most` times the longest round of a loop; `inner` are the longest paths from its entry."""
    cycle = NOTHING
    for node in part:
        back = edges.get(node, {}).get(head)
        if back is not None and node in inner:
            cycle = longer(cycle, inner[node] + back)
    return Length(cycle.count * most.count, cycle.open | most.open)


def _limited(part: frozenset[Node], within: Edges[Node], limits: Limits[Node]) -> dict[Node, int]:
    """Return the places of a loop that few of its rounds reach; those of its inner loops count there."""
    known = {node: limit for node in part if (limit := limits(node)) is not None}
    if not known:
        return {}
    inner = {node for each in _parts(set(part), within) if len(each) > 1 for node in each}
    return {
        node: limit for node, limit in known.items() if node not in inner and node not in within.get(node, {})
    }


def parts_of(edges: Mapping[Node, Iterable[Node]]) -> Sequence[tuple[Node, ...]]:
    """Return the strongly connected parts of a graph."""
    return _parts(set(edges), {n: dict.fromkeys(after, NOTHING) for n, after in edges.items()})


def inner_parts(edges: Mapping[Node, Iterable[Node]], head: Node) -> Sequence[frozenset[Node]]:
    """Return the loops within a loop that is entered at `head`; `edges` are those of all of its places."""
    within = {n: {to: NOTHING for to in after if to in edges and to != head} for n, after in edges.items()}
    found = _parts(set(edges), within)
    return [frozenset(part) for part in found if len(part) > 1 or part[0] in within[part[0]]]


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
