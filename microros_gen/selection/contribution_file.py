# SPDX-License-Identifier: Apache-2.0
"""The part of `component.yaml` that says what a component contributes → Contributions.

component.schema.json has the structure; what it cannot say (the calls, the phases) is checked here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.tree_values import bool_of, child, child_text, entries, int_of, items, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, YamlNode
from microros_gen.selection.contribution import (
    HOOK_POINTS,
    Conditions,
    Contributions,
    Counter,
    ErrorCode,
    Handler,
    Hook,
    HookHeader,
    Include,
    InitOption,
    Kept,
    Output,
    Property,
    Replacement,
    Setting,
    State,
    Variant,
)

KEYS = (
    "hook_headers",
    "state",
    "kept",
    "hooks",
    "on",
    "output",
    "errors",
    "config",
    "counters",
    "properties",
    "includes",
    "variants",
    "replaces",
    "init_options",
)
_CALL = re.compile(r"(?:\(void\))?[a-z_]\w*\((?:[^\";{}=]*)\)")
_WORD = re.compile(r"(?<![\w>.])[a-z_]\w*(?!\w*\()")


def read_contributions(node: MappingNode, diagnostics: Diagnostics) -> Contributions:
    """Return what `node`, a component file, contributes; faulty calls and phases are errors in `diagnostics`."""
    return Contributions(
        hook_headers=tuple(
            HookHeader(header=text_of(i) or child_text(i, "header"), when=conditions_of(i))
            for i in items(node.get("hook_headers"))
        ),
        state=tuple(
            State(
                declaration=child_text(i, "declare"),
                section=child_text(i, "section"),
                header=child_text(i, "header"),
                comment=child_text(i, "comment"),
                clocks=tuple(text_of(c) or "" for c in items(child(i, "clocks"))),
                when=conditions_of(i),
            )
            for i in items(node.get("state"))
        ),
        kept=tuple(
            Kept(field=e.key, type=_value(e, "type"), when=conditions_of(e.value))
            for e in entries(node.get("kept"))
        ),
        hooks=tuple(_hooks(node, diagnostics)),
        handlers=tuple(
            Handler(submessage=e.key, function=_value(e, "function"), when=conditions_of(v))
            for e, v in _each(node, "on")
        ),
        outputs=tuple(_output(e) for e in entries(node.get("output"))),
        errors=tuple(_error(e) for e in entries(node.get("errors"))),
        config=tuple(_setting(section.key, e) for section, e in _sections(node.get("config"))),
        counters=tuple(
            Counter(
                group=child_text(i, "group"),
                name=child_text(i, "name"),
                value=child_text(i, "value"),
                warns=bool_of(child(i, "warns")) or False,
                header=child_text(i, "header"),
                each=child_text(i, "each"),
                when=conditions_of(i),
            )
            for i in items(node.get("counters"))
        ),
        properties=tuple(
            Property(
                name=e.key, value=child_text(e.value, "value"), digits=int_of(child(e.value, "digits")) or 0
            )
            for e in entries(node.get("properties"))
        ),
        includes=tuple(
            Include(into=e.key, header=text_of(i) or child_text(i, "header"), when=conditions_of(i))
            for e in entries(node.get("includes"))
            for i in items(e.value)
        ),
        variants=tuple(
            Variant(header=child_text(i, "header"), file=child_text(i, "file"), when=conditions_of(i))
            for i in items(node.get("variants"))
        ),
        replaces=tuple(
            Replacement(header=text_of(i) or child_text(i, "header"), when=conditions_of(i))
            for i in items(node.get("replaces"))
        ),
        init_options=tuple(
            InitOption(
                function=e.key,
                arguments=child_text(e.value, "arguments"),
                comment=child_text(e.value, "comment"),
                absent=child_text(e.value, "absent"),
                unmet=child_text(e.value, "unmet"),
                when=conditions_of(e.value),
            )
            for e in entries(node.get("init_options"))
        ),
    )


def read_conditions(when: YamlNode | None) -> Conditions | None:
    """Return the conditions of `when`, none where it is missing; None where it is no mapping of plain values."""
    if when is None:
        return ()
    if not isinstance(when, MappingNode):
        return None
    values = [(e.key, e.value.value) for e in when if isinstance(e.value, ScalarNode)]
    found = tuple((k, v) for k, v in values if isinstance(v, (str, int)))
    return found if len(found) == len(when.entries) else None


def conditions_of(node: YamlNode | None) -> Conditions:
    """Return the conditions of `when` in `node`; none where it is missing or was reported."""
    return read_conditions(child(node, "when")) or ()


def _value(entry: Entry, key: str) -> str:
    """Return the value of an entry that is a text, or a mapping that has it as `key`."""
    return text_of(entry.value) or child_text(entry.value, key)


def _each(node: MappingNode, key: str) -> Iterator[tuple[Entry, YamlNode]]:
    """Yield the entries of `key`; one with a list once for each item."""
    for entry in entries(node.get(key)):
        for value in items(entry.value) or (entry.value,):
            yield Entry(entry.key, entry.key_span, value), value


def _sections(node: YamlNode | None) -> Iterator[tuple[Entry, Entry]]:
    for section in entries(node):
        for entry in entries(section.value):
            yield section, entry


def _hooks(node: MappingNode, diagnostics: Diagnostics) -> Iterator[Hook]:
    for entry, value in _each(node, "hooks"):
        name, _, phase = entry.key.partition("/")
        point = HOOK_POINTS.get(name)
        if point is None:
            message = f"unknown hook point '{name}'"
            diagnostics.error(message, entry.key_span, nearest(name, HOOK_POINTS), id="MG-4044")
            continue
        if phase not in point.phases:
            phases = " or ".join(f"{name}/{p}" if p else name for p in point.phases)
            diagnostics.error(
                f"unknown phase '{phase}' of '{name}'", entry.key_span, f"Write {phases}", id="MG-4045"
            )
        call, test = _value(entry, "call"), child_text(value, "test")
        for text in (call, test) if test else (call,):
            _check_call(text, point.variables, value, diagnostics)
        yield Hook(point=name, phase=phase, call=call, test=test, when=conditions_of(value))


def _check_call(call: str, variables: tuple[str, ...], node: YamlNode, diagnostics: Diagnostics) -> None:
    example = f"Write a call such as `xrce_x_step({', '.join(variables)})`"
    if not _CALL.fullmatch(call):
        diagnostics.error(f"'{call}' is not a call of a C function", node.span, example, id="MG-4046")
        return
    for word in _WORD.findall(call.removeprefix("(void)").partition("(")[2]):
        if word not in variables:
            diagnostics.error(f"unknown variable '{word}' of the hook", node.span, example, id="MG-4047")


def _output(entry: Entry) -> Output:
    calls = tuple((e.key, text_of(e.value) or "") for e in entries(entry.value) if text_of(e.value))
    return Output(stream=entry.key, calls=calls, when=conditions_of(entry.value))


def _error(entry: Entry) -> ErrorCode:
    code = int_of(child(entry.value, "code"))
    own = int_of(entry.value)
    return ErrorCode(name=entry.key, code=own or code or 0, text=child_text(entry.value, "text"))


def _setting(section: str, entry: Entry) -> Setting:
    return Setting(
        name=entry.key,
        section=section,
        value=_value(entry, "value"),
        comment=child_text(entry.value, "comment"),
        when=conditions_of(entry.value),
    )
