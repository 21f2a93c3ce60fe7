# SPDX-License-Identifier: Apache-2.0
"""What runs the application: timers, clocks, executors with their handles, guard conditions and wait sets."""

from __future__ import annotations

from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application, ExecutorDecl, NodeDecl
from microros_gen.client.plan.declared import pool
from microros_gen.client.plan.runtime_entities import TimerPlan
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.model import Selection

_NS_PER_US = 1000


_TICK_SOURCES = {"rtos": "port_timer", "hardware": "port_hardware_timer"}


@dataclass(frozen=True)
class TickSource:
    """What makes timers of a kind ready: `functions` is how the names of its C functions begin."""

    kind: str
    functions: str


@dataclass(frozen=True, kw_only=True)
class TimersPlan:
    """`max` places of timers, the first for those that are `declared`; 0: `timers` is not selected."""

    max: int = 0
    declared: tuple[TimerPlan, ...] = ()

    @property
    def any(self) -> bool:
        """Whether `timers` is selected."""
        return self.max > 0

    @property
    def has_rtos(self) -> bool:
        """Whether a timer of the system drives a declared one."""
        return any(timer.kind == "rtos" for timer in self.declared)

    @property
    def has_hardware(self) -> bool:
        """Whether the application drives a declared timer."""
        return any(timer.kind == "hardware" for timer in self.declared)

    @property
    def has_gated(self) -> bool:
        """Whether the state of its node decides when a declared one may be ready."""
        return any(timer.gated for timer in self.declared)

    @property
    def tick_sources(self) -> tuple[TickSource, ...]:
        """The sources of ticks that declared timers use."""
        used = {timer.kind for timer in self.declared}
        return tuple(TickSource(kind, name) for kind, name in _TICK_SOURCES.items() if kind in used)

    @property
    def has_ticked(self) -> bool:
        """Whether something else than its clock makes a timer ready."""
        return self.has_rtos or self.has_hardware


@dataclass(frozen=True, kw_only=True)
class ExecutorPlan:
    """`max` places of executors, with `handles_max` handles each; 0: `executor` is not selected."""

    max: int = 0
    handles_max: int = 0
    guard_conditions_max: int = 0
    wait_sets_max: int = 0

    @property
    def any(self) -> bool:
        """Whether `executor` is selected."""
        return self.max > 0


@dataclass(frozen=True, kw_only=True)
class ClockPlan:
    """Places of clocks of ROS time, 0: `clock` is not selected; and of callbacks of each at a jump of its time.

    `has_ros_time`: the first subscription is that of /clock, which the library opens itself.
    """

    ros_clocks_max: int = 0
    jump_callbacks_max: int = 0
    has_ros_time: bool = False

    @property
    def any(self) -> bool:
        """Whether `clock` is selected."""
        return self.ros_clocks_max > 0


@dataclass(frozen=True)
class Running:
    """The slices of what runs the application."""

    timers: TimersPlan
    executor: ExecutorPlan
    clock: ClockPlan


def plan_running(
    application: Application, selection: Selection, receivers: int, diagnostics: Diagnostics
) -> Running:
    """Count what the selected components of `executor`, `timers` and `clock` need places for.

    `receivers` are the subscriptions, services and clients that an executor can run. Declared timers and executors are
    the least; `pools` says more, and how many there are without `nodes:`, one of each by default. A guard condition is
    not declared by a node: with `nodes:` there are those of `pools`. rclc's support has a ROS clock where time comes
    from /clock.
    """
    clock = _clock_plan(application, selection, diagnostics)
    timers = _timers_plan(application, selection, diagnostics)
    executor = _executor_plan(application, selection, receivers, timers, diagnostics)
    return Running(timers, executor, clock)


def _timers_plan(application: Application, selection: Selection, diagnostics: Diagnostics) -> TimersPlan:
    if not selection.has("timers"):
        return TimersPlan()
    timers = _timers(application)
    return TimersPlan(max=_places(application, "timers", len(timers), diagnostics), declared=timers)


def _executor_plan(
    application: Application,
    selection: Selection,
    receivers: int,
    timers: TimersPlan,
    diagnostics: Diagnostics,
) -> ExecutorPlan:
    if not selection.has("executor"):
        return ExecutorPlan()
    guards = pool(application, "guard_conditions", 0 if application.nodes else 1, diagnostics)
    executors = tuple((node, e) for node in application.nodes for e in node.executors)
    everything = receivers + timers.max
    most = max((_handles(node, executor) for node, executor in executors), default=everything)
    extra_timers = timers.max - len(timers.declared)
    handles = (most + extra_timers if executors else everything) + guards
    return ExecutorPlan(
        max=_places(application, "executors", len(executors), diagnostics),
        handles_max=max(pool(application, "handles", handles, diagnostics), 1),
        guard_conditions_max=guards,
        wait_sets_max=max(pool(application, "wait_sets", 1, diagnostics), 1),
    )


def _clock_plan(application: Application, selection: Selection, diagnostics: Diagnostics) -> ClockPlan:
    ros_time = selection.has(CLOCK_ROS)
    if not selection.has("clock"):
        return ClockPlan(has_ros_time=ros_time)
    return ClockPlan(
        ros_clocks_max=max(pool(application, "ros_clocks", 2 if ros_time else 1, diagnostics), 1),
        jump_callbacks_max=max(pool(application, "jump_callbacks", 1, diagnostics), 1),
        has_ros_time=ros_time,
    )


def _timers(application: Application) -> tuple[TimerPlan, ...]:
    declared = [(index, timer) for index, node in enumerate(application.nodes) for timer in node.timers]
    return tuple(
        TimerPlan(index, node, timer.name, timer.period_us * _NS_PER_US, timer.kind, timer.managed)
        for index, (node, timer) in enumerate(declared)
    )


def _places(application: Application, key: str, declared: int, diagnostics: Diagnostics) -> int:
    """Return the larger of what is declared and what `pools` says; 1 at least."""
    return max(declared, pool(application, key, 1, diagnostics) if key in application.pools else 1)


def _handles(node: NodeDecl, executor: ExecutorDecl) -> int:
    """Return how many handles an executor has: those that it names, or all that its node has.

    A name may be that of a service and of a client; a name before `remap:` is what the sources have. What a component
    has for an executor has no name there and always takes its handles.
    """
    names = {handle.name for handle in executor.handles}
    received = [e for e in node.endpoints if KIND[e.kind].waited and e.takes_handle]
    timers = sum(not names or timer.name in names for timer in node.timers)
    return timers + sum(not names or e.executed or (e.declared_as or e.topic) in names for e in received)
