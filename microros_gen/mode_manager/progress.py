# SPDX-License-Identifier: Apache-2.0
"""Which parts are on their way, and which ones wait for others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.hearing import SILENT
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.targets import predecessors
from microros_gen.modes.model import Model, Status


class Progress:
    """A view of leaves and targets, which others change."""

    def __init__(
        self,
        model: Model,
        scope: Scope,
        leaves: Mapping[str, Leaf],
        targets: Mapping[str, Status],
        status: Callable[[Leaf], Status],
    ) -> None:
        self._model = model
        self._inner = {system.name for system in scope.systems}
        self._leaves = leaves
        self._targets = targets
        self._status = status

    def is_moving(self, name: str) -> bool:
        """Return whether a part, or one below it, is on its way to its target, or is just being asked."""
        leaf = self._leaves.get(name)
        if leaf is None:
            return any(self.is_moving(part) for part in self._model.parts[name].part_names)
        if leaf.target is None or leaf.link is Link.ABSENT:
            return leaf.target is not None and not leaf.failure
        if leaf.failure != SILENT and (leaf.call is not None or leaf.stale or leaf.doubts):
            return True
        if leaf.failure or self._is_done(leaf):
            return False
        if leaf.deviates and not leaf.is_passing(self._status(leaf)):
            return False
        blocker = self.blocker(name)
        return not blocker or self.is_moving(blocker)

    def blocker(self, name: str) -> str:
        """Return the part that a part has to wait for; empty: none."""
        for system in self.systems_of(name):
            waits, needed = predecessors(self._model.parts[system], name, self._targets)
            for other in waits:
                if not self._is_settled(other) and (other in needed or self._is_pending(other)):
                    return other
            name = system
        return ""

    def below(self, name: str) -> Iterable[Leaf]:
        """Return the leaves of a part."""
        if name in self._leaves:
            return [self._leaves[name]]
        return [leaf for part in self._model.parts[name].part_names for leaf in self.below(part)]

    def systems_of(self, name: str) -> list[str]:
        """Return the systems of the scope that a part is in, the lowest first."""
        found: list[str] = []
        while (name := self._model.parents.get(name, "")) in self._inner:
            found.append(name)
        return found

    def _is_done(self, leaf: Leaf) -> bool:
        return leaf.is_settled(self._status(leaf))

    def _is_settled(self, name: str) -> bool:
        return all(self._is_done(leaf) for leaf in self.below(name))

    def _is_pending(self, name: str) -> bool:
        """Return whether a part that is stopped may still get its target."""
        return any(not leaf.failure and not self._is_done(leaf) for leaf in self.below(name))
