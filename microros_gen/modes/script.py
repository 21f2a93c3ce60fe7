# SPDX-License-Identifier: Apache-2.0
"""A script of requests and faults (YAML) → events in the order of time.

- {at: 0 s, request: actuation, target: active.PERFORMANCE}
- {at: 2 s, fail: manipulator, state: inactive}
- {at: 5 s, repair: manipulator}
- {at: 6 s, change: drive_base, state: active.SLOW}
- {at: 7 s, change: drive_base, parameters: {max_speed: 0.2}}
- {at: 8 s, delay: drive_base, time: 7 s}
- {at: 9 s, refuse: drive_base, calls: [activate], reason: too hot}
- {at: 10 s, silence: drive_base}
- {at: 11 s, leave: drive_base}
- {at: 12 s, diagnose: manipulator, level: warn, name: motor}
- {at: 13 s, hardware: battery, level: warn, name: cell 1}
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import field, replace
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, nearest, reads
from microros_gen.documents.tree_read import check_keys, expect_mapping, read_text
from microros_gen.documents.tree_values import items, text_of, time_of
from microros_gen.documents.yaml_tree import MappingNode, SequenceNode, YamlNode, parse_yaml
from microros_gen.modes.model import ERROR, Model, Status, Value
from microros_gen.modes.node_keys import LEVELS
from microros_gen.modes.outline import plain_name
from microros_gen.modes.reader import read_source
from microros_gen.modes.statuses import Subject, parse_status, parse_target
from microros_gen.modes.templates import parameter_type
from microros_gen.modes.values import parse_values
from microros_gen.records import dataclass

REQUEST, FAIL, REPAIR, CHANGE = "request", "fail", "repair", "change"
DELAY, REFUSE, SILENCE, LEAVE, DIAGNOSE = "delay", "refuse", "silence", "leave", "diagnose"
HARDWARE = "hardware"
DIAGNOSED = ("ok", *LEVELS)
"""Levels of /diagnostics, by their numbers there."""
CALLS = ("configure", "cleanup", "activate", "deactivate", "change_mode", "set_parameters")
"""What a node can refuse: transitions of its life cycle, and the two ways into a mode."""
_KEYS: Mapping[str, tuple[str, ...]] = {
    REQUEST: ("target",),
    FAIL: ("state",),
    REPAIR: (),
    CHANGE: ("state", "parameters"),
    DELAY: ("time", "calls"),
    REFUSE: ("calls", "reason"),
    SILENCE: (),
    LEAVE: (),
    DIAGNOSE: ("level", "name"),
    HARDWARE: ("level", "name"),
}
_DETAILS = frozenset(key for keys in _KEYS.values() for key in keys)


@dataclass(frozen=True)
class Event:
    """What happens at `time_us`, microseconds: a request, or what happens to a node.

    `status` is the target of a request and the state of a failure or change; None: a change of `parameters`.
    `delay_us` is how long a node takes for a response from then on. `calls` are those that are
    late, none: all, or that a node refuses, for `reason`. `level` is what /diagnostics has of a node from then on, for
    its status `name`; of the kind HARDWARE, `part` is no part but a hardware_id.
    """

    time_us: int
    kind: str
    part: str
    status: Status | None = None
    parameters: Mapping[str, Value] = field(default_factory=dict)
    delay_us: int = 0
    calls: tuple[str, ...] = ()
    reason: str = ""
    level: str = ""
    name: str = ""

    def __str__(self) -> str:
        values = ", ".join(f"{name}: {value.value}" for name, value in self.parameters.items())
        words = [self.kind, self.part, str(self.status or ""), f"{{{values}}}" if values else ""]
        words += [seconds_text(self.delay_us) if self.kind == DELAY else "", ", ".join(self.calls)]
        words += [self.name, self.level]
        return " ".join(word for word in words if word)


def seconds_text(time_us: int) -> str:
    """Return a time in microseconds as seconds with their unit."""
    text = f"{time_us // 1_000_000}.{time_us % 1_000_000:06}".rstrip("0").rstrip(".")
    return f"{text} s"


def read_script(path: Path, model: Model) -> tuple[Event, ...]:
    """Return the events of a file. Raises UserError with all that is wrong with them."""
    diagnostics = Diagnostics()
    source = read_source(path, diagnostics)
    events = parse_script(source, model, diagnostics) if source is not None else ()
    diagnostics.check()
    return events


@reads
def parse_script(source: Source, model: Model, diagnostics: Diagnostics) -> tuple[Event, ...]:
    """Return the events that `source` describes; what is wrong is reported and left out."""
    tree = parse_yaml(source, diagnostics)
    if not isinstance(tree, SequenceNode):
        if not diagnostics.has_errors():
            hint = "Write lines such as `- {at: 1 s, request: PART, target: active}`"
            diagnostics.error(f"'{source.name}' is no list of events", hint=hint, id="MG-8861")
        return ()
    events: list[Event] = []
    for item in items(tree):
        event = _event(item, model, diagnostics)
        if event is None:
            continue
        if events and event.time_us < events[-1].time_us:
            message = "the event is before the preceding one"
            diagnostics.error(message, item.span, "Sort the events by time", id="MG-8862")
        events.append(event)
    return tuple(events)


def _event(item: YamlNode, model: Model, diagnostics: Diagnostics) -> Event | None:
    node = expect_mapping(item, "an event", diagnostics)
    if node is None:
        return None
    kinds = [kind for kind in _KEYS if kind in node.entries]
    if len(kinds) != 1:
        message = f"an event has one of {', '.join(_KEYS)}"
        other = next((e for e in node if e.key != "at" and e.key not in _DETAILS), None)
        hint = nearest(other.key, _KEYS) if other is not None and not kinds else None
        diagnostics.error(message, node.span, hint or "Write one event a line", id="MG-8863")
        return None
    kind = kinds[0]
    check_keys(node, ("at", kind, *_KEYS[kind]), ("at",), diagnostics)
    time_us = _time(node, "at", diagnostics)
    if kind == HARDWARE:
        hardware = read_text(node, HARDWARE, diagnostics)
        return None if time_us is None else _diagnosis(Event(time_us, kind, hardware), node, diagnostics)
    part = _part(node.entries[kind].value, kind, model, diagnostics)
    if part is None or time_us is None:
        return None
    return _with_details(Event(time_us, kind, part.name), part, node, model, diagnostics)


def _time(event: MappingNode, key: str, diagnostics: Diagnostics) -> int | None:
    node = event.get(key)
    time_us = time_of(node)
    if time_us is None and node is not None:
        message = f"'{key}' must be a time"
        diagnostics.error(message, node.span, "Write 500 ms, or 2 s", id="MG-8864")
    return time_us


def _part(node: YamlNode, kind: str, model: Model, diagnostics: Diagnostics) -> Subject | None:
    name = plain_name(text_of(node) or "")
    known: Collection[str] = model.parts if kind == REQUEST else [part.name for part in model.nodes]
    if name in known:
        part = model.parts[name]
        return Subject(name, part.is_system, tuple(part.modes))
    what = "part" if kind == REQUEST else "node"
    hint = nearest(name, known) or f"Known: {', '.join(known)}"
    diagnostics.error(f"unknown {what} '{name}'", node.span, hint, id="MG-8865")
    return None


def _with_details(
    event: Event, part: Subject, node: MappingNode, model: Model, diagnostics: Diagnostics
) -> Event | None:
    if not _KEYS[event.kind]:
        return event
    if event.kind == REFUSE:
        return _refusal(event, node, diagnostics)
    if event.kind == DIAGNOSE:
        return _diagnosis(event, node, diagnostics)
    if event.kind == DELAY:
        check_keys(node, tuple(node.entries), ("time",), diagnostics)
        delay_us, calls = _time(node, "time", diagnostics), _calls(node, diagnostics)
        if delay_us is None or calls is None:
            return None
        return replace(event, delay_us=delay_us, calls=calls)
    if event.kind == CHANGE and ("state" in node.entries) == ("parameters" in node.entries):
        message = "a change has either a state or parameters"
        diagnostics.error(message, node.span, "Write state: active.MODE", id="MG-8866")
        return None
    if "parameters" in node.entries:
        values = _values(node, part, model, diagnostics)
        return replace(event, parameters=values) if values else None
    key = "target" if event.kind == REQUEST else "state"
    value = node.get(key)
    if value is None and event.kind == FAIL:
        return replace(event, status=Status(ERROR))
    if value is None:
        check_keys(node, tuple(node.entries), (key,), diagnostics)
        return None
    parse = parse_target if event.kind == REQUEST else parse_status
    status = parse(value, part, diagnostics)
    return replace(event, status=status) if status is not None else None


def _refusal(event: Event, node: MappingNode, diagnostics: Diagnostics) -> Event | None:
    """Return which calls a node refuses: without `calls` all of them."""
    calls = _calls(node, diagnostics)
    reason = read_text(node, "reason", diagnostics)
    return replace(event, calls=calls or CALLS, reason=reason) if calls is not None else None


def _diagnosis(event: Event, node: MappingNode, diagnostics: Diagnostics) -> Event | None:
    check_keys(node, tuple(node.entries), ("level",), diagnostics)
    value = node.get("level")
    if value is None:
        return None
    level = text_of(value) or ""
    if level not in DIAGNOSED:
        hint = nearest(level, DIAGNOSED) or f"Known: {', '.join(DIAGNOSED)}"
        diagnostics.error(f"unknown level '{level}' of a diagnosis", value.span, hint, id="MG-8884")
        return None
    return replace(event, level=level, name=read_text(node, "name", diagnostics))


def _calls(event: MappingNode, diagnostics: Diagnostics) -> tuple[str, ...] | None:
    """Return the names of `calls`, none where it is not there; None: they are wrong."""
    listed = event.get("calls")
    names = [text_of(item) or "" for item in items(listed)]
    for item, name in zip(items(listed), names, strict=True):
        if name not in CALLS:
            hint = nearest(name, CALLS) or f"Known: {', '.join(CALLS)}"
            diagnostics.error(f"unknown call '{name}'", item.span, hint, id="MG-8878")
    if listed is not None and not names:
        hint = "Write calls: [activate], or leave it out for all of them"
        diagnostics.error("'calls' must be a list of calls", listed.span, hint, id="MG-8879")
        return None
    return tuple(names) if all(name in CALLS for name in names) else None


def _values(node: MappingNode, part: Subject, model: Model, diagnostics: Diagnostics) -> Mapping[str, Value]:
    found: dict[str, Value] = {}
    names = {name for mode in model.parts[part.name].modes.values() for name in mode.parameters}
    values = expect_mapping(node.get("parameters"), "'parameters' of a change", diagnostics)
    for name, value in parse_values(values, diagnostics).items():
        wanted = parameter_type(model, model.parts[part.name], name)
        if name not in names:
            hint = nearest(name, names) or f"Known: {', '.join(sorted(names))}"
            message = f"no mode of '{part.name}' sets the parameter '{name}'"
            diagnostics.error(message, value.name_span, hint, id="MG-8867")
        elif value.parent or value.type != wanted:
            message = f"the parameter '{name}' takes a value of type {wanted}"
            hint = "Write it with a decimal point" if wanted == "double" else "Change the value"
            diagnostics.error(message, value.span, hint, id="MG-8868")
        else:
            found[name] = value
    return found
