# SPDX-License-Identifier: Apache-2.0
"""What runs the application: timers, clocks, executors with their handles, guard conditions and wait sets."""

from __future__ import annotations

from microros_gen.application.model import Application, ExecutorDecl, NodeDecl
from microros_gen.client.plan.declared import pool
from microros_gen.client.plan.runtime_entities import TimerPlan
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.model import Selection

_NS_PER_US = 1000


@dataclass(frozen=True)
class Running:
    """Places of each; see RuntimePlan."""

    timers: tuple[TimerPlan, ...] = ()
    timers_max: int = 0
    executors_max: int = 0
    handles_max: int = 0
    guard_conditions_max: int = 0
    wait_sets_max: int = 0
    ros_clocks_max: int = 0
    jump_callbacks_max: int = 0


def plan_running(
    application: Application, selection: Selection, receivers: int, diagnostics: Diagnostics
) -> Running:
    """Count what the selected components of `executor`, `timers` and `clock` need places for.

    `receivers` are the subscriptions, services and clients that an executor can run. Declared timers and executors are
    the least; `pools` says more, and how many there are without `nodes:`, one of each by default. A guard condition is
    not declared by a node: with `nodes:` there are those of `pools`. rclc's support has a ROS clock where time comes
    from /clock.
    """
    declared = bool(application.nodes)
    clocks, of_support = selection.has("clock"), 1 if selection.has(CLOCK_ROS) else 0
    ros_clocks = max(pool(application, "ros_clocks", 1 + of_support, diagnostics), 1) if clocks else 0
    jump_callbacks = max(pool(application, "jump_callbacks", 1, diagnostics), 1) if clocks else 0
    timers = _timers(application) if selection.has("timers") else ()
    timers_max = _places(application, "timers", len(timers), diagnostics) if selection.has("timers") else 0
    if not selection.has("executor"):
        return Running(
            ros_clocks_max=ros_clocks,
            jump_callbacks_max=jump_callbacks,
        )
    guards = pool(application, "guard_conditions", 0 if declared else 1, diagnostics)
    executors = tuple((node, e) for node in application.nodes for e in node.executors)
    everything = receivers + timers_max
    most = max((_handles(node, executor) for node, executor in executors), default=everything)
    extra_timers = timers_max - len(timers)
    handles = (most + extra_timers if executors else everything) + guards
    return Running(
        timers=timers,
        timers_max=timers_max,
        executors_max=_places(application, "executors", len(executors), diagnostics),
        handles_max=max(pool(application, "handles", handles, diagnostics), 1),
        guard_conditions_max=guards,
        wait_sets_max=max(pool(application, "wait_sets", 1, diagnostics), 1),
        ros_clocks_max=ros_clocks,
        jump_callbacks_max=jump_callbacks,
    )


def _timers(application: Application) -> tuple[TimerPlan, ...]:
    declared = [(index, timer) for index, node in enumerate(application.nodes) for timer in node.timers]
    return tuple(
        TimerPlan(index, node, timer.name, timer.period_us * _NS_PER_US, timer.kind)
        for index, (node, timer) in enumerate(declared)
    )


def _places(application: Application, key: str, declared: int, diagnostics: Diagnostics) -> int:
    """Return the larger of what is declared and what `pools` says; 1 at least."""
    return max(declared, pool(application, key, 1, diagnostics) if key in application.pools else 1)


def _handles(node: NodeDecl, executor: ExecutorDecl) -> int:
    """Return how many handles an executor has: those that it names, or all that its node has.

    A name may be that of a service and of a client; a name before `remap:` is what the sources have.
    """
    names = {handle.name for handle in executor.handles}
    received = [e for e in node.endpoints if e.kind != "publisher" and not e.of_the_library]
    timers = sum(not names or timer.name in names for timer in node.timers)
    return timers + sum(not names or (e.given or e.topic) in names for e in received)
