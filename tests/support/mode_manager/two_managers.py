# SPDX-License-Identifier: Apache-2.0
"""Two managers of one hierarchy in simulated time: the lower one is a part of the world of the upper one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from microros_gen.mode_manager.calls import Call, Kind, Link, Topic
from microros_gen.mode_manager.messages import mode_of
from microros_gen.mode_manager.parent_values import names_of
from microros_gen.modes.model import active
from tests.support.mode_manager.world import Node, World

STEP_S = 0.1


@dataclass
class LowerManager(Node):
    """The services of the manager of `system` in another world; dead: it was killed."""

    world: World | None = None
    system: str = ""

    def carry_out(self, call: Call) -> dict[str, Any]:
        assert self.world is not None
        manager = self.world.manager
        status = manager.statuses()[self.system]
        if call.kind is Kind.GET_STATE:
            return {"success": True, "state": status.state}
        if call.kind is Kind.GET_MODE:
            return {"success": True, "mode": mode_of(status)}
        if call.kind is Kind.GET_PARAMETERS:
            known, system = manager.parent_values(self.system), self.world.model.parts[self.system]
            return {"success": True, "values": {name: known.get(name) for name in names_of(system)}}
        if call.kind is Kind.SET_PARAMETERS:
            reason = manager.set_parent_values(self.system, call.values)
            return {"success": not reason, "reason": reason}
        assert call.kind is Kind.CHANGE_MODE
        manager.request(self.system, active(call.mode))
        return {"success": True}


class TwoManagers:
    """Runs both worlds; what the lower manager publishes reaches the upper one."""

    def __init__(self, upper: World, lower: World, system: LowerManager) -> None:
        self.upper, self.lower, self.system = upper, lower, system
        self._published = 0

    def let(self, seconds: float) -> None:
        """Let time pass in both."""
        for _ in range(round(seconds / STEP_S)):
            if not self.system.is_dead:
                self.lower.let(STEP_S)
                self._publish()
            self.upper.let(STEP_S)

    def kill(self) -> None:
        """Kill the lower manager, which the upper one does not notice by itself."""
        self.system.is_dead = True

    def restart(self, *late: str) -> None:
        """Start the lower manager again; it has not discovered the nodes `late` yet."""
        nodes = {name: self.lower.nodes[name] for name in late}
        for node in nodes.values():
            node.is_dead = True
        self.lower.start()
        for node in nodes.values():
            node.is_dead = False
        self.system.is_dead, self.system.busy_until = False, 0.0

    def discover(self, *late: str) -> None:
        """Let the lower manager discover nodes."""
        for name in late:
            self.lower.join(name, self.lower.nodes[name])

    def _publish(self) -> None:
        for each in self.lower.announced[self._published :]:
            if each.part == self.system.system and self.upper.manager.leaves[each.part].link is Link.SYSTEM:
                if each.topic is Topic.TRANSITION_EVENT:
                    self.upper.manager.hear_state(each.part, each.goal.state)
                elif each.topic is Topic.MODE_EVENT:
                    self.upper.manager.hear_mode(each.part, mode_of(each.goal))
        self._published = len(self.lower.announced)
