# SPDX-License-Identifier: Apache-2.0
"""A node, or a system of another manager, as the services and events of one show it. No ROS."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from microros_gen.mode_manager.calls import (
    ACTIVATE,
    CLEANUP,
    CONFIGURE,
    DEACTIVATE,
    Call,
    Kind,
    Link,
)
from microros_gen.modes.model import ACTIVE, DEFAULT, INACTIVE, UNCONFIGURED, Scalar

GOALS = {
    (UNCONFIGURED, CONFIGURE): INACTIVE,
    (INACTIVE, CLEANUP): UNCONFIGURED,
    (INACTIVE, ACTIVATE): ACTIVE,
    (ACTIVE, DEACTIVATE): INACTIVE,
}
PASSING = {
    CONFIGURE: "configuring",
    CLEANUP: "cleaningup",
    ACTIVATE: "activating",
    DEACTIVATE: "deactivating",
}
"""The state between two others that a transition leads through."""
ANSWER_S = 0.01
"""How long a node without a fault takes for a response."""


@dataclass
class SimulatedNode:
    """`refuses` says which calls it refuses, for `reason`; `delay_of` how long it takes for a response, in seconds."""

    link: Link = Link.PARAMETERS
    state: str = UNCONFIGURED
    mode: str = ""
    """Of a node: it is kept while the node is not active, as firmware does; empty: __DEFAULT__."""
    values: dict[str, Scalar | tuple[Scalar, ...]] = field(default_factory=dict)
    serves_parameters: bool = False
    """One with mode services serves its parameters, too."""
    mode_values: Mapping[str, Mapping[str, Scalar | tuple[Scalar, ...]]] = field(default_factory=dict)
    """The values that it has for each of its modes, and sets when it gets the mode."""
    refuses: Callable[[Call], bool] = lambda _: False
    reason: str = ""
    fails_to: str = ""
    """Where a refused transition ends; empty: it stays."""
    delay_s: float = ANSWER_S
    delays: Callable[[Call], bool] = lambda _: True
    """The calls whose responses take `delay_s`; all others take ANSWER_S."""
    is_dead: bool = False
    """It does not answer, nor carry out anything."""
    settles: bool = True
    """A system of another manager gets its target at once."""
    busy_until: float = 0.0
    """It carries out one call after another."""

    def due(self, call: Call, now: float) -> float:
        """Return when the response to a call that arrives now is there; calls before it come first."""
        self.busy_until = max(now, self.busy_until) + (self.delay_s if self.delays(call) else ANSWER_S)
        return self.busy_until

    def carry_out(self, call: Call) -> dict[str, Any]:
        """Return the response, as the arguments of `Orchestrator.answer`."""
        if call.kind is Kind.GET_STATE:
            return {"success": True, "state": self.state}
        if call.kind is Kind.GET_MODE:
            return {"success": True, "mode": (self.mode or DEFAULT) if self.state == ACTIVE else ""}
        if call.kind is Kind.GET_PARAMETERS:
            return {"success": True, "values": dict(self.values)}
        if self.refuses(call):
            self.state = self.fails_to or self.state
            return {"success": False, "reason": self.reason if call.kind is Kind.SET_PARAMETERS else ""}
        if call.kind is Kind.SET_PARAMETERS:
            self.values.update({name: value for name, value in call.values.items() if value is not None})
            return {"success": True}
        if call.kind is Kind.CHANGE_MODE:
            return {"success": self._change_mode(call.mode)}
        goal = GOALS.get((self.state, call.transition))
        self.state = goal or self.state
        if self.link is Link.SYSTEM:
            self.mode = DEFAULT if goal == ACTIVE else ""
        return {"success": goal is not None}

    def events(self, call: Call, before: str, success: bool) -> Iterator[tuple[Kind, Any]]:
        """Yield what it publishes of a call before its response: what it is of, and the new state, mode or values.

        `before` is its state before the call.
        """
        if call.kind is Kind.CHANGE_STATE and self.link is not Link.SYSTEM:
            passed = success or self.state != before
            for state in (PASSING[call.transition], self.state) if passed else ():
                yield Kind.GET_STATE, state
        elif call.kind is Kind.CHANGE_MODE and success and self.mode:
            if self.serves_parameters:
                yield Kind.GET_PARAMETERS, dict(self.mode_values.get(self.mode, {}))
            yield Kind.GET_MODE, self.mode
        elif call.kind is Kind.SET_PARAMETERS and success:
            yield Kind.GET_PARAMETERS, dict(call.values)

    def _change_mode(self, mode: str) -> bool:
        if self.link is Link.SYSTEM:
            if self.settles:
                self.state, self.mode = ACTIVE, mode
            return True
        accepts = self.state in (ACTIVE, INACTIVE)
        if accepts:
            self.mode = mode
            self.values.update(self.mode_values.get(mode, {}))
        return accepts
