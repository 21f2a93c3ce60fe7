# SPDX-License-Identifier: Apache-2.0
"""Plays a script of requests and failures on a model. The same files give the same trace."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from microros_gen.modes.inference import Inference
from microros_gen.modes.manager import OSCILLATION, Manager, Step
from microros_gen.modes.model import ACTIVE, DEFAULT, Model, Scalar, Status
from microros_gen.modes.script import CHANGE, FAIL, REPAIR, REQUEST, Event
from microros_gen.modes.templates import resolve
from microros_gen.records import dataclass

_WIDTH = 10


@dataclass(frozen=True)
class PlayedEvent:
    """An event and what followed from it."""

    event: Event
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class End:
    """Where a part is when the script ends; `target` None: nothing was requested of it."""

    part: str
    status: Status
    target: Status | None


@dataclass(frozen=True)
class Played:
    """A whole trace. `is_stable` false: rules oscillated after an event."""

    events: tuple[PlayedEvent, ...]
    ends: tuple[End, ...]

    @property
    def is_stable(self) -> bool:
        """Return whether no rules oscillated."""
        return all(step.kind != OSCILLATION for played in self.events for step in played.steps)

    def text(self) -> str:
        """Return the trace as lines."""
        lines: list[str] = []
        for played in self.events:
            lines.append(f"{_seconds(played.event.time_us):<{_WIDTH}}{played.event}")
            lines += [f"{'':<{_WIDTH}}  {step}" for step in played.steps]
        for i, end in enumerate(self.ends):
            lines.append(f"{'' if i else 'end':<{_WIDTH}}{end.part} {end.status}{_deviation(end)}")
        return "".join(f"{line}\n" for line in lines)

    def data(self) -> dict[str, Any]:
        """Return the trace as data for JSON; times in microseconds."""
        return {
            "version": 1,
            "stable": self.is_stable,
            "events": [
                {
                    "time_us": played.event.time_us,
                    "event": str(played.event),
                    "steps": [
                        {"kind": s.kind, "part": s.part, "status": str(s.status), "rule": s.rule}
                        for s in played.steps
                    ],
                }
                for played in self.events
            ],
            "end": [
                {"part": e.part, "status": str(e.status), "target": str(e.target) if e.target else ""}
                for e in self.ends
            ],
        }


def simulate(model: Model, events: Iterable[Event]) -> Played:
    """Return what happens when `events` happen one after another."""
    manager = Manager(model)
    changed: dict[str, dict[str, Scalar | tuple[Scalar, ...]]] = {}
    played = tuple(PlayedEvent(event, tuple(_play(manager, event, changed))) for event in events)
    statuses = manager.statuses()
    ends = (End(name, statuses[name], manager.targets.get(name)) for name in model.parts)
    return Played(played, tuple(ends))


def _play(
    manager: Manager, event: Event, changed: dict[str, dict[str, Scalar | tuple[Scalar, ...]]]
) -> Iterator[Step]:
    if event.kind == REPAIR:
        yield from manager.repair(event.part)
    elif event.kind == REQUEST and event.status is not None:
        yield from manager.request(event.part, event.status)
    elif event.kind == FAIL and event.status is not None:
        yield from manager.fail(event.part, event.status)
    elif event.kind == CHANGE:
        status = event.status or _status_of_parameters(manager, event, changed)
        yield from manager.change(event.part, status)


def _status_of_parameters(
    manager: Manager, event: Event, changed: dict[str, dict[str, Scalar | tuple[Scalar, ...]]]
) -> Status:
    """Return the status of a node whose parameters changed; those of a node that is not active say nothing."""
    status = manager.nodes[event.part]
    if status.state != ACTIVE:
        return status
    node = manager.model.parts[event.part]
    values = resolve(manager.model, node, node.modes[status.mode or DEFAULT], manager.targets)
    known = {name: value for name, value in values.items() if value is not None}
    if not status.mode:
        known.update(changed.get(event.part, {}))
    known.update({n: v.value for n, v in event.parameters.items() if v.value is not None})
    changed[event.part] = known
    return Inference(manager.model).infer_node(node, known, manager.targets)


def _seconds(time_us: int) -> str:
    text = f"{time_us // 1_000_000}.{time_us % 1_000_000:06}".rstrip("0").rstrip(".")
    return f"{text} s"


def _deviation(end: End) -> str:
    if end.target is None or end.status.is_same(end.target):
        return ""
    return f", target {end.target}"
