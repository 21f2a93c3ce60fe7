# SPDX-License-Identifier: Apache-2.0
"""What the statuses of a node on /diagnostics can say to the rules of its system: every combination that differs.

A status has any level at any time, and rules know statuses by their names. Names of a pattern (`motor*`) are all alike
unless another pattern, or a name, is among them. So one name for each pattern, which nothing else is like, and all
names of the file say everything that there can be. The same holds for the hardware of statuses of no part.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import product

from microros_gen.modes.model import ERROR_LEVEL, STALE_LEVEL, WARN_LEVEL, Part, Rule, outside
from microros_gen.records import dataclass

_LEVELS = (WARN_LEVEL, ERROR_LEVEL, STALE_LEVEL)


@dataclass(frozen=True)
class Diagnosis:
    """The level of a status of a node; `name` is without that of the node, and may be a pattern of one."""

    name: str
    level: str

    def __str__(self) -> str:
        return f"{self.name} {self.level}"


@dataclass(frozen=True)
class Report:
    """What all statuses of a node say together.

    `held`: which rules have the statuses that they want, a bit for each by its index. `is_error`: one of the statuses
    is an error of the node, which is in error processing then.
    """

    held: int = 0
    is_error: bool = False


def reports_of(node: Part, rules: Iterable[Rule], most: int) -> Mapping[Report, tuple[Diagnosis, ...]]:
    """Return what a node can report to the rules of its system, each with the fewest statuses that this takes.

    With more than `most` of them, not all are returned, but more than that.
    """
    wanted = [
        (i, r.diagnostics)
        for i, r in enumerate(rules)
        if r.diagnostics and not r.diagnostics.hardware and r.if_part == node.name
    ]
    found: dict[Report, tuple[Diagnosis, ...]] = {Report(): ()}
    if not wanted:
        return found
    names = dict.fromkeys(pattern for _, diagnostics in wanted for pattern in diagnostics.patterns)
    for name in dict.fromkeys((*names, *node.diagnostics.names)):
        for report, statuses in tuple(found.items()):
            for level in _LEVELS:
                held = sum(1 << i for i, diagnostics in wanted if diagnostics.covers(name, level))
                is_error = node.diagnostics.is_error(level, name)
                after = Report(report.held | held, report.is_error or is_error)
                known = found.get(after)
                if known is None or len(statuses) + 1 < len(known):
                    found[after] = (*statuses, Diagnosis(name, level))
        if len(found) > most:
            break
    return found


def outside_statuses(rules: Iterable[Rule]) -> tuple[tuple[str, str], ...]:
    """Return the statuses of no part that some rules can tell apart: key, as of `outside`, and name of each."""
    wanted = [r.diagnostics for r in rules if r.diagnostics and r.diagnostics.hardware]
    hardware = dict.fromkeys(diagnostics.hardware for diagnostics in wanted)
    names = dict.fromkeys(pattern for diagnostics in wanted for pattern in diagnostics.patterns)
    return tuple(product(map(outside, hardware), names))


def outside_reports(
    rules: Sequence[Rule], most: int, statuses: Iterable[tuple[str, str]] | None = None
) -> Mapping[int, tuple[tuple[str, Diagnosis], ...]]:
    """Return what the statuses of no part can say to some rules: which rules have those that they want.

    A bit for each rule by its index; each with the fewest statuses that this takes, by the keys of `outside`.
    `statuses` are those that have a level; None: all of `outside_statuses`. With more than `most` combinations, not all
    are returned, but more than that.
    """
    wanted = [(i, r.diagnostics) for i, r in enumerate(rules) if r.diagnostics and r.diagnostics.hardware]
    found: dict[int, tuple[tuple[str, Diagnosis], ...]] = {0: ()}
    for key, name in outside_statuses(rules) if statuses is None else statuses:
        about = [(i, diagnostics) for i, diagnostics in wanted if diagnostics.is_about(key, name)]
        for held, levels in tuple(found.items()):
            for level in _LEVELS:
                after = held | sum(1 << i for i, diagnostics in about if diagnostics.covers(name, level))
                if len(levels) + 1 < len(found.get(after, range(len(levels) + 2))):
                    found[after] = (*levels, (key, Diagnosis(name, level)))
        if len(found) > most:
            break
    return found
