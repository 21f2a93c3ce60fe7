# SPDX-License-Identifier: Apache-2.0
"""The tasks with their priorities: bands of criticality, and by deadline within one; the session's by rule."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from microros_gen.application.model import Application
from microros_gen.application.task_decl import CRITICALITIES, TaskDecl
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.tasks.analysis import analyze_tasks, gaps, is_placed_by_rule, timed
from microros_gen.components.tasks.unbounded import unbounded_locks
from microros_gen.diagnostics import Diagnostic, Diagnostics
from microros_gen.diagnostics.notes import note_data
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.schedule.report import schedule_data
from microros_gen.schedule.response import Response

_ALIGNMENT = 8
_USUAL = "middle"
_NO_DEADLINE = 1 << 32
_SESSION = "session"
_CRITICALITY_OF_SESSION = "by rule"
_MILLISECOND_US = 1000
_ON_OVERRUN = (
    "/* A run of the task ended after its deadline; `missed` releases came meanwhile. */",
    "static void on_overrun(uint8_t task, uint32_t missed)",
    "{",
    "  (void)task;",
    "  (void)missed;",
    "}",
    "",
)
_FEED = (
    "/* Every task is in time: feed the watchdog of the device here. */",
    "void port_watchdog_feed(void)",
    "{",
    "}",
    "",
)
_OUTBOX_BESIDES = 72
"""Bytes beside the largest message: its size, and a message of the session itself (CREATE_CLIENT and smaller ones)."""
_WAIT_MOST_US = 1_000_000
"""Longest wait of a task without a period, with a watchdog: RCLC_TASKS_WAIT_MOST_MS of rclc_tasks_watch_on.h."""


@dataclass(frozen=True, kw_only=True)
class TaskPlan:
    """A task; times are microseconds, 0: none. It begins in the function `entry`.

    `executor` is the position of its executor among the declared ones, None: the session. `stack_auto`: the size of its
    stack follows from an image, `lock_auto`: and the instructions for which it holds the lock.

    `priority` is 1 for the highest, `level` 1 for the lowest.
    """

    name: str
    entry: str
    executor: int | None
    period_us: int
    interval_us: int
    deadline_us: int
    criticality: str
    time_us: int
    lock_us: int
    lock_instructions: int
    lock_auto: bool
    overrun: str
    stack: int
    stack_auto: bool
    priority: int
    level: int

    @property
    def constant(self) -> str:
        """Return the name of its number in C."""
        return f"RCLC_TASK_{self.name.upper()}"

    @property
    def plan_entry(self) -> str:
        """Return its row of rclc_task_plans, as C."""
        numbers = ", ".join(f"{number}u" for number in (self.period_us, self.interval_us, self.deadline_us))
        return f"{{{numbers}, RCLC_TASK_{self.overrun.upper()}}}"

    @property
    def setting_entry(self) -> str:
        """Return its row of rclc_task_settings, as C."""
        stack = f"stack_of_{self.name}"
        return f'{{"{self.name}", {self.entry}, {stack}, {self.stack}u, {self.level}u}}'


@dataclass(frozen=True, kw_only=True)
class TasksPlan:
    """The tasks in the order of the application file, that of the session last.

    `stack_context` is what the system puts on each stack, bytes.
    `responses` is the analysis of their deadlines, by priority; empty where it cannot be made, because of `gaps`.
    `margin_us`: time after a deadline from which on the watchdog is not fed; 0: without one.
    `outbox_size`: bytes for messages that wait for the write function of the application.
    `unbounded`: why no image says how long a task holds the lock; None: images do.
    """

    tasks: tuple[TaskPlan, ...]
    stack_macro: str = ""
    stack_headers: tuple[str, ...] = ()
    stack_context: int = 0
    responses: tuple[Response, ...] = ()
    margin_us: int = 0
    gaps: tuple[str, ...] = ()
    outbox_size: int = 0
    unbounded: Diagnostic | None = None

    @property
    def count(self) -> int:
        """Return the number of tasks."""
        return len(self.tasks)

    @property
    def is_watched(self) -> bool:
        """Return whether a watchdog is fed."""
        return self.margin_us != 0

    @property
    def headers(self) -> tuple[str, ...]:
        """Return the headers with what the application defines."""
        return ("microros/port_watchdog.h",) if self.is_watched else ()

    @property
    def watch(self) -> str:
        """Return what a report says of the watchdog: what its own time must exceed."""
        periodic = [t.period_us + t.deadline_us for t in self.tasks if t.period_us]
        others = [_WAIT_MOST_US + t.interval_us + t.deadline_us for t in self.tasks if not t.period_us]
        return f"port_watchdog_feed() at least every {_time(min(periodic + others) + self.margin_us)}"

    @property
    def stack_entries(self) -> tuple[str, ...]:
        """Return the definitions of the stacks as lines of C: arrays, or what a macro of the system defines."""
        if self.stack_macro:
            return tuple(f"static {self.stack_macro}(stack_of_{t.name}, {t.stack}u);" for t in self.tasks)
        return tuple(f"static uint64_t stack_of_{t.name}[{t.stack}u / sizeof(uint64_t)];" for t in self.tasks)

    @property
    def constants(self) -> tuple[str, ...]:
        """Return the numbers of the tasks as lines of C."""
        return ("enum {", *(f"  {task.constant} = {i}," for i, task in enumerate(self.tasks)), "};")

    @property
    def shown(self) -> str:
        """Return what a report says: the names by priority, each with what releases it."""
        by_priority = sorted(self.tasks, key=lambda task: task.priority)
        return ", ".join(f"{task.name} ({_released(task)})" for task in by_priority)

    @property
    def stacks(self) -> str:
        """Return what a report says of the stacks."""
        return f"{', '.join(f'{task.name} {task.stack}' for task in self.tasks)} bytes"

    @property
    def schedule(self) -> list[dict[str, object]]:
        """Return the rows of `microros-gen schedule` as data; empty: the deadlines were not analyzed."""
        return schedule_data(self.responses)

    @property
    def notes(self) -> list[dict[str, object]]:
        """Return as data what `microros-gen locks` and `schedule` say of the numbers."""
        return [note_data(self.unbounded)] if self.unbounded is not None else []

    @property
    def analysis(self) -> str:
        """Return what a report says of the deadlines."""
        if self.gaps:
            return f"not analyzed: {', '.join(self.gaps)}"
        slacks = [(r.slack_us, r.task.name) for r in self.responses if r.slack_us is not None]
        least, name = min(slacks, default=(0, ""))
        return f"every deadline is met, {name} with the least slack: {least} us"

    @property
    def example_calls(self) -> tuple[str, ...]:
        """Return the calls of the example that name the executors and the functions of tasks."""
        runs = [
            f"rclc_task_set_executor({task.constant}, &executor_{task.executor}, {_callback(task)})"
            for task in self.tasks
            if task.executor is not None
        ]
        calls = [f"rclc_task_set_overrun({task.constant}, on_overrun)" for task in self.tasks if _calls(task)]
        return (*runs, *calls)

    @property
    def example_function(self) -> tuple[str, ...]:
        """Return functions of the example as lines of C, for the overruns of tasks and for the watchdog."""
        return (*(_ON_OVERRUN if any(map(_calls, self.tasks)) else ()), *(_FEED if self.is_watched else ()))


def _callback(task: TaskPlan) -> str:
    """Return the function of the example for releases: of the first executor, which has all that components add."""
    return "on_release" if task.executor == 0 and task.period_us else "NULL"


def _calls(task: TaskPlan) -> bool:
    return task.overrun == "call"


def _released(task: TaskPlan) -> str:
    if task.period_us:
        return f"every {_time(task.period_us)}"
    return "events" if task.executor is not None else "line"


def _time(time_us: int) -> str:
    whole = time_us % _MILLISECOND_US == 0
    return f"{time_us // _MILLISECOND_US} ms" if whole else f"{time_us} us"


def plan(context: PlanContext, diagnostics: Diagnostics) -> TasksPlan:
    """Return the tasks with priorities and stacks; a target without tasks is refused."""
    application = context.application
    if not application.tasks:
        message = "the component 'tasks' is for the tasks that the application file declares"
        hint = "Add `tasks: [{name: control, executor: NAME, rate: 100 Hz}]`"
        diagnostics.error(message, application.spans.get("components"), hint, id="MG-7230")
        return TasksPlan(tasks=())
    _check_target(application, context.target, diagnostics)
    session = next((task for task in application.tasks if task.is_session), None)
    tasks = [*(task for task in application.tasks if not task.is_session)]
    tasks.append(session or TaskDecl(_session_name(tasks)))
    tasks = [*timed(tasks, context.target, diagnostics)]
    priorities = priorities_of(tasks)
    open_gaps = gaps(tasks)
    os = context.target.os
    _warn_of_stacks(tasks, os.task_stack, diagnostics)
    unbounded = unbounded_locks(tasks, context.target)
    _warn_of_locks(tasks, unbounded, diagnostics)
    return TasksPlan(
        stack_context=os.task_stack_context,
        tasks=tuple(
            TaskPlan(
                name=task.name,
                entry=_entry(task),
                executor=_position(application, task),
                period_us=task.period_us,
                interval_us=task.interval_us,
                deadline_us=_deadline(task),
                criticality=task.criticality or (_CRITICALITY_OF_SESSION if task.is_session else _USUAL),
                time_us=task.time_us,
                lock_us=task.lock_us or task.time_us,
                lock_instructions=task.lock_instructions,
                lock_auto=task.lock_auto,
                overrun=task.overrun,
                stack=_aligned(max(task.stack or os.task_stack, os.task_stack_least)),
                stack_auto=task.stack_auto,
                priority=priority,
                level=len(tasks) + 1 - priority,
            )
            for task, priority in zip(tasks, priorities, strict=True)
        ),
        stack_macro=os.task_stack_macro,
        stack_headers=(os.task_stack_header,) if os.task_stack_header else (),
        responses=() if open_gaps else analyze_tasks(tasks, diagnostics, context.target.instructions_per_us),
        margin_us=application.watchdog.margin_us if application.watchdog is not None else 0,
        gaps=open_gaps,
        outbox_size=context.runtime.streams.mtu + _OUTBOX_BESIDES,
        unbounded=unbounded,
    )


def _check_target(application: Application, target: Target, diagnostics: Diagnostics) -> None:
    offered = {p.capability for part in target.parts for p in part.component.provides}
    if "tasks" not in offered | set(target.own_capabilities):
        os = target.part("os")
        name = os.component.name if os is not None else "no operating system"
        message = f"the target {target.name} has no tasks: its operating system is {name}"
        hint = "Remove `tasks:` and spin the executors in main, or choose a system: `target: {name: …, rtos: freertos}`"
        diagnostics.error(message, application.tasks[0].span, hint, id="MG-7231")


def _session_name(tasks: Iterable[TaskDecl]) -> str:
    names = {task.name.lower() for task in tasks}
    return _SESSION if _SESSION not in names else "line_and_session"


def _position(application: Application, task: TaskDecl) -> int | None:
    if task.executor is None:
        return None
    every = [(node, e.name) for node, decl in enumerate(application.nodes) for e in decl.executors]
    return every.index((task.node, task.executor.name))


def _deadline(task: TaskDecl) -> int:
    return task.deadline_us or task.period_us or task.interval_us


def _entry(task: TaskDecl) -> str:
    kind = "session" if task.is_session else "period" if task.period_us else "events"
    return f"rclc_tasks_run_{kind}"


def _warn_of_stacks(tasks: Iterable[TaskDecl], plain: int, diagnostics: Diagnostics) -> None:
    """Warn of sizes that are to follow from an image which nobody has measured yet."""
    for task in tasks:
        if task.stack_auto and task.stack is None:
            message = f"the stack that the task '{task.name}' needs is not known yet: it has {plain} bytes"
            hint = "Build the image, then run `microros-gen stacks OUT -o microros.stacks.yaml`"
            diagnostics.warning(message, task.stack_span, hint, id="MG-7146")


def _warn_of_locks(tasks: Sequence[TaskDecl], unbounded: Diagnostic | None, diagnostics: Diagnostics) -> None:
    """Warn of holds of the lock that are to follow from an image: nobody has measured it yet, or it cannot say."""
    if unbounded is not None and any(task.lock_auto for task in tasks):
        diagnostics.add(unbounded)
    for task in tasks:
        if unbounded is None and task.lock_auto and not task.lock_instructions:
            message = (
                f"how long the task '{task.name}' holds the lock is not known yet: all of its time counts"
            )
            hint = "Build the image, then run `microros-gen locks OUT -o microros.locks.yaml`"
            diagnostics.warning(message, task.lock_span, hint, id="MG-7150")


def _aligned(size: int) -> int:
    return (size + _ALIGNMENT - 1) // _ALIGNMENT * _ALIGNMENT


def priorities_of(tasks: Sequence[TaskDecl]) -> tuple[int, ...]:
    """Return the priority of each task, 1 for the highest.

    Those of the application file hold. The others take the remaining places: by criticality, then by deadline, then in
    the order of the file. The session's task, where nothing is said of it, precedes the first task that handles
    release, since it is what wakes that; without one it is the last.
    """
    free = [task for task in tasks if not task.priority]
    ordered = sorted((task for task in free if not is_placed_by_rule(task)), key=_rank)
    for session in (task for task in free if is_placed_by_rule(task)):
        woken = (i for i, task in enumerate(ordered) if not task.period_us)
        ordered.insert(next(woken, len(ordered)), session)
    fixed = {task.priority for task in tasks if task.priority}
    places = (place for place in range(1, len(tasks) + 1) if place not in fixed)
    assigned = {id(task): place for task, place in zip(ordered, places, strict=True)}
    return tuple(task.priority or assigned[id(task)] for task in tasks)


def _rank(task: TaskDecl) -> tuple[int, int]:
    return CRITICALITIES.index(task.criticality or _USUAL), _deadline(task) or _NO_DEADLINE


def record(part: TasksPlan) -> object:
    """Return what the plan id is made of: an application is compiled with the numbers of its tasks."""
    return {
        "tasks": [[t.name, t.executor, t.plan_entry, t.stack, t.level, t.deadline_us] for t in part.tasks],
        **({"watchdog": part.margin_us} if part.is_watched else {}),
    }
