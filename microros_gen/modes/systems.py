# SPDX-License-Identifier: Apache-2.0
"""A system of a model file: its parts, modes, rules and start order."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.named import Named
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.tree_values import entries, items, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, SequenceNode, YamlNode
from microros_gen.modes.model import DEFAULT, Command, Mode, Part, Rule, Status, Value
from microros_gen.modes.outline import PARAMETERS, Outline, plain_name
from microros_gen.modes.part_names import PartList, parse_names
from microros_gen.modes.rule_diagnostics import DIAGNOSTICS_KEY, parse_diagnostics
from microros_gen.modes.statuses import Subject, parse_status, parse_target
from microros_gen.modes.values import inherit, parse_values
from microros_gen.records import dataclass

_RULE_KEYS = ("if_target", "if_part", "new_target")
_RECOVER_KEY = "recover_if"


@dataclass(frozen=True)
class _Parts:
    """The parts of a system by name; `is_complete` false: names that are not among them were reported before."""

    subjects: Mapping[str, Subject]
    is_complete: bool


def parse_system(
    outline: Outline, listed: PartList, subjects: Mapping[str, Subject], diagnostics: Diagnostics
) -> Part:
    """Return the system with the parts of `listed`; what is wrong with it is reported and left out."""
    own = _Parts({part.name: subjects[part.name] for part in listed.parts}, listed.is_complete)
    return Part(
        outline.name,
        True,
        outline.span,
        _modes(outline, own, diagnostics),
        listed.parts,
        _rules(outline, own, diagnostics),
        _start_after(outline, own, diagnostics),
    )


def _modes(outline: Outline, parts: _Parts, diagnostics: Diagnostics) -> dict[str, Mode]:
    found: dict[str, Mode] = {}
    default = outline.modes.get(DEFAULT)
    for entry in ([default] if default else []) + [e for e in outline.modes.values() if e is not default]:
        mode = expect_mapping(entry.value, f"the mode '{entry.key}'", diagnostics)
        base = found.get(DEFAULT)
        commands = dict(base.commands) if base else {}
        commands.update(_commands(entry.key, mode, parts, diagnostics))
        values = _values(entry.key, mode, base.parameters if base else None, diagnostics)
        found[entry.key] = Mode(entry.key, entry.key_span, values, commands)
        if entry is default and mode is not None:
            _check_complete(outline, mode, parts, diagnostics)
    return {name: found[name] for name in outline.modes}


def _values(
    mode: str, node: MappingNode | None, default: Mapping[str, Value] | None, diagnostics: Diagnostics
) -> dict[str, Value]:
    own = parse_values(node.get(PARAMETERS) if node else None, diagnostics)
    return inherit(mode, own, default, diagnostics)


def _commands(
    mode: str, node: MappingNode | None, parts: _Parts, diagnostics: Diagnostics
) -> dict[str, Command]:
    found: dict[str, Command] = {}
    for entry in node or ():
        if entry.key == PARAMETERS:
            continue
        name = plain_name(entry.key)
        if name not in parts.subjects:
            if parts.is_complete:
                hint = nearest(name, parts.subjects) or f"Add it to the parts: {', '.join(parts.subjects)}"
                message = f"unknown part '{name}' in the mode '{mode}'"
                diagnostics.error(message, entry.key_span, hint, id="MG-8813")
            continue
        target = parse_target(entry.value, parts.subjects[name], diagnostics)
        if target is not None:
            found[name] = Command(target, entry.value.span)
    return found


def _check_complete(outline: Outline, mode: MappingNode, parts: _Parts, diagnostics: Diagnostics) -> None:
    named = {plain_name(entry.key) for entry in mode}
    for name in parts.subjects:
        if name not in named:
            message = f"{DEFAULT} of '{outline.name}' gives no state of the part '{name}'"
            hint = f"Add `{name}: inactive`, or active"
            diagnostics.error(message, outline.modes[DEFAULT].key_span, hint, id="MG-8812")


def _rules(outline: Outline, parts: _Parts, diagnostics: Diagnostics) -> tuple[Rule, ...]:
    node = outline.body.get("rules")
    rules = expect_mapping(node, f"'rules' of '{outline.name}'", diagnostics)
    found = [_rule(entry, outline, parts, diagnostics) for entry in rules or ()]
    return tuple(sorted((rule for rule in found if rule is not None), key=lambda rule: rule.name))


def _rule(entry: Entry, outline: Outline, parts: _Parts, diagnostics: Diagnostics) -> Rule | None:
    node = expect_mapping(entry.value, f"the rule '{entry.key}'", diagnostics)
    if node is None:
        return None
    check_keys(node, (*_RULE_KEYS, _RECOVER_KEY, DIAGNOSTICS_KEY), _RULE_KEYS, diagnostics)
    if_target, if_part, new_target = (node.get(key) for key in _RULE_KEYS)
    if if_target is None or if_part is None or new_target is None:
        return None
    target = parse_target(if_target, outline.subject, diagnostics)
    goal = parse_target(new_target, outline.subject, diagnostics)
    pair = _part_status(if_part, outline, parts, diagnostics)
    if target is None or goal is None or pair is None:
        return None
    part, status = pair
    parsed = parse_status(status, parts.subjects[part], diagnostics)
    if parsed is None:
        return None
    recover_part, statuses = _recovery(node.get(_RECOVER_KEY), outline, parts, diagnostics)
    wanted = parse_diagnostics(node, entry.key, diagnostics)
    return Rule(entry.key, target, part, parsed, goal, entry.key_span, recover_part, statuses, wanted)


def _recovery(
    node: YamlNode | None, outline: Outline, parts: _Parts, diagnostics: Diagnostics
) -> tuple[str, tuple[Status, ...]]:
    """Return the part and the statuses of `recover_if: [part, inactive, …]`; none without the key."""
    if node is None:
        return "", ()
    found = items(node)
    if not isinstance(node, SequenceNode) or len(found) < 2 or text_of(found[0]) is None:
        message = f"'{_RECOVER_KEY}' must be a part and its states"
        hint = f"Write {_RECOVER_KEY}: [part, inactive, unconfigured]"
        diagnostics.error(message, node.span, hint, id="MG-8885")
        return "", ()
    name = _part_name(found[0], outline, parts, diagnostics)
    if not name:
        return "", ()
    parsed = (parse_status(each, parts.subjects[name], diagnostics) for each in found[1:])
    return name, tuple(status for status in parsed if status is not None)


def _part_status(
    node: YamlNode, outline: Outline, parts: _Parts, diagnostics: Diagnostics
) -> tuple[str, YamlNode] | None:
    """Return the part and the status of `if_part: [part, status]`."""
    found = items(node)
    if not isinstance(node, SequenceNode) or len(found) != 2 or text_of(found[0]) is None:
        message = "'if_part' must be a part and its state"
        diagnostics.error(message, node.span, "Write if_part: [part, inactive]", id="MG-8830")
        return None
    name = _part_name(found[0], outline, parts, diagnostics)
    return (name, found[1]) if name else None


def _part_name(node: YamlNode, outline: Outline, parts: _Parts, diagnostics: Diagnostics) -> str:
    """Return the name of a part in a rule; empty: the system does not have it."""
    name = plain_name(text_of(node) or "")
    if name in parts.subjects:
        return name
    if parts.is_complete:
        hint = nearest(name, parts.subjects) or f"Known: {', '.join(parts.subjects)}"
        message = f"'{name}' is no part of '{outline.name}', whose rule names it"
        diagnostics.error(message, node.span, hint, id="MG-8831")
    return ""


def _start_after(outline: Outline, parts: _Parts, diagnostics: Diagnostics) -> dict[str, tuple[Named, ...]]:
    node = outline.body.get("start_after")
    expect_mapping(node, f"'start_after' of '{outline.name}'", diagnostics)
    found: dict[str, tuple[Named, ...]] = {}
    for entry in entries(node):
        followers = (Named(plain_name(entry.key), entry.key_span),)
        named = parse_names(entry.value, diagnostics)
        for name in (*followers, *named):
            if name.name not in parts.subjects and parts.is_complete:
                hint = nearest(name.name, parts.subjects) or f"Known: {', '.join(parts.subjects)}"
                message = f"'start_after' of '{outline.name}' names '{name.name}', which is no part of it"
                diagnostics.error(message, name.span, hint, id="MG-8826")
        found[followers[0].name] = tuple(name for name in named if name.name in parts.subjects)
    return {name: before for name, before in found.items() if name in parts.subjects}
