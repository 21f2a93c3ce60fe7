# SPDX-License-Identifier: Apache-2.0
"""Whether each task meets its deadline, where the application file has the times that this takes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import floor

from microros_gen.application.task_decl import TaskDecl
from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.target import Target
from microros_gen.schedule.check import check_deadlines
from microros_gen.schedule.response import Response
from microros_gen.schedule.task import (
    CALL_GRAPH,
    INSTRUCTIONS,
    LONGEST_US,
    MIDDLE,
    TIME,
    Section,
    Task,
    time_of_instructions,
)

LOCK = "library"
"""Name of the lock of the library, which every task takes: publishers, executors and the session need it."""


def is_placed_by_rule(task: TaskDecl) -> bool:
    """Return whether the priority of a task is that of the session's task of which nothing is said."""
    return task.is_session and not (task.criticality or task.deadline_us)


def timed(tasks: Sequence[TaskDecl], target: Target, diagnostics: Diagnostics) -> tuple[TaskDecl, ...]:
    """Return the tasks with the times of those that have a number of instructions instead, unless that is an error.

    A target that does not say how long an instruction takes, a run that is longer than its deadline, and a lock that is
    held for longer than that, are errors.
    """
    return tuple(
        _timed(task, target, diagnostics) if task.instructions or task.lock_instructions else task
        for task in tasks
    )


def _timed(task: TaskDecl, target: Target, diagnostics: Diagnostics) -> TaskDecl:
    rate = target.instructions_per_us
    if rate is None:
        message = (
            f"the target {target.name} does not say how long an instruction of the task '{task.name}' takes"
        )
        hint = "Write `time: 1 ms` and the like instead, or `cycles_per_instruction: …` into the target file"
        diagnostics.error(message, task.span, hint, id="MG-7143")
        return task
    time_us = time_of_instructions(task.instructions, rate) if task.instructions else task.time_us
    lock_us = time_of_instructions(task.lock_instructions, rate) if task.lock_instructions else task.lock_us
    if task.instructions and time_us > _deadline_us(task):
        of = f"{task.instructions} instructions of the task '{task.name}'"
        message = (
            f"{of} take {time_us} us on {target.name}, longer than its deadline of {_deadline_us(task)} us"
        )
        hint = f"Write instructions: {floor(_deadline_us(task) * rate)} or less, or a later deadline"
        diagnostics.error(message, task.span, hint, id="MG-7144")
        return task
    if lock_us > time_us and task.lock_auto:
        lock_us = 0  # the run is what bounds it: that has a smaller bound than the call graph
    if lock_us > time_us:
        message = f"the task '{task.name}' holds the lock for {lock_us} us, longer than it runs"
        most = (
            f"lock_instructions: {floor(time_us * rate)}" if task.lock_instructions else f"lock: {time_us} us"
        )
        diagnostics.error(message, task.span, f"Write {most} or less", id="MG-7145")
        return task
    return replace(task, time_us=time_us, lock_us=lock_us)


def _deadline_us(task: TaskDecl) -> int:
    return task.deadline_us or task.period_us or task.interval_us or LONGEST_US


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


def analyze_tasks(
    tasks: Sequence[TaskDecl], diagnostics: Diagnostics, instructions_per_us: Fraction | None = None
) -> tuple[Response, ...]:
    """Return the response of each task by priority; a deadline that is missed is an error at its task.

    `instructions_per_us` is the rate of the target, which tasks with instructions need.

    No task has a gap. Priorities are those of plan.priorities_of: both follow the same rules.
    """
    places = {task.name: task.span for task in tasks if task.span is not None}
    return check_deadlines([task_of(task, instructions_per_us) for task in tasks], places, diagnostics)


def task_of(task: TaskDecl, instructions_per_us: Fraction | None = None) -> Task:
    """Return a task without gaps as the analysis takes it."""
    return Task(
        task.name,
        task.period_us or task.interval_us,
        task.time_us,
        task.criticality or MIDDLE,
        deadline_us=task.deadline_us or None,
        sections=(_section(task, instructions_per_us),),
        priority=task.priority or None,
        sporadic=not task.period_us,
        session=is_placed_by_rule(task),
        instructions_per_us=instructions_per_us if task.instructions else None,
    )


def _section(task: TaskDecl, instructions_per_us: Fraction | None) -> Section:
    """Return what a task holds the lock for; without a separate number that is all of its time."""
    if not task.lock_us:
        return Section(LOCK, task.time_us, source=TIME)
    if task.lock_instructions:
        return Section(
            LOCK, task.lock_us, instructions_per_us, CALL_GRAPH if task.lock_auto else INSTRUCTIONS
        )
    return Section(LOCK, task.lock_us)
