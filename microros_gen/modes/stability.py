# SPDX-License-Identifier: Apache-2.0
"""Whether the rules of a model end in a stable state for every combination of failures; counterexamples as traces."""

from __future__ import annotations

from collections.abc import Iterator
from math import prod

from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity
from microros_gen.modes.alike import alike_modes, with_inferred
from microros_gen.modes.behavior import Oscillation, Settled, every_failure, failure_states, settle_all
from microros_gen.modes.manager import OSCILLATES, Manager, Step
from microros_gen.modes.model import INACTIVE, Model, Status
from microros_gen.modes.report import OPEN, PROVEN, REFUTED, Property
from microros_gen.modes.reports import Diagnosis
from microros_gen.modes.together import has_shared_statuses, settle_together

MOST_COMBINATIONS = 100_000
"""Different combinations of a system that are kept by default; 6 parts with a few modes and rules have some hundred."""

_LONGEST_TRACE = 40


def check_stability(model: Model, settled: Settled, most: int, diagnostics: Diagnostics) -> Property:
    """Report each cycle of rules with a trace, and each system of which `most` combinations do not say enough.

    `settled` is what `settle_all` returns of the model.
    """
    has_alike = any(map(alike_modes, model.nodes))
    inferred = settle_all(model, most, with_inferred) if has_alike else settled
    if not all(_is_possible(model, found) for found in settled.oscillations):
        settled = settle_together(model, most, every_failure, settled)
    if not has_alike:
        inferred = settled
    elif inferred.oscillations and has_shared_statuses(model):
        inferred = settle_together(model, most, with_inferred, inferred)
    certain = [found for found in settled.oscillations if _is_possible(model, found)]
    for oscillation in settled.oscillations:
        diagnostics.add((_oscillation if oscillation in certain else _possible)(model, oscillation))
    for name in inferred.open:
        message = f"not proven for '{name}': more than {most} different combinations of failures"
        hint = "Raise --limit, or split the system"
        span = model.parts[name].span
        diagnostics.add(Diagnostic(message, span, hint, Severity.WARNING, id="MG-8845"))
    vague = [] if settled.oscillations else [_undecided(model, found) for found in inferred.oscillations]
    diagnostics.extend(vague)
    is_open = bool(settled.oscillations or inferred.open or vague)
    result = REFUTED if certain else OPEN if is_open else PROVEN
    count = prod(1 + len(failure_states(node)) for node in model.nodes)
    rules = [rule for part in model.parts.values() for rule in part.rules]
    diagnosed = sum(rule.diagnostics is not None for rule in rules)
    of = f", with diagnostics: {diagnosed}" if diagnosed else ""
    detail = f"rules: {len(rules)}{of}; combinations of failures: {count:,}, different: {settled.kept:,}"
    return Property("stable rules", result, detail)


def _undecided(model: Model, found: Oscillation) -> Diagnostic:
    """Return a warning: rules may oscillate because modes of a node have the same values."""
    rules = ", ".join(f"'{name}'" for name in found.rules)
    message = f"not proven for '{found.system}': its rules {rules} take modes with the same values for others"
    hint = "Let the modes of a node differ in a value"
    block = tuple(f"  {_fault(*failure)}" for failure in found.failures)
    span = model.parts[found.system].span
    return Diagnostic(message, span, hint, Severity.WARNING, block=block, id="MG-8847")


def _is_possible(model: Model, found: Oscillation) -> bool:
    """Return whether the failures that were found let rules oscillate.

    With rules of several systems on statuses of no part they may not: if each system was taken for itself, two of them
    may have been given different levels of one status.
    """
    return not has_shared_statuses(model) or any(line.startswith(OSCILLATES) for line in _lines(model, found))


def _possible(model: Model, found: Oscillation) -> Diagnostic:
    """Return a warning: rules oscillate if two systems see different levels of one status."""
    rules = ", ".join(f"'{name}'" for name in found.rules)
    message = f"not proven for '{found.system}': its rules {rules} oscillate if two systems see one status differently"
    hint = "Let only one system have rules with 'hardware'"
    block = tuple(f"  {_fault(*failure)}" for failure in found.failures)
    span = model.parts[found.system].span
    return Diagnostic(message, span, hint, Severity.WARNING, block=block, id="MG-9838")


def _oscillation(model: Model, found: Oscillation) -> Diagnostic:
    system = model.parts[found.system]
    rule = next(rule for rule in system.rules if rule.name == found.rules[0])
    names = ", ".join(f"'{name}'" for name in found.rules)
    message = f"the rules of '{found.system}' oscillate: {names}"
    hint = "Let one of them lead to a target that has no rule for this failure"
    block = tuple(f"  {line}" for line in trace(model, found))
    return Diagnostic(message, rule.span, hint, block=block, id="MG-8844")


def trace(model: Model, found: Oscillation) -> list[str]:
    """Return the first lines of what happens when a system is requested while nodes are stuck."""
    lines = _lines(model, found)
    return lines if len(lines) <= _LONGEST_TRACE else [*lines[:_LONGEST_TRACE], "…"]


def _lines(model: Model, found: Oscillation) -> list[str]:
    manager = Manager(model)
    lines = []
    for node, what in found.failures:
        lines.append(_fault(node, what))
        for _ in _steps(manager, node, what):
            pass  # no part has a target yet: nothing happens
    for node in found.configured:
        lines.append(f"configured {node}")
        for _ in manager.change(node, Status(INACTIVE)):
            pass
    lines.append(f"request {found.system} {found.request}")
    return [*lines, *(str(step) for step in manager.request(found.system, found.request))]


def _steps(manager: Manager, node: str, what: Status | Diagnosis) -> Iterator[Step]:
    if isinstance(what, Diagnosis):
        return manager.diagnose(node, what.name, what.level)
    return manager.fail(node, what)


def _fault(node: str, what: Status | Diagnosis) -> str:
    """Return the line of a trace: where a node is stuck, or what a status of it is."""
    return f"{'diagnosed' if isinstance(what, Diagnosis) else 'failed'} {node} {what}"
