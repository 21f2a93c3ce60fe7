# SPDX-License-Identifier: Apache-2.0
"""A script of requests and failures (YAML) → events in the order of time.

- {at: 0 s, request: actuation, target: active.PERFORMANCE}
- {at: 2 s, fail: manipulator, state: inactive}
- {at: 5 s, repair: manipulator}
- {at: 6 s, change: drive_base, state: active.SLOW}
- {at: 7 s, change: drive_base, parameters: {max_speed: 0.2}}
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import field
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, nearest, reads
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.tree_values import items, text_of, time_of
from microros_gen.documents.yaml_tree import MappingNode, SequenceNode, YamlNode, parse_yaml
from microros_gen.modes.model import ERROR, Model, Status, Value
from microros_gen.modes.outline import plain_name
from microros_gen.modes.reader import read_source
from microros_gen.modes.statuses import Subject, parse_status, parse_target
from microros_gen.modes.templates import parameter_type
from microros_gen.modes.values import parse_values
from microros_gen.records import dataclass

REQUEST, FAIL, REPAIR, CHANGE = "request", "fail", "repair", "change"
_KEYS: Mapping[str, tuple[str, ...]] = {
    REQUEST: ("target",),
    FAIL: ("state",),
    REPAIR: (),
    CHANGE: ("state", "parameters"),
}


@dataclass(frozen=True)
class Event:
    """What happens at `time_us`, microseconds: a request, or a failure, repair or change of a node.

    `status` is the target of a request and the state of a failure or change; None: a change of `parameters`.
    """

    time_us: int
    kind: str
    part: str
    status: Status | None = None
    parameters: Mapping[str, Value] = field(default_factory=dict)

    def __str__(self) -> str:
        values = ", ".join(f"{name}: {value.value}" for name, value in self.parameters.items())
        words = [self.kind, self.part, str(self.status or ""), f"{{{values}}}" if values else ""]
        return " ".join(word for word in words if word)


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
        other = next((e for e in node if e.key not in ("at", "target", "state", "parameters")), None)
        hint = nearest(other.key, _KEYS) if other is not None and not kinds else None
        diagnostics.error(message, node.span, hint or "Write one event a line", id="MG-8863")
        return None
    kind = kinds[0]
    check_keys(node, ("at", kind, *_KEYS[kind]), ("at",), diagnostics)
    time_us = _time(node.get("at"), diagnostics)
    part = _part(node.entries[kind].value, kind, model, diagnostics)
    if part is None or time_us is None:
        return None
    return _with_details(Event(time_us, kind, part.name), part, node, model, diagnostics)


def _time(node: YamlNode | None, diagnostics: Diagnostics) -> int | None:
    time_us = time_of(node)
    if time_us is None and node is not None:
        message = "'at' must be a time"
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
    if event.kind == REPAIR:
        return event
    if event.kind == CHANGE and ("state" in node.entries) == ("parameters" in node.entries):
        message = "a change has either a state or parameters"
        diagnostics.error(message, node.span, "Write state: active.MODE", id="MG-8866")
        return None
    if "parameters" in node.entries:
        values = _values(node, part, model, diagnostics)
        return Event(event.time_us, event.kind, event.part, None, values) if values else None
    key = "target" if event.kind == REQUEST else "state"
    value = node.get(key)
    if value is None and event.kind == FAIL:
        return Event(event.time_us, event.kind, event.part, Status(ERROR))
    if value is None:
        check_keys(node, tuple(node.entries), (key,), diagnostics)
        return None
    parse = parse_target if event.kind == REQUEST else parse_status
    status = parse(value, part, diagnostics)
    return Event(event.time_us, event.kind, event.part, status) if status is not None else None


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
