# SPDX-License-Identifier: Apache-2.0
"""`init --migrate` rewrites files for the current version and leaves everything else as it is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.schema import validate
from microros_gen.documents.schema_files import complete_schema, schema_files
from microros_gen.documents.yaml_tree import parse_yaml
from microros_gen.migrate.current_keys import migrated_text
from tests.support.migrate.proposals import Init

OLD = {"deprecated": True, "deprecationMessage": "Write `new:`"}
SCHEMA: dict[str, Any] = {
    "type": "object",
    "additionalProperties": False,
    "properties": {
        "version": {"const": 1},
        "speed": {"type": "integer"},
        "baud": {"type": "integer", **OLD, "x-replacement": {"key": "speed"}},
        "gone": {**OLD, "x-replacement": {"remove": True}},
        "by_hand": OLD,
        "lines": {"type": "array", "items": {"$ref": "#/$defs/line"}},
        "other": {"$ref": "#/$defs/other"},
        "name": {"type": "string"},
    },
    "$defs": {
        "line": {
            "type": "object",
            "properties": {"old": {**OLD, "x-replacement": {"key": "new"}}, "gone": {"$ref": "#/$defs/gone"}},
        },
        "other": {"type": "object", "required": ["old"]},
        "gone": {**OLD, "x-replacement": {"remove": True}},
    },
}


def migrated(text: str) -> tuple[str | None, list[str]]:
    diagnostics, source = Diagnostics(), Source("f.yaml", text)
    tree = parse_yaml(source, diagnostics)
    assert tree is not None
    after = migrated_text(tree, source, SCHEMA, diagnostics)
    return after, [d.headline() for d in diagnostics]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("version: 1\n# why\nbaud:  9600   # fast\n", "version: 1\n# why\nspeed:  9600   # fast\n"),
        ('version: 1\n"baud": 1\n', "version: 1\nspeed: 1\n"),
        ("# top\nbaud: 5\n", "# top\nversion: 1\nspeed: 5\n"),
        ("version: 1\ngone: 3 # not needed\nspeed: 1\n", "version: 1\nspeed: 1\n"),
        ("version: 1\nspeed: 1\ngone: x", "version: 1\nspeed: 1\n"),
        ("version: 1\nlines: [{old: 1, b: 2}]\n", "version: 1\nlines: [{new: 1, b: 2}]\n"),
        ("version: 1\nlines: [{gone: 1, b: 2}]\n", "version: 1\nlines: [{b: 2}]\n"),
        ("version: 1\nlines: [{b: 2, gone: 1}]\n", "version: 1\nlines: [{b: 2}]\n"),
        (
            "version: 1\nlines:\n  - b: 1\n    old:\n      c: 2\n",
            "version: 1\nlines:\n  - b: 1\n    new:\n      c: 2\n",
        ),
        ("version: 1\nlines: [&a {old: 1}, *a]\n", "version: 1\nlines: [&a {new: 1}, *a]\n"),
        ("version: 1\r\nbaud: 5 # a\nname: x\r\n", "version: 1\r\nspeed: 5 # a\nname: x\r\n"),
        ("# a\nbaud: 5\r\nname: x\n", "# a\nversion: 1\nspeed: 5\r\nname: x\n"),
        ("# a\r\nbaud: 5\nname: x", "# a\r\nversion: 1\r\nspeed: 5\nname: x"),
        ("version: 1\r\ngone: 3 # x\r\nspeed: 1\n", "version: 1\r\nspeed: 1\n"),
        ("version: 1\nspeed: 1\r\ngone: 3\r\n", "version: 1\nspeed: 1\r\n"),
        ("version: 1\rgone: 3\rbaud: 1\r", "version: 1\rspeed: 1\r"),
        ("version: 1\nlines:\n- &a\n  old: 1\n- *a\n", "version: 1\nlines:\n- &a\n  new: 1\n- *a\n"),
        ("version: 1\nbaud: &n 3\nlines: [{b: *n}]\n", "version: 1\nspeed: &n 3\nlines: [{b: *n}]\n"),
        ("{version: 1, baud: 2, lines: [{old: 'ä'}]}\n", "{version: 1, speed: 2, lines: [{new: 'ä'}]}\n"),
    ],
)
def test_keys_are_replaced_at_their_places(before: str, after: str) -> None:
    assert migrated(before) == (after, [])
    assert migrated(after) == (after, []), "idempotent"
    diagnostics, source = Diagnostics(), Source("f.yaml", after)
    validate(parse_yaml(source, diagnostics), source, SCHEMA, diagnostics)
    assert not list(diagnostics)


@pytest.mark.parametrize(
    ("text", "headline"),
    [
        ("by_hand: 1\n", "f.yaml:1:1: error: the deprecated 'by_hand' must be replaced by hand"),
        ("speed: 1\ngone:\n  a: 1\n", "f.yaml:2:1: error: the deprecated 'gone' must be replaced by hand"),
        (
            "lines:\n  - gone: 1\n    b: 2\n",
            "f.yaml:2:5: error: the deprecated 'lines[0].gone' must be replaced",
        ),
        ("baud: 1\nspeed: 2\n", "f.yaml:1:1: error: 'baud' is deprecated, and 'speed', which replaces it"),
    ],
)
def test_what_cannot_be_replaced_is_refused_at_its_place(text: str, headline: str) -> None:
    after, found = migrated(text)
    assert after is None
    assert len(found) == 1
    assert found[0].startswith(headline)
    assert found[0].endswith("[MG-9276]" if "speed: 2" in text else "[MG-9275]")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("lines: [&a {old: 1}]\nother: *a\n", 1),
        ("other: &a {old: 1}\nlines: [*a]\n", 1),
        ("gone: &n 3\nspeed: *n\n", 1),
        ("name: &k old\nlines: [{*k : 1}]\n", 1),
        ("lines:\n- &a {gone: 1, b: 2}\nother: {old: *a}\n", 2),
    ],
)
def test_a_key_whose_text_has_another_use_is_refused(text: str, line: int) -> None:
    after, found = migrated(text)
    assert after is None
    (headline,) = found
    assert headline.startswith(f"f.yaml:{line}:")
    assert headline.endswith("Write the anchors and aliases of these keys out [MG-9279]")


def parts(schema: Any) -> list[dict[str, Any]]:
    inner = schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ()
    return [p for value in inner for p in parts(value)] + ([schema] if isinstance(schema, dict) else [])


@pytest.mark.parametrize("name", schema_files())
def test_every_deprecated_key_of_the_tool_has_a_replacement_of_a_known_kind(name: str) -> None:
    for part in parts(complete_schema(schema_files()[name])):
        replacement = part.get("x-replacement")
        assert replacement is None or part.get("deprecated") is True
        assert replacement in (None, {"remove": True}) or set(replacement) == {"key"}


def test_a_file_is_written_once(init: Init, tmp_path: Path) -> None:
    path = tmp_path / "microros.yaml"
    path.write_bytes(b"# mine\r\nprofiles: [pure_sender]  # one\r\n")
    status, out, _ = init("--migrate", "--dry-run", "microros.yaml")
    assert (status, path.read_bytes()) == (0, b"# mine\r\nprofiles: [pure_sender]  # one\r\n")
    assert out.splitlines()[:2] == ["--- a/microros.yaml", "+++ b/microros.yaml"]
    assert [line for line in out.splitlines()[2:] if line[0] in "+-"] == ["+version: 1"]
    assert init("--migrate", "microros.yaml")[:2] == (0, "microros.yaml: written for this version\n")
    assert path.read_bytes() == b"# mine\r\nversion: 1\r\nprofiles: [pure_sender]  # one\r\n"
    assert init("--migrate", "microros.yaml")[:2] == (0, "")


def test_bytes_outside_of_what_is_replaced_stay(init: Init, tmp_path: Path) -> None:
    """Line ends of both kinds, a mark of UTF-8, no line end at the end."""
    path = tmp_path / "microros.yaml"
    before = b"\xef\xbb\xbf# mine\nprofiles:  [pure_sender]  # one\xc2\xa0 two\r\n# end"
    path.write_bytes(before)
    status, out, error = init("--migrate", "--dry-run", "microros.yaml")
    assert (status, error) == (0, "")
    assert "\n+version: 1\n" in out
    assert out.endswith("\n # end\n\\ No newline at end of file\n")
    assert init("--migrate", "microros.yaml")[0] == 0
    assert path.read_bytes() == before.replace(b"profiles", b"version: 1\nprofiles")


def test_no_file_is_changed_if_one_is_wrong(init: Init, tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("profiles: [pure_sender]\n")
    (tmp_path / "b.yaml").write_text("nonsense: 1\n")
    status, _, error = init("--migrate", "a.yaml", "b.yaml", "c.yaml")
    assert status == 2
    assert "b.yaml:1:1: error: the keys of the file are those of no kind" in error
    assert "[MG-9277]" in error
    assert "cannot read c.yaml: No such file or directory. Name YAML files in UTF-8 [MG-9278]" in error
    assert (tmp_path / "a.yaml").read_text() == "profiles: [pure_sender]\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--migrate", "--target", "host", "a.yaml"), "--migrate takes no other option than --dry-run."),
        (("--dry-run", "robot"), "--dry-run needs --migrate."),
        (("one", "two"), "Got unexpected extra argument (two)"),
        ((), "Missing argument 'DIR'."),
        (("--migrate",), "--migrate needs the files to rewrite, such as microros.yaml."),
    ],
)
def test_options_that_do_not_fit_are_refused(init: Init, arguments: tuple[str, ...], message: str) -> None:
    status, _, error = init(*arguments)
    assert status == 2
    assert message in error
