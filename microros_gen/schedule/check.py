# SPDX-License-Identifier: Apache-2.0
"""Deadlines that are missed, as diagnostics with the number that would do."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.schedule.remedies import DEADLINE, LOCK, PERIOD, TIME, Remedy, remedies
from microros_gen.schedule.report import blocked_by
from microros_gen.schedule.response import Response, analyze, utilization
from microros_gen.schedule.task import INSTRUCTIONS, Task

INTERVAL = "interval"
"""What the period of a task is called that no clock releases."""


def check_deadlines(
    tasks: Sequence[Task], places: Mapping[str, Span], diagnostics: Diagnostics
) -> tuple[Response, ...]:
    """Return the analysis of the tasks; each that misses its deadline is an error at its place.

    Numbers of other tasks are proposed for the first one alone: they may help those of lower priority, too.

    `places` has where a task is declared, by its name. The priorities must be possible (priorities.py).
    """
    responses = analyze(tasks)
    first = next((response.task.name for response in responses if not response.meets), "")
    for index, response in enumerate(responses):
        if response.meets:
            continue
        name, span = response.task.name, places.get(response.task.name)
        found = remedies(tasks, name, of_others=name == first)
        hint = f"Correct '{first}' first" if name != first and not found else _hint(found, tasks, name)
        if response.overloaded:
            load = utilization([r.task for r in responses[: index + 1]]) * 1000
            tenths = -(-load.numerator // load.denominator)
            above = f" and the {index} above it take" if index else " takes"
            message = f"the task '{name}'{above} {tenths // 10}.{tenths % 10} % of the processor's time"
            diagnostics.error(message, span, hint, id="MG-7140")
        elif response.response_us is None:
            message = (
                f"no bound was found for the response of the task '{name}': the processor is hardly ever free"
            )
            diagnostics.error(message, span, hint, id="MG-7141")
        else:
            message = (
                f"the task '{name}' may end {response.response_us} us after its release is due, and its deadline is"
                f" {response.task.due_us} us ({_parts(response)})"
            )
            diagnostics.error(message, span, hint, id="MG-7142")
    return responses


def _parts(response: Response) -> str:
    """Return what the response consists of; that of a later release of a busy period also has what is before it."""
    task = response.task
    earlier = _earlier(response)
    parts = [f"time {earlier + 1} x {task.time_us}" if earlier else f"time {task.time_us}"]
    parts += [f"jitter {task.jitter_us}"] if task.jitter_us else []
    parts += [f"blocking {response.blocking_us}: {blocked_by(response)}"] if response.blocking_us else []
    parts += [f"{i.task} {i.times} x {i.time_us // i.times}" for i in response.interference]
    if earlier:
        releases = "release delays" if earlier == 1 else "releases delay"
        parts.append(f"less {earlier} x {task.period_us}, as {earlier} earlier {releases} it")
    return "; ".join(parts)


def _earlier(response: Response) -> int:
    """Return how many releases of the task precede the one of the longest response in its busy period."""
    task, response_us = response.task, response.response_us or 0
    whole = (
        task.time_us + task.jitter_us + response.blocking_us + sum(i.time_us for i in response.interference)
    )
    gained = task.period_us - task.time_us
    return (whole - response_us) // gained if gained > 0 else 0


def _hint(found: Sequence[Remedy], tasks: Sequence[Task], name: str) -> str:
    if not found:
        return "No number of one task is enough: give several tasks less time or longer periods"
    texts = []
    named = {task.name: task for task in tasks}
    for remedy in found:
        of = "" if remedy.task == name else f" of '{remedy.task}'"
        direction = "more" if remedy.what in (PERIOD, DEADLINE) else "less"
        texts.append(f"`{_written(remedy, named[remedy.task])}`{of} or {direction}")
    return f"Write {', or '.join(texts)}"


def _written(remedy: Remedy, task: Task) -> str:
    """Return a number as the application file has it: a time is one of instructions where the task has those."""
    if remedy.what == TIME and task.instructions_per_us is not None:
        return f"{INSTRUCTIONS}: {math.floor(remedy.value_us * task.instructions_per_us)}"
    rate = next((s.instructions_per_us for s in task.sections if s.instructions_per_us is not None), None)
    if remedy.what == LOCK and rate is not None:
        return f"lock_instructions: {math.floor(remedy.value_us * rate)}"
    what = INTERVAL if remedy.what == PERIOD and (task.sporadic or task.session) else remedy.what
    return f"{what}: {remedy.value_us} us"
