# SPDX-License-Identifier: Apache-2.0
"""Properties that follow from the structure of a model: modes differ from outside, commands are single."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity
from microros_gen.modes.inference import RESTING
from microros_gen.modes.model import DEFAULT, Mode, Model, Part, Rule, Status, active
from microros_gen.modes.report import PROVEN, REFUTED, Property
from microros_gen.modes.templates import resolve


def check_inference(model: Model, diagnostics: Diagnostics) -> Property:
    """Report two modes of a system that look the same from outside.

    From outside a node has a state and parameter values: two of its modes with the same values look the same, and one
    that is unconfigured fits a mode that wants it inactive. Two modes of a node, neither of which is `__DEFAULT__`, are
    a warning: inference takes the target, else the first.
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
        first = known.setdefault(tuple(_outside(model, system, active(mode.name), {})), mode.name)
        if first != mode.name:
            trace = _both(system, system.modes[first], mode)
            message = f"the modes '{first}' and '{mode.name}' of '{system.name}' look the same from outside"
            hint = "Command another mode or state of a part in one of them"
            found.append(Diagnostic(message, mode.span, hint, block=tuple(trace), id="MG-8841"))
    return found


def _both(system: Part, first: Mode, second: Mode) -> list[str]:
    """Return a line for each part: what two modes command it to be."""
    lines = []
    for name in system.part_names:
        before, after = first.commands[name].target, second.commands[name].target
        differ = f" in '{first.name}', {after} in '{second.name}'" if not before.is_same(after) else ""
        lines.append(f"  {name}: {before}{differ}")
    return lines


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


def _outside(model: Model, part: Part, status: Status, targets: Mapping[str, Status]) -> Iterator[object]:
    """Yield what can be seen of each node of a part that is commanded to be `status`, below systems with `targets`.

    Nodes are all that can be seen: the state of a system is inferred from them.
    """
    if part.is_system:
        below = {**targets, part.name: status}
        for name in part.part_names:
            yield from _outside(model, model.parts[name], model.command(part, status, name), below)
    elif status.state in RESTING:
        yield part.name, RESTING
    else:
        values = resolve(model, part, part.modes[status.mode], targets)
        yield part.name, tuple((name, type(value), value) for name, value in sorted(values.items()))


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
