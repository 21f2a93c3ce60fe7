# SPDX-License-Identifier: Apache-2.0
"""One scenario, played by `simulate` and by the manager on ROS with nodes of rclpy: both decide the same."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.mode_manager.calls import Call
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.server import ModeManager
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulated_node import PASSING
from microros_gen.mode_manager.simulation import CALL, EVENT, LOG, STATUS, Step, Trace, simulate
from microros_gen.modes import Event, Model
from microros_gen.modes.script import parse_script
from microros_gen.ros.peer import Peer
from tests.support.mode_manager.processes import Asking, node
from tests.support.modes.models import model_of, model_text
from tests.support.patience import deadline
from tests.support.ros.running import Running

pytestmark = pytest.mark.ros
ARM = model_text("arm")
VALUES: dict[str, dict[str, Any]] = {
    "gripper": {"force": 0.5},
    "joint": {"speed": 0.1, "law": "TORQUE"},
}
REFUSALS = {"activate": "refuse_activation", "set_parameters": "refuse_parameters"}
SETTINGS = Settings(call_s=2.0)


def script(text: str, model: Model) -> tuple[Event, ...]:
    diagnostics = Diagnostics()
    events = parse_script(Source("s.yaml", text), model, diagnostics)
    assert [d.render() for d in diagnostics] == []
    return events


class Faults:
    """Lets nodes of rclpy have the faults of a script."""

    def __init__(self, asking: Asking, domain: int, stack: ExitStack) -> None:
        self._asking, self._domain, self._stack = asking, domain, stack
        self._running = {name: self._start(name) for name in VALUES}

    def _start(self, name: str) -> Running:
        started: Running = self._stack.enter_context(node(self._domain, name, **VALUES[name]))
        return started

    def happen(self, event: Event) -> None:
        if event.kind == "refuse":
            self._asking.set(event.part, **{REFUSALS[call]: True for call in event.calls})
        elif event.kind == "delay":
            assert event.calls == ("activate",)
            self._asking.set(event.part, late_s=event.delay_us / 1e6)
        elif event.kind == "leave":
            self._running[event.part].process.send_signal(signal.SIGINT)
            self._running[event.part].process.wait()
        elif event.kind == "repair":
            if self._running[event.part].process.poll() is not None:
                self._running[event.part] = self._start(event.part)
            else:
                self._asking.set(event.part, refuse_activation=False, refuse_parameters=False, late_s=0.0)
        elif event.status is not None:
            assert event.status.state == "inactive"
            assert self._asking.change_state(event.part, 4)
        else:
            self._asking.set(event.part, **{name: value.value for name, value in event.parameters.items()})


def real(model: Model, events: Iterable[Event], domain: int, stack: ExitStack) -> list[Step]:
    """Return the trace of a manager on ROS."""
    asking = Asking(stack.enter_context(Peer("asking")))
    faults = Faults(asking, domain, stack)
    peer = stack.enter_context(Peer("manager"))
    trace = Trace()
    manager = ModeManager(peer, model, select_scope(model), trace.log, SETTINGS)
    orchestrator = manager.orchestrator
    decide = orchestrator.turn

    def turn() -> Sequence[Call]:
        calls = decide()
        trace.turn(orchestrator, calls)
        return calls

    vars(orchestrator)["turn"] = turn

    def spin(until: float) -> None:
        while time.monotonic() < until:
            manager.turn()

    end = deadline(60)
    while any(leaf.state == "unknown" or leaf.stale for leaf in orchestrator.leaves.values()):
        manager.turn()
        assert time.monotonic() < end, orchestrator.leaves
    trace.steps.clear()
    begin = time.monotonic()
    for event in events:
        spin(begin + event.time_us / 1e6)
        trace.event(event)
        if event.kind == "request" and event.status is not None:
            orchestrator.request(event.part, event.status)
        else:
            faults.happen(event)
    quiet = time.monotonic()
    end = deadline(120)
    count = -1
    while time.monotonic() - quiet < 8.0 or orchestrator.progress.is_moving("arm"):
        manager.turn()
        if len(trace.steps) != count:
            count, quiet = len(trace.steps), time.monotonic()
        assert time.monotonic() < end, trace.steps
    return trace.steps


def of(steps: Iterable[Step], part: str, *kinds: str) -> list[str]:
    """Return what steps of a part say, event by event, without times: nodes answer in any order.

    States that a node passes are seen or not.
    """
    return [
        f"-- {step.text}" if step.kind == EVENT else f"{step.kind} {step.text}"
        for step in steps
        if step.kind == EVENT
        or (
            step.part == part and step.kind in kinds and not (part != "arm" and step.text in PASSING.values())
        )
    ]


@pytest.mark.parametrize(
    "text",
    [
        """\
- {at: 0 s, refuse: gripper, calls: [activate]}
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 12 s, repair: gripper}
- {at: 12 s, request: arm, target: active.GENTLE}
- {at: 16 s, refuse: joint, calls: [set_parameters], reason: not now}
- {at: 16 s, request: arm, target: active.QUICK}
""",
        pytest.param(
            """\
- {at: 0 s, delay: joint, time: 3 s, calls: [activate]}
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 12 s, repair: joint}
- {at: 12 s, change: joint, parameters: {speed: 0.7}}
- {at: 16 s, leave: joint}
- {at: 26 s, repair: joint}
- {at: 36 s, change: gripper, state: inactive}
""",
            marks=pytest.mark.variant,
        ),
    ],
    ids=["refusing", "late, changed and away"],
)
def test_the_simulation_shows_what_the_manager_does(text: str, stack: ExitStack, domain: int) -> None:
    model = model_of(ARM)
    events = script(text, model)
    played = simulate(model, events, SETTINGS)
    steps = real(model, events, domain, stack)
    for part in model.parts:
        assert of(steps, part, CALL, LOG) == of(played.steps, part, CALL, LOG)
        assert of(steps, part, STATUS) == of(played.steps, part, STATUS)
