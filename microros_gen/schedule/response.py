# SPDX-License-Identifier: Apache-2.0
"""Response times of tasks that are preempted by fixed priority on one processor; whole numbers only.

The longest response is in the busy period that begins when the task and all of higher priority are released at once,
each as late as its jitter allows, just after a task of lower priority took a lock (Joseph and Pandya 1986; Lehoczky
1990; Audsley et al. 1993). The release q = 0, 1, … of that busy period is complete at the least w with

    w = B + (q + 1) C + sum over the tasks j of higher priority of ceil((w + J_j) / T_j) C_j

and its response is J + w - q T. Every release of the busy period is looked at, so this holds for deadlines beyond the
period, too; it is exact for independent releases, and an upper bound for B (`blockers`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

from microros_gen.records import dataclass
from microros_gen.schedule.priorities import by_priority
from microros_gen.schedule.task import DECLARED, Task

MOST_STEPS = 20_000
"""Steps of the iteration after which the analysis of a task ends; a load that is a hair below 1 takes more."""


@dataclass(frozen=True)
class Blocker:
    """`task`, of lower priority, holds `lock` for `time_us`, which follows from `source` (Section)."""

    task: str
    lock: str
    time_us: int
    source: str = DECLARED


@dataclass(frozen=True)
class Interference:
    """A task of higher priority runs `times` in the response, for `time_us` together."""

    task: str
    times: int
    time_us: int


@dataclass(frozen=True)
class Response:
    """The result for `task`, whose `priority` counts from 1, the highest.

    `blocking_us` is B, with `blockers` and Task.blocking_us. `response_us` is R: the longest time from the instant at
    which a release is due until it is complete; None: no bound was found, `overloaded` where none exists, because
    this task and those above it take more time than there is. `interference` is what delays the release with the
    longest response, from the start of its busy period.
    """

    task: Task
    priority: int
    blocking_us: int
    blockers: tuple[Blocker, ...] = ()
    response_us: int | None = None
    overloaded: bool = False
    interference: tuple[Interference, ...] = ()

    @property
    def slack_us(self) -> int | None:
        """The deadline less the response; negative where it is missed, None without a response."""
        return None if self.response_us is None else self.task.due_us - self.response_us

    @property
    def meets(self) -> bool:
        """Whether the deadline is met."""
        return self.slack_us is not None and self.slack_us >= 0


def analyze(tasks: Sequence[Task]) -> tuple[Response, ...]:
    """Return the response of each task in the order of priorities. ValueError as of by_priority."""
    order = by_priority(tasks)
    return tuple(_response(order, index) for index in range(len(order)))


def meeting(tasks: Sequence[Task]) -> frozenset[str]:
    """Return the names of the tasks that meet their deadlines: as analyze, but up to the first late release alone."""
    order = by_priority(tasks)
    return frozenset(task.name for index, task in enumerate(order) if _meets(order, index))


def utilization(tasks: Sequence[Task]) -> Fraction:
    """Return the share of the processor's time that the tasks take together, exactly."""
    return sum((Fraction(task.time_us, task.period_us) for task in tasks), Fraction(0))


def blockers(order: Sequence[Task], index: int) -> tuple[Blocker, ...]:
    """Return what blocks the task at `index` of `order` at most once in a busy period.

    These are sections of tasks of lower priority, of locks that this task or one of higher priority takes, too. With
    inheritance each lock blocks once, and each task once; the smaller of both sums counts. Where all tasks share one
    lock, as that of the session, this is its longest section.
    """
    taken = {section.lock for task in order[: index + 1] for section in task.sections}
    found = [
        Blocker(task.name, s.lock, s.time_us, s.source)
        for task in order[index + 1 :]
        for s in task.sections
        if s.lock in taken
    ]
    found.sort(key=lambda blocker: -blocker.time_us)
    locks = {blocker.lock: blocker for blocker in reversed(found)}
    tasks = {blocker.task: blocker for blocker in reversed(found)}
    fewer = min((locks, tasks), key=lambda longest: sum(b.time_us for b in longest.values()))
    return tuple(sorted(fewer.values(), key=lambda blocker: (-blocker.time_us, blocker.task)))


def _response(order: Sequence[Task], index: int) -> Response:
    task, above = order[index], order[:index]
    held = blockers(order, index)
    found = Response(task, index + 1, task.blocking_us + sum(b.time_us for b in held), held)
    if utilization(order[: index + 1]) > 1:
        return _with(found, None, (), overloaded=True)
    longest, end = 0, 0
    for number, complete in enumerate(_completions(task, above, found.blocking_us)):
        if complete is None:
            return _with(found, None, ())
        response = task.jitter_us + complete - number * task.period_us
        if response > longest:
            longest, end = response, complete
    times = [(t, _releases(t, end)) for t in above]
    return _with(found, longest, tuple(Interference(t.name, n, n * t.time_us) for t, n in times))


def _with(
    found: Response,
    response_us: int | None,
    interference: tuple[Interference, ...],
    overloaded: bool = False,
) -> Response:
    return Response(
        found.task,
        found.priority,
        found.blocking_us,
        found.blockers,
        response_us,
        overloaded,
        interference,
    )


def _meets(order: Sequence[Task], index: int) -> bool:
    task, above = order[index], order[:index]
    if utilization(order[: index + 1]) > 1:
        return False
    blocking = task.blocking_us + sum(b.time_us for b in blockers(order, index))
    for number, complete in enumerate(_completions(task, above, blocking)):
        if complete is None or task.jitter_us + complete - number * task.period_us > task.due_us:
            return False
    return True


def _completions(task: Task, above: Sequence[Task], blocking: int) -> Iterator[int | None]:
    """Yield when each release of the busy period is complete, from its begin; None: there are too many steps.

    A busy period that never ends, at a load of exactly 1, repeats after the least common multiple of the periods.
    """
    repeats = utilization((*above, task)) == 1
    last = math.lcm(*(t.period_us for t in (*above, task))) // task.period_us if repeats else None
    complete, number, steps = blocking, 0, 0
    while number != last:
        begin = blocking + (number + 1) * task.time_us
        complete += task.time_us
        while True:
            steps += 1
            if steps > MOST_STEPS:
                yield None
                return
            needed = begin + sum(_releases(t, complete) * t.time_us for t in above)
            if needed == complete:
                break
            complete = needed
        yield complete
        number += 1
        if complete + task.jitter_us <= number * task.period_us:
            return


def _releases(task: Task, time_us: int) -> int:
    """Return how often a task is released before `time_us` of a busy period that begins with a release of it."""
    return -(-(time_us + task.jitter_us) // task.period_us)
