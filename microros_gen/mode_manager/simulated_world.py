# SPDX-License-Identifier: Apache-2.0
"""The orchestration of the manager with simulated nodes and a made clock: what happens depends on nothing else."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulated_node import SimulatedNode
from microros_gen.modes.model import Model

_BUSY_US, _IDLE_US = 10_000, 100_000
"""Time between two turns: of a manager that waits for responses, and of one that does not."""
_US = 1e6


class SimulatedWorld:
    """Time passes only in `run`. `manager` is the orchestrator, `nodes` what it manages, by name."""

    def __init__(
        self,
        model: Model,
        nodes: Mapping[str, SimulatedNode],
        scope: Scope,
        settings: Settings,
        log: Callable[[str], object],
        observe: Callable[[Sequence[Call]], object],
    ) -> None:
        """`log` gets the lines of the manager, `observe` the calls of each turn."""
        self.nodes = dict(nodes)
        self.now_us = 0
        self._observe = observe
        self._due: list[tuple[float, Call]] = []
        self.begin(model, scope, settings, log)

    @property
    def now(self) -> float:
        """Return the time in seconds."""
        return self.now_us / _US

    def begin(self, model: Model, scope: Scope, settings: Settings, log: Callable[[str], object]) -> None:
        """Begin with a new manager: one before it was killed, and so are its calls."""
        self._due = []
        self.manager = Orchestrator(model, scope, lambda: self.now, settings, log)
        for name in self.manager.leaves:
            if name in self.nodes and not self.nodes[name].is_dead:
                self.nodes[name].busy_until = 0.0
                self._link(name)

    def run(self, duration_us: int) -> None:
        """Let time pass, in microseconds, in steps of 10 ms, or of 100 ms where nothing is due."""
        end = self.now_us + duration_us
        while self.now_us < end:
            for entry in [entry for entry in self._due if entry[0] <= self.now]:
                self._due.remove(entry)
                self._answer(entry[1])
            self._turn()
            is_due = any(due <= self.now + _IDLE_US / _US for due, _ in self._due)
            self.now_us = min(end, self.now_us + (_BUSY_US if is_due else _IDLE_US))

    def leave(self, name: str) -> None:
        """Let a node be gone."""
        self.nodes[name].is_dead = True
        self.manager.link(name, Link.ABSENT)

    def join(self, name: str, node: SimulatedNode) -> None:
        """Let a node be there from now on."""
        self.nodes[name] = node
        self._link(name)

    def _link(self, name: str) -> None:
        node = self.nodes[name]
        self.manager.link(name, node.link, node.serves_parameters)

    def publish(self, name: str, kind: Kind, what: Any) -> None:
        """Let the manager hear an event of a node: `kind` says whether it is of its state, mode or parameters."""
        if kind is Kind.GET_STATE:
            self.manager.hear_state(name, what)
        elif kind is Kind.GET_MODE:
            self.manager.hear_mode(name, what)
        else:
            self.manager.hear_parameters(name, what)

    def _answer(self, call: Call) -> None:
        node = self.nodes[call.part]
        if node.is_dead:
            return
        before = node.state
        response = node.carry_out(call)
        for kind, what in node.events(call, before, response["success"]):
            self.publish(call.part, kind, what)
        self.manager.answer(call, **response)

    def _turn(self) -> None:
        calls = self.manager.turn()
        for call in calls:
            node = self.nodes.get(call.part)
            if node is not None:
                self._due.append((node.due(call, self.now), call))
        self._observe(calls)
