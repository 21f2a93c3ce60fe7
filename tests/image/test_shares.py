# SPDX-License-Identifier: Apache-2.0
"""Loops with a total: what runs in all of their rounds counts once, and never less than what can run."""

from __future__ import annotations

import random

import pytest

from microros_gen.image.paths import Length
from microros_gen.image.rounds import Sources
from microros_gen.image.shares import HOLD, Total

TEXT = Total(("format",), "all loops", 100)


def put(rounds: int, cost: int) -> Length:
    """Return a loop that puts characters."""
    return Length(cost).times(Length(rounds, total=TEXT), 0)


def test_a_total_counts_once_in_its_scope_and_as_often_as_it_is_reached_outside() -> None:
    each = Length(5) + put(100, 7)
    many = each.times(Length(50), 0)
    assert many.count == 50 * 705
    assert many.within("format").count == 50 * 5 + 700
    assert many.within("other").count == many.count
    assert many.within("format").times(Length(2), 0).count == 2 * 950, "another call has its own total"


def test_a_total_that_differs_from_the_rounds_of_one_loop() -> None:
    digits = Length(9).times(Length(22, total=Total(("format",), "digits", 200)), 0)
    assert digits.times(Length(50), 0).within("format").count == 200 * 9
    assert digits.within("format").count == 22 * 9, "one loop has no more rounds than its own number"


def test_rounds_of_the_message_drop_a_total() -> None:
    assert not put(10, 3).times(Length(0, rate=1 << 16), 10).shares


@pytest.mark.parametrize("seed", range(40))
def test_no_run_is_longer_than_the_sum(seed: int) -> None:
    """Loops in a loop share a number of characters; each round of the outer one takes one of several ways."""
    rng = random.Random(seed)
    ways = [(rng.randint(1, 20), [rng.randint(1, 20) for _ in range(rng.randint(0, 3))]) for _ in range(4)]
    rounds = rng.randint(1, 30)
    bound = None
    for fixed, loops in ways:
        way = Length(fixed)
        for cost in loops:
            way += put(TEXT.most, cost)
        bound = way if bound is None else bound.or_longer(way)
    assert bound is not None
    most = bound.times(Length(rounds), 0).within("format").count
    for _ in range(200):
        left, run = TEXT.most, 0
        for _ in range(rounds):
            fixed, loops = rng.choice(ways)
            run += fixed
            for cost in loops:
                rounds_here = rng.choice((0, rng.randint(0, left), left))
                left -= rounds_here
                run += rounds_here * cost
        assert run <= most


SOURCE = """\
/* at most 4 calls in a hold */
static void look(void)
{
  /* at most 22 rounds, 10 * 20 in each format */
  while (is_left()) {
    put();
  }
  /* at most 30 rounds of all loops in each format */
  while (is_left()) {
    put();
  }
}
"""


def test_comments_have_totals() -> None:
    sources = Sources(lambda name: SOURCE, [])
    assert sources.rounds([("a.c", 6)]) == Length(22, total=Total(("format",), "a.c:5", 200))
    assert sources.rounds([("a.c", 10)]) == Length(30, total=Total(("format",), "all loops", 30))
    assert sources.all_calls("a.c", "look") == Length(4, total=Total((HOLD,), "a.c:2", 4))
    assert sources.all_calls("a.c", "other") == Length(1)


def test_a_comment_can_have_several_lines() -> None:
    """Its number is that of the loop after it; two functions with the same code differ in any of its lines."""
    text = SOURCE.replace("of all loops in each format */", "of all loops\n     in each format or begin */")
    total = Total(("format", "begin"), "all loops", 30)
    assert Sources(lambda name: text, []).rounds([("a.c", 11)]) == Length(30, total=total)
    twins = text + text.replace("look", "see").replace("or begin", "or end")
    assert Sources(lambda name: twins, []).rounds([("a.c", 11)]) == "a.c:10"
