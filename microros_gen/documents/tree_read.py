# SPDX-License-Identifier: Apache-2.0
"""Typed reads of a YAML tree, for files whose shape no schema has checked before.

Each function reports what does not fit at its place and returns the rest of it.
"""

from __future__ import annotations

from collections.abc import Collection

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.named import Named
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode


def expect_mapping(node: YamlNode | None, what: str, diagnostics: Diagnostics) -> MappingNode | None:
    """Return `node` as a mapping; another kind is an error about `what`."""
    if isinstance(node, MappingNode):
        return node
    if node is not None:
        diagnostics.error(
            f"{what} must be a mapping of keys and values",
            node.span,
            "Write `key: value` lines",
            id="MG-1007",
        )
    return None


def check_keys(
    node: MappingNode, known: Collection[str], required: Collection[str], diagnostics: Diagnostics
) -> None:
    """Report keys that are not known, with the nearest one that is, and keys that are missing."""
    for entry in node:
        if entry.key not in known:
            hint = nearest(entry.key, known) or f"Known: {', '.join(known)}"
            diagnostics.error(f"unknown key '{entry.key}'", entry.key_span, hint, id="MG-1008")
    for key in required:
        if key not in node.entries:
            diagnostics.error(f"missing key '{key}'", node.span, f"Add `{key}: …`", id="MG-1009")


def read_text(node: MappingNode, key: str, diagnostics: Diagnostics, default: str = "") -> str:
    """Return the text of `key`; `default` where it is not there."""
    value = node.get(key)
    if value is None:
        return default
    if isinstance(value, ScalarNode) and isinstance(value.value, str):
        return value.value
    diagnostics.error(f"'{key}' must be a text", value.span, "Put it into quotes", id="MG-1010")
    return default


def read_choice(
    node: MappingNode, key: str, choices: Collection[str], diagnostics: Diagnostics
) -> Named | None:
    """Return the value of `key`, one of `choices`, with its place; None where it is not there."""
    value = node.get(key)
    if value is None:
        return None
    if isinstance(value, ScalarNode) and value.text in choices:
        return Named(value.text, value.span)
    found = value.text if isinstance(value, ScalarNode) else ""
    hint = nearest(found, choices)
    diagnostics.error(f"'{key}' must be one of {', '.join(choices)}", value.span, hint, id="MG-1011")
    return None


def read_names(
    node: MappingNode, key: str, diagnostics: Diagnostics, known: Collection[str] | None = None
) -> tuple[Named, ...]:
    """Return the list of names of `key` with their places, each one of `known` where that is given."""
    value = node.get(key)
    if value is None:
        return ()
    if not isinstance(value, SequenceNode):
        diagnostics.error(f"'{key}' must be a list", value.span, f"Write `{key}: [a, b]`", id="MG-1012")
        return ()
    names: list[Named] = []
    for item in value.items:
        if not isinstance(item, ScalarNode) or not isinstance(item.value, str):
            diagnostics.error(f"'{key}' must list names", item.span, id="MG-1013")
        elif known is not None and item.value not in known:
            diagnostics.error(
                f"unknown value '{item.value}' in '{key}'",
                item.span,
                nearest(item.value, known),
                id="MG-1014",
            )
        else:
            names.append(Named(item.value, item.span))
    return tuple(names)
