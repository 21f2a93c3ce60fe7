# SPDX-License-Identifier: Apache-2.0
"""The analysis of response times: known sets, an independent processor played tick by tick, and what it refuses."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest

from microros_gen.schedule.phasing import worst_phasing
from microros_gen.schedule.response import Blocker, Interference, analyze, meeting, utilization
from microros_gen.schedule.task import LONGEST_US, Section, Task
from tests.support.ticks import played_response, random_tasks

SETS = 10_000
HORIZON = 1500
PLAYED_EACH = 100


def test_the_example_of_the_literature() -> None:
    """Burns and Wellings, Real-Time Systems and Programming Languages: periods 80, 40, 20 and times 40, 10, 5."""
    tasks = [Task("a", 80, 40), Task("b", 40, 10), Task("c", 20, 5)]
    assert [(r.task.name, r.priority, r.response_us, r.slack_us) for r in analyze(tasks)] == [
        ("c", 1, 5, 15),
        ("b", 2, 15, 25),
        ("a", 3, 80, 0),
    ]
    assert utilization(tasks) == 1
    assert analyze(tasks)[2].interference == (Interference("c", 4, 20), Interference("b", 2, 20))


def test_a_later_release_has_the_longest_response_beyond_the_period() -> None:
    """Lehoczky 1990, table 1: of the second task, the responses of the busy period are 114, 102, 116, 104, 118, ..."""
    tasks = [Task("a", 70, 26), Task("b", 100, 62, deadline_us=118)]
    last = analyze(tasks)[1]
    assert (last.response_us, last.meets) == (118, True)
    assert analyze([tasks[0], Task("b", 100, 62, deadline_us=117)])[1].slack_us == -1
    assert meeting(tasks) == {"a", "b"}
    played = [c.response_us for c in worst_phasing(analyze(tasks), "b", 700).completions if c.task == "b"]
    assert played == [114, 102, 116, 104, 118, 106, 94]


@pytest.mark.parametrize("part", range(4))
def test_agrees_with_a_processor_played_tick_by_tick(part: int) -> None:
    """On 10,000 random sets: each response, and what the tool plays of the worst phasing, to the microsecond."""
    random, unbounded, missed, beyond = Random(part), 0, 0, 0
    for number in range(SETS // 4):
        tasks = random_tasks(random)
        responses = analyze(tasks)
        order = [response.task for response in responses]
        assert meeting(tasks) == {r.task.name for r in responses if r.meets}, tasks
        for index, response in enumerate(responses):
            if response.overloaded:
                unbounded += 1
                assert utilization(order[: index + 1]) > 1
                continue
            if utilization(order[: index + 1]) > Fraction(19, 20):
                continue  # a busy period of any length
            played = played_response(order[: index + 1], response.blocking_us, HORIZON)
            assert response.response_us == played, (tasks, response)
            if number % PLAYED_EACH == 0:
                phasing = worst_phasing(responses, response.task.name, HORIZON)
                own = [c.response_us for c in phasing.completions if c.task == response.task.name]
                assert max(own) == played, (tasks, response)
            missed += not response.meets
            beyond += played is not None and played > response.task.period_us
    assert unbounded > 100
    assert missed > 100
    assert beyond > 100


def test_a_load_of_exactly_one_has_a_response_and_no_end() -> None:
    """With blocking the processor is never free again, but what is late does not grow: it repeats after 12 us."""
    tasks = [Task("a", 4, 2), Task("b", 6, 3, deadline_us=12, blocking_us=2)]
    response = analyze(tasks)[1]
    releases = 2 * 12 // 6
    phasing = worst_phasing(analyze(tasks), "b", 5 * 12)
    own = [c.response_us for c in phasing.completions if c.task == "b"][:releases]
    assert (response.response_us, response.overloaded) == (max(own), False)
    assert played_response(tasks, 2, HORIZON) is None


def test_more_than_the_processor_has_ends_at_once() -> None:
    """At a load that is one millionth above 1, no iteration would ever end."""
    tasks = [Task("a", 1_000_000, 500_000), Task("b", 999_999, 500_000, deadline_us=LONGEST_US)]
    last = analyze(tasks)[1]
    assert (last.task.name, last.overloaded, last.response_us, last.slack_us) == ("b", True, None, None)
    assert not last.meets
    assert meeting(tasks) == {"a"}


def test_a_load_next_to_one_ends_without_a_response() -> None:
    """This busy period lasts for hours: no bound is found, and the deadline counts as missed."""
    period = 999_999
    tasks = [
        Task("a", 1_000_000, 500_000),
        Task("b", period, period // 2, deadline_us=LONGEST_US, blocking_us=100_000),
    ]
    last = analyze(tasks)[1]
    assert (last.overloaded, last.response_us, last.meets) == (False, None, False)


def test_what_blocks_is_the_longest_section_below_of_a_lock_that_is_taken_above() -> None:
    tasks = [
        Task("fast", 100, 5, sections=(Section("session", 1),)),
        Task("middle", 200, 5),
        Task("slow", 300, 30, sections=(Section("session", 9), Section("log", 20))),
        Task("slowest", 400, 30, sections=(Section("session", 7),)),
    ]
    fast, middle, slow, slowest = analyze(tasks)
    assert fast.blockers == middle.blockers == (Blocker("slow", "session", 9),)
    assert slow.blockers == (Blocker("slowest", "session", 7),)
    assert (slowest.blockers, slowest.blocking_us) == ((), 0)
    assert fast.response_us == 5 + 9


def test_two_locks_block_once_each_and_each_task_once() -> None:
    both = (Section("a", 4), Section("b", 6))
    top = Task("top", 100, 10, sections=both)
    one_below = analyze([top, Task("low", 200, 10, sections=both)])[0]
    assert one_below.blockers == (Blocker("low", "b", 6),)
    two_below = analyze([top, *(Task(name, 200, 10, sections=both) for name in ("low", "lower"))])[0]
    assert sum(blocker.time_us for blocker in two_below.blockers) == two_below.blocking_us == 4 + 6


def test_jitter_counts_for_the_task_itself_and_for_those_below() -> None:
    high, low = analyze([Task("high", 10, 3, jitter_us=4), Task("low", 50, 8)])
    assert (high.response_us, low.response_us) == (7, 14)
    assert analyze([Task("high", 10, 3), Task("low", 50, 8)])[1].response_us == 14
    assert analyze([Task("high", 10, 3, jitter_us=9), Task("low", 50, 8)])[1].response_us == 17


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"period_us": 0}, "the period of 'a' is 0 us, not 1 to 1000000000"),
        ({"time_us": 0}, "the time of 'a' is 0 us"),
        ({"deadline_us": LONGEST_US + 1}, "the deadline of 'a'"),
        ({"jitter_us": -1}, "the jitter of 'a' is -1 us, not 0 to"),
        ({"blocking_us": -1}, "the blocking of 'a'"),
        ({"criticality": "urgent"}, "the criticality of 'a' is 'urgent'"),
        ({"sections": (Section("session", 3),)}, "'a' holds a lock for longer than it runs"),
    ],
)
def test_times_that_no_task_has_are_refused(change: dict[str, object], message: str) -> None:
    arguments: dict[str, object] = {"name": "a", "period_us": 10, "time_us": 2} | change
    with pytest.raises(ValueError, match=message):
        Task(**arguments)  # type: ignore[arg-type]
