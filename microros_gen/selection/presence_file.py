# SPDX-License-Identifier: Apache-2.0
"""The part of `component.yaml` that says how a component appears → Presence."""

from __future__ import annotations

from microros_gen.documents.tree_values import child, child_text, entries, int_of, items, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode
from microros_gen.selection.contribution_file import conditions_of
from microros_gen.selection.presence import (
    ExamplePart,
    ManifestEntry,
    MemoryUse,
    Presence,
    ReportRow,
    SelectingCall,
)

KEYS = ("example", "manifest", "reports", "size", "calls")


def read_presence(node: MappingNode) -> Presence:
    """Return how the component of `node` appears; component.schema.json has the structure."""
    example = node.get("example")
    return Presence(
        example=() if example is None else (_example(example),),
        manifest=tuple(
            ManifestEntry(name=e.key, value=_value(e.value), when=conditions_of(e.value))
            for e in entries(node.get("manifest"))
        ),
        reports=tuple(
            ReportRow(
                name=child_text(i, "name"),
                value=child_text(i, "value"),
                why=child_text(i, "why"),
                when=conditions_of(i),
            )
            for i in items(node.get("reports"))
        ),
        memory=tuple(
            MemoryUse(
                variable=e.key,
                use=text_of(e.value) or child_text(e.value, "use"),
                when=conditions_of(e.value),
            )
            for e in entries(node.get("size"))
        ),
        calls=tuple(
            SelectingCall(text_of(i) or child_text(i, "name"), child_text(i, "conversions"))
            for i in items(node.get("calls"))
        ),
    )


def _example(node: YamlNode) -> ExamplePart:
    includes = tuple(text_of(i) or "" for i in items(child(node, "includes")))
    handles = child(node, "handles")
    return ExamplePart(
        includes=includes, handles=int_of(handles) or text_of(handles) or 0, when=conditions_of(node)
    )


def _value(node: YamlNode | None) -> int | str:
    """Return a number or path that is written alone or as `value`."""
    value = child(node, "value") or node
    number = int_of(value)
    return (text_of(value) or "") if number is None else number
