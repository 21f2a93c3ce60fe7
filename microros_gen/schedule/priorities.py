# SPDX-License-Identifier: Apache-2.0
"""Priorities of tasks: bands by criticality, and within a band the shorter deadline first."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.records import dataclass
from microros_gen.schedule.task import BANDS, Task


@dataclass(frozen=True)
class PriorityFault:
    """A priority that `task` cannot have: above the number of tasks (`other` None), or that of `other`."""

    task: Task
    other: Task | None = None


def priority_faults(tasks: Sequence[Task]) -> tuple[PriorityFault, ...]:
    """Return each priority of the application that cannot be: 1 to the number of tasks, and no two the same."""
    faults: list[PriorityFault] = []
    taken: dict[int, Task] = {}
    for task in tasks:
        if task.priority is None:
            continue
        if not 1 <= task.priority <= len(tasks):
            faults.append(PriorityFault(task))
        elif (other := taken.setdefault(task.priority, task)) is not task:
            faults.append(PriorityFault(task, other))
    return tuple(faults)


def by_priority(tasks: Sequence[Task]) -> tuple[Task, ...]:
    """Return the tasks in the order of their priorities: the first has priority 1, the highest.

    A task whose priority is given has it. The others take the priorities that are left, the bands in the order of
    BANDS, within a band the shortest deadline first, and of equal deadlines as the tasks are given. The session's task
    directly precedes the first of them that is sporadic, since it is what releases that; without one it is the last.
    ValueError where a priority is not possible (priority_faults).
    """
    if priority_faults(tasks):
        raise ValueError("impossible priorities")
    fixed = {task.priority: task for task in tasks if task.priority is not None}
    free = [task for task in tasks if task.priority is None]
    order = sorted((task for task in free if not task.session), key=_rank)
    for session in (task for task in free if task.session):
        released = (index for index, task in enumerate(order) if task.sporadic)
        order.insert(next(released, len(order)), session)
    left = iter(order)
    return tuple(fixed.get(priority) or next(left) for priority in range(1, len(tasks) + 1))


def _rank(task: Task) -> tuple[int, int]:
    return BANDS.index(task.criticality), task.due_us
