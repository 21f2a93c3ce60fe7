# SPDX-License-Identifier: Apache-2.0
"""Clocks, timers and the executor, as C units over a port whose time is made and an agent that grants everything."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen.client.plan.feature_slices import Features, FeatureSlice
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan, TimerPlan
from microros_gen.components.agents.plan import AgentPlan, AgentsPlan
from microros_gen.components.on_silence.plan import SilencePlan, SilenceRow
from microros_gen.components.time_source.plan import NEVER_US, TimeSourcePlan
from tests.support.patience import seconds
from tests.support.plans import EXECUTOR, ROS_TIME, changed
from tests.support.runtime.harness import SANITIZE, Tree, build, compilers, components, render

MS = 1_000_000
TICKS = changed(
    EXECUTOR,
    timers__declared=(
        TimerPlan(0, 0, "system", 10 * MS, "rtos"),
        TimerPlan(1, 0, "hardware", 20 * MS, "hardware"),
        TimerPlan(2, 0, "plain", 30 * MS),
    ),
)
CHANGES = changed(
    EXECUTOR,
    streams__mtu=256,
    streams__best_effort_size=256,
    timers__max=2,
    entities__services__max=3,
    entities__clients__max=2,
    input__queues=(*(QueuePlan(2, 16),) * 2, *(QueuePlan(2, 40),) * 3, *(QueuePlan(2, 20),) * 2),
)
THREE = AgentsPlan(declared=tuple(AgentPlan("127.0.0.1", 8888 + i) for i in range(3)), try_ms=300)
ASKING = TimeSourcePlan(period_ms=10_000, slew_ppm=500, step_us=NEVER_US, holdover_ms=60_000)
SILENCES = SilencePlan(
    (SilenceRow(0, "/speed", 500, "stop_motors"), SilenceRow(1, "/light", 2000, "switch_off"))
)
UNITS = {
    "unit_clock.c": EXECUTOR,
    "unit_stamp.c": EXECUTOR,
    "unit_timer.c": EXECUTOR,
    "unit_executor.c": EXECUTOR,
    "unit_executor_changes.c": CHANGES,
    "unit_days.c": EXECUTOR,
    "unit_flush.c": EXECUTOR,
    "unit_service_call.c": CHANGES,
    "unit_executor_nodes.c": CHANGES,
    "unit_new_data.c": CHANGES,
    "unit_qos_events.c": changed(CHANGES, entities__timed_qos=True),
    "unit_ticks.c": TICKS,
    "unit_clock_ros.c": ROS_TIME,
    "unit_agents.c": changed(
        EXECUTOR,
        times__retry_first_ms=100,
        times__retry_most_ms=4000,
        features=Features((FeatureSlice("agents", THREE, "[]"),)),
    ),
    "unit_silence.c": changed(
        EXECUTOR,
        times__retry_first_ms=100,
        times__retry_most_ms=4000,
        features=Features((FeatureSlice("on_silence", SILENCES, "[]"),)),
    ),
    "unit_silence_sleep.c": changed(
        EXECUTOR,
        session__has_sleep=True,
        session__has_state=True,
        features=Features((FeatureSlice("on_silence", SILENCES, "[]"),)),
    ),
    "unit_time_source.c": changed(
        EXECUTOR,
        session__has_time_sync=True,
        times__retry_first_ms=100,
        times__retry_most_ms=4000,
        features=Features((FeatureSlice("time_source", ASKING, "[]"),)),
    ),
    "unit_woken.c": changed(
        EXECUTOR,
        session__multithread=True,
        session__has_sleep=True,
        session__has_state=True,
        session__has_time_sync=True,
        times__retry_first_ms=100,
        times__retry_most_ms=4000,
        features=Features((FeatureSlice("time_source", ASKING, "[]"),)),
    ),
}

SELECTED = {
    "unit_service_call.c": ("service_call",),
    "unit_executor_nodes.c": ("executor_nodes",),
    "unit_new_data.c": ("new_data_callbacks",),
    "unit_qos_events.c": ("qos_events",),
    "unit_agents.c": ("agents",),
    "unit_silence.c": ("on_silence",),
    "unit_silence_sleep.c": ("on_silence",),
    "unit_stamp.c": ("clock_stamp",),
    "unit_time_source.c": ("time_source",),
    "unit_woken.c": ("time_source",),
}
"""Components that a unit has besides those of its plan."""


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize(
    ("compiler", "flags"),
    [
        pytest.param("", (), id="quick"),
        pytest.param("gcc", ("-m32", "-Os"), id="gcc-m32", marks=pytest.mark.variant),
        pytest.param("gcc", SANITIZE, id="gcc-sanitized", marks=pytest.mark.variant),
    ],
)
def test_unit(unit: str, compiler: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    if compiler and compiler not in compilers():
        pytest.skip(f"no {compiler}")
    _run(unit, UNITS[unit], compiler, flags, tmp_path)


def _run(unit: str, plan: RuntimePlan, compiler: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    names = [name for name in components(plan) if name != "port_posix"]
    tree = render(tmp_path, plan, [*names, *SELECTED.get(unit, ())])
    fixtures = ["port_agent.c", "types_read.c", *(["types_clock.c"] if plan.clock.has_ros_time else []), unit]
    program = build(tree, fixtures, "unit", compiler, flags)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


def test_waiting_of_the_posix_port(tmp_path: Path) -> None:
    tree = render(tmp_path, TICKS, components(TICKS))
    wanted = ("port_posix_wait.c", "port_posix_steady.c", "port_posix_timer.c")
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name in wanted))
    program = build(alone, ["unit_wait.c"], "unit")
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr
