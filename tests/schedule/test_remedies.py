# SPDX-License-Identifier: Apache-2.0
"""The number that would do, against all numbers tried in turn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from random import Random

from microros_gen.schedule.remedies import DEADLINE, LOCK, PERIOD, TIME, Remedy, remedies
from microros_gen.schedule.response import meeting
from microros_gen.schedule.task import HIGH, Section, Task
from tests.support.ticks import random_tasks

MOST = 150


CHANGES: dict[str, Callable[[Task, int], Task]] = {
    PERIOD: lambda task, value: replace(task, period_us=value),
    DEADLINE: lambda task, value: replace(task, deadline_us=value),
    TIME: lambda task, value: replace(task, time_us=value, sections=shorter(task, value, task.time_us)),
    LOCK: lambda task, value: replace(task, sections=shorter(task, value, 0)),
}


def shorter(task: Task, most: int, least: int) -> tuple[Section, ...]:
    """The sections, those of `least` and more for at most `most`."""
    return tuple(Section(s.lock, min(s.time_us, most)) if s.time_us >= least else s for s in task.sections)


def first_that_fits(
    tasks: Sequence[Task], index: int, what: str, values: Iterable[int], late: str
) -> int | None:
    kept = meeting(tasks) | {late}
    for value in values:
        other = CHANGES[what](tasks[index], value)
        if kept <= meeting([*tasks[:index], other, *tasks[index + 1 :]]):
            return value
    return None


def tried_in_turn(tasks: Sequence[Task], index: int, late: str) -> set[Remedy]:
    task = tasks[index]
    least = max((s.time_us for s in task.sections if s.time_us < task.time_us), default=1)
    tries: dict[str, Iterable[int]] = {
        PERIOD: range(task.period_us + 1, MOST),
        TIME: range(task.time_us - 1, least - 1, -1),
    }
    if task.name == late:
        most = task.period_us + 1 if task.due_us <= task.period_us else MOST
        tries[DEADLINE] = range(task.due_us + 1, most)
    found = {what: first_that_fits(tasks, index, what, values, late) for what, values in tries.items()}
    return {Remedy(task.name, what, value) for what, value in found.items() if value is not None}


def test_each_number_is_the_first_that_fits() -> None:
    random, kinds = Random(7), set()
    for _ in range(60):
        tasks = random_tasks(random, most=4)
        for late in sorted({task.name for task in tasks} - meeting(tasks))[:1]:
            found = {remedy for remedy in remedies(tasks, late) if remedy.value_us < MOST}
            own = next(i for i, task in enumerate(tasks) if task.name == late)
            expected = tried_in_turn(tasks, own, late)
            if not expected and not any(r.task == late for r in remedies(tasks, late)):
                expected = {r for i in range(len(tasks)) if i != own for r in tried_in_turn(tasks, i, late)}
            for i in (i for i in range(len(tasks)) if i != own):
                longest = max((section.time_us for section in tasks[i].sections), default=0)
                most = first_that_fits(tasks, i, LOCK, range(longest - 1, 0, -1), late)
                expected |= {Remedy(tasks[i].name, LOCK, most)} if most is not None else set()
            assert found == expected, tasks
            kinds |= {remedy.what for remedy in found}
    assert kinds == {PERIOD, DEADLINE, TIME, LOCK}


def test_a_task_that_is_late_by_itself_needs_another_deadline_or_less_time() -> None:
    tasks = [Task("fast", 10, 4), Task("slow", 40, 9, deadline_us=15)]
    assert remedies(tasks, "slow") == (Remedy("slow", DEADLINE, 17), Remedy("slow", TIME, 7))


def test_a_period_that_is_the_deadline_is_lengthened() -> None:
    tasks = [Task("fast", 10, 4), Task("slow", 15, 9)]
    assert remedies(tasks, "slow") == (Remedy("slow", PERIOD, 17), Remedy("slow", TIME, 7))


def test_where_nothing_of_the_task_helps_the_others_are_changed() -> None:
    """The task above takes all the time, whatever the one below needs."""
    tasks = [Task("greedy", 10, 10, criticality=HIGH), Task("small", 100, 1)]
    assert remedies(tasks, "small") == (Remedy("greedy", PERIOD, 11), Remedy("greedy", TIME, 9))


def test_a_lock_is_not_held_for_longer_than_the_time_that_is_proposed() -> None:
    tasks = [Task("a", 10, 10, criticality=HIGH, sections=(Section("session", 6),)), Task("b", 10, 4)]
    assert remedies(tasks, "b") == (Remedy("a", TIME, 6),)
    longer = replace(tasks[0], sections=(Section("session", 7),))
    assert remedies([longer, tasks[1]], "b") == ()


def test_a_lock_that_is_held_all_the_time_is_held_for_less_with_less_time() -> None:
    tasks = [
        Task("first", 100, 2),
        Task("second", 500, 20, deadline_us=15, sections=(Section("session", 20),)),
    ]
    assert Remedy("second", TIME, 15) in remedies(tasks, "second")


def test_a_task_that_blocks_may_hold_the_lock_for_less() -> None:
    first = Task("first", 100, 2, criticality=HIGH, deadline_us=12, sections=(Section("session", 1),))
    second = Task("second", 500, 20, sections=(Section("session", 20),))
    assert remedies([second, first], "first") == (Remedy("first", DEADLINE, 22), Remedy("second", LOCK, 10))


def test_nothing_helps_where_two_tasks_are_late_for_a_third() -> None:
    first, second = (Task(name, 10, 10, criticality=HIGH, deadline_us=25) for name in ("first", "second"))
    assert remedies([first, second, Task("third", 10, 1)], "third") == ()
