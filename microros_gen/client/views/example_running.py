# SPDX-License-Identifier: Apache-2.0
"""Prepared view of how the example application runs where it has an executor: what is called back, and when."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from microros_gen.client.plan.project import Project
from microros_gen.client.views.example_services import ServiceView
from microros_gen.records import dataclass

_NS_PER_US = 1000
_NS_PER_MS = 1_000_000
_WIDTH = 84
# Several executors of one task take turns: none of them waits long for what is its own.
_TURN = "RCL_MS_TO_NS(10)"
_PAUSE_MS = 10


@dataclass(frozen=True)
class Received:
    """A subscription: its variable, its topic, its message, and its callback; see SubscriptionView."""

    variable: str
    node: str
    topic: str
    message: str
    c_type: str
    callback: str
    format: str
    value: str


@dataclass(frozen=True)
class Sender:
    """A function that sends something, and the topic or service that is named where it fails."""

    function: str
    node: str
    what: str


@dataclass(frozen=True)
class TimerView:
    """A timer, its callback, its period as C, and what its callback sends."""

    variable: str
    node: str
    name: str
    callback: str
    period: str
    sends: tuple[Sender, ...] = ()


@dataclass(frozen=True)
class ExecutorView:
    """An executor, how many handles it has, the calls that it begins with, and how long a round waits, as C.

    `has_task`: a task runs it; `has_releases`: a task with a period.
    """

    variable: str
    handles: int
    calls: tuple[str, ...]
    wait: str
    has_task: bool = False
    has_releases: bool = False


@dataclass(frozen=True)
class RunningView:
    """`sends` is what goes out every EXAMPLE_PERIOD_MS where no timer sends; `left_out` is in no executor, as words."""

    executors: tuple[ExecutorView, ...]
    timers: tuple[TimerView, ...]
    received: tuple[Received, ...]
    services: tuple[ServiceView, ...]
    clients: tuple[ServiceView, ...]
    sends: tuple[Sender, ...]
    left_out: tuple[str, ...]

    @property
    def has_tasks(self) -> bool:
        """Return whether tasks run executors."""
        return any(executor.has_task for executor in self.executors)

    @property
    def has_release(self) -> bool:
        """Return whether a function is called in the task of the first executor, which has what components add."""
        return bool(self.executors) and self.executors[0].has_releases

    @property
    def spun(self) -> tuple[ExecutorView, ...]:
        """Return the executors that main runs."""
        return tuple(executor for executor in self.executors if not executor.has_task)

    @property
    def pause(self) -> str:
        """Return the statement by which main waits where it runs no executor, as C; empty: it runs one."""
        return "" if self.spun else f"port_sleep_ms({_PAUSE_MS});"

    @property
    def ticks(self) -> str:
        """Return the number of ticks, as C: tasks share it."""
        return "value_of(&ticks)" if self.has_tasks else "ticks"

    @property
    def count_tick(self) -> str:
        """Return the statement that counts a tick, as C."""
        return "add_one(&ticks);" if self.has_tasks else "++ticks;"

    @property
    def count_failure(self) -> str:
        """Return the statement that counts a failure, as C."""
        return "add_one(&failed);" if self.has_tasks else "++failed;"

    @property
    def start(self) -> str:
        """Return what follows the initialization in a chain of conditions, as C."""
        return " || rclc_tasks_start() != RCL_RET_OK" if self.has_tasks else ""

    @property
    def stop(self) -> str:
        """Return the statement before everything is closed, as C; empty: without tasks."""
        return "(void)rclc_tasks_stop(); /* cannot fail: they run */" if self.has_tasks else ""

    @property
    def has_callbacks(self) -> bool:
        """Return whether there are functions to declare before those that name them."""
        return any((self.timers, self.received, self.services, self.clients))


@dataclass(frozen=True)
class _Handle:
    """What an executor can run: the name that `handles` has for it, and the call that adds it."""

    variable: str
    node: str
    name: str
    call: str
    kind: str


def running_view(
    project: Project,
    nodes: Sequence[str],
    publishers: Iterable[Sender],
    received: Sequence[Received],
    services: Sequence[ServiceView],
    more_handles: int = 0,
) -> RunningView | None:
    """Return what runs the example; None without an executor. `nodes` are the variables of the nodes.

    The first executor has `more_handles` than what it runs.
    """
    if not project.runtime.executor.any or not nodes:
        return None
    timers = tuple(_timers(project, nodes))
    handles = (*_timer_handles(timers), *_received_handles(received), *_service_handles(services))
    shared = _shared(project, nodes, handles)
    run = {handle.variable for _, own, _ in shared for handle in own}
    clients = tuple(s for s in services if s.kind == "client" and s.variable in run)
    sends = (*publishers, *(Sender(s.function, s.node, s.name) for s in clients))
    used = tuple(timer for timer in timers if timer.variable in run)
    return RunningView(
        executors=tuple(
            _executor(
                name,
                own,
                timeout,
                bool(used),
                0 if index else more_handles,
                has_task=name in _of_tasks(project),
                has_releases=name in _of_tasks(project, periodic=True),
            )
            for index, (name, own, timeout) in enumerate(shared)
        ),
        timers=tuple(_sending(used, sends)),
        received=tuple(r for r in received if r.variable in run),
        services=tuple(s for s in services if s.kind == "service" and s.variable in run),
        clients=clients,
        sends=() if used else sends,
        left_out=(*(f"{h.kind} {h.name}" for h in handles if h.variable not in run), *_of_hardware(project)),
    )


def _of_tasks(project: Project, *, periodic: bool = False) -> frozenset[str]:
    """Return the variables of the executors that tasks run; `periodic`: that tasks with a period run."""
    nodes = project.application.nodes
    every = [(node, executor.name) for node, decl in enumerate(nodes) for executor in decl.executors]
    return frozenset(
        f"executor_{every.index((task.node, task.executor.name))}"
        for task in project.application.tasks
        if task.executor is not None and (task.period_us or not periodic)
    )


def _timers(project: Project, nodes: Sequence[str]) -> Iterator[TimerView]:
    """Yield the declared timers, or one of the example's own where there is a place for any.

    None where hardware drives one: the function that starts it is the application's.
    """
    runtime = project.runtime
    if not runtime.timers.any or runtime.timers.has_hardware:
        return
    for timer in runtime.timers.declared:
        yield TimerView(
            f"timer_{timer.index}",
            nodes[timer.node],
            timer.name,
            f"on_timer_{timer.index}",
            _time(timer.period_ns),
        )
    if not runtime.timers.declared:
        yield TimerView("example_timer", nodes[0], "", "on_example_timer", "RCL_MS_TO_NS(EXAMPLE_PERIOD_MS)")


def _time(nanoseconds: int) -> str:
    if nanoseconds % _NS_PER_MS == 0:
        return f"RCL_MS_TO_NS({nanoseconds // _NS_PER_MS})"
    return f"RCL_US_TO_NS({nanoseconds // _NS_PER_US})"


def _of_hardware(project: Project) -> Iterator[str]:
    timers = project.runtime.timers.declared if project.runtime.timers.has_hardware else ()
    for timer in timers:
        why = " (port_hardware_timer_start is yours to write)" if timer.kind == "hardware" else ""
        yield f"timer {timer.name}{why}"


def _timer_handles(timers: Iterable[TimerView]) -> Iterator[_Handle]:
    for t in timers:
        yield _Handle(t.variable, t.node, t.name, f"rclc_executor_add_timer(&{{}}, &{t.variable})", "timer")


def _received_handles(received: Iterable[Received]) -> Iterator[_Handle]:
    for r in received:
        call = (
            f"rclc_executor_add_subscription(&{{}}, &{r.variable}, &{r.message}, {r.callback}, ON_NEW_DATA)"
        )
        yield _Handle(r.variable, r.node, r.topic, call, "topic")


def _service_handles(services: Iterable[ServiceView]) -> Iterator[_Handle]:
    for s in services:
        if s.kind == "service":
            messages = f"&{s.received.variable}, &{s.sent.variable}, {s.function}"
        else:
            messages = f"&{s.received.variable}, {s.reply_function}"
        call = f"rclc_executor_add_{s.kind}(&{{}}, &{s.variable}, {messages})"
        yield _Handle(s.variable, s.node, s.name, call, s.kind)


def _shared(
    project: Project, nodes: Sequence[str], handles: Sequence[_Handle]
) -> list[tuple[str, tuple[_Handle, ...], str]]:
    """Return each executor's variable, its handles and its timeout: those that are declared, or one for everything."""
    declared = [
        (node, executor)
        for node, decl in zip(nodes, project.application.nodes, strict=False)
        for executor in decl.executors
    ]
    if not declared:
        return [("executor", tuple(handles), "")]
    rest = {handle.variable: handle for handle in handles}
    shared: list[tuple[str, tuple[_Handle, ...], str]] = []
    for index, (node, executor) in enumerate(declared):
        own_handles = [h for h in rest.values() if h.node == node and h.name]
        if executor.handles:
            by_name: Mapping[str, list[_Handle]] = {
                h.name: [m for m in own_handles if m.name == h.name] for h in executor.handles
            }
            own_handles = [handle for found in by_name.values() for handle in found]
        own_handles += [] if index else [h for h in rest.values() if not h.name]
        for handle in own_handles:
            del rest[handle.variable]
        default = _TURN if len(declared) > 1 else ""
        timeout = _time(executor.timeout_us * _NS_PER_US) if executor.timeout_us else default
        shared.append((f"executor_{index}", tuple(own_handles), timeout))
    return shared


def _executor(
    variable: str,
    handles: Sequence[_Handle],
    timeout: str,
    has_timers: bool,
    more_handles: int,
    *,
    has_task: bool,
    has_releases: bool,
) -> ExecutorView:
    """`has_timers`: rounds have no other end than what is ready; otherwise all of them fill EXAMPLE_PERIOD_MS."""
    calls = [f"rclc_executor_set_timeout(&{variable}, {timeout})"] if timeout else []
    calls += [_in_lines(handle.call.format(variable)) for handle in handles]
    rest = timeout or "(uint64_t)(EXAMPLE_PERIOD_MS - passed) * 1000000u"
    return ExecutorView(
        variable,
        max(len(handles) + more_handles, 1),
        tuple(calls),
        f"{variable}.timeout_ns" if has_timers else rest,
        has_task,
        has_releases,
    )


def _in_lines(call: str) -> str:
    """Return a call as it is written in its function: with the arguments on a separate line if it is long."""
    return call if len(call) <= _WIDTH else call.replace("(", "(\n      ", 1)


def _sending(timers: Sequence[TimerView], sends: Sequence[Sender]) -> Iterator[TimerView]:
    """Yield the timers, each with what it sends: the timers of a node take turns, a node without one has all."""
    for timer in timers:
        sent: list[Sender] = []
        for index, sender in enumerate(sends):
            of_node = [t for t in timers if t.node == sender.node] or list(timers)
            if of_node[index % len(of_node)] is timer:
                sent.append(sender)
        yield TimerView(timer.variable, timer.node, timer.name, timer.callback, timer.period, tuple(sent))
