# SPDX-License-Identifier: Apache-2.0
"""For each key below `tasks:` a value that is taken, what it becomes, and one that is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from microros_gen.application.model import Application
from microros_gen.application.task_decl import TaskDecl
from tests.support.application.key_case import KeyCase

_NODES = "nodes: [{name: n, executors: [{name: fast}]}]\n"


def _task(read: Callable[[TaskDecl], Any]) -> Callable[[Application], Any]:
    return lambda application: read(application.tasks[0])


def _in_task(text: str) -> str:
    return f"{_NODES}tasks:\n  - {{name: t, executor: fast, {text}}}\n"


def _name_of_executor(task: TaskDecl) -> str:
    return "" if task.executor is None else task.executor.name


def _time(key: str, least: str = "rate: 1 Hz, ") -> KeyCase:
    return KeyCase(
        _in_task(f"{least}{key}: 20 ms"),
        _task(lambda t: getattr(t, f"{key}_us")),
        20_000,
        _in_task(f"{least}{key}: 20"),
        f"3:{33 + len(least) + len(key)}",
        f"'tasks[0].{key}' must be a time with its unit",
    )


def _margin_us(application: Application) -> int:
    return 0 if application.watchdog is None else application.watchdog.margin_us


TASK_CASES = {
    "watchdog": KeyCase(
        _NODES + "tasks: [{name: t, executor: fast}]\nwatchdog: {margin: 1 s}",
        _margin_us,
        1_000_000,
        "watchdog: 1 s",
        "1:11",
        "'watchdog' must be a mapping such as {margin: 50 ms}; it is the text '1 s'",
    ),
    "watchdog.margin": KeyCase(
        _NODES + "tasks: [{name: t, executor: fast}]\nwatchdog: {margin: 20 ms}",
        _margin_us,
        20_000,
        "watchdog: {margin: 20}",
        "1:20",
        "'watchdog.margin' must be a time with its unit such as 20 ms (units us, ms, s); it is 20",
    ),
    "tasks": KeyCase(
        _NODES + "tasks: [{name: t, executor: fast}]",
        lambda a: [(t.name, _name_of_executor(t), t.is_session) for t in a.tasks],
        [("t", "fast", False)],
        _NODES + "tasks: []",
        "2:8",
        "'tasks' must be a list with at least one item",
    ),
    "tasks[].name": KeyCase(
        _NODES + "tasks: [{name: Fast_1, executor: fast}]",
        _task(lambda t: t.name),
        "Fast_1",
        _NODES + "tasks: [{name: 1st, executor: fast}]",
        "2:16",
        "'tasks[0].name' must be a letter, then letters, digits or _, at most 15 in all; it is the text '1st'",
    ),
    "tasks[].executor": KeyCase(
        _NODES + "tasks: [{name: t, executor: n/fast}]",
        _task(_name_of_executor),
        "fast",
        _NODES + "tasks: [{name: t, executor: 1}]",
        "2:29",
        "'tasks[0].executor' must be the name of an executor; it is 1",
    ),
    "tasks[].session": KeyCase(
        _NODES + "tasks: [{name: line, session: true}, {name: t, executor: fast}]",
        _task(lambda t: t.is_session),
        True,
        _NODES + "tasks: [{name: line, session: 1}]",
        "2:31",
        "'tasks[0].session' must be true or false; it is 1",
    ),
    "tasks[].rate": KeyCase(
        _in_task("rate: 1.6 kHz"),
        _task(lambda t: t.period_us),
        625,
        _in_task("rate: 100"),
        "3:37",
        "'tasks[0].rate' must be a rate above 0 such as 100 Hz or 1 kHz; it is 100",
    ),
    "tasks[].period": _time("period", ""),
    "tasks[].interval": _time("interval", ""),
    "tasks[].deadline": _time("deadline"),
    "tasks[].time": _time("time"),
    "tasks[].lock": KeyCase(
        _in_task("rate: 1 Hz, time: 30 ms, lock: auto"),
        _task(lambda t: (t.lock_auto, t.lock_us)),
        (True, 0),
        _in_task("rate: 1 Hz, time: 30 ms, lock: 20"),
        "3:62",
        "'tasks[0].lock' must be a time as 40 us, or auto; it is 20",
    ),
    "tasks[].instructions": KeyCase(
        _in_task("rate: 1 Hz, instructions: 5000"),
        _task(lambda t: (t.instructions, t.time_us)),
        (5000, 0),
        _in_task("rate: 1 Hz, instructions: 5 ms"),
        "3:57",
        "'tasks[0].instructions' must be a number of instructions, 1 to 1000000000000; it is the text '5 ms'",
    ),
    "tasks[].lock_instructions": KeyCase(
        _in_task("rate: 1 Hz, time: 9 ms, lock_instructions: 50"),
        _task(lambda t: (t.lock_instructions, t.lock_us)),
        (50, 0),
        _in_task("rate: 1 Hz, time: 9 ms, lock_instructions: 0"),
        "3:74",
        "'tasks[0].lock_instructions' must be a number of instructions, 1 to 1000000000000; it is 0",
    ),
    "tasks[].criticality": KeyCase(
        _in_task("criticality: low"),
        _task(lambda t: t.criticality),
        "low",
        _in_task("criticality: top"),
        "3:44",
        "'tasks[0].criticality' must be high, middle or low; it is the text 'top'",
    ),
    "tasks[].overrun": KeyCase(
        _in_task("rate: 1 Hz, overrun: catch_up"),
        _task(lambda t: t.overrun),
        "catch_up",
        _in_task("rate: 1 Hz, overrun: wait"),
        "3:52",
        "'tasks[0].overrun' must be skip, catch_up or call; it is the text 'wait'",
    ),
    "tasks[].stack": KeyCase(
        _in_task("stack: 2 KiB"),
        _task(lambda t: t.stack),
        2048,
        _in_task("stack: 2 K"),
        "3:38",
        "'tasks[0].stack' must be a size",
    ),
    "tasks[].priority": KeyCase(
        _in_task("priority: 2"),
        _task(lambda t: t.priority),
        2,
        _in_task("priority: 0"),
        "3:41",
        "'tasks[0].priority' must be a whole number between 1 and 31; it is 0",
    ),
}
