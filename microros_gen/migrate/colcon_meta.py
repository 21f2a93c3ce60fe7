# SPDX-License-Identifier: Apache-2.0
"""colcon.meta (JSON or YAML) → the settings that it gives to packages, each with its place."""

from __future__ import annotations

import re
from collections.abc import Iterator

from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.tree_read import expect_mapping
from microros_gen.documents.yaml_tree import (
    Entry,
    MappingNode,
    ScalarNode,
    SequenceNode,
    YamlNode,
    parse_yaml,
)
from microros_gen.records import dataclass

_DEFINITION = re.compile(r"-D\s*(?P<name>[A-Za-z_][A-Za-z0-9_]*)(?::[A-Z]+)?=(?P<value>.*)", re.DOTALL)
_DUPLICATE_KEY = "MG-1044"


@dataclass(frozen=True)
class MetaSetting:
    """`-DNAME=VALUE` of a package; another argument has no `name` and is its `value`."""

    package: str
    name: str
    value: str
    span: Span

    def __str__(self) -> str:
        return f"{self.package} {self.name}={self.value}" if self.name else f"{self.package} {self.value}"


@reads
def read_settings(source: Source, diagnostics: Diagnostics) -> tuple[MetaSetting, ...]:
    """Return every argument of CMake that `source` gives, in its order.

    Report a file that is not a colcon.meta. Of a duplicate package, which JSON allows, the first is used;
    the other one is a warning.
    """
    found = Diagnostics()
    tree = parse_yaml(Source(source.name, source.text.replace("\t", " ")), found)
    for diagnostic in found:
        if diagnostic.id == _DUPLICATE_KEY:
            diagnostics.warning(
                diagnostic.message + "; the first one is used", diagnostic.span, diagnostic.hint, id="MG-9006"
            )
        else:
            diagnostics.extend([diagnostic])
    root = expect_mapping(tree, f"'{source.name}'", diagnostics)
    if tree is None and not found.has_errors():
        diagnostics.error(
            f"'{source.name}' is empty", hint="A colcon.meta has a mapping `names` of packages", id="MG-9007"
        )
    if root is None:
        return ()
    packages = [
        entry
        for key in ("names", "paths")
        if (node := root.get(key)) is not None
        for entry in _entries(node, f"'{key}'", diagnostics)
    ]
    if not packages and not diagnostics.has_errors():
        diagnostics.error(
            "no packages in this file", root.span, "A colcon.meta has a mapping `names` of them", id="MG-9008"
        )
    return tuple(setting for entry in packages for setting in _settings(entry, diagnostics))


def _entries(node: YamlNode, what: str, diagnostics: Diagnostics) -> Iterator[Entry]:
    yield from expect_mapping(node, what, diagnostics) or MappingNode({}, node.span)


def _settings(package: Entry, diagnostics: Diagnostics) -> Iterator[MetaSetting]:
    name = package.key.rstrip("/").rsplit("/", 1)[-1]
    for entry in _entries(package.value, f"package '{package.key}'", diagnostics):
        if entry.key == "cmake-args":
            yield from _arguments(name, entry.value, diagnostics)
        else:
            yield MetaSetting(name, "", f"`{entry.key}`", entry.key_span)


def _arguments(package: str, node: YamlNode, diagnostics: Diagnostics) -> Iterator[MetaSetting]:
    items = node.items if isinstance(node, SequenceNode) else (node,)
    open_definition = ""
    for item in items:
        if not isinstance(item, ScalarNode):
            diagnostics.error(
                "'cmake-args' must list strings", item.span, 'Write ["-DNAME=VALUE"]', id="MG-9009"
            )
            continue
        for word in item.text.split() if isinstance(node, ScalarNode) else [item.text.strip()]:
            if word == "-D":
                open_definition = word
                continue
            match = _DEFINITION.fullmatch(open_definition + word)
            open_definition = ""
            if match:
                yield MetaSetting(package, match["name"], match["value"].strip('"'), item.span)
            elif word:
                yield MetaSetting(package, "", word, item.span)
