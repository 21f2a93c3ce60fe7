# SPDX-License-Identifier: Apache-2.0
"""The longest path through a graph whose loops have a largest number of rounds.

A loop is a strongly connected part that is entered at one place. Without the edges to that place it may contain others
(Bourdoncle, "Efficient chaotic iteration strategies with widenings", 1993). What its place is reached with grows by its
longest round for each round. A place of a loop may be reached in few of its rounds only: the others then grow by the
longest one without it.

What decodes a message has a part for each byte that it reads, besides a fixed one. Each byte is read once: of two calls
one after the other, and of the rounds of a loop, the bytes are disjoint (Cormen et al., "Introduction to Algorithms",
amortized analysis). So the part for each byte is the larger one of both calls, and that of one round.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import field, replace
from operator import add
from typing import Generic, TypeVar

from microros_gen.image.shares import NONE, Shares, Split, Total, joined, repeated
from microros_gen.records import dataclass

Node = TypeVar("Node", bound=Hashable)


UNIT = 1 << 16
"""Parts of an instruction in which `Length.rate` is: it is rounded up to one."""


@dataclass(frozen=True)
class Length:
    """At most `count` instructions, but for what is in `open`: why it is no bound.

    `rate`: those for each byte of the message that are read meanwhile, besides `count`; of an instruction UNIT parts.
    `apart`: another length that is apart is of other bytes. `least`: it reads so many bytes, for which `rate` does not
    count, unless what is read is refused. Then it counts for all bytes, and the message ends.
    `shares`: what of `count` has a total (shares.py). `total`: of rounds, that they are all that there are.
    """

    count: int
    open: frozenset[str] = frozenset()
    rate: int = 0
    apart: bool = False
    least: int = 0
    shares: Shares = field(default_factory=dict)
    total: Total | None = None

    def __add__(self, other: Length) -> Length:
        """Return both, one after the other."""
        count, why, least = self.count + other.count, self.open | other.open, self.least + other.least
        shares = joined((self.count, other.count), (self.shares, other.shares), add)
        if not self.rate and not other.rate:
            return Length(count, why, least=least, shares=shares)
        apart = self._is_apart and other._is_apart
        rate = max(self.rate, other.rate) if apart else self.rate + other.rate
        return Length(count, why, rate, apart, least if apart else 0, shares)

    @property
    def _is_apart(self) -> bool:
        return self.apart or not self.rate

    def of(self, size: int) -> Length:
        """Return the length where at most `size` bytes are read."""
        if not self.rate and not self.least:
            return self
        more = -(-self.rate * size // UNIT)
        shares = {scope: Split(split.base + more, split.parts) for scope, split in self.shares.items()}
        return Length(self.count + more, self.open, shares=shares)

    def within(self, scope: str) -> Length:
        """Return the length where all of it is in one call of `scope`: each of its totals counts once."""
        if scope not in self.shares:
            return self
        others = {name: split for name, split in self.shares.items() if name != scope}
        return replace(self, count=min(self.count, self.shares[scope].length), shares=others)

    def called(self, rounds: Length) -> Length:
        """Return the length of one of `rounds.count` calls, which are all that there are in the scope of its total."""
        if rounds.total is None or rounds.open:
            return self
        all_calls = repeated(self.count, self.shares, rounds.count, rounds.total)
        return replace(self, shares={**self.shares, **{s: all_calls[s] for s in rounds.total.scopes}})

    def times(self, rounds: Length, size: int) -> Length:
        """Return `rounds.count` rounds of this length, and those for each byte; `size`: the most bytes of a message.

        Of `k` rounds that read at least `m` bytes each, `k * count + rate * (bytes - k * least)` is the largest for no
        round or for as many as there are bytes for.
        """
        rate, most, each = self.rate, rounds, self.count * UNIT
        if self.rate and not self.apart:  # each round may be about the same bytes
            most = rounds.of(size)
            rate *= most.count
        elif rounds.apart:
            each = max(each - self.rate * self.least, 0)
        apart = self._is_apart and (rounds.apart or not most.rate)
        rate += -(-each * most.rate // UNIT)
        count, why = self.count * most.count, self.open | rounds.open
        shares = NONE if most.rate else repeated(self.count, self.shares, most.count, most.total)
        return Length(count, why, rate, apart and rate > 0, shares=shares)

    def or_longer(self, other: Length) -> Length:
        """Return a length that neither of both is longer than."""
        apart, rate = self._is_apart and other._is_apart, max(self.rate, other.rate)
        least = min(self.least, other.least) if apart else 0
        count, why = max(self.count, other.count), self.open | other.open
        shares = joined((self.count, other.count), (self.shares, other.shares), max)
        return Length(count, why, rate, apart and rate > 0, least, shares)


NOTHING = Length(0)
Edges = Mapping[Node, Mapping[Node, Length]]
Rounds = Callable[[Node, frozenset[Node]], Length]
"""Of a loop, by the place where it is entered and all of its places: the most rounds, or why nobody knows.

`rate`: those for each byte that is read in it."""
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
    size: int


def longer(known: Length | None, other: Length) -> Length:
    """Return the longer of two paths, with what is open in either."""
    return other if known is None else known.or_longer(other)


def longest(
    edges: Edges[Node],
    begins: Mapping[Node, Length],
    rounds: Rounds[Node],
    limits: Limits[Node] = _everywhere,
    anywhere: Anywhere[Node] = _nowhere,
    size: int = 0,
) -> dict[Node, Length]:
    """Return the longest path to each place that one of `begins` leads to, from what each of those begins with.

    `size`: the most bytes of a message.
    """
    return _longest(_reached(edges, begins), edges, begins, _Bounds(rounds, limits, anywhere, size))


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
    more = _rounds(part, head, edges, inner).times(most, bounds.size)
    limited = _limited(part, within, bounds.limits)
    few = sum(limited.values())
    if limited and (few < most.count or most.rate) and not several:
        others = {node: {} if node in limited else after for node, after in within.items()}
        shorter = _longest(set(part), others, {head: NOTHING}, bounds)
        free = {node: edges.get(node, {}) if node not in limited else {} for node in part}
        others_most = Length(max(most.count - few, 0), rate=most.rate, apart=most.apart)
        rest = _rounds(part, head, free, shorter).times(others_most, bounds.size)
        more = _rounds(part, head, edges, inner).times(Length(few, most.open), bounds.size) + rest
    if len(outside) > 1 and not several:
        more += Length(0, frozenset({"a loop with several entries"}))
    return {node: value + more + length for node, length in inner.items()}


def _rounds(part: frozenset[Node], head: Node, edges: Edges[Node], inner: Mapping[Node, Length]) -> Length:
    """Return the longest round of a loop; `inner` are the longest paths from its entry."""
    cycle: Length | None = None
    for node in part:
        back = edges.get(node, {}).get(head)
        if back is not None and node in inner:
            cycle = longer(cycle, inner[node] + back)
    return cycle if cycle is not None else NOTHING


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
