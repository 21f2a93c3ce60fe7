# SPDX-License-Identifier: Apache-2.0
"""`tasks:` of the application file → what each task runs, when, and with which settings."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.application.model import NodeDecl
from microros_gen.application.nodes import check_unique
from microros_gen.application.task_decl import AUTO, TaskDecl
from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.named import Named
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    entries,
    int_of,
    items,
    named_of,
    rate_of,
    size_of,
    span_of,
    text_of,
    time_of,
)
from microros_gen.documents.yaml_tree import YamlNode

LONGEST_US = 1_000_000_000
"""Longest time of a task: half of the range of a count of microseconds with 32 bits must be longer."""
LONGEST_NAME = 15
"""Characters of the name of a task."""
MOST_TASKS = 30
"""Tasks of an application besides that of the session."""

_TIMES = ("period", "interval", "deadline", "time", "lock")
_OF_EXECUTORS = ("rate", "period", "overrun")


def parse_tasks(
    tree: YamlNode | None, nodes: Sequence[NodeDecl], diagnostics: Diagnostics
) -> tuple[TaskDecl, ...]:
    """Return what is below `tasks:`; none without the key. Faults are errors at their places."""
    tasks = tuple(_task(item, nodes, diagnostics) for item in items(tree))
    runs = [
        child(item, "executor") is not None or bool_of(child(item, "session")) is True for item in items(tree)
    ]
    check_unique(
        "task", [(task.name.lower(), task.span) for task in tasks], diagnostics, longest=LONGEST_NAME
    )
    _check_runners(
        [t for t, runs_something in zip(tasks, runs, strict=True) if runs_something], nodes, diagnostics
    )
    _check_priorities(tasks, diagnostics)
    return tasks


def _task(item: YamlNode, nodes: Sequence[NodeDecl], diagnostics: Diagnostics) -> TaskDecl:
    name = text_of(child(item, "name")) or ""
    executor = named_of(child(item, "executor"))
    is_session = bool_of(child(item, "session")) is True
    if is_session == (executor is not None):
        message = f"the task '{name}' has {'a session and an executor' if is_session else 'nothing to run'}"
        hint = "Write either `executor: NAME` or `session: true`"
        diagnostics.error(message, item.span, hint, id="MG-3220")
    for entry in entries(item) if is_session else ():
        if entry.key in _OF_EXECUTORS:
            message = f"'{entry.key}' has no effect for the task of the session, which the line releases"
            diagnostics.error(message, entry.key_span, "Remove it", id="MG-3221")
    node, found = _executor(executor, nodes, diagnostics)
    times = {key: _time(child(item, key), key, name, diagnostics) for key in _TIMES}
    period = times["period"] or _rate(child(item, "rate"), name, diagnostics)
    task = TaskDecl(
        name=name,
        executor=found,
        node=node,
        period_us=period,
        interval_us=times["interval"],
        deadline_us=times["deadline"],
        criticality=text_of(child(item, "criticality")) or "",
        time_us=times["time"],
        instructions=int_of(child(item, "instructions")) or 0,
        lock_us=times["lock"],
        lock_instructions=int_of(child(item, "lock_instructions")) or 0,
        lock_auto=text_of(child(item, "lock")) == AUTO,
        overrun=text_of(child(item, "overrun")) or TaskDecl.overrun,
        stack=size_of(child(item, "stack")),
        stack_auto=text_of(child(item, "stack")) == AUTO,
        priority=int_of(child(item, "priority")) or 0,
        span=item.span,
        stack_span=span_of(child(item, "stack")),
        lock_span=span_of(child(item, "lock")),
        priority_span=span_of(child(item, "priority")),
    )
    _check_times(item, task, diagnostics)
    return task


def _executor(
    executor: Named | None, nodes: Sequence[NodeDecl], diagnostics: Diagnostics
) -> tuple[int, Named | None]:
    """Return the position of the executor's node, and the executor's own name; 0 and the name where it is unknown."""
    if executor is None:
        return 0, None
    every = [(index, node, e.name) for index, node in enumerate(nodes) for e in node.executors]
    found = [
        (index, node, name)
        for index, node, name in every
        if executor.name in (name, f"{node.name}/{name}", f"{node.full_name}/{name}")
    ]
    if len(found) == 1:
        return found[0][0], Named(found[0][2], executor.span)
    if found:
        hint = f"Write one of {', '.join(f'{node.full_name}/{name}' for _, node, name in found)}"
        message = f"several nodes have an executor '{executor.name}'"
        diagnostics.error(message, executor.span, hint, id="MG-3222")
    else:
        names = [name for _, _, name in every]
        hint = nearest(executor.name, names) or "Add to a node: `executors: [{name: NAME}]`"
        message = f"no node has an executor '{executor.name}'"
        diagnostics.error(message, executor.span, hint, id="MG-3223")
    return 0, executor


def _time(node: YamlNode | None, key: str, task: str, diagnostics: Diagnostics) -> int:
    """Return microseconds; 0: the key is not there, or is wrong."""
    time = time_of(node)
    if time is not None and not 1 <= time <= LONGEST_US:
        message = (
            f"'{key}' of the task '{task}' is {text_of(node)}; it must be 1 us to {LONGEST_US // 1_000_000} s"
        )
        diagnostics.error(message, span_of(node), f"Write {key}: 10 ms", id="MG-3224")
        return 0
    return time or 0


def _rate(node: YamlNode | None, task: str, diagnostics: Diagnostics) -> int:
    """Return the period in microseconds; 0: the key is not there, or the period is no whole number of them."""
    period = rate_of(node)
    if period is None:
        return 0
    if period != int(period) or not 1 <= period <= LONGEST_US:
        message = (
            f"'rate' of the task '{task}' is {text_of(node)}: the period is no whole number of microseconds "
            f"from 1 us to {LONGEST_US // 1_000_000} s"
        )
        hint = f"Write `period: {min(max(round(period), 1), LONGEST_US)} us` instead"
        diagnostics.error(message, span_of(node), hint, id="MG-3225")
        return 0
    return int(period)


def _check_overrun(item: YamlNode, task: TaskDecl, diagnostics: Diagnostics) -> None:
    """Refuse what a task without a period cannot do: it misses no release, but it may have a deadline."""
    why, hint = "nothing is missed without a period", "Remove it"
    if task.overrun == "call":
        why, hint = "it has no deadline", "Add `deadline: 10 ms`, or remove it"
    if task.overrun != "call" or not (task.deadline_us or task.interval_us):
        message = f"'overrun' of the task '{task.name}' has no effect: {why}"
        diagnostics.error(message, span_of(child(item, "overrun")), hint, id="MG-3227")


def _check_times(item: YamlNode, task: TaskDecl, diagnostics: Diagnostics) -> None:
    released = [key for key in ("rate", "period", "interval") if child(item, key) is not None]
    if len(released) > 1:
        message = f"the task '{task.name}' has {' and '.join(released)}"
        hint = "Keep one: `period` releases it by the clock, `interval` limits how often its handles do"
        diagnostics.error(message, span_of(child(item, released[1])), hint, id="MG-3226")
    limit = task.period_us or task.interval_us
    if not task.period_us and task.overrun != TaskDecl.overrun:
        _check_overrun(item, task, diagnostics)
    if limit and task.deadline_us > limit:
        message = f"the deadline of the task '{task.name}' is later than its next release"
        hint = f"Write deadline: {limit} us or less"
        diagnostics.error(message, span_of(child(item, "deadline")), hint, id="MG-3228")
    deadline = task.deadline_us or limit
    if deadline and task.time_us > deadline:
        message = f"the task '{task.name}' runs {task.time_us} us, longer than its deadline of {deadline} us"
        hint = f"Write time: {deadline} us or less, or a later deadline"
        diagnostics.error(message, span_of(child(item, "time")), hint, id="MG-3229")
    if task.time_us and task.instructions:
        message = f"the task '{task.name}' has time and instructions"
        hint = "Keep one: the time of a run follows from its instructions"
        diagnostics.error(message, span_of(child(item, "instructions")), hint, id="MG-3290")
    if task.priority and task.criticality:
        message = (
            f"'criticality' of the task '{task.name}' has no effect beside 'priority', which fixes its place"
        )
        diagnostics.error(message, span_of(child(item, "criticality")), "Remove `criticality`", id="MG-9853")
    _check_lock(item, task, diagnostics)


def _check_lock(item: YamlNode, task: TaskDecl, diagnostics: Diagnostics) -> None:
    for key, number in (
        ("lock", task.lock_us or task.lock_auto),
        ("lock_instructions", task.lock_instructions),
    ):
        if number and not (task.time_us or task.instructions):
            message = (
                f"'{key}' of the task '{task.name}' has no effect without 'time', its longest execution time"
            )
            diagnostics.error(message, span_of(child(item, key)), "Add `time`, or remove it", id="MG-3235")
    if (task.lock_us or task.lock_auto) and task.lock_instructions:
        message = f"the task '{task.name}' has lock and lock_instructions"
        hint = "Keep one: the time follows from the instructions"
        diagnostics.error(message, span_of(child(item, "lock_instructions")), hint, id="MG-3293")
    if task.time_us and task.lock_us > task.time_us:
        message = f"the task '{task.name}' holds the lock for {task.lock_us} us, longer than it runs"
        hint = f"Write lock: {task.time_us} us or less"
        diagnostics.error(message, span_of(child(item, "lock")), hint, id="MG-3236")


def _check_runners(tasks: Sequence[TaskDecl], nodes: Sequence[NodeDecl], diagnostics: Diagnostics) -> None:
    seen: dict[tuple[int, str], str] = {}
    for task in tasks:
        key = (-1, "") if task.executor is None else (task.node, task.executor.name)
        if key in seen:
            what = "the session" if task.executor is None else f"the executor '{task.executor.name}'"
            message = f"two tasks run {what}: '{seen[key]}' and '{task.name}'"
            diagnostics.error(message, task.span, "Remove one of them", id="MG-3230")
        seen.setdefault(key, task.name)
    if tasks and all(task.is_session for task in tasks):
        hint = "Add one: `{name: control, executor: fast}`"
        diagnostics.error("no task runs an executor", tasks[0].span, hint, id="MG-3231")
    if len(tasks) > MOST_TASKS:
        message = f"the application has {len(tasks)} tasks; it may have {MOST_TASKS}"
        diagnostics.error(message, tasks[MOST_TASKS].span, "Run several callbacks in one", id="MG-3232")


def _check_priorities(tasks: Sequence[TaskDecl], diagnostics: Diagnostics) -> None:
    lowest = len(tasks) + (0 if any(task.is_session for task in tasks) else 1)
    seen: dict[int, str] = {}
    for task in tasks:
        if task.priority > lowest:
            place = f"{task.priority}, and {lowest} tasks have 1 to {lowest}"
            message = f"the priority of the task '{task.name}' is {place}"
            hint = f"Write priority: {lowest} or less; that of the session counts, too"
            diagnostics.error(message, task.priority_span, hint, id="MG-3233")
        elif task.priority and task.priority in seen:
            message = f"the tasks '{seen[task.priority]}' and '{task.name}' have the priority {task.priority}"
            diagnostics.error(message, task.priority_span, "Give each a different one", id="MG-3234")
        seen.setdefault(task.priority, task.name)
