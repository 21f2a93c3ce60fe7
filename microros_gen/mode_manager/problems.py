# SPDX-License-Identifier: Apache-2.0
"""Errors of parts from several sources. Sources of this process implement `ProblemSource`; others use /diagnostics."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from microros_gen.mode_manager.diagnosis import PartStatus
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Problem:
    """An error of a part that lasts until its source no longer returns it: a missed deadline, an overrun."""

    part: str
    text: str


class ProblemSource(Protocol):
    """What observes parts: deadlines, overruns, heartbeats, a supply voltage."""

    def problems(self) -> Iterable[Problem]:
        """Return all errors that there are now; called in the thread of the manager, in each of its turns."""


class Problems:
    """Joins all sources: a part has the first error of any of them."""

    def __init__(self, manager: Orchestrator, sources: Sequence[ProblemSource] = ()) -> None:
        self._manager = manager
        self._sources = sources
        self._reported: dict[str, dict[str, str]] = {}

    def report(self, status: PartStatus) -> None:
        """Note a status of a part from another process: an error until it is none any more, and its level for rules."""
        source = f"{status.part}: {status.name}" if status.name else status.part
        known = self._reported.setdefault(status.part, {})
        known.pop(source, None)
        if status.error:
            known[source] = status.error
        self._manager.hear_level(status.part, status.name, status.level)

    def forget(self, part: str) -> None:
        """Forget what was reported of a part, which has left."""
        self._reported.pop(part, None)

    def step(self) -> None:
        """Pass on what has changed."""
        found: dict[str, str] = {}
        for part, known in self._reported.items():
            for source, text in known.items():
                found.setdefault(part, f"{source}: {text}")
        for observer in self._sources:
            for problem in observer.problems():
                found.setdefault(problem.part, problem.text)
        for name, leaf in self._manager.leaves.items():
            if leaf.problem != found.get(name, ""):
                self._manager.hear_problem(name, found.get(name, ""))
