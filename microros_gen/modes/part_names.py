# SPDX-License-Identifier: Apache-2.0
"""`parts:` of a system → names with their places.

The files of the package list the parts as lines without hyphens, which YAML reads as one text.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.named import Named
from microros_gen.documents.tree_values import text_of
from microros_gen.documents.yaml_tree import ScalarNode, SequenceNode, YamlNode
from microros_gen.modes.outline import Outline, plain_name
from microros_gen.records import dataclass

_WORD = re.compile(r"\S+")


@dataclass(frozen=True)
class PartList:
    """The parts of a system; `is_complete` false: some could not be read, which was reported."""

    parts: tuple[Named, ...]
    is_complete: bool


def parse_parts(
    outline: Outline, known: Collection[str], unreadable: Collection[str], diagnostics: Diagnostics
) -> PartList:
    """Return the parts of a system, each one of `known` and named once; those in `unreadable` were reported."""
    found: dict[str, Named] = {}
    own_diagnostics = Diagnostics()
    node = outline.body.get("parts")
    names = tuple(_names(node, own_diagnostics))
    for named in names:
        if named.name in found:
            message = f"'{named.name}' is listed as a part of '{outline.name}' before"
            own_diagnostics.error(message, named.span, "Remove it", id="MG-8807")
        elif named.name in known:
            found[named.name] = named
        elif named.name not in unreadable:
            hint = nearest(named.name, known) or "Add it to this file"
            message = f"unknown part '{named.name}' of '{outline.name}'"
            own_diagnostics.error(message, named.span, hint, id="MG-8806")
    if node is not None and not names and not own_diagnostics.has_errors():
        message = f"the system '{outline.name}' has no parts"
        own_diagnostics.error(message, node.span, "List at least one part", id="MG-8809")
    diagnostics.extend(own_diagnostics)
    return PartList(tuple(found.values()), len(found) == len(names) > 0)


def parse_names(node: YamlNode | None, diagnostics: Diagnostics) -> tuple[Named, ...]:
    """Return names of a list, or of a text with one or more of them."""
    return tuple(_names(node, diagnostics))


def _names(node: YamlNode | None, diagnostics: Diagnostics) -> Iterator[Named]:
    if isinstance(node, ScalarNode) and isinstance(node.value, str):
        for word, span in _words(node):
            yield Named(plain_name(word), span)
    elif isinstance(node, SequenceNode) and all(text_of(item) is not None for item in node.items):
        for item in node.items:
            yield Named(plain_name(text_of(item) or ""), item.span)
    elif node is not None:
        hint = "Write one name a line, or a list"
        diagnostics.error("a list of parts must have names only", node.span, hint, id="MG-8808")


def _words(node: ScalarNode) -> Iterator[tuple[str, Span]]:
    """Yield the words of a text that may go over several lines, each with its place.

    A word that is written with an escape, and those after it, have the place of the whole text.
    """
    span = node.span
    lines = span.source.text.splitlines()
    line, column, is_found = span.line - 1, span.column - (1 if node.plain else 0), True
    for word in _WORD.findall(node.text):
        while is_found and line < len(lines) and not lines[line][column:].strip():
            line, column = line + 1, 0
        rest = lines[line][column:] if line < len(lines) else ""
        column += len(rest) - len(rest.lstrip())
        is_found = is_found and rest.lstrip().startswith(word)
        yield word, Span(span.source, line + 1, column + 1, column + 1 + len(word)) if is_found else span
        column += len(word) if is_found else 0
