# SPDX-License-Identifier: Apache-2.0
"""The simulated world with a record of what the manager said, sent and announced."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.mode_manager.calls import COMMANDS, Announcement, Call, Topic
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulated_node import SimulatedNode as Node
from microros_gen.mode_manager.simulated_world import SimulatedWorld
from microros_gen.modes import Model, Status

__all__ = ["Node", "World"]


class World(SimulatedWorld):
    """`sent` are the commands in their order, with times."""

    def __init__(
        self,
        model: Model,
        nodes: dict[str, Node],
        roots: tuple[str, ...] = (),
        without: tuple[str, ...] = (),
        settings: Settings | None = None,
    ) -> None:
        self.model = model
        self.settings = settings or Settings()
        self.log: list[str] = []
        self.sent: list[tuple[float, Call]] = []
        self.announced: list[Announcement] = []
        self.scope = select_scope(model, roots, without)
        super().__init__(model, nodes, self.scope, self.settings, self.log.append, self._record)

    def start(self) -> None:
        """Begin with a new manager: the one before was killed."""
        self.begin(self.model, self.scope, self.settings, self.log.append)

    def let(self, seconds: float) -> None:
        """Let time pass."""
        self.run(round(seconds * 1e6))

    def _record(self, calls: Sequence[Call]) -> None:
        self.sent += [(self.now, call) for call in calls if call.kind in COMMANDS]
        self.announced += self.manager.announcements()

    def request(self, part: str, target: Status, seconds: float = 3.0) -> None:
        self.manager.request(part, target)
        self.let(seconds)

    def change(self, name: str, state: str) -> None:
        """Let somebody else change the state of a node, which publishes it."""
        self.nodes[name].state = state
        self.manager.hear_state(name, state)

    def status(self, part: str) -> str:
        return str(self.manager.statuses()[part])

    def commands(self, since: int = 0) -> list[str]:
        return [f"{call.part} {call}" for _, call in self.sent[since:]]

    def topics(self, part: str) -> list[tuple[Topic, str]]:
        return [(each.topic, str(each.goal)) for each in self.announced if each.part == part]
