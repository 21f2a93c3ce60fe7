# SPDX-License-Identifier: Apache-2.0
"""Validation of a YAML tree against a JSON Schema (draft 2020-12), in words and with places.

Each schema is a file next to the parser that uses it, for editors too. Keywords of this project in them, which
other tools take as annotations: `x-expects` (what a value must be, in words), `x-keys` (what keys must be),
`x-reserved` (what a key is kept for), `x-format` (for hints), `x-meant` (words of other programs, and what to write),
`x-other-keys` (the hint for a key that is none, with KEY for it), `x-meant-keys` (keys of other programs, and the hint
for each), `x-meant-item` (keys of an item that is written as one `key: value`), `x-meant-list` (keys of a mapping that
is written as a list). A key with `deprecated: true` works and gives a
warning with the hint `deprecationMessage`, which editors show, too; `x-replacement` says what `init --migrate` writes
instead.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import cast

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.schema_check import Difference, Schema, deprecated_parts, differences
from microros_gen.documents.schema_words import describe_mismatch, describe_unknown_key, key_without_space
from microros_gen.documents.yaml_tree import MappingNode, SequenceNode, YamlNode, to_data


def load_schema(path: Path, *others: Path) -> Schema:
    """Return the schema in the file `path`, with the definitions of `others` that it refers to by their `$id`."""
    text = path.read_text(encoding="utf-8")
    definitions: Schema = {}
    for other in others:
        found = cast(Schema, json.loads(other.read_text(encoding="utf-8")))
        text = text.replace(f'"{found["$id"]}#/', '"#/')
        definitions |= found["$defs"]
    schema = cast(Schema, json.loads(text))
    return {**schema, "$defs": {**definitions, **schema.get("$defs", {})}} if definitions else schema


def validate(tree: YamlNode | None, source: Source, schema: Schema, diagnostics: Diagnostics) -> None:
    """Report each difference between `tree` and `schema` at its place, in the order of the text."""
    if tree is None:
        diagnostics.error("the file is empty", Span(source, 1, 1), "Write `key: value` lines", id="MG-1001")
        return
    found, data = Diagnostics(), to_data(tree)
    for difference in differences(data, schema):
        _report(tree, difference, schema, found)
    for part in deprecated_parts(data, schema):
        _warn_of_deprecated(tree, part, found)
    diagnostics.extend(sorted(found, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0)))


def _report(tree: YamlNode, difference: Difference, root: Schema, diagnostics: Diagnostics) -> None:
    path, schema, keyword = list(difference.path), difference.schema, difference.keyword
    node = _node_at(tree, path)
    label = path_label(path)
    if keyword == "additionalProperties" and isinstance(node, MappingNode):
        for entry in node:
            if _is_unknown(entry.key, schema):
                message, hint = describe_unknown_key(entry.key, label, schema, root)
                diagnostics.error(message, entry.key_span, hint, id="MG-1002")
    elif keyword == "required" and isinstance(node, MappingNode):
        for key in cast("list[str]", schema["required"]):
            meant = any(key_without_space(entry.key, schema) == key for entry in node)
            if key not in node.entries and not meant:
                where = f"'{label}'" if label else "the file"
                hint = f"Add `{key}: {_first_value(schema.get('properties', {}).get(key, {}))}`"
                diagnostics.error(f"missing key '{key}' in {where}", node.span, hint, id="MG-1003")
    elif keyword == "not" and "x-reserved" in schema:
        message = (
            f"the key '{path[-1]}' is reserved for {schema['x-reserved']}, which this version does not have"
        )
        diagnostics.error(message, _key_span(tree, path), "Remove it", id="MG-1004")
    elif keyword == "uniqueItems" and isinstance(node, SequenceNode):
        _report_twins(node, label, diagnostics)
    else:
        message, hint = describe_mismatch(node, label, schema, root)
        diagnostics.error(message, node.span, hint, id="MG-1005")


def _first_value(schema: Schema) -> object:
    """Return a value that a schema names; else an ellipsis."""
    named = [schema[keyword][0] for keyword in ("examples", "enum") if keyword in schema]
    return schema.get("const", next(iter(named), "…"))


def _warn_of_deprecated(tree: YamlNode, part: Difference, diagnostics: Diagnostics) -> None:
    path = list(part.path)
    message = f"'{path_label(path)}' is deprecated and will be removed"
    diagnostics.warning(message, _key_span(tree, path), part.schema["deprecationMessage"], id="MG-9244")


def path_label(path: list[str | int]) -> str:
    """Return a path as it is printed: `nodes[0].publishers[1].topic`."""
    text = ""
    for step in path:
        if isinstance(step, int):
            text += f"[{step}]"
        else:
            text += f".{step}" if re.fullmatch(r"\w+", step) else f'["{step}"]'
    return text.lstrip(".")


def _is_unknown(key: str, schema: Schema) -> bool:
    patterns = schema.get("patternProperties", {})
    return key not in schema.get("properties", {}) and not any(re.search(p, key) for p in patterns)


def _report_twins(node: SequenceNode, label: str, diagnostics: Diagnostics) -> None:
    seen: dict[str, int] = {}
    for item in node.items:
        text = repr(to_data(item))
        if text in seen:
            message = f"'{label}' contains {text} twice; first in line {seen[text]}"
            diagnostics.error(message, item.span, "Remove one of them", id="MG-1006")
        seen.setdefault(text, item.span.line)


def _node_at(tree: YamlNode, path: list[str | int]) -> YamlNode:
    node = tree
    for step in path:
        if isinstance(node, SequenceNode) and isinstance(step, int):
            node = node.items[step]
        elif isinstance(node, MappingNode) and isinstance(step, str):
            node = node.entries[step].value
    return node


def _key_span(tree: YamlNode, path: list[str | int]) -> Span:
    owner = _node_at(tree, path[:-1])
    key = path[-1]
    if isinstance(owner, MappingNode) and isinstance(key, str):
        return owner.entries[key].key_span
    return owner.span
