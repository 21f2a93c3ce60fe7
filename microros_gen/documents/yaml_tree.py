# SPDX-License-Identifier: Apache-2.0
"""YAML text → a tree of nodes with places.

Plain scalars follow the core schema of YAML 1.2 (clause 10.3.2), not YAML 1.1, whose booleans and numbers
surprise:

- `true` and `false` (also True, TRUE, …) are booleans; `yes`, `no`, `on`, `off` are texts.
- `10`, `-3`, `0x1F` and `0o17` are integers; `1.5`, `1e3`, `.inf` and `.nan` are floats; `10:30` is a text.
- A number with a leading zero (`010`) is eight to some readers and ten to others: an error.
- `null`, `~` and nothing are null.

One document a text. Aliases (`*name`) are taken; an alias inside its own anchor, tags (`!x`), merge keys
(`<<`), keys that are no texts, and the same key twice are errors.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, Union

import yaml

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.yaml_faults import yaml_fault
from microros_gen.records import dataclass

Data = Union[bool, int, float, str, "list[Data]", "dict[str, Data]", None]

LARGEST_TREE = 100_000
"""Nodes that a text may have once its aliases are written out; more is an accident or an attack."""

DEEPEST_TREE = 64
"""Levels of nesting that are taken."""

LONGEST_NUMBER = 64
"""Characters of a number that are taken; Python refuses to read or print very long ones."""

_DEEPEST_FOR_C = 5_000

_INTEGER = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_LEADING_ZERO = re.compile(r"[-+]?0[0-9]+")
_PROPERTIES = re.compile(r"(?:[&!]\S*\s+)*[&!]\S*")
_TRAILING_TAB = re.compile(r"[ \t]*\t[ \t]*$", re.MULTILINE)
# libyaml and the loader in Python disagree about tabs, tags, a `?` inside flow collections and `|#`.
_LOADERS_DIFFER = re.compile(r"[\t!?]|[|>][0-9+-]*#")
_NULLS = ("", "~", "null", "Null", "NULL")
_TRUES = ("true", "True", "TRUE")
_FALSES = ("false", "False", "FALSE")
_OF_TEXTS = frozenset("abcdeghijklmopqrsuvwxyzABCDEGHIJKLMOPQRSUVWXYZ_/")
"""First characters of plain scalars that are texts: no number, boolean or null begins with them."""

_INFINITY = re.compile(r"[-+]?\.(inf|Inf|INF)")
_NOT_A_NUMBER = (".nan", ".NaN", ".NAN")


@dataclass(frozen=True)
class ScalarNode:
    """A scalar: `value` is what it means, `text` what is in the file; `plain` where it has no quotes."""

    value: bool | int | float | str | None
    text: str
    plain: bool
    span: Span


@dataclass(frozen=True)
class SequenceNode:
    """A sequence of nodes."""

    items: tuple[YamlNode, ...]
    span: Span


@dataclass(frozen=True)
class Entry:
    """A key with its place, and its value."""

    key: str
    key_span: Span
    value: YamlNode


@dataclass(frozen=True)
class MappingNode:
    """A mapping with its entries in the order of the file; a key that came twice has its first value."""

    entries: Mapping[str, Entry]
    span: Span

    def get(self, key: str) -> YamlNode | None:
        """Return the value of `key`, or None where it is not there."""
        entry = self.entries.get(key)
        return entry.value if entry else None

    def __iter__(self) -> Iterator[Entry]:
        return iter(self.entries.values())


YamlNode = ScalarNode | SequenceNode | MappingNode


def parse_yaml(source: Source, diagnostics: Diagnostics, c_loader: bool = True) -> YamlNode | None:
    """Return the tree of `source`; None where it is empty or broken (then `diagnostics` has errors).

    `c_loader` false: leave libyaml aside although it is there. The result is the same.
    """
    root = _compose(source, diagnostics, c_loader)
    if root is None:
        return None
    builder = _Builder(source, diagnostics)
    if not builder.measure(root):
        return None
    return builder.build(root)


def to_data(node: YamlNode) -> Data:
    """Return the tree as plain data (dict, list, scalars).

    A node that aliases name stands in it more than once.
    """
    if isinstance(node, ScalarNode):
        return node.value
    if isinstance(node, SequenceNode):
        return [to_data(item) for item in node.items]
    return {entry.key: to_data(entry.value) for entry in node}


def _compose(source: Source, diagnostics: Diagnostics, c_loader: bool) -> yaml.Node | None:
    text = _TRAILING_TAB.sub(lambda match: " " * len(match.group()), source.text)
    may_use_c = c_loader and hasattr(yaml, "CBaseLoader") and not _may_be_deep(text)
    if may_use_c and not _LOADERS_DIFFER.search(text):
        try:
            return yaml.compose(text, Loader=_c_loader())
        except (yaml.YAMLError, ValueError, RecursionError):
            pass  # the loader in Python says it again, the same on every machine
    try:
        return yaml.compose(text, Loader=yaml.BaseLoader)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        diagnostics.extend([yaml_fault(source, error)])
        return None


@cache
def _c_loader() -> type[yaml.CBaseLoader]:
    """Return libyaml's loader without the tags of YAML 1.1, which this module does not read, and which take time."""

    class Loader(yaml.CBaseLoader):
        def resolve(self, kind: object, value: object, implicit: object) -> str:
            return ""

    return Loader


def _may_be_deep(text: str) -> bool:
    """Return whether `text` could nest so deeply that libyaml, which recurses in C, would end the process.

    Each level of flow style takes a bracket, and each level of block style a column of its line (two levels share
    one where a list is not indented).
    """
    columns = max(map(len, text.split("\n")))
    return text.count("[") + text.count("{") + 2 * columns > _DEEPEST_FOR_C


class _Builder:
    """Turns composed nodes into the tree; nodes that aliases share are built once."""

    def __init__(self, source: Source, diagnostics: Diagnostics) -> None:
        self._source = source
        self._diagnostics = diagnostics
        self._may_have_tags = "!" in source.text
        self._may_have_aliases = "*" in source.text
        self._sizes: dict[int, int] = {}
        self._built: dict[int, YamlNode] = {}

    def measure(self, root: yaml.Node) -> bool:
        """Return whether the tree is finite and of a sane size, aliases written out; else say why not."""
        return _is_small(root) or self._measure(root, [])

    def _measure(self, node: yaml.Node, path: list[int]) -> bool:
        if id(node) in self._sizes:
            return True
        if id(node) in path:
            self._error(
                node, "this anchor contains an alias to itself", "Write the inner value out", id="MG-1021"
            )
            return False
        if len(path) >= DEEPEST_TREE:
            self._error(node, f"nested more than {DEEPEST_TREE} levels deep", "Flatten it", id="MG-1040")
            return False
        path.append(id(node))
        children = _children(node)
        if not all(self._measure(child, path) for child in children):
            return False
        path.pop()
        self._sizes[id(node)] = size = 1 + sum(self._sizes[id(child)] for child in children)
        if size > LARGEST_TREE:
            message = (
                f"contains {size} values with its aliases written out; at most {LARGEST_TREE} are allowed"
            )
            self._error(node, message, "Use fewer aliases of aliases", id="MG-1041")
            return False
        return True

    def build(self, node: yaml.Node) -> YamlNode:
        """Return the tree below `node`."""
        if not self._may_have_aliases:
            return self._build(node)
        known = self._built.get(id(node))
        if known is None:
            known = self._built[id(node)] = self._build(node)
        return known

    def _build(self, node: yaml.Node) -> YamlNode:
        if self._may_have_tags:
            self._check_tag(node)
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node)
        if isinstance(node, yaml.SequenceNode):
            return SequenceNode(tuple(self.build(item) for item in node.value), self._span(node))
        entries: dict[str, Entry] = {}
        for key, value in node.value:
            self._add_entry(entries, key, self.build(value))
        return MappingNode(entries, self._span(node))

    def _add_entry(self, entries: dict[str, Entry], key: yaml.Node, value: YamlNode) -> None:
        if self._may_have_tags:
            self._check_tag(key)
        if not isinstance(key, yaml.ScalarNode):
            self._error(key, "a key must be a word", "Write `key: value`", id="MG-1042")
        elif key.value == "<<" and _is_plain(key):
            self._error(
                key, "merge keys (<<) are not part of YAML 1.2", "Write the merged keys out", id="MG-1043"
            )
        elif key.value in entries:
            first = entries[key.value].key_span
            self._error(
                key,
                f"duplicate key '{key.value}'; first in line {first.line}",
                "Remove one of them",
                id="MG-1044",
            )
        else:
            entries[key.value] = Entry(key.value, self._span(key), value)

    def _scalar(self, node: yaml.ScalarNode) -> ScalarNode:
        span, text = self._span(node), str(node.value)
        if "\0" in text:
            self._error(node, "the text contains a NUL character", "Remove it", id="MG-1045")
            return ScalarNode(None, text.replace("\0", ""), True, span)
        if not _is_plain(node):
            return ScalarNode(text, text, False, span)
        if text[:1] in _OF_TEXTS:
            return ScalarNode(text, text, True, span)
        if _LEADING_ZERO.fullmatch(text):
            number = text.lstrip("+-").lstrip("0") or "0"
            hint = f"Write {number} (decimal), 0o{number} (octal) or '{text}' (text)"
            self._error(
                node, f"'{text}' is octal to some readers of YAML and decimal to others", hint, id="MG-1046"
            )
        if len(text) > LONGEST_NUMBER and (_INTEGER.fullmatch(text) or _FLOAT.fullmatch(text)):
            self._error(
                node,
                f"a number of {len(text)} characters is too long",
                "Write a smaller one, or quote a text",
                id="MG-1047",
            )
            return ScalarNode(None, text, True, span)
        return ScalarNode(_plain_value(text), text, True, span)

    def _check_tag(self, node: yaml.Node) -> None:
        start = node.start_mark.index
        if isinstance(node, yaml.MappingNode) and node.value and node.value[0][0].start_mark.index == start:
            return  # a block mapping begins with its first key, whose tag it is
        match = _PROPERTIES.match(self._source.text, start)
        tag = next((w for w in match.group().split() if w.startswith("!")), None) if match else None
        if tag is not None:
            self._error(node, f"tags ({tag}) are not supported", "Remove it", id="MG-1048")

    def _span(self, node: yaml.Node) -> Span:
        start, end = node.start_mark, node.end_mark
        same_line = start.line == end.line and end.column > start.column
        return Span(self._source, start.line + 1, start.column + 1, end.column + 1 if same_line else None)

    def _error(self, node: yaml.Node, message: str, hint: str | None, *, id: str) -> None:
        self._diagnostics.error(message, self._span(node), hint, id=id)


def _children(node: yaml.Node) -> list[yaml.Node]:
    if isinstance(node, yaml.ScalarNode):
        return []
    if isinstance(node, yaml.MappingNode):
        return [part for pair in node.value for part in pair]
    return list(node.value)


def _is_small(root: yaml.Node) -> bool:
    """Return whether the tree is certainly within the limits: level by level, so a cycle is too deep for that."""
    level, total = [root], 1
    for _ in range(DEEPEST_TREE - 1):
        children: list[yaml.Node] = []
        for node in level:
            if isinstance(node, yaml.MappingNode):
                for pair in node.value:
                    children += pair
            elif isinstance(node, yaml.SequenceNode):
                children += node.value
        total += len(children)
        if total > LARGEST_TREE:
            return False
        level = [child for child in children if not isinstance(child, yaml.ScalarNode)]
        if not level:
            return True
    return False


def _is_plain(node: yaml.ScalarNode) -> bool:
    return node.style in (None, "")


def _plain_value(text: str) -> Any:
    if text in _NULLS:
        return None
    if text in _TRUES or text in _FALSES:
        return text in _TRUES
    if _INTEGER.fullmatch(text):
        return int(text, 0) if text[:2] in ("0x", "0o") else int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    if _INFINITY.fullmatch(text):
        return -math.inf if text.startswith("-") else math.inf
    return math.nan if text in _NOT_A_NUMBER else text
