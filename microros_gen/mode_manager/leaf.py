# SPDX-License-Identifier: Apache-2.0
"""What is known of one node, or of a system of another manager, and the next call on the way to its target."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from microros_gen.mode_manager.calls import (
    ACTIVATE,
    CLEANUP,
    COMMANDS,
    CONFIGURE,
    DEACTIVATE,
    Call,
    Kind,
    Link,
    Values,
)
from microros_gen.mode_manager.reports import Reports
from microros_gen.modes.inference import fulfills
from microros_gen.modes.model import (
    ACTIVE,
    DEFAULT,
    ERROR,
    FINALIZED,
    INACTIVE,
    UNCONFIGURED,
    UNKNOWN,
    Part,
    Scalar,
    Status,
)

RESTING = (UNCONFIGURED, INACTIVE)
_FINAL = (ERROR, FINALIZED)
_STAYING = (*RESTING, ACTIVE, *_FINAL)
Step = tuple[Kind, int, str, Values]
"""The members of a call."""


@dataclass
class Leaf:
    """`failure`: why it is not commanded any longer; empty: it is. Times are those of the clock of the manager."""

    part: Part
    link: Link = Link.ABSENT
    serves_parameters: bool = False
    """It serves parameters besides its modes: of one without mode services this is known by its link."""
    state: str = UNKNOWN
    mode: str = ""
    values: dict[str, Scalar | tuple[Scalar, ...]] = field(default_factory=dict)
    has_known_values: bool = False
    """Of one that reports its mode: `values` were read, or set, in this mode."""
    byte_arrays: set[str] = field(default_factory=set)
    """Parameters of the type byte[], which lists of integers of a model file are sent as."""
    stale: set[Kind] = field(default_factory=set)
    """Queries that come before any decision."""
    doubts: set[Kind] = field(default_factory=set)
    """The same for what events during own commands contradict: it is asked when these have ended."""
    target: Status | None = None
    must_configure: bool = False
    """Unconfigured does not count as inactive."""
    call: Call | None = None
    late_at: float = 0.0
    attempts: int = 0
    retries: int = 0
    """How many calls were repeated since the start, for the diagnosis."""
    wait_until: float = 0.0
    failure: str = ""
    deviates: bool = False
    """It had its target, and somebody else changed it."""
    has_reached: bool = False
    """It has had its target since that was requested: what has not yet is not changed by others, but on its way."""
    deviations: list[float] = field(default_factory=list)
    reconfigures: bool = False
    """It was active and is inactive only until it has the parameters of its mode."""
    restores: bool = False
    """The new parameters or mode were refused while it was inactive: it gets active again as it was."""
    is_mode_late: bool = False
    """It refused its mode while it was inactive: it gets it when it is active."""
    polled: float = 0.0
    commanded: float = -1e9
    """When the last own command ended."""
    expected: set[str] = field(default_factory=set)
    """States that the own commands lead through: late events of them say nothing new."""
    settle_until: float = 0.0
    """A system of another manager has accepted a command and is on its way until then."""
    passing_since: float = 0.0
    """Since when it is between two states; 0: it is not."""
    unanswered: int = 0
    reaction: str = ""
    """The mode that it went to by itself, for an error that is not over yet: rules do not command it the same again."""
    observed: str = ""
    """An error of it that a source of this process knows."""
    reports: Reports = field(default_factory=Reports)
    """What it publishes on /diagnostics."""

    @property
    def name(self) -> str:
        """Return the name of the part."""
        return self.part.name

    @property
    def problem(self) -> str:
        """Return an error that it has, as far as that is known; empty: it has none."""
        return self.reports.error or self.observed

    @property
    def has_new_problem(self) -> bool:
        """Return whether it has an error that was not only reported before it was away."""
        return bool(self.reports.confirmed_error or self.observed)

    @property
    def queries(self) -> set[Kind]:
        """Return the queries that give the status of the part."""
        if self.link is Link.PLAIN:
            return {Kind.GET_PARAMETERS}
        if self.link is Link.PARAMETERS:
            return {Kind.GET_STATE, Kind.GET_PARAMETERS}
        reported = {Kind.GET_STATE, Kind.GET_MODE}
        return {*reported, Kind.GET_PARAMETERS} if self.reports_values else reported

    @property
    def reports_values(self) -> bool:
        """Return whether it reports its mode, and the values of its parameters besides."""
        return self.link in (Link.MODES, Link.SYSTEM) and self.serves_parameters and bool(self.parameters)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Return the names of the parameters of its modes that a manager sets; of a system those that its parent gives.

        These have their names there.
        """
        if self.part.is_system:
            parents = (
                value.parent for mode in self.part.modes.values() for value in mode.parameters.values()
            )
            return tuple(dict.fromkeys(name for name in parents if name))
        return tuple(dict.fromkeys(name for mode in self.part.modes.values() for name in mode.parameters))

    @property
    def inherited(self) -> tuple[str, ...]:
        """Return the names of the parameters that have values of a parent in some mode."""
        modes = self.part.modes.values()
        return tuple(dict.fromkeys(n for mode in modes for n, v in mode.parameters.items() if v.parent))

    @property
    def is_commanded(self) -> bool:
        """Return whether a command is not answered yet: its events may arrive before the response."""
        return self.call is not None and self.call.kind in COMMANDS

    def is_settled(self, status: Status) -> bool:
        """Return whether it has its target, or none."""
        if self.target is None:
            return True
        return status.is_same(self.target) if self.must_configure else fulfills(status, self.target)

    def is_passing(self, status: Status) -> bool:
        """Return whether it is between two states, or in none that is known; one of a system follows from others."""
        return self.link is not Link.SYSTEM and status.state not in _STAYING

    def begin(self, goal: Status, must_configure: bool, by_rule: bool) -> None:
        """Begin with a target: what hindered the one before does not count; `failure` is left."""
        keeps = by_rule and self.has_reached and self.target == goal
        self.reaction = ""
        self.target, self.must_configure = goal, must_configure
        self.attempts, self.settle_until, self.wait_until = 0, 0.0, 0.0
        self.deviates = self.restores = self.reconfigures = False
        self.has_reached = keeps  # a node that reacts to an error leaves it then
        self.is_mode_late = False

    def step(self, status: Status, wanted: Values, inactive_first: bool) -> Step | str:
        """Return the next call on the way from `status` to the target, or the reason why it cannot get there.

        `wanted` are the parameter values of the target's mode.
        """
        target = self.target
        assert target is not None
        if self.link is Link.SYSTEM:
            return self._command_system(target, wanted)
        if status.state in _FINAL:
            return f"it is {status.state}"
        if self.link is Link.PLAIN and target.state != ACTIVE:
            return "it has no life cycle and is always active"
        if target.state != ACTIVE:
            return self._stop(status, target)
        if status.state == UNCONFIGURED:
            return _change(CONFIGURE)
        by_parameters = self.link in (Link.PARAMETERS, Link.PLAIN)
        if status.state == INACTIVE:
            return self._prepare(target, wanted)
        if self.restores:
            what = "parameters of the mode" if by_parameters else f"mode {target.mode}"
            return f"it refuses the {what}, and is active as before"
        if inactive_first and self.link is not Link.PLAIN:
            return _change(DEACTIVATE)
        return _set(wanted) if by_parameters else self._enter(target, wanted)

    def _command_system(self, target: Status, wanted: Values) -> Step:
        if target.state != ACTIVE:
            return _change(DEACTIVATE)
        if self.reports_values and not self._has(wanted):
            return _set(wanted)
        return _mode(target.mode or DEFAULT)

    def _enter(self, target: Status, wanted: Values) -> Step:
        """Return the next call for a node with mode services: first the values of its parent, then the mode.

        The node has the other values of the mode itself; they are set if it has different ones nevertheless.
        """
        values = self.part.modes[target.mode].parameters
        inherited = {name: value for name, value in wanted.items() if values[name].parent}
        own = {name: value for name, value in wanted.items() if not values[name].parent}
        if self.reports_values and not self._has(inherited):
            return _set(inherited)
        if self.mode != target.mode or not self.reports_values or self._has(own):
            return Kind.CHANGE_MODE, 0, target.mode, own
        return _set(own)

    def _prepare(self, target: Status, wanted: Values) -> Step:
        """Return the next call for an inactive node: it gets its mode first, and is never active in a former one."""
        if (
            not self.restores
            and self.link is Link.MODES
            and not self.is_mode_late
            and (self.mode != target.mode or (self.reports_values and not self._has(wanted)))
        ):
            return self._enter(target, wanted)
        if not self.restores and self.link is Link.PARAMETERS and not self._has(wanted):
            return _set(wanted)
        return _change(ACTIVATE)

    def _stop(self, status: Status, target: Status) -> Step:
        if status.state == ACTIVE:
            return _change(DEACTIVATE)
        return _change(CONFIGURE if target.state == INACTIVE else CLEANUP)

    def _has(self, wanted: Values) -> bool:
        return has_values(self.values, wanted)


def has_values(values: Mapping[str, Scalar | tuple[Scalar, ...]], wanted: Values) -> bool:
    """Return whether all wanted values are there, with their types."""
    return all(
        name in values and type(values[name]) is type(value) and values[name] == value
        for name, value in wanted.items()
    )


def _change(transition: int) -> Step:
    return Kind.CHANGE_STATE, transition, "", {}


def _mode(mode: str) -> Step:
    return Kind.CHANGE_MODE, 0, mode, {}


def _set(values: Values) -> Step:
    return Kind.SET_PARAMETERS, 0, "", values
