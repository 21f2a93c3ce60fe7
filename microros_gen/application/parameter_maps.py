# SPDX-License-Identifier: Apache-2.0
"""`__map_NAME` in a file of generate_parameter_library: one group for each text of the list NAME.

The list is found in the group that has the map, or in one around it. A device has the parameters that its image
declares, so the groups are those of the list's default, and the list is read-only.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from microros_gen.application.parameters import scalar_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import child, entries, items, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, YamlNode
from microros_gen.records import dataclass

MAP = "__map_"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


@dataclass(frozen=True)
class Maps:
    """What is below `root`, and the `lists` by whose texts it has groups.

    `scope`: the groups around the outermost map; None outside of a map.
    """

    root: YamlNode
    lists: frozenset[str]
    scope: tuple[str, ...] | None = None

    @staticmethod
    def of(root: YamlNode) -> Maps:
        """Return those of a file, from outside of its maps."""
        return Maps(root, frozenset(_lists(root, root, (), None)))

    def within(self, prefix: str) -> Maps:
        """Return it for what is below a map in the group with that prefix."""
        scope = tuple(part for part in prefix.split(".") if part)
        return self if self.scope is not None else replace(self, scope=scope)

    def values(self, entry: Entry, diagnostics: Diagnostics) -> tuple[str, ...]:
        """Return the texts of the list that a map names; none where they are no names, which is reported."""
        name = entry.key.removeprefix(MAP)
        _, found = _find(self.root, name, self.scope or ())
        if found is None:
            message = f"'{entry.key}' names no list of texts"
            hint = f"Declare {name}: {{type: string_array, default_value: [...]}} in the same group or one around it"
            diagnostics.error(message, entry.key_span, hint, id="MG-3076")
            return ()
        nodes = items(child(found, "default_value"))
        for node in nodes:
            value = scalar_of(node)
            if isinstance(value, str) and not _NAME.fullmatch(value):
                message = f"'{value}' is no part of a name"
                hint = f"Write {name_of(value)}: letters, digits and underscores"
                diagnostics.error(message, node.span, hint, id="MG-3078")
                return ()
        return tuple(dict.fromkeys(v for v in map(scalar_of, nodes) if isinstance(v, str)))


def name_of(text: str) -> str:
    """Return a name that is like a text which is none."""
    letters = re.sub(r"[^A-Za-z0-9_]+", "_", text).strip("_")
    return f"_{letters}" if not letters or letters[0].isdigit() else letters


def is_group(entry: Entry) -> bool:
    """Return whether an entry has parameters below it."""
    return isinstance(entry.value, MappingNode) and text_of(child(entry.value, "type")) is None


def _find(root: YamlNode, name: str, scope: tuple[str, ...]) -> tuple[str, YamlNode | None]:
    """Return the full name and declaration of the nearest list of that name; None if it does not exist."""
    for count in range(len(scope), -1, -1):
        node: YamlNode | None = root
        for part in (*scope[:count], name):
            node = child(node, part)
        if (text_of(child(node, "type")) or "").startswith("string_array"):
            return ".".join((*scope[:count], name)), node
    return name, None


def _lists(
    root: YamlNode, node: YamlNode, path: tuple[str, ...], scope: tuple[str, ...] | None
) -> Iterator[str]:
    """Yield the full names of the lists that the maps below `node` name."""
    for entry in filter(is_group, entries(node)):
        if entry.key.startswith(MAP):
            inner = path if scope is None else scope
            name, found = _find(root, entry.key.removeprefix(MAP), inner)
            yield from (name,) if found is not None else ()
            yield from _lists(root, entry.value, path, inner)
        else:
            yield from _lists(root, entry.value, (*path, entry.key), scope)
