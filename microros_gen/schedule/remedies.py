# SPDX-License-Identifier: Apache-2.0
"""For a task that misses its deadline: the numbers that would do, each alone, found with the analysis itself."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

from microros_gen.records import dataclass
from microros_gen.schedule.priorities import by_priority
from microros_gen.schedule.response import meeting
from microros_gen.schedule.task import LONGEST_US, Task

PERIOD, DEADLINE, TIME, LOCK = "period", "deadline", "time", "lock"
"""What a remedy changes."""


@dataclass(frozen=True)
class Remedy:
    """With `value_us` as `what` of `task` the deadline is met.

    This is the smallest period or deadline, the largest time, or the longest time for which it holds a lock.
    """

    task: str
    what: str
    value_us: int


def remedies(tasks: Sequence[Task], late: str, of_others: bool = True) -> tuple[Remedy, ...]:
    """Return what makes the task `late` meet its deadline, and none miss it that meets it now.

    These are changes of the task itself; where none of them is enough, those of the other tasks, unless `of_others` is
    false: they are most of the search; and locks that tasks of lower priority hold for less time. Each number is exact:
    the next smaller period or deadline, or the next larger time, is not enough. A deadline above the period is proposed
    only where the task has one. A lock that is held as long as the task runs stays so with less time. Priorities follow
    from the numbers again. Empty: no number alone is enough.
    """
    own = tuple(_changes(tasks, late, late))
    others = (
        remedy
        for task in tasks
        if of_others and task.name != late
        for remedy in _changes(tasks, task.name, late)
    )
    return (*(own or others), *_locks(tasks, late))


def _locks(tasks: Sequence[Task], late: str) -> Iterator[Remedy]:
    kept = meeting(tasks) | {late}
    order = by_priority(tasks)
    index = next(i for i, task in enumerate(order) if task.name == late)
    for task in order[index + 1 :]:
        longest = max((section.time_us for section in task.sections), default=0)
        most = _largest(partial(_fits_holding, tasks, task, kept), 1, longest - 1)
        if most is not None:
            yield Remedy(task.name, LOCK, most)


def _fits_holding(tasks: Sequence[Task], changed: Task, kept: frozenset[str], most_us: int) -> bool:
    return kept <= meeting([_holding(task, most_us) if task is changed else task for task in tasks])


def _changes(tasks: Sequence[Task], changed: str, late: str) -> Iterator[Remedy]:
    index = next(i for i, task in enumerate(tasks) if task.name == changed)
    task, kept = tasks[index], meeting(tasks) | {late}

    def fits(other: Task) -> bool:
        return kept <= meeting([*tasks[:index], other, *tasks[index + 1 :]])

    marks = sorted({other.due_us for other in tasks if other is not task})
    period = _least(
        lambda value: fits(replace(task, period_us=value)),
        _spans(task.period_us + 1, LONGEST_US, marks if task.deadline_us is None else ()),
    )
    if period is not None:
        yield Remedy(changed, PERIOD, period)
    most = task.period_us if task.due_us <= task.period_us else LONGEST_US
    if changed == late and task.due_us < most:
        deadline = _least(
            lambda value: fits(replace(task, deadline_us=value)), _spans(task.due_us + 1, most, marks)
        )
        if deadline is not None:
            yield Remedy(changed, DEADLINE, deadline)
    longest = max((s.time_us for s in task.sections if s.time_us < task.time_us), default=1)
    time = _largest(lambda value: fits(_shorter(task, value)), longest, task.time_us - 1)
    if time is not None:
        yield Remedy(changed, TIME, time)


def _shorter(task: Task, time_us: int) -> Task:
    return replace(_holding(task, time_us), time_us=time_us)


def _holding(task: Task, most_us: int) -> Task:
    """Return a task that holds each lock for at most `most_us`."""
    sections = (replace(section, time_us=min(section.time_us, most_us)) for section in task.sections)
    return replace(task, sections=tuple(sections))


def _spans(first: int, last: int, marks: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Yield the parts of `first` to `last` within which the order of deadlines stays: apart at each of `marks`."""
    begin = first
    for mark in marks:
        for end in (mark - 1, mark):
            if begin <= end < last:
                yield begin, end
                begin = end + 1
    yield begin, last


def _least(fits: Callable[[int], bool], spans: Iterator[tuple[int, int]]) -> int | None:
    """Return the least number that fits; within a span each number above one that fits does, too."""
    for low, high in spans:
        if low > high or not fits(high):
            continue
        while low < high:
            middle = (low + high) // 2
            low, high = (low, middle) if fits(middle) else (middle + 1, high)
        return low
    return None


def _largest(fits: Callable[[int], bool], low: int, high: int) -> int | None:
    """Return the largest number that fits, where each below one that fits does, too."""
    if low > high or not fits(low):
        return None
    while low < high:
        middle = (low + high + 1) // 2
        low, high = (middle, high) if fits(middle) else (low, middle - 1)
    return low
