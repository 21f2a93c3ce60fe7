# SPDX-License-Identifier: Apache-2.0
"""Whether the modes of parts are reached: a mode of their system commands them, or rules that can hold lead there.

Two sets of targets are computed for each system. It surely has those that rules lead to when its own system commands
it while some nodes are stuck. It can have no others than those that rules lead to while nodes fail and recover again
and again. What is only in the second set is not proven.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity
from microros_gen.modes.alike import alike_modes, without_alike
from microros_gen.modes.behavior import Settled, settle_all
from microros_gen.modes.model import Model, Part, Status, active
from microros_gen.modes.report import OPEN, PROVEN, REFUTED, Property


def check_reachable(model: Model, settled: Settled, most: int, diagnostics: Diagnostics) -> Property:
    """Report modes of parts that no mode of their system commands, and no rule of theirs leads to.

    A part that is in no system is requested from outside, `__DEFAULT__` is what activation leads to, and
    contingencies are reached by the node itself. `settled` is
    what `settle_all` returns of the model with `most`.
    """
    certain = settle_all(model, most, without_alike) if any(map(alike_modes, model.nodes)) else settled
    results = [PROVEN]
    for part in model.parts.values():
        if part.name not in model.parents:
            continue
        commanded = _commanded(model, part)
        sure = _surely(part, certain, commanded)
        possible = _possibly(model, part, settled, commanded)
        for mode in part.modes.values():
            if active(mode.name) in sure:
                continue
            is_open = active(mode.name) in possible
            results.append(OPEN if is_open else REFUTED)
            diagnostics.add(_finding(model, part, mode.name, commanded, is_open))
    result = next(r for r in (REFUTED, OPEN, PROVEN) if r in results)
    return Property(
        "reachable modes", result, f"modes: {sum(len(part.modes) for part in model.parts.values())}"
    )


def _commanded(model: Model, part: Part) -> frozenset[Status]:
    parent = model.parts[model.parents[part.name]]
    commands = (model.command(parent, goal, part.name) for goal in model.targets(parent))
    return frozenset({active(), *commands, *map(active, part.contingencies)})


def _surely(part: Part, settled: Settled, commanded: frozenset[Status]) -> frozenset[Status]:
    """Return the targets of a part for some target of its system and some failures."""
    led = settled.led.get(part.name, {})
    return commanded.union(*(led.get(target, frozenset()) for target in commanded))


def _possibly(model: Model, part: Part, settled: Settled, commanded: frozenset[Status]) -> frozenset[Status]:
    """Return all targets of a part, and perhaps more, when failures change while it has one of them.

    The status of a node can be any at any time. That of a subsystem follows from what happened before, so that each
    rule on one is taken to hold.
    """
    led = settled.led.get(part.name)
    if led is not None and not any(model.parts[name].is_system for name in part.part_names):
        return _closure(commanded, lambda target: led.get(target, frozenset()))
    return _closure(
        commanded, lambda target: [r.new_target for r in part.rules if r.if_target.is_same(target)]
    )


def _closure(start: frozenset[Status], following: Callable[[Status], Iterable[Status]]) -> frozenset[Status]:
    found = set(start)
    while more := {after for target in found for after in following(target)} - found:
        found |= more
    return frozenset(found)


def _finding(model: Model, part: Part, mode: str, commanded: frozenset[Status], is_open: bool) -> Diagnostic:
    parent = model.parents[part.name]
    used = ", ".join(sorted(target.mode for target in commanded if target.mode))
    rules = [f"'{rule.name}'" for rule in part.rules if rule.new_target.is_same(active(mode))]
    trace = [f"  '{parent}' commands {used}"]
    span = part.modes[mode].span
    if is_open:
        trace.append(f"  rules that lead to it: {', '.join(rules)}")
        message = f"not proven: the mode '{mode}' of '{part.name}' is reached"
        hint = f"Command it in a mode of '{parent}', or check that one of the rules can hold"
        return Diagnostic(message, span, hint, Severity.WARNING, block=tuple(trace), id="MG-8846")
    if rules:
        trace.append(f"  never applied: {', '.join(rules)}")
    message = f"the mode '{mode}' of '{part.name}' is never reached"
    hint = f"Command it in a mode of '{parent}', or remove it"
    return Diagnostic(message, span, hint, block=tuple(trace), id="MG-8843")
