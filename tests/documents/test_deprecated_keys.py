# SPDX-License-Identifier: Apache-2.0
"""A deprecated key works, and a warning says where it is and what to write instead."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from docs.generators.schemas import page
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.schema import validate
from microros_gen.documents.schema_files import complete_schema, schema_files
from microros_gen.documents.yaml_tree import parse_yaml
from tests.support.paths import ROOT

SCHEMA: dict[str, Any] = {
    "type": "object",
    "additionalProperties": False,
    "properties": {
        "speed": {"type": "integer", "description": "Bits per second"},
        "baud": {
            "type": "integer",
            "description": "Speed of the line",
            "deprecated": True,
            "deprecationMessage": "Write `speed:` instead",
        },
        "lines": {"type": "array", "items": {"$ref": "#/$defs/line"}},
    },
    "$defs": {
        "line": {
            "type": "object",
            "properties": {"old": {"deprecated": True, "deprecationMessage": "Remove it"}},
        }
    },
}


def found(text: str) -> list[str]:
    diagnostics, source = Diagnostics(), Source("f.yaml", text)
    tree = parse_yaml(source, diagnostics)
    validate(tree, source, SCHEMA, diagnostics)
    return [d.headline() for d in diagnostics]


def test_a_deprecated_key_is_a_warning_at_its_place() -> None:
    assert found("speed: 5\nbaud: 9600\n") == [
        "f.yaml:2:1: warning: 'baud' is deprecated and will be removed. Write `speed:` instead [MG-9244]"
    ]
    assert found("lines:\n  - {a: 1}\n  - {b: 1, old: 2}\n") == [
        "f.yaml:3:12: warning: 'lines[1].old' is deprecated and will be removed. Remove it [MG-9244]"
    ]


def test_other_keys_give_no_warning() -> None:
    assert found("speed: 5\nlines: [{a: 1}]\n") == []


def test_a_deprecated_key_is_checked_as_before() -> None:
    headlines = found("baud: fast\n")
    assert [h.split(": ")[1] for h in headlines] == ["warning", "error"], "in the order of the text"


def parts(schema: Any) -> Iterator[dict[str, Any]]:
    if isinstance(schema, dict):
        yield schema
        for value in schema.values():
            yield from parts(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from parts(value)


@pytest.mark.parametrize("name", schema_files())
def test_every_deprecated_key_of_the_tool_says_what_to_write(name: str) -> None:
    for part in parts(complete_schema(schema_files()[name])):
        assert (part.get("deprecated") is True) == isinstance(part.get("deprecationMessage"), str), part


def test_the_reference_marks_it(tmp_path: Any) -> None:
    path = tmp_path / "lines.schema.json"
    path.write_text(json.dumps(SCHEMA))
    (row,) = (line for line in page("Lines", "", path).splitlines() if line.startswith("| `baud`"))
    assert "Deprecated: Write `speed:` instead" in row


def test_the_page_says_whether_there_are_any() -> None:
    schemas = [complete_schema(path) for path in schema_files().values()]
    none = not any(part.get("deprecated") for schema in schemas for part in parts(schema))
    text = (ROOT / "docs/compatibility.md").read_text(encoding="utf-8")
    assert ("No key is deprecated at present" in text) == none
