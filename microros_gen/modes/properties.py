# SPDX-License-Identifier: Apache-2.0
"""Properties that follow from the structure of a model: modes differ from outside, commands are single."""

from __future__ import annotations

from itertools import combinations

from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity
from microros_gen.modes.model import ACTIVE, DEFAULT, Model, Part, Rule, Status, active
from microros_gen.modes.report import PROVEN, REFUTED, Property
from microros_gen.modes.templates import resolve


def check_inference(model: Model, diagnostics: Diagnostics) -> Property:
    """Report two modes of a system that look the same from outside.

    From outside a node has a state and parameter values: two of its modes with the same values look the same. Two
    modes of a node, neither of which is `__DEFAULT__`, are a warning: inference takes the target, else the first.
    """
    systems = [part for part in model.parts.values() if part.is_system]
    found = [d for system in systems for d in _same_modes(model, system)]
    for node in model.nodes:
        diagnostics.extend(_same_node_modes(model, node))
    diagnostics.extend(found)
    count = sum(len(system.modes) for system in systems)
    return Property("inference", REFUTED if found else PROVEN, f"modes of systems: {count}")


def _same_modes(model: Model, system: Part) -> list[Diagnostic]:
    found = []
    known: dict[object, str] = {}
    for mode in system.modes.values():
        first = known.setdefault(_outside(model, system, active(mode.name), {}), mode.name)
        if first != mode.name:
            trace = [f"  {name}: {mode.commands[name].target}" for name in system.part_names]
            message = f"the modes '{first}' and '{mode.name}' of '{system.name}' look the same from outside"
            hint = "Command another mode or state of a part in one of them"
            found.append(Diagnostic(message, mode.span, hint, block=tuple(trace), id="MG-8841"))
    return found


def _same_node_modes(model: Model, node: Part) -> list[Diagnostic]:
    found = []
    known: dict[object, str] = {}
    for mode in node.modes.values():
        if mode.name == DEFAULT:
            continue
        values = tuple((n, v.value, v.type, v.parent) for n, v in sorted(mode.parameters.items()))
        first = known.setdefault(values, mode.name)
        if first != mode.name:
            message = f"the modes '{first}' and '{mode.name}' of the node '{node.name}' have the same values"
            hint = "Remove one, or change a value"
            found.append(Diagnostic(message, mode.span, hint, Severity.WARNING, id="MG-8842"))
    return found


def _outside(model: Model, part: Part, status: Status, targets: dict[str, Status]) -> object:
    """Return what can be seen of a part that is `status` while the systems above it have `targets`."""
    if status.state != ACTIVE:
        return status.state
    mode = part.modes[status.mode]
    if not part.is_system:
        values = resolve(model, part, mode, targets)
        return ACTIVE, tuple((name, type(value), value) for name, value in sorted(values.items()))
    below = {**targets, part.name: status}
    commands = ((name, mode.commands[name].target) for name in part.part_names)
    return ACTIVE, tuple((n, _outside(model, model.parts[n], target, below)) for n, target in commands)


def check_commands(model: Model) -> Property:
    """Say why no part is commanded twice at once: it has one system, and that applies one rule at a time."""
    pairs = sum(
        _can_hold_at_once(a, b) for part in model.parts.values() for a, b in combinations(part.rules, 2)
    )
    detail = f"parts with one system: {len(model.parents)}"
    if pairs:
        detail += f"; pairs of rules of which the last by name is applied: {pairs}"
    return Property("single commands", PROVEN, detail)


def _can_hold_at_once(a: Rule, b: Rule) -> bool:
    """Return whether two rules of a system can hold at once and lead to different targets."""
    if not a.if_target.is_same(b.if_target) or a.new_target.is_same(b.new_target):
        return False
    return a.if_part != b.if_part or a.if_status.is_same(b.if_status)


def check_start_orders(model: Model) -> Property:
    """Say how many start orders there are; a circular one is refused when the file is read."""
    count = sum(len(followers) for part in model.parts.values() for followers in part.start_after.values())
    return Property("start order", PROVEN, f"parts that wait for another one: {count}")
