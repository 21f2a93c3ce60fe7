# SPDX-License-Identifier: Apache-2.0
"""A system with its nodes, their modes and rules, as data.

The terms are those of the package system_modes: a *system* has *parts*, which are nodes or systems; a mode of a node
is a set of parameter values, a mode of a system is a state, and where that is active a mode, of each part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field

from microros_gen.diagnostics import Source, Span
from microros_gen.documents.named import Named
from microros_gen.records import dataclass

DEFAULT = "__DEFAULT__"
"""The mode of a part that is activated without a mode; every other mode inherits from it."""

ACTIVE, INACTIVE, UNCONFIGURED = "active", "inactive", "unconfigured"
FINALIZED, UNKNOWN, ERROR = "finalized", "unknown", "errorprocessing"
ACTIVATING, DEACTIVATING = "activating", "deactivating"

STATES = (
    UNKNOWN,
    UNCONFIGURED,
    INACTIVE,
    ACTIVE,
    FINALIZED,
    "configuring",
    "cleaningup",
    "shuttingdown",
    ACTIVATING,
    DEACTIVATING,
    ERROR,
)
"""The states of lifecycle_msgs/msg/State as the package spells them."""

WARN_LEVEL, ERROR_LEVEL, STALE_LEVEL = "warn", "error", "stale"
"""Levels of /diagnostics that can be errors of a node, or let a rule apply."""
_AT_LEAST = {
    WARN_LEVEL: (WARN_LEVEL, ERROR_LEVEL),
    ERROR_LEVEL: (ERROR_LEVEL,),
    STALE_LEVEL: (STALE_LEVEL,),
}

MANAGER_HARDWARE = "mode manager"
"""`hardware_id` of what managers publish there; it is no status of a part, and no rule wants it."""

Reported = Mapping[str, Mapping[str, str]]
"""Node → name of a status on /diagnostics, without that of the node → its level. Those that are OK can be left out.

What is of no part of the model is in it by its hardware_id, as `outside` writes that, and by its whole name."""

_OUTSIDE = "hardware "
"""Begins keys of `Reported` that are no parts; their names have no spaces."""

Scalar = bool | int | float | str


@dataclass(frozen=True)
class Status:
    """A state of the life cycle and, where it is active, a mode; `mode` empty: an active node is in no known mode."""

    state: str
    mode: str = ""

    def __str__(self) -> str:
        return f"{self.state}.{self.mode}" if self.mode else self.state

    def is_same(self, other: Status) -> bool:
        """Return whether both are one state, and one mode where that is active."""
        return self.state == other.state and (self.state != ACTIVE or self.mode == other.mode)


def active(mode: str = DEFAULT) -> Status:
    """Return the status active in `mode`."""
    return Status(ACTIVE, mode)


@dataclass(frozen=True)
class Value:
    """A parameter value in a mode. `type` is bool, integer, double, string or `T[]`.

    `parent` is not empty: the value is that of the parameter `parent` of the system that the part is in, `value` is
    None and `type` empty. `span` is the place of the value, `name_span` that of its name.
    """

    value: Scalar | tuple[Scalar, ...] | None
    type: str
    span: Span
    name_span: Span
    parent: str = ""


@dataclass(frozen=True)
class Command:
    """What a mode of a system commands one of its parts to be."""

    target: Status
    span: Span


@dataclass(frozen=True)
class Mode:
    """A mode with all that it inherits from `__DEFAULT__`; `commands` are those of a system, by part."""

    name: str
    span: Span
    parameters: Mapping[str, Value] = field(default_factory=dict)
    commands: Mapping[str, Command] = field(default_factory=dict)


def outside(hardware: str) -> str:
    """Return the key of the statuses with a hardware_id that belong to no part of the model."""
    return f"{_OUTSIDE}{hardware}"


def part_of(status: str, parts: Iterable[str]) -> str:
    """Return the part that a status on /diagnostics belongs to, by its name; empty: to none of `parts`.

    The name is that of the part, or begins with it and a colon, as diagnostic_updater writes it.
    """
    name = status.lstrip("/")
    return next((part for part in parts if name == part or name.startswith(f"{part}:")), "")


def is_named(name: str, names: Iterable[str]) -> bool:
    """Return whether a status has one of these names; `motor*` is each name that begins with motor."""
    return any(name.startswith(n[:-1]) if n.endswith("*") else name == n for n in names)


@dataclass(frozen=True)
class RuleDiagnostics:
    """What a rule wants of the statuses of its node: one of `names` (none: any of all) with one of `levels`.

    With `hardware` it wants that of statuses of no part, which have this hardware_id; `board*` and `*` are patterns.

    `warn` is also fulfilled by ERROR, as an error is worse; `stale` by nothing else. `span` is the place of the levels.
    """

    levels: tuple[str, ...]
    names: tuple[Named, ...]
    span: Span
    hardware: str = ""

    @property
    def patterns(self) -> tuple[str, ...]:
        """Return the names; `*` if none were given."""
        return tuple(named.name for named in self.names) or ("*",)

    def covers(self, name: str, level: str) -> bool:
        """Return whether a status `name` (without the node's) with this level fulfills it."""
        return any(level in _AT_LEAST[own] for own in self.levels) and is_named(name, self.patterns)

    def is_about(self, key: str, name: str) -> bool:
        """Return whether a status `name` of no part, with a key as `outside` writes it, is one of those it wants."""
        is_meant = key.startswith(_OUTSIDE) and is_named(key[len(_OUTSIDE) :], (self.hardware,))
        return is_meant and is_named(name, self.patterns)

    def first(self, node: str, reported: Reported) -> str:
        """Return the first status that fulfills it, as `node: name: level`, or `name: level`; empty: none does."""
        if not self.hardware:
            own = reported.get(node, {})
            found = ((name, level) for name, level in own.items() if self.covers(name, level))
            return next(
                (f"{node}: {name}: {level}" if name else f"{node}: {level}" for name, level in found), ""
            )
        others = (
            f"{name}: {level}"
            for key, statuses in reported.items()
            for name, level in statuses.items()
            if self.is_about(key, name) and self.covers(name, level)
        )
        return next(others, "")

    def __str__(self) -> str:
        names = ", ".join(named.name for named in self.names)
        of = f" of hardware {self.hardware}" if self.hardware else ""
        return f"{names or 'any status'}{of}: {' or '.join(self.levels)}"


@dataclass(frozen=True)
class Rule:
    """If a system with the target `if_target` is not in it, and `if_part` is in `if_status`, its target changes.

    With `diagnostics` it also changes while the system is in its target, and only if these hold: of the part, or of
    what is no part.

    It changes back when the part `recover_part` is in one of `recover_statuses`, and `diagnostics` hold no longer;
    without statuses it does not.
    """

    name: str
    if_target: Status
    if_part: str
    if_status: Status
    new_target: Status
    span: Span
    recover_part: str = ""
    recover_statuses: tuple[Status, ...] = ()
    diagnostics: RuleDiagnostics | None = None

    def holds(self, statuses: Mapping[str, Status], reported: Reported, is_reached: bool) -> bool:
        """Return whether the rule applies to a system with its target, which it is in or not (`is_reached`)."""
        if not statuses[self.if_part].is_same(self.if_status):
            return False
        return bool(self.cause(reported)) if self.diagnostics is not None else not is_reached

    def cause(self, reported: Reported) -> str:
        """Return the status on /diagnostics that lets it apply, as RuleDiagnostics.first; empty: none does."""
        return self.diagnostics.first(self.if_part, reported) if self.diagnostics is not None else ""

    def recovers(self, statuses: Mapping[str, Status], reported: Reported) -> bool:
        """Return whether the rule, which was applied, is undone; `statuses` are those of the parts of its system."""
        is_well = any(statuses[self.recover_part].is_same(status) for status in self.recover_statuses)
        return is_well and not self.cause(reported)


@dataclass(frozen=True)
class DiagnosticLevels:
    """Which levels of /diagnostics are errors of a node; besides ERROR only for statuses in `names`, if it has some.

    `motor*` in `names` is each status whose name begins with motor.
    """

    levels: tuple[str, ...] = (ERROR_LEVEL,)
    names: tuple[str, ...] = ()

    def is_error(self, level: str, name: str) -> bool:
        """Return whether a status `name` (without the node's) with this level is an error."""
        is_meant = not self.names or is_named(name, self.names)
        return level == ERROR_LEVEL or (level in self.levels and is_meant)


@dataclass(frozen=True)
class Part:
    """A node or a system; `parts`, `rules` and `start_after` are those of a system.

    `contingencies` are modes that a node changes to by itself, for an error. `published` are the names of the statuses
    on /diagnostics that a node can have, as its application file declares them; None: they are not known.

    `rules` are sorted by name, modes are in the order of the file. `start_after` has for a part the parts that are
    commanded before it.
    """

    name: str
    is_system: bool
    span: Span
    modes: Mapping[str, Mode]
    parts: tuple[Named, ...] = ()
    rules: tuple[Rule, ...] = ()
    start_after: Mapping[str, tuple[Named, ...]] = field(default_factory=dict)
    contingencies: tuple[str, ...] = ()
    diagnostics: DiagnosticLevels = DiagnosticLevels()
    published: tuple[str, ...] | None = None

    @property
    def part_names(self) -> tuple[str, ...]:
        """Return the names of the parts in the order of the file."""
        return tuple(part.name for part in self.parts)


@dataclass(frozen=True)
class Model:
    """All parts in the order of the file. `parents` has the system of each part that is in one."""

    source: Source
    parts: Mapping[str, Part]
    parents: Mapping[str, str]

    @property
    def systems(self) -> tuple[Part, ...]:
        """Return the systems, each after the systems that are its parts."""
        found: dict[str, Part] = {}
        for part in self.parts.values():
            found.update((p.name, p) for p in self._bottom_up(part) if p.is_system)
        return tuple(found.values())

    @property
    def nodes(self) -> tuple[Part, ...]:
        """Return the nodes in the order of the file."""
        return tuple(part for part in self.parts.values() if not part.is_system)

    @property
    def roots(self) -> tuple[Part, ...]:
        """Return the parts that are in no system, in the order of the file."""
        return tuple(part for part in self.parts.values() if part.name not in self.parents)

    def leaves(self, name: str) -> Iterator[Part]:
        """Yield the nodes below a part, or the part itself where it is one."""
        yield from (part for part in self._bottom_up(self.parts[name]) if not part.is_system)

    def _bottom_up(self, part: Part) -> Iterator[Part]:
        for name in part.part_names:
            yield from self._bottom_up(self.parts[name])
        yield part

    def targets(self, system: Part) -> tuple[Status, ...]:
        """Return everything that a system can be commanded to be: inactive, and active in each of its modes."""
        return (Status(INACTIVE), *(active(mode) for mode in system.modes))

    def command(self, system: Part, target: Status, part: str) -> Status:
        """Return what `part` is commanded to be when the target of its system is `target`."""
        if target.state != ACTIVE:
            return Status(INACTIVE)
        return system.modes[target.mode].commands[part].target


def start_sequence(parts: tuple[str, ...], after: Mapping[str, tuple[Named, ...]]) -> tuple[str, ...]:
    """Return `parts` so that each follows those it starts after, otherwise in their order.

    Parts in a cycle, and those after one, are left out.
    """
    done: list[str] = []
    while ready := next(
        (p for p in parts if p not in done and all(a.name in done for a in after.get(p, ()))), None
    ):
        done.append(ready)
    return tuple(done)
