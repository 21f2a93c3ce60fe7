# SPDX-License-Identifier: Apache-2.0
"""Nodes without ROS for the orchestration: with a made clock, and failures by order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from microros_gen.mode_manager.calls import Announcement, Call, Kind, Link, Settings, Topic
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.mode_manager.scope import select_scope
from microros_gen.modes import Model, Status

GOALS = {
    ("unconfigured", 1): "inactive",
    ("inactive", 2): "unconfigured",
    ("inactive", 3): "active",
    ("active", 4): "inactive",
}
COMMANDS = (Kind.CHANGE_STATE, Kind.CHANGE_MODE, Kind.SET_PARAMETERS)


@dataclass
class Node:
    """A node with a life cycle. `refuses` says which calls it refuses; `delay_s` is the time of a response."""

    link: Link = Link.PARAMETERS
    state: str = "unconfigured"
    mode: str = ""
    values: dict[str, Any] = field(default_factory=dict)
    refuses: Callable[[Call], bool] = lambda _: False
    fails_to: str = ""
    """Where a refused transition ends; empty: it stays."""
    delay_s: float = 0.01
    is_dead: bool = False
    settles: bool = True
    """A system of another manager gets its target at once."""

    def carry_out(self, call: Call) -> dict[str, Any]:
        """Return the response, as the arguments of `Orchestrator.answer`."""
        if call.kind is Kind.GET_STATE:
            return {"success": True, "state": self.state}
        if call.kind is Kind.GET_MODE:
            return {"success": True, "mode": self.mode if self.state == "active" else ""}
        if call.kind is Kind.GET_PARAMETERS:
            return {"success": True, "values": dict(self.values)}
        if self.refuses(call):
            self.state = self.fails_to or self.state
            return {"success": False, "reason": "no"}
        if call.kind is Kind.SET_PARAMETERS:
            self.values.update(call.values)
            return {"success": True}
        if call.kind is Kind.CHANGE_MODE:
            if self.link is Link.SYSTEM:
                if self.settles:
                    self.state, self.mode = "active", call.mode
                return {"success": True}
            if self.state == "active":
                self.mode = call.mode
            return {"success": self.state == "active"}
        goal = GOALS.get((self.state, call.transition))
        self.state = goal or self.state
        self.mode = "__DEFAULT__" if goal == "active" else ""
        return {"success": goal is not None}


class World:
    """An orchestrator, its nodes, and time. `sent` are the commands in their order, with times."""

    def __init__(
        self,
        model: Model,
        nodes: dict[str, Node],
        roots: tuple[str, ...] = (),
        without: tuple[str, ...] = (),
        settings: Settings | None = None,
    ) -> None:
        self.model, self.nodes, self.now = model, nodes, 0.0
        self.settings = settings or Settings()
        self.roots, self.without = roots, without
        self.log: list[str] = []
        self.sent: list[tuple[float, Call]] = []
        self.announced: list[Announcement] = []
        self._due: list[tuple[float, Call]] = []
        self.start()

    def start(self) -> None:
        """Begin with a new manager: the one before was killed."""
        scope = select_scope(self.model, self.roots, self.without)
        self._due = []
        self.manager = Orchestrator(
            self.model, scope, lambda: self.now, self.settings, lambda line: self.log.append(line)
        )
        for name in self.manager.leaves:
            if name in self.nodes and not self.nodes[name].is_dead:
                self.manager.link(name, self.nodes[name].link)

    def run(self, seconds: float) -> None:
        """Let time pass in steps of 10 ms, or of 100 ms where nothing is due."""
        end = self.now + seconds
        while self.now < end - 0.001:
            for due, call in [entry for entry in self._due if entry[0] <= self.now]:
                self._due.remove((due, call))
                node = self.nodes[call.part]
                if not node.is_dead:
                    before = node.state
                    response = node.carry_out(call)
                    self._publish(call, node, before, response["success"])
                    self.manager.answer(call, **response)
            self._turn()
            is_due = any(due <= self.now + 0.1 for due, _ in self._due)
            self.now = round(min(end, self.now + (0.01 if is_due else 0.1)), 2)

    def _publish(self, call: Call, node: Node, before: str, success: bool) -> None:
        """Publish the events of a command before its response, as nodes do."""
        if call.kind is Kind.CHANGE_STATE and node.link is not Link.SYSTEM:
            passing = ("", "configuring", "cleaningup", "activating", "deactivating")[call.transition]
            for state in (passing, node.state) if success or node.state != before else ():
                self.manager.hear_state(call.part, state)
            if success and node.state == "active" and node.link is Link.MODES:
                self.manager.hear_mode(call.part, node.mode)
        elif call.kind is Kind.CHANGE_MODE and success and node.mode:
            self.manager.hear_mode(call.part, node.mode)
        elif call.kind is Kind.SET_PARAMETERS and success:
            self.manager.hear_parameters(call.part, dict(call.values))

    def _turn(self) -> None:
        for call in self.manager.turn():
            if call.kind in COMMANDS:
                self.sent.append((self.now, call))
            node = self.nodes.get(call.part)
            if node is not None:
                self._due.append((self.now + node.delay_s, call))
        self.announced += self.manager.announcements()

    def request(self, part: str, target: Status, seconds: float = 3.0) -> None:
        self.manager.request(part, target)
        self.run(seconds)

    def change(self, name: str, state: str) -> None:
        """Let somebody else change the state of a node, which publishes it."""
        self.nodes[name].state = state
        self.manager.hear_state(name, state)

    def leave(self, name: str) -> None:
        self.nodes[name].is_dead = True
        self.manager.link(name, Link.ABSENT)

    def join(self, name: str, node: Node) -> None:
        self.nodes[name] = node
        self.manager.link(name, node.link)

    def status(self, part: str) -> str:
        return str(self.manager.statuses()[part])

    def commands(self, since: int = 0) -> list[str]:
        return [f"{call.part} {call}" for _, call in self.sent[since:]]

    def topics(self, part: str) -> list[tuple[Topic, str]]:
        return [(each.topic, str(each.goal)) for each in self.announced if each.part == part]
