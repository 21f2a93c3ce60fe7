# SPDX-License-Identifier: Apache-2.0
"""Whether each task meets its deadline, where the application file has the times that this takes."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.application.task_decl import TaskDecl
from microros_gen.diagnostics import Diagnostics
from microros_gen.schedule.check import check_deadlines
from microros_gen.schedule.response import Response
from microros_gen.schedule.task import MIDDLE, Section, Task

LOCK = "library"
"""Name of the lock of the library, which every task takes: publishers, executors and the session need it."""


def is_placed_by_rule(task: TaskDecl) -> bool:
    """Return whether the priority of a task is that of the session's task of which nothing is said."""
    return task.is_session and not (task.criticality or task.deadline_us)


def gaps(tasks: Sequence[TaskDecl]) -> tuple[str, ...]:
    """Return for each task what the analysis needs and nobody said; it needs all of it, since each task delays others.

    A task without `lock` holds the lock as long as it runs, which is the worst.
    """
    found = []
    for task in tasks:
        missing = [] if task.time_us else ["time"]
        missing += [] if task.period_us or task.interval_us else ["interval"]
        if missing:
            found.append(f"{task.name} has no {' and no '.join(missing)}")
    return tuple(found)


def analyze_tasks(tasks: Sequence[TaskDecl], diagnostics: Diagnostics) -> tuple[Response, ...]:
    """Return the response of each task by priority; a deadline that is missed is an error at its task.

    No task has a gap. Priorities are those of plan.priorities_of: both follow the same rules.
    """
    places = {task.name: task.span for task in tasks if task.span is not None}
    return check_deadlines([task_of(task) for task in tasks], places, diagnostics)


def task_of(task: TaskDecl) -> Task:
    """Return a task without gaps as the analysis takes it."""
    return Task(
        task.name,
        task.period_us or task.interval_us,
        task.time_us,
        task.criticality or MIDDLE,
        deadline_us=task.deadline_us or None,
        sections=(Section(LOCK, task.lock_us or task.time_us),),
        priority=task.priority or None,
        sporadic=not task.period_us,
        session=is_placed_by_rule(task),
    )
