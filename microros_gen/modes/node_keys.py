# SPDX-License-Identifier: Apache-2.0
"""What a model file can say of a node besides its modes: `contingencies` and `diagnostics`."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.tree_values import items, text_of
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode
from microros_gen.modes.model import ERROR_LEVEL, STALE_LEVEL, WARN_LEVEL, DiagnosticLevels

LEVELS = (WARN_LEVEL, ERROR_LEVEL, STALE_LEVEL)


def parse_contingencies(
    body: MappingNode, part: str, modes: tuple[str, ...], diagnostics: Diagnostics
) -> tuple[str, ...]:
    """Return the modes that a node changes to by itself; names of no mode are reported and left out."""
    found: list[str] = []
    for item in _listed(body.get("contingencies"), "contingencies", "[SAFE]", diagnostics):
        name = text_of(item) or ""
        if name in modes:
            found.append(name)
            continue
        hint = nearest(name, modes) or f"Known: {', '.join(modes)}"
        diagnostics.error(
            f"'contingencies' of '{part}': unknown mode '{name}'", item.span, hint, id="MG-8881"
        )
    return tuple(dict.fromkeys(found))


def parse_levels(body: MappingNode, part: str, diagnostics: Diagnostics) -> DiagnosticLevels:
    """Return which levels of /diagnostics are errors of a node; ERROR always is one."""
    node = expect_mapping(body.get("diagnostics"), f"'diagnostics' of '{part}'", diagnostics)
    if node is None:
        return DiagnosticLevels()
    check_keys(node, ("level", "names"), ("level",), diagnostics)
    levels = [ERROR_LEVEL]
    for item in _listed(node.get("level"), "level", "warn, or [warn, stale]", diagnostics):
        name = text_of(item) or ""
        levels.append(name)
        if name not in LEVELS:
            hint = nearest(name, LEVELS) or f"Known: {', '.join(LEVELS)}"
            message = f"unknown level '{name}' of the diagnostics of '{part}'"
            diagnostics.error(message, item.span, hint, id="MG-8882")
    names = (text_of(item) or "" for item in _listed(node.get("names"), "names", "[battery]", diagnostics))
    return DiagnosticLevels(tuple(level for level in LEVELS if level in levels), tuple(names))


def _listed(node: YamlNode | None, key: str, example: str, diagnostics: Diagnostics) -> Iterator[YamlNode]:
    """Yield the texts of a list, or the only one."""
    if isinstance(node, ScalarNode) and text_of(node) is not None:
        yield node
    elif isinstance(node, SequenceNode) and all(text_of(item) is not None for item in node.items):
        yield from items(node)
    elif node is not None:
        message = f"'{key}' must be a text, or a list of texts"
        diagnostics.error(message, node.span, f"Write {key}: {example}", id="MG-8883")
