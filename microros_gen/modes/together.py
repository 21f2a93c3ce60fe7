# SPDX-License-Identifier: Apache-2.0
"""Statuses of no part that several systems see: each combination of their levels is taken for all systems at once.

`settle_all` takes each system for itself, so that two of them can be given different levels of one status. What that
proves is proven. Only where it finds a cycle that may need different levels, one combination after another is tried
here. What a system does follows from what its rules and those of the systems below it see, and is computed once for
each of these.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from microros_gen.modes.behavior import Oscillation, Settle, Settled, SettledSystem, settle_all, settle_system
from microros_gen.modes.machines import Behaviors
from microros_gen.modes.model import Model, Part
from microros_gen.modes.reports import outside_reports

MOST_LEVELS = 1024
"""Combinations of levels that rules can tell apart: as many as ten rules have that are independent of each other."""

Held = Mapping[str, int]
"""System → those of its rules, as bits, that see a status of no part that they want."""


def has_shared_statuses(model: Model) -> bool:
    """Return whether rules of several systems want statuses of no part."""
    return sum(any(r.diagnostics and r.diagnostics.hardware for r in s.rules) for s in model.systems) > 1


def settle_together(
    model: Model, most: int, of_node: Callable[[Model, Part], Behaviors], before: Settled
) -> Settled | None:
    """Return `before`, of `settle_all`, with the cycles and open systems that there are if all see the same levels.

    None: the levels have more than `MOST_LEVELS` combinations.
    """
    rules = [rule for system in model.systems for rule in system.rules]
    reports = outside_reports(rules, MOST_LEVELS)
    if len(reports) > MOST_LEVELS:
        return None
    known: dict[object, SettledSystem | None] = {}
    cycles: dict[tuple[str, frozenset[str]], Oscillation] = {}
    unproven: dict[str, None] = {}
    for bits, statuses in reports.items():
        settled = settle_all(model, most, of_node, _settle_with(model, most, _split(model, bits), known))
        unproven.update(dict.fromkeys(settled.open))
        for found in settled.oscillations:
            with_levels = replace(found, failures=statuses + found.failures)
            cycles.setdefault((found.system, frozenset(found.rules)), with_levels)
    return replace(before, oscillations=tuple(cycles.values()), open=tuple(unproven))


def _split(model: Model, bits: int) -> Held:
    """Return the bits of each system, of those of the rules of all systems one after another."""
    held: dict[str, int] = {}
    for system in model.systems:
        held[system.name] = bits & ((1 << len(system.rules)) - 1)
        bits >>= len(system.rules)
    return held


def _settle_with(model: Model, most: int, held: Held, known: dict[object, SettledSystem | None]) -> Settle:
    """Return a function that settles a system where rules see that; `known` has what was settled before."""

    def settle(system: Part, behaviors: Mapping[str, Behaviors]) -> SettledSystem | None:
        key = system.name, tuple(held[name] for name in _systems_below(model, system))
        if key not in known:
            known[key] = settle_system(model, system, behaviors, most, {held[system.name]: ()})
        return known[key]

    return settle


def _systems_below(model: Model, system: Part) -> list[str]:
    """Return the names of a system and of all systems below it."""
    names = [system.name]
    for name in system.part_names:
        if model.parts[name].is_system:
            names += _systems_below(model, model.parts[name])
    return names
