# SPDX-License-Identifier: Apache-2.0
"""What the selected components contribute, as the shared templates print it: direct calls, members, constants.

A template loops over this and names no component. The order within a phase is that of the components: each after
what it needs, else by name; so it does not depend on the order in which anything was selected.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping

from microros_gen.client.plan.values import Values
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.contribution import (
    CONFIG_SECTIONS,
    HANDLE_SECTIONS,
    HOOK_POINTS,
    OUTPUT_FUNCTIONS,
    OUTPUT_STREAMS,
    RETAINED_SECTIONS,
    STATE_SECTIONS,
    TRANSPORT_SECTIONS,
    Conditional,
    Contributions,
    ErrorCode,
    Hook,
    Include,
    Kept,
    Setting,
    State,
)
from microros_gen.selection.xrce import SUBMESSAGES

Holds = Callable[[Conditional], bool]
ValueOf = Callable[[str], object]
_OUTPUT_PARAMETERS: Mapping[str, tuple[str, ...]] = {
    "reserve": ("client", "reliable"),
    "commit": ("client", "reliable", "size"),
    "capacity": ("reliable",),
    "drop_oldest": ("client",),
    "unacknowledged": ("client",),
    "passes": ("client", "mark"),
}
_LONGEST_RETURNED = 100
"""Characters of an expression that `return` has in one line."""
_ELSEWHERE: Mapping[str, tuple[str, ...]] = {
    "session": ("received", "handled"),
    "due": ("due", "due_always"),
    "woken": ("woken",),
    "support": ("support_opened", "support_closed"),
    "node": ("node_opened", "node_closing"),
    "receiver": ("receiver_opened", "receiver_closed"),
    "waiting": ("pumped", "rests", "rested"),
    "round": ("round_begins", "round_ends"),
    "contingency": ("contingency",),
    "clock_jump": ("clock_jump",),
}
_CALLERS: Mapping[str, tuple[str, ...]] = {
    **_ELSEWHERE,
    "routes": ("on", *(set(HOOK_POINTS) - {name for points in _ELSEWHERE.values() for name in points})),
}
"""File that calls → its hook points; `on` means submessages and output streams."""
_RELIABLE_ALONE = ("drop_oldest", "unacknowledged", "passes")
_AFTER_RESERVE = ("commit",)
"""Called only for a stream whose `reserve` found room: no question where one stream alone is selected."""


@dataclass(frozen=True)
class Call:
    """A call, with what `takes` asks before it; `unused` are variables of its function that nothing else uses."""

    call: str
    test: str = ""


@dataclass(frozen=True)
class Point:
    """The calls of a hook point. `all`: whether each of them says so, as one expression."""

    calls: tuple[Call, ...]
    unused: tuple[str, ...]

    @property
    def all(self) -> str:
        """Return the calls joined by `&&`."""
        return " && ".join(call.call for call in self.calls) or "true"


@dataclass(frozen=True)
class Block:
    """Steps one after the other, all under one gate or none."""

    gate: str
    calls: tuple[Call, ...]


@dataclass(frozen=True)
class Handlers:
    """A kind of submessage and the functions that take it."""

    submessage: str
    functions: tuple[str, ...]


@dataclass(frozen=True)
class Member:
    """A member of the client."""

    declaration: str
    comment: str

    @property
    def name(self) -> str:
        """Return the member's name: `creation` of `uint8_t creation[SIZE]`."""
        return re.sub(r"\[.*", "", self.declaration).split()[-1].lstrip("*")

    @property
    def line(self) -> str:
        """Return the line that declares it."""
        return f"{self.declaration};" + (f" /* {self.comment} */" if self.comment else "")

    @property
    def count(self) -> str:
        """Return how many elements it has; empty: it is no array."""
        found = re.search(r"\[(.*)\]", self.declaration)
        return found.group(1) if found else ""


@dataclass(frozen=True)
class Moments:
    """A member with fields that hold moments; of an array, each element has them."""

    member: Member
    fields: tuple[str, ...]
    owner: str
    """What precedes its name in C: `client->`, or nothing for a variable."""

    @property
    def elements(self) -> str:
        """Return how many elements the array has; empty: the member is none."""
        return self.member.count


@dataclass(frozen=True)
class Output:
    """What a function of the output streams returns, and which of its parameters that leaves unused."""

    value: str
    unused: tuple[str, ...]


@dataclass(frozen=True)
class Contributed:
    """Everything that the selected components contribute. Mappings have every point, section and function."""

    hook_headers: Mapping[str, tuple[str, ...]]
    hooks: Mapping[str, Point]
    steps: tuple[Block, ...]
    handlers: tuple[Handlers, ...]
    state: Mapping[str, tuple[Member, ...]]
    state_headers: tuple[str, ...]
    retained_headers: tuple[str, ...]
    moments: tuple[Moments, ...]
    kept: tuple[Kept, ...]
    output: Mapping[str, Output]
    errors: tuple[ErrorCode, ...]
    error_texts: tuple[ErrorCode, ...]
    config: Mapping[str, tuple[str, ...]]
    includes: Mapping[str, tuple[str, ...]]
    properties: str


def contributed(components: Iterable[Component], values: Values) -> Contributed:
    """Return what `components` contribute to a plan with `values`."""

    def holds(part: Conditional) -> bool:
        return values.holds(part.when)

    value_of = values.value
    parts = [c.contributes for c in in_order(components)]
    hooks = [h for p in parts for h in p.hooks if holds(h)]
    states = [s for p in parts for s in p.state if holds(s)]
    handlers = [h for p in parts for h in p.handlers if holds(h)]
    outputs = {o.stream: dict(o.calls) for p in parts for o in p.outputs if holds(o)}
    settings = [s for p in parts for s in p.config if holds(s)]
    errors = tuple(sorted((e for p in parts for e in p.errors), key=lambda e: e.code))
    properties = [(q.name, value_of(q.value), q.digits) for p in parts for q in p.properties if holds(q)]
    return Contributed(
        hook_headers={file: _headers(parts, points, holds) for file, points in _CALLERS.items()},
        hooks={name: _point(name, hooks) for name in HOOK_POINTS},
        steps=tuple(_steps(hooks)),
        handlers=tuple(
            Handlers(name, tuple(h.function for h in handlers if h.submessage == name))
            for name in SUBMESSAGES
            if any(h.submessage == name for h in handlers)
        ),
        state={
            section: _members(s for s in states if s.section == section)
            for section in (*STATE_SECTIONS, *HANDLE_SECTIONS, *TRANSPORT_SECTIONS, *RETAINED_SECTIONS)
        },
        state_headers=tuple(sorted({s.header for s in states if s.header and s.section in STATE_SECTIONS})),
        retained_headers=tuple(
            sorted({s.header for s in states if s.header and s.section in RETAINED_SECTIONS})
        ),
        moments=tuple(Moments(_member(s), s.clocks, _owner(s)) for s in states if s.clocks),
        kept=tuple(k for p in parts for k in p.kept if holds(k)),
        output={name: _output(name, outputs) for name in OUTPUT_FUNCTIONS},
        errors=errors,
        error_texts=tuple(e for e in errors if e.text),
        config={
            section: tuple(dict.fromkeys(_define(s, value_of) for s in settings if s.section == section))
            for section in CONFIG_SECTIONS
        },
        includes=_includes(i for p in parts for i in p.includes if holds(i)),
        properties=", ".join(_properties(properties)),
    )


def in_order(components: Iterable[Component]) -> tuple[Component, ...]:
    """Return the components by name, but each after those that it needs."""
    waiting = {c.name: c for c in sorted(components, key=lambda c: c.name)}
    found: dict[str, Component] = {}
    while waiting:
        name = next(n for n, c in waiting.items() if not any(need in waiting for need in c.needs))
        found[name] = waiting.pop(name)
    return tuple(found.values())


def _headers(parts: Iterable[Contributions], points: tuple[str, ...], holds: Holds) -> tuple[str, ...]:
    """Return the headers of the components that are called at one of `points`, sorted."""
    found: set[str] = set()
    for part in parts:
        called = any(h.point in points and holds(h) for h in part.hooks)
        if called or ("on" in points and any(map(holds, (*part.handlers, *part.outputs)))):
            found |= {h.header for h in part.hook_headers if holds(h)}
    return tuple(sorted(found))


def _point(name: str, hooks: Iterable[Hook]) -> Point:
    point = HOOK_POINTS[name]
    calls = tuple(
        Call(h.call, h.test) for phase in point.phases for h in hooks if (h.point, h.phase) == (name, phase)
    )
    return Point(calls, _unused(point.variables, *(c.call for c in calls)))


def _steps(hooks: Iterable[Hook]) -> Iterator[Block]:
    for phase in HOOK_POINTS["step"].phases:
        calls = tuple(Call(h.call) for h in hooks if (h.point, h.phase) == ("step", phase))
        gates = [h.call for h in hooks if (h.point, h.phase) == ("gate", phase)]
        if calls:
            yield Block(" && ".join(gates), calls)


def _member(state: State) -> Member:
    return Member(state.declaration, state.comment)


def _owner(state: State) -> str:
    return "" if state.section in RETAINED_SECTIONS else "client->"


def _members(states: Iterable[State]) -> tuple[Member, ...]:
    """Return the members; what two components declare is there once, with the first one's comment."""
    found: dict[str, Member] = {}
    for state in states:
        found.setdefault(state.declaration, _member(state))
    return tuple(found.values())


def _output(function: str, streams: Mapping[str, Mapping[str, str]]) -> Output:
    """Return the choice between the streams; one expression where both are the same."""
    none = OUTPUT_FUNCTIONS[function]
    reliable, best_effort = (streams.get(name, {}).get(function, none) for name in OUTPUT_STREAMS)
    if function in _RELIABLE_ALONE or best_effort == reliable:
        value = reliable
    elif function in _AFTER_RESERVE and none in (reliable, best_effort):
        value = best_effort if reliable == none else reliable
    else:
        value = f"reliable ? {reliable} : {best_effort}"
        if len(value) > _LONGEST_RETURNED:
            value = f"reliable ? {reliable}\n                  : {best_effort}"
    return Output(value, _unused(_OUTPUT_PARAMETERS[function], value))


def _unused(variables: tuple[str, ...], *texts: str) -> tuple[str, ...]:
    used = {word for text in texts for word in re.findall(r"(?<![\w>.])\w+", text)}
    return tuple(name for name in variables if name not in used)


def _includes(includes: Iterable[Include]) -> Mapping[str, tuple[str, ...]]:
    """Return the headers for each header that gathers others, sorted."""
    found: dict[str, set[str]] = {}
    for include in includes:
        found.setdefault(include.into, set()).add(include.header)
    return defaultdict(tuple, {into: tuple(sorted(headers)) for into, headers in found.items()})


def _define(setting: Setting, value_of: ValueOf) -> str:
    comment = f" /* {setting.comment} */" if setting.comment else ""
    return f"#define {setting.name} {_constant(value_of(setting.value))}{comment}"


def _constant(value: object) -> str:
    """Return a constant of C: `512u`, `1u` for true, `"192.168.1.10"`."""
    return f"{int(value)}u" if isinstance(value, int) else f'"{value}"'


def _properties(properties: list[tuple[str, object, int]]) -> Iterator[str]:
    """Yield the bytes of an optional PropertySeq at byte 21 of a message, as C, up to where 16 bits may follow.

    Numbers of 32 bits begin at multiples of four of the message: they are lengths, of the sequence and of each string.
    """
    if not properties:
        yield "0"
        return
    octets: list[str] = ["1", "0", "0", str(len(properties)), "0", "0", "0"]
    for name, value, digits in properties:
        for text in (name, f"{value:0{digits}d}"):
            while len(octets) % 4 != 3:
                octets.append("0")
            octets += [str(len(text) + 1), "0", "0", "0", *(f"'{letter}'" for letter in text), "0"]
    yield from (*octets, "0") if len(octets) % 2 == 0 else octets
