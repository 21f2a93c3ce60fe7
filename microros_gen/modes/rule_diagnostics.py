# SPDX-License-Identifier: Apache-2.0
"""`diagnostics:` of a rule: which statuses of its node, or of what is no part, on /diagnostics let it apply."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.documents.tree_read import expect_mapping
from microros_gen.documents.tree_values import text_of
from microros_gen.documents.yaml_tree import MappingNode
from microros_gen.modes.model import ERROR, MANAGER_HARDWARE, Part, Rule, RuleDiagnostics, part_of
from microros_gen.modes.node_keys import check_pattern, check_published, parse_levels_and_names

DIAGNOSTICS_KEY = "diagnostics"
_HARDWARE = "hardware"


def parse_diagnostics(rule: MappingNode, name: str, diagnostics: Diagnostics) -> RuleDiagnostics | None:
    """Return what a rule wants of statuses; None: nothing, or it is wrong, which was reported."""
    node = expect_mapping(rule.get(DIAGNOSTICS_KEY), f"'{DIAGNOSTICS_KEY}' of '{name}'", diagnostics)
    if node is None:
        return None
    levels, names = parse_levels_and_names(node, name, diagnostics, (_HARDWARE,))
    hardware = _hardware(node, name, diagnostics)
    level = node.get("level")
    return RuleDiagnostics(levels, names, level.span, hardware) if levels and level is not None else None


def _hardware(node: MappingNode, rule: str, diagnostics: Diagnostics) -> str:
    """Return `hardware` of a rule; empty: it is not there, or wrong."""
    value = node.get(_HARDWARE)
    if value is None:
        return ""
    hardware = text_of(value) or ""
    if not hardware or hardware == MANAGER_HARDWARE:
        message = f"'{_HARDWARE}' of the diagnostics of '{rule}' must be a hardware_id of another program"
        hint = f"Write {_HARDWARE}: battery, or {_HARDWARE}: '*' for each"
        diagnostics.error(message, value.span, hint, id="MG-9836")
        return ""
    check_pattern(Named(hardware, value.span), diagnostics)
    return hardware


def check_rules(system: Part, parts: Mapping[str, Part], diagnostics: Diagnostics) -> None:
    """Report rules whose diagnostics never hold: of a system, of a status that nothing publishes, in another state."""
    for rule in system.rules:
        wanted = rule.diagnostics
        if wanted is not None and wanted.hardware:
            _check_outside(wanted, parts, diagnostics)
        elif wanted is not None and rule.if_part in parts:
            _check(rule, wanted, parts[rule.if_part], diagnostics)


def _check_outside(wanted: RuleDiagnostics, parts: Mapping[str, Part], diagnostics: Diagnostics) -> None:
    for named in wanted.names:
        part = part_of(named.name, parts)
        if part:
            own = named.name.lstrip("/")[len(part) :].lstrip(": ")
            message = f"'{named.name}' is a status of '{part}', which is a part: '{_HARDWARE}' leaves it out"
            what = f"names: [{own}]" if own.strip("*") else "no names"
            hint = f"Remove {_HARDWARE} and write {what}, in a rule on {part}"
            if parts[part].is_system:
                hint = "Name a status of no part: no rule waits for those of a system"
            diagnostics.error(message, named.span, hint, id="MG-9837")


def _check(rule: Rule, wanted: RuleDiagnostics, part: Part, diagnostics: Diagnostics) -> None:
    if part.is_system:
        message = f"'{part.name}' is a system, and the rule '{rule.name}' wants diagnostics of it"
        hint = f"Write a rule of '{part.name}' on one of its nodes, and name here what that leads to"
        diagnostics.error(message, wanted.span, hint, id="MG-9834")
        return
    check_published(part.name, wanted.names, part.published, diagnostics)
    names = wanted.patterns
    levels = (level for level in ("warn", "error", "stale") if any(wanted.covers(n, level) for n in names))
    is_error = all(part.diagnostics.is_error(level, name) for level in levels for name in names)
    if is_error and rule.if_status.state != ERROR:
        message = f"the rule '{rule.name}' never applies: with these statuses '{part.name}' is in {ERROR}"
        hint = f"Write if_part: [{part.name}, {ERROR}], or another level"
        diagnostics.error(message, wanted.span, hint, id="MG-9835")
