# SPDX-License-Identifier: Apache-2.0
"""What a manager knows by /diagnostics and by sources in its process: of its parts, and of what is no part."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.outside import Outside
from microros_gen.mode_manager.scope import Scope
from microros_gen.modes.model import Reported


class Diagnosed:
    """`reported` has all levels, as rules want them. Times are seconds of the clock of the manager."""

    def __init__(
        self,
        scope: Scope,
        leaves: Mapping[str, Leaf],
        clock: Callable[[], float],
        log: Callable[[str], object],
        repeat_s: float,
    ) -> None:
        """`log` gets a line about each error of a part; a status is repeated within `repeat_s` seconds."""
        self._leaves = leaves
        self._clock = clock
        self._log = log
        levels = {name: leaf.reports.levels for name, leaf in leaves.items()}
        self._outside = Outside([rule for system in scope.systems for rule in system.rules], levels, repeat_s)
        self.reported: Reported = levels

    def hear(self, part: str, name: str, level: str, error: str = "") -> None:
        """Note a status of a part; `name` is without that of the part, `error` empty: it is no error of it."""
        leaf = self._leaves[part]
        before = leaf.problem
        leaf.reports.hear(name, level, error)
        self._compare(leaf, before)

    def hear_outside(self, hardware: str, name: str, level: str) -> None:
        """Note a status of no part, with its hardware_id; `level` is empty: it is OK."""
        self._outside.hear(hardware, name, level, self._clock())

    def observe(self, part: str, text: str) -> None:
        """Note an error of a part that a source of this process knows; empty: it is over."""
        leaf = self._leaves[part]
        before = leaf.problem
        leaf.observed = text
        self._compare(leaf, before)

    def link(self, leaf: Leaf, before: Link) -> None:
        """Note that a leaf is linked in another way than before: it has left, or is back."""
        problem = leaf.problem
        if leaf.link is Link.ABSENT:
            leaf.reports.leave()
        elif before is Link.ABSENT:
            leaf.reports.arrive(self._clock())
        self._compare(leaf, problem)

    def step(self) -> None:
        """Note that time has passed."""
        now = self._clock()
        self._outside.step(now)
        for leaf in self._leaves.values():
            before = leaf.problem
            leaf.reports.step(now)
            self._compare(leaf, before)

    def _compare(self, leaf: Leaf, before: str) -> None:
        """Say that a part has an error now; one that has none any more does not react to it either."""
        if leaf.problem and not before:
            self._log(f"{leaf.name}: {leaf.problem}")
        if before and not leaf.problem:
            leaf.reaction = ""
