# SPDX-License-Identifier: Apache-2.0
"""The longest path through graphs with loops, against one that follows every path."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping

import pytest

from microros_gen.image.paths import NOTHING, Length, longest

Graph = Mapping[int, Mapping[int, int]]


def measured(graph: Graph, rounds: Mapping[int, int], begin: int = 0) -> dict[int, int]:
    edges = {node: {to: Length(weight) for to, weight in after.items()} for node, after in graph.items()}
    found = longest(edges, {begin: NOTHING}, lambda head, _: Length(rounds[head]))
    assert all(not length.open for length in found.values())
    return {node: length.count for node, length in found.items()}


def test_a_path_without_loops_is_the_heaviest() -> None:
    assert measured({0: {1: 1, 2: 5}, 1: {3: 9}, 2: {3: 1}}, {}) == {0: 0, 1: 1, 2: 5, 3: 10}


def test_a_loop_counts_its_longest_round_each_time() -> None:
    graph = {0: {1: 2}, 1: {2: 1, 3: 4, 4: 1}, 2: {1: 1}, 3: {1: 1}}
    assert measured(graph, {1: 10})[4] == 2 + 10 * 5 + 1


def test_a_loop_in_a_loop_counts_in_each_of_its_rounds() -> None:
    graph = {0: {1: 1}, 1: {2: 1, 9: 1}, 2: {3: 1, 1: 1}, 3: {2: 1}}
    assert measured(graph, {1: 3, 2: 7})[9] == 1 + 3 * (1 + 7 * 2 + 1) + 1


def test_a_loop_with_two_entries_is_no_bound() -> None:
    edges = {0: {1: Length(1), 2: Length(1)}, 1: {2: Length(1)}, 2: {1: Length(1), 3: Length(1)}}
    found = longest(edges, {0: NOTHING}, lambda head, part: Length(1))
    assert found[3].open == {"a loop with several entries"}


def limited(graph: Graph, rounds: Mapping[int, int], limits: Mapping[int, int]) -> dict[int, int]:
    edges = {node: {to: Length(weight) for to, weight in after.items()} for node, after in graph.items()}
    found = longest(edges, {0: NOTHING}, lambda head, _: Length(rounds[head]), limits.get)
    return {node: length.count for node, length in found.items()}


def test_what_few_rounds_reach_counts_in_those() -> None:
    graph = {0: {1: 2}, 1: {2: 1, 3: 1, 4: 1}, 2: {1: 100}, 3: {1: 4}}
    assert limited(graph, {1: 10}, {2: 3})[4] == 2 + 3 * 101 + 7 * 5 + 1
    assert limited(graph, {1: 10}, {2: 3, 3: 2})[4] == 2 + 5 * 101 + 1, "any of those that are limited"
    assert limited(graph, {1: 10}, {2: 30})[4] == 2 + 10 * 101 + 1
    assert limited(graph, {1: 10}, {2: 0})[4] == 2 + 10 * 5 + 1


def test_what_few_rounds_of_an_inner_loop_reach_counts_in_each_of_the_outer_one() -> None:
    graph = {0: {1: 1}, 1: {2: 1, 9: 1}, 2: {3: 1, 4: 1, 1: 1}, 3: {2: 50}, 4: {2: 1}}
    assert limited(graph, {1: 3, 2: 7}, {3: 2})[9] == 1 + 3 * (1 + 2 * 51 + 5 * 2 + 1) + 1


def walked(
    graph: Graph, left: Mapping[int, int], at: int, length: int, best: dict[int, int], few: tuple[int, int]
) -> None:
    """Follow each path that takes an edge back to a node at most as often as `left` says.

    `few`: a node, and how often a path leaves it at most.
    """
    best[at] = max(best.get(at, 0), length)
    node, most = few
    if at == node:
        if most == 0:
            return
        few = (node, most - 1)
    for to, weight in graph.get(at, {}).items():
        if to > at:
            walked(graph, left, to, length + weight, best, few)
        elif left[to]:
            walked(graph, {**left, to: left[to] - 1}, to, length + weight, best, few)


@pytest.mark.parametrize("seed", range(40))
def test_no_path_is_longer_than_what_was_found(seed: int) -> None:
    """Loops of random graphs: each jumps back to a node that every path to its end has passed."""
    chance = random.Random(seed)
    count = 7
    graph: dict[int, dict[int, int]] = {n: {n + 1: chance.randint(1, 9)} for n in range(count - 1)}
    for node in range(count - 2):
        if chance.random() < 0.4:
            graph[node][node + 2] = chance.randint(1, 9)
    heads = [n for n in range(1, count - 1) if all(not (a < n < b) for a in graph for b in graph[a])]
    for head in heads[:2]:
        graph[chance.randrange(head, count - 1)][head] = chance.randint(1, 9)
    rounds = dict.fromkeys(range(count), 2)
    found, best = measured(graph, rounds), dict[int, int]()
    walked(graph, rounds, 0, 0, best, (count, 0))
    assert set(found) == set(best)
    assert all(found[node] >= length for node, length in best.items())
    for node in range(count):
        best = {}
        walked(graph, rounds, 0, 0, best, (node, 1))
        few = limited(graph, rounds, {node: 1})
        assert all(length <= few[at] <= found[at] for at, length in best.items())


def heaviest(graph: Graph, end: int, cycles: int, walk: tuple[int, ...] = (0,)) -> int | None:
    """Return the weight of the heaviest walk to `end` that goes round at most `cycles` times; None: nothing does."""
    found = 0 if walk[-1] == end else None
    for to, weight in graph.get(walk[-1], {}).items():
        after = walk[: walk.index(to) + 1] if to in walk else (*walk, to)
        if to in walk and cycles == 0:
            continue
        more = heaviest(graph, end, cycles - (to in walk), after)
        if more is not None:
            found = max(found or 0, weight + more)
    return found


def constant(rounds: int) -> Callable[[int, frozenset[int]], Length]:
    return lambda head, part: Length(rounds)


def test_a_loop_with_several_entries_is_bounded_where_each_way_round_counts() -> None:
    rng = random.Random(17)
    compared = 0
    while compared < 300:
        edges = {(a, b) for a in (1, 2, 3) for b in (1, 2, 3) if a != b and rng.random() < 0.6}
        edges |= {(0, 1), (0, 2), (rng.choice((1, 2, 3)), 4)}
        graph: dict[int, dict[int, int]] = {}
        for a, b in sorted(edges):
            graph.setdefault(a, {})[b] = rng.randint(1, 9)
        rounds = rng.randint(1, 3)
        lengths = {node: {to: Length(w) for to, w in after.items()} for node, after in graph.items()}
        found = longest(lengths, {0: NOTHING}, constant(rounds), anywhere=lambda head: True)
        most = heaviest(graph, 4, rounds)
        if most is not None:
            assert most <= found[4].count, (graph, rounds)
            assert not found[4].open
            compared += 1
