# SPDX-License-Identifier: Apache-2.0
"""Plays a script of requests and faults on a model with the orchestration of the manager, and nodes without ROS.

The manager knows its nodes when the script begins. The same files give the same trace.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any

from microros_gen.mode_manager.calls import (
    ACTIVATE,
    CLEANUP,
    COMMANDS,
    CONFIGURE,
    DEACTIVATE,
    Call,
    Kind,
    Link,
)
from microros_gen.mode_manager.diagnosis import PartStatus, error_of
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.mode_manager.problems import Problems
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulated_node import ANSWER_S, GOALS, PASSING, SimulatedNode
from microros_gen.mode_manager.simulated_world import SimulatedWorld
from microros_gen.modes.model import (
    ACTIVE,
    DEFAULT,
    ERROR,
    INACTIVE,
    UNCONFIGURED,
    UNKNOWN,
    Model,
    Part,
    Scalar,
    Status,
)
from microros_gen.modes.node_keys import LEVELS
from microros_gen.modes.script import (
    CHANGE,
    DELAY,
    DIAGNOSE,
    FAIL,
    HARDWARE,
    LEAVE,
    REFUSE,
    REPAIR,
    REQUEST,
    SILENCE,
    Event,
    seconds_text,
)
from microros_gen.modes.templates import resolve
from microros_gen.records import dataclass

EVENT, CALL, STATUS, LOG = "event", "call", "status", "log"
"""Kinds of steps: of the script, a command of the manager, what it knows of a part, and a line of its log."""
MOST_S = 600
"""Seconds after the last event in which the parts have to come to rest."""
_WIDTH = 10
_BEFORE_US = 1_000_000
_CALLS: Mapping[str, tuple[Kind, int]] = {
    "configure": (Kind.CHANGE_STATE, CONFIGURE),
    "cleanup": (Kind.CHANGE_STATE, CLEANUP),
    "activate": (Kind.CHANGE_STATE, ACTIVATE),
    "deactivate": (Kind.CHANGE_STATE, DEACTIVATE),
    "change_mode": (Kind.CHANGE_MODE, 0),
    "set_parameters": (Kind.SET_PARAMETERS, 0),
}
_REPAIRED = (UNCONFIGURED, INACTIVE, ACTIVE)


@dataclass(frozen=True)
class Step:
    """One step of a trace at `time_us`, microseconds; `part` is empty where it concerns none."""

    time_us: int
    kind: str
    part: str
    text: str


class Trace:
    """Notes what a manager decides: its commands, the lines of its log, and each status that is another one."""

    def __init__(self) -> None:
        """Begin with nothing; `now_us` is set by whoever has the clock."""
        self.now_us = 0
        self.steps: list[Step] = []
        self._shown: dict[str, Status] = {}

    def event(self, event: Event) -> None:
        """Note an event of the script."""
        self._add(EVENT, event.part, str(event))

    def log(self, line: str) -> None:
        """Note a line of the log; the part is before its colon."""
        part, _, text = line.partition(": ")
        self._add(LOG, part, text)

    def turn(self, manager: Orchestrator, calls: Iterable[Call]) -> None:
        """Note what a turn gave: the statuses that differ from those before, and commands."""
        for name, status in manager.statuses().items():
            if self._shown.get(name) != status:
                self._shown[name] = status
                self._add(STATUS, name, str(status))
        for call in calls:
            if call.kind in COMMANDS:
                self._add(CALL, call.part, str(call))

    def _add(self, kind: str, part: str, text: str) -> None:
        self.steps.append(Step(self.now_us, kind, part, text))


@dataclass(frozen=True)
class End:
    """Where a part is in the end; `target` None: nothing was requested of it. `failure`: why it is not there."""

    part: str
    status: Status
    target: Status | None
    failure: str


@dataclass(frozen=True)
class Played:
    """A whole trace. `oscillating`: systems whose rules never ended. `rests` false: parts were still on their way."""

    steps: tuple[Step, ...]
    ends: tuple[End, ...]
    oscillating: tuple[str, ...]
    rests: bool

    @property
    def is_stable(self) -> bool:
        """Return whether all came to rest without rules that oscillate."""
        return self.rests and not self.oscillating

    def text(self) -> str:
        """Return the trace as lines."""
        lines: list[str] = []
        shown = ""
        for step in self.steps:
            time = seconds_text(step.time_us)
            is_event = step.kind == EVENT
            head = time if is_event or time != shown else ""
            lines.append(f"{head:<{_WIDTH}}{_words(step)}")
            shown = time
        for i, end in enumerate(self.ends):
            lines.append(f"{'' if i else 'end':<{_WIDTH}}{end.part} {end.status}{_deviation(end)}")
        if not self.rests:
            lines.append(f"parts are on their way after {MOST_S} s")
        return "".join(f"{line}\n" for line in lines)

    def data(self) -> dict[str, Any]:
        """Return the trace as data for JSON; times in microseconds."""
        return {
            "version": 1,
            "stable": self.is_stable,
            "steps": [
                {"time_us": s.time_us, "kind": s.kind, "part": s.part, "text": s.text} for s in self.steps
            ],
            "end": [
                {
                    "part": e.part,
                    "status": str(e.status),
                    "target": str(e.target) if e.target else "",
                    "failure": e.failure,
                }
                for e in self.ends
            ],
        }


def simulate(
    model: Model,
    events: Iterable[Event],
    settings: Settings | None = None,
    with_services: Collection[str] = (),
) -> Played:
    """Return what a manager of the whole model does when `events` happen.

    Nodes are unconfigured at first and have the parameters of `__DEFAULT__`; `with_services` have mode services.
    """
    play = _Play(model, settings or Settings(), with_services)
    for event in events:
        play.run_until(event.time_us)
        play.happen(event)
    rests = play.run_to_rest()
    manager = play.world.manager
    statuses = manager.statuses()
    ends = [
        End(name, statuses[name], target, manager.leaves[name].failure if name in manager.leaves else "")
        for name, target in ((name, manager.targets.get(name)) for name in model.parts)
    ]
    return Played(tuple(play.trace.steps), tuple(ends), tuple(sorted(manager.oscillating)), rests)


class _Play:
    """A world with a trace, in which events happen."""

    def __init__(self, model: Model, settings: Settings, with_services: Collection[str]) -> None:
        self._model = model
        self._settings = settings
        self._links = {
            n.name: Link.MODES if n.name in with_services else Link.PARAMETERS for n in model.nodes
        }
        nodes = {node.name: self._fresh(node) for node in model.nodes}
        self.trace = Trace()
        self._outside: dict[tuple[str, str], str] = {}
        scope = select_scope(model)
        self.world = SimulatedWorld(model, nodes, scope, settings, self._log, self._turn)
        self._problems = Problems(self.world.manager)
        self.world.run(_BEFORE_US)
        self.trace.steps.clear()  # what the manager learns first is no part of the script

    def run_until(self, time_us: int) -> None:
        """Let time pass until a time of the script."""
        self.world.run(time_us + _BEFORE_US - self.world.now_us)

    def run_to_rest(self) -> bool:
        """Let time pass until nothing follows any more; return false if that does not happen.

        Parts are polled once in the last part of it, in which the manager finds nothing.
        """
        settings = self._settings
        quiet_us = round((settings.poll_s + settings.call_s + settings.pause_s) * 1e6)
        end = self.world.now_us + MOST_S * 1_000_000
        manager, steps = self.world.manager, -1
        while len(self.trace.steps) != steps or any(map(manager.progress.is_moving, manager.scope.roots)):
            if self.world.now_us >= end:
                return False
            steps = len(self.trace.steps)
            self.world.run(quiet_us)
        return True

    def happen(self, event: Event) -> None:
        """Let an event happen now."""
        self.trace.now_us = event.time_us
        self.trace.event(event)
        if event.kind == REQUEST and event.status is not None:
            self.world.manager.request(event.part, event.status)
            return
        if event.kind == HARDWARE:
            self._outside[event.part, event.name] = event.level if event.level in LEVELS else ""
            self._repeat()
            return
        node = self.world.nodes[event.part]
        if event.kind == REPAIR:
            self._repair(event.part, node)
        elif event.kind == FAIL and event.status is not None:
            self._fail(event.part, node, event.status)
        elif event.kind == CHANGE:
            self._change(event.part, node, event)
        elif event.kind == DELAY:
            node.delay_s = event.delay_us / 1e6
            node.delays = _among(event.calls) if event.calls else lambda _: True
        elif event.kind == REFUSE:
            node.refuses, node.reason = _among(event.calls), event.reason
        elif event.kind == SILENCE:
            node.is_dead = True
        elif event.kind == LEAVE:
            self.world.leave(event.part)
        elif event.kind == DIAGNOSE:
            self._diagnose(event)

    def _diagnose(self, event: Event) -> None:
        """Let /diagnostics have a status of a node, as the manager reads it."""
        level = event.level if event.level in LEVELS else ""
        text = error_of(self._model.parts[event.part].diagnostics, event.name, level, "")
        self._problems.report(PartStatus(event.part, event.name, level, text))

    def _repeat(self) -> None:
        """Let /diagnostics have the statuses of no part once more, as their publishers repeat them."""
        for (hardware, name), level in self._outside.items():
            self.world.manager.diagnosed.hear_outside(hardware, name, level)

    def _turn(self, calls: Sequence[Call]) -> None:
        self._repeat()
        self.trace.now_us = self.world.now_us - _BEFORE_US
        self.trace.turn(self.world.manager, calls)

    def _log(self, line: str) -> None:
        self.trace.now_us = self.world.now_us - _BEFORE_US
        self.trace.log(line)

    def _fresh(self, node: Part) -> SimulatedNode:
        link, values = self._links[node.name], self._values(node, DEFAULT, {})
        if link is not Link.MODES:
            return SimulatedNode(link, values=values)
        own = {
            mode.name: {n: v.value for n, v in mode.parameters.items() if v.value is not None}
            for mode in node.modes.values()
        }
        return SimulatedNode(link, values=values, serves_parameters=True, mode_values=own)

    def _values(
        self, node: Part, mode: str, targets: Mapping[str, Status]
    ) -> dict[str, Scalar | tuple[Scalar, ...]]:
        values = resolve(self._model, node, node.modes[mode], targets)
        return {name: value for name, value in values.items() if value is not None}

    def _fail(self, name: str, node: SimulatedNode, status: Status) -> None:
        """Let a node be in a status in which it stays whatever is commanded; unknown: it has left."""
        node.refuses, node.reason = (lambda _: True), "it has failed"
        if status.state == UNKNOWN:
            self.world.leave(name)
        else:
            self._become(name, node, status)

    def _repair(self, name: str, node: SimulatedNode) -> None:
        """Let a node follow again. One that cannot go on by itself, or has left, is started again."""
        node.refuses, node.reason, node.delay_s = (lambda _: False), "", ANSWER_S
        node.busy_until = 0.0  # responses that it still owes delay no others
        has_left = self.world.manager.leaves[name].link is Link.ABSENT
        if has_left or node.state not in (*_REPAIRED, ERROR):
            self.world.leave(name)
            self.world.join(name, self._fresh(self._model.parts[name]))
            return
        node.is_dead = False
        if node.state == ERROR:
            self._become(name, node, Status(UNCONFIGURED))

    def _change(self, name: str, node: SimulatedNode, event: Event) -> None:
        if event.status is not None:
            goal = event.status.state
            for (before, transition), after in GOALS.items():
                if (before, after) == (node.state, goal):
                    self._publish(name, Kind.GET_STATE, PASSING[transition])
            self._become(name, node, event.status)
            return
        values = {n: v.value for n, v in event.parameters.items() if v.value is not None}
        node.values.update(values)
        self._publish(name, Kind.GET_PARAMETERS, values)

    def _become(self, name: str, node: SimulatedNode, status: Status) -> None:
        """Let a node be in a status, and publish that."""
        if status.state != node.state:
            node.state = status.state
            self._publish(name, Kind.GET_STATE, status.state)
        if status.state != ACTIVE:
            return
        mode = status.mode or DEFAULT
        node.mode = mode
        values = self._values(self._model.parts[name], mode, self.world.manager.targets)
        node.values.update(values)
        self._publish(name, Kind.GET_PARAMETERS, values)
        if node.link is Link.MODES:
            self._publish(name, Kind.GET_MODE, mode)

    def _publish(self, name: str, kind: Kind, what: Any) -> None:
        if not self.world.nodes[name].is_dead:
            self.world.publish(name, kind, what)


def _among(names: Collection[str]) -> Callable[[Call], bool]:
    """Return a test whether a call is one of those that a script names."""
    known = [_CALLS[name] for name in names]
    return lambda call: (call.kind, call.transition) in known


def _words(step: Step) -> str:
    if step.kind == EVENT:
        return step.text
    return f"  {step.part}: {step.text}" if step.kind == LOG else f"  {step.kind} {step.part} {step.text}"


def _deviation(end: End) -> str:
    if end.target is None or end.status.is_same(end.target):
        return ""
    return f", target {end.target}{f': {end.failure}' if end.failure else ''}"
