# SPDX-License-Identifier: Apache-2.0
"""Rewrites a YAML file of the tool for the current version: deprecated keys, and the version if it is not there.

The text is edited at the places of its keys, so that comments, order and layout stay. A schema says with
`x-replacement` what replaces a key with `deprecated: true`: `{"key": NAME}`, another name for the same value, or
`{"remove": true}`, nothing. A file in which a key cannot be replaced is not changed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import unified_diff
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import read_bytes, reason_of
from microros_gen.documents.schema import path_label
from microros_gen.documents.schema_check import Difference, Schema, deprecated_parts
from microros_gen.documents.schema_files import complete_schema, schema_files
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, YamlNode, parse_yaml, to_data
from microros_gen.records import dataclass

_FIRST_KIND = "application"
_LINE_END = "\r\n|[\n\r\x85\u2028\u2029]"
"""What the loaders of YAML count as the end of a line."""
_NO_LINE_END = "\\ No newline at end of file"
_LINE = re.compile(r"[^\n]*\n|[^\n]+")


@dataclass(frozen=True)
class Migrated:
    """A file before and after, with the line ends that each of its lines has."""

    path: Path
    before: str
    after: str

    def content(self) -> bytes:
        """Return the bytes of the new file."""
        return self.after.encode()

    def difference(self) -> str:
        """Return what would change, as `git diff` prints it."""
        before, after = _LINE.findall(self.before), _LINE.findall(self.after)
        lines = unified_diff(before, after, f"a/{self.path}", f"b/{self.path}")
        return "".join(line if line.endswith("\n") else f"{line}\n{_NO_LINE_END}\n" for line in lines)


@dataclass(frozen=True)
class _Edit:
    """Characters `begin` to `end` (exclusive) of the text, and what replaces them."""

    begin: int
    end: int
    text: str


def migrated_file(path: Path, diagnostics: Diagnostics) -> Migrated | None:
    """Return a file and what it is in the current version; None with errors in `diagnostics`."""
    try:
        text = read_bytes(path).decode()
    except (OSError, UnicodeDecodeError) as error:
        hint = "Name YAML files in UTF-8"
        diagnostics.error(f"cannot read {path}: {reason_of(error)}", hint=hint, id="MG-9278")
        return None
    mark = "\ufeff" if text.startswith("\ufeff") else ""  # YAML counts no column for it
    source, found = Source(str(path), text.removeprefix(mark)), Diagnostics()
    tree = parse_yaml(source, found)
    diagnostics.extend(found)
    if tree is None or found.has_errors():
        return None
    schema = _schema_of(tree)
    if schema is None:
        kinds = ", ".join(schema_files())
        message = "the keys of the file are those of no kind of file of microros-gen"
        diagnostics.error(
            message, Span(source, 1, 1), f"Correct its keys to those of one kind: {kinds}", id="MG-9277"
        )
        return None
    after = migrated_text(tree, source, schema, diagnostics)
    return None if after is None else Migrated(path, text, mark + after)


def migrated_text(tree: YamlNode, source: Source, schema: Schema, diagnostics: Diagnostics) -> str | None:
    """Return the text of `source`, whose tree is `tree`, for the current version; None with errors in `diagnostics`."""
    edits: dict[int, _Edit] = {}  # by place: an alias leads to the keys of its anchor
    found = Diagnostics()
    parts = list(deprecated_parts(to_data(tree), schema))
    for part in parts:
        edit = _edit_of(tree, source, part, found)
        if edit is not None:
            edits[edit.begin] = edit
    diagnostics.extend(found)
    if found.has_errors():
        return None
    text = source.text
    for _, edit in sorted(edits.items(), reverse=True):
        text = text[: edit.begin] + edit.text + text[edit.end :]
    wanted = to_data(tree)
    for part in sorted(parts, key=lambda part: len(part.path), reverse=True):  # inner ones first
        _replace(wanted, part)
    if _data_of(text) != wanted:
        entry = _entry_at(tree, parts[0].path)[1]
        message = f"the deprecated '{path_label(list(parts[0].path))}' cannot be replaced: other places use its text"
        hint = "Write the anchors and aliases of these keys out"
        diagnostics.error(message, entry.key_span if entry else tree.span, hint, id="MG-9279")
        return None
    return _with_version(text, tree, source, schema)


def _replace(data: Any, part: Difference) -> None:
    """Do to plain data what the edit of a part does to the text."""
    *way, key = part.path
    for step in way:
        data = data[step]
    value = data.pop(key)
    if "key" in part.schema["x-replacement"]:
        data[part.schema["x-replacement"]["key"]] = value


def _data_of(text: str) -> Any:
    """Return what a text means; None for one with an error."""
    found = Diagnostics()
    tree = parse_yaml(Source("", text), found)
    return None if tree is None or found.has_errors() else to_data(tree)


def _schema_of(tree: YamlNode) -> Schema | None:
    """Return the schema of the first kind of file that has all keys of the outermost mapping."""
    files = schema_files()
    for name in sorted(files, key=lambda kind: (kind != _FIRST_KIND, kind)):
        schema = complete_schema(files[name])
        if isinstance(tree, MappingNode) and set(tree.entries) <= set(schema.get("properties", {})):
            return schema
    return None


def _edit_of(tree: YamlNode, source: Source, part: Difference, diagnostics: Diagnostics) -> _Edit | None:
    """Return the edit for a deprecated part; None with an error if it has none."""
    mapping, entry = _entry_at(tree, part.path)
    replacement: dict[str, Any] = part.schema.get("x-replacement", {})
    label = path_label(list(part.path))
    if entry is not None and mapping is not None and "key" in replacement:
        if replacement["key"] in mapping.entries:
            message = (
                f"'{label}' is deprecated, and '{replacement['key']}', which replaces it, is in the file, too"
            )
            diagnostics.error(message, entry.key_span, f"Remove `{entry.key}:`", id="MG-9276")
            return None
        begin, end = _range(source, entry.key_span)
        return _Edit(begin, end, replacement["key"])
    edit = None
    if entry is not None and mapping is not None and replacement.get("remove"):
        # Without another entry nothing would be left of the mapping, which means null.
        edit = _removal(source, entry) if len(mapping.entries) > 1 else None
    if edit is None:
        span = entry.key_span if entry is not None else tree.span
        hint = part.schema["deprecationMessage"]
        diagnostics.error(f"the deprecated '{label}' must be replaced by hand", span, hint, id="MG-9275")
    return edit


def _entry_at(tree: YamlNode, path: tuple[str | int, ...]) -> tuple[MappingNode | None, Entry | None]:
    """Return the entry at `path`, and the mapping that it is in; None for an element of a sequence."""
    node, mapping, entry = tree, None, None
    for step in path:
        mapping, entry = None, None
        if isinstance(node, MappingNode) and isinstance(step, str):
            mapping, entry = node, node.entries[step]
            node = entry.value
        elif not isinstance(node, (MappingNode, ScalarNode)) and isinstance(step, int):
            node = node.items[step]
    return mapping, entry


def _removal(source: Source, entry: Entry) -> _Edit | None:
    """Return the edit that removes an entry whose key and scalar are on one line; None for others."""
    value = entry.value
    if (
        not isinstance(value, ScalarNode)
        or value.span.line != entry.key_span.line
        or value.span.end_column is None
    ):
        return None
    begin, end = _range(source, Span(source, value.span.line, entry.key_span.column, value.span.end_column))
    line = max(start for start in _line_starts(source.text) if start <= begin)
    rest = re.compile(rf"[ ]*(#[^\n\r\x85\u2028\u2029]*)?({_LINE_END}|$)").match(source.text, end)
    if not source.text[line:begin].strip(" ") and rest is not None:
        return _Edit(line, rest.end(), "")
    comma = re.compile(r"[ ]*,[ ]*").match(source.text, end)
    if comma is not None:
        return _Edit(begin, comma.end(), "")
    before = re.search(r"[ ]*,[ ]*$", source.text[line:begin])
    return _Edit(line + before.start(), end, "") if before is not None else None


def _range(source: Source, span: Span) -> tuple[int, int]:
    """Return where the characters of a span begin and end in the text."""
    starts = tuple(_line_starts(source.text))
    end = span.end_column if span.end_column is not None else span.column
    return starts[span.line - 1] + span.column - 1, starts[span.line - 1] + end - 1


def _line_starts(text: str) -> Iterator[int]:
    yield 0
    yield from (found.end() for found in re.finditer(_LINE_END, text))


def _with_version(text: str, tree: YamlNode, source: Source, schema: Schema) -> str:
    """Return `text` with the version before its first key, if the kind of file has one and the file has block style."""
    version = schema.get("properties", {}).get("version", {}).get("const")
    if version is None or not isinstance(tree, MappingNode) or "version" in tree.entries:
        return text
    first = next(iter(tree), None)
    if first is None or first.key_span.column != 1:
        return text
    place, _ = _range(source, first.key_span)
    line_end = re.compile(_LINE_END).search(source.text)
    return f"{text[:place]}version: {version}{line_end.group() if line_end else chr(10)}{text[place:]}"
