# SPDX-License-Identifier: Apache-2.0
"""Statuses of no part that several systems see: each combination of their levels is taken for all systems at once.

`settle_all` takes each system for itself, so that two of them can be given different levels of one status. What that
proves is proven. Only for a system with a cycle that may need different levels, one combination after another is tried
here, of the statuses that at least two of this system and those below it see. A status that only one of them sees has
any level there, whatever the others are: they have no part and no other status in common, so nothing is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from microros_gen.modes.behavior import Oscillation, Settled, SettledSystem, settle_system
from microros_gen.modes.machines import Behaviors, Failures
from microros_gen.modes.model import Model, Part
from microros_gen.modes.reports import outside_reports, outside_statuses
from microros_gen.records import dataclass

MOST_LEVELS = 1024
"""Combinations of levels that rules can tell apart: as many as ten rules have that are independent of each other."""


@dataclass(frozen=True)
class _Below:
    """A system and all systems below it, from the bottom up, and what they see of statuses of no part.

    `shared` has the rules, one bit for each of all these systems, that see statuses which several systems see; `own`,
    for each system, those of its rules that see others.
    """

    systems: tuple[Part, ...]
    shared: Mapping[int, Failures]
    own: Mapping[str, Mapping[int, Failures]]

    def levels_of(self, system: Part, bits: int) -> Mapping[int, Failures]:
        """Return which rules of a system see what they want, while the shared statuses say `bits`."""
        for each in self.systems:
            if each is system:
                break
            bits >>= len(each.rules)
        bits &= (1 << len(system.rules)) - 1
        found: dict[int, Failures] = {}
        for held, statuses in self.own[system.name].items():
            found.setdefault(bits | held, statuses)
        return found


def has_shared_statuses(model: Model) -> bool:
    """Return whether rules of several systems want statuses of no part."""
    return sum(any(r.diagnostics and r.diagnostics.hardware for r in s.rules) for s in model.systems) > 1


def settle_together(
    model: Model, most: int, of_node: Callable[[Model, Part], Behaviors], before: Settled
) -> Settled:
    """Return `before`, of `settle_all`, with the cycles and open systems that there are if all see the same levels.

    A system remains as it was if the statuses that it shares have more than `MOST_LEVELS` combinations.
    """
    nodes = {node.name: of_node(model, node) for node in model.nodes}
    uncertain = {*before.open, *(found.system for found in before.oscillations)}
    cycles: list[Oscillation] = []
    unproven: list[str] = []
    for system in model.systems:
        if system.name not in uncertain:
            continue
        below = _below(model, system, most)
        if below is None:
            cycles += [found for found in before.oscillations if found.system == system.name]
            unproven += [name for name in before.open if name == system.name]
            continue
        found = _settle(model, below, nodes, most)
        if found is None:
            unproven.append(system.name)
        else:
            cycles += found
    return replace(before, oscillations=tuple(cycles), open=tuple(unproven))


def _below(model: Model, top: Part, most: int) -> _Below | None:
    """Return what the systems below `top`, with it, see; None: that is too much."""
    names = _systems_below(model, top)
    systems = tuple(system for system in model.systems if system.name in names)
    rules = [rule for system in systems for rule in system.rules]
    statuses = outside_statuses(rules)
    seeing = {status: [s for s in systems if _sees(s, *status)] for status in statuses}
    shared = outside_reports(rules, MOST_LEVELS, [status for status in statuses if len(seeing[status]) > 1])
    if len(shared) > MOST_LEVELS:
        return None
    own = {
        s.name: outside_reports(s.rules, most, [status for status in statuses if seeing[status] == [s]])
        for s in systems
    }
    if any(len(reports) > most for reports in own.values()):
        return None
    return _Below(systems, shared, own)


def _sees(system: Part, key: str, name: str) -> bool:
    return any(
        r.diagnostics and r.diagnostics.hardware and r.diagnostics.is_about(key, name) for r in system.rules
    )


def _settle(
    model: Model, below: _Below, nodes: Mapping[str, Behaviors], most: int
) -> tuple[Oscillation, ...] | None:
    """Return the cycles of the last one of these systems; None: it has too many combinations.

    What a system does follows from what its rules and those of the systems below it see, and is computed once for each
    of these.
    """
    known: dict[object, SettledSystem | None] = {}
    cycles: dict[frozenset[str], Oscillation] = {}
    for bits, statuses in below.shared.items():
        behaviors = dict(nodes)
        found = None
        for system in below.systems:
            levels = below.levels_of(system, bits)
            key = system.name, frozenset(levels), *(id(behaviors[name]) for name in system.part_names)
            if key not in known:
                known[key] = settle_system(model, system, behaviors, most, levels)
            found = known[key]
            if found is None:
                return None
            behaviors[system.name] = found.behaviors
        for each in found.oscillations if found is not None else ():
            with_levels = replace(each, failures=statuses + each.failures)
            cycles.setdefault(frozenset(each.rules), with_levels)
    return tuple(cycles.values())


def _systems_below(model: Model, system: Part) -> frozenset[str]:
    """Return the names of a system and of all systems below it."""
    below = (_systems_below(model, model.parts[n]) for n in system.part_names if model.parts[n].is_system)
    return frozenset({system.name}).union(*below)
