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

    def report(self, status: PartStatus) -> None:
        """Note a status of a part from another process: an error until it is none any more, and its level for rules."""
        source = f"{status.part}: {status.name}" if status.name else status.part
        error = f"{source}: {status.error}" if status.error else ""
        self._manager.diagnosed.hear(status.part, status.name, status.level, error)

    def step(self) -> None:
        """Pass on what has changed in this process."""
        found: dict[str, str] = {}
        for observer in self._sources:
            for problem in observer.problems():
                found.setdefault(problem.part, problem.text)
        for name, leaf in self._manager.leaves.items():
            if leaf.observed != found.get(name, ""):
                self._manager.diagnosed.observe(name, found.get(name, ""))
