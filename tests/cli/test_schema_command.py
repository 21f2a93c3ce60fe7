# SPDX-License-Identifier: Apache-2.0
"""`microros-gen schema`: what editors get is what the tool checks with; `check-jsonschema` judges files by it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from microros_gen.documents.schema_files import complete_schema, schema_files
from tests.support.application.key_cases import CASES
from tests.support.command_line import Runner
from tests.support.paths import ROOT

MISTAKES = {
    "an unknown key": ("transports: {type: udp}\n", "$", "'transports' was unexpected"),
    "an unknown key inside": (
        "nodes:\n  - name: a\n    publishers:\n      - {topic: x, type: std_msgs/msg/Int32, qoss: 1}\n",
        "$.nodes[0].publishers[0]",
        "'qoss' was unexpected",
    ),
    "a missing key": (
        "nodes:\n  - name: a\n    publishers:\n      - {topic: x}\n",
        "$.nodes[0].publishers[0]",
        "'type' is a required property",
    ),
    "another type": ("profiles: pure_sender\n", "$.profiles", "is not of type 'array'"),
    "a value that is not offered": ("liveliness: never\n", "$.liveliness", "'never' is not one of"),
    "a number out of range": ("transport: {mtu: 99999999}\n", "$.transport.mtu", "maximum of"),
    "a text of another form": ("components: ['+No Name']\n", "$.components[0]", "does not match"),
    "an item twice": ("profiles: [pure_sender, pure_sender]\n", "$.profiles", "has non-unique elements"),
    "another version": ("version: 2\n", "$.version", "1 was expected"),
}
"""One mistake of each kind: the text, where check-jsonschema finds it, and a part of its message."""


def judged(schema: Path, files: list[Path]) -> dict[str, Any]:
    """Return the report of check-jsonschema on `files`."""
    command = [sys.executable, "-m", "check_jsonschema", "-o", "json", "--schemafile", str(schema)]
    done = subprocess.run([*command, *(str(f) for f in files)], capture_output=True, text=True, check=False)
    report: dict[str, Any] = json.loads(done.stdout)
    return report


def test_the_list_has_every_schema_of_the_package(run: Runner) -> None:
    found = run("schema").out.splitlines()[1:]
    on_disk = {p.name.removesuffix(".schema.json") for p in (ROOT / "microros_gen").rglob("*.schema.json")}
    assert {line.split()[0] for line in found} == on_disk
    assert {"application", "profile", "system", "target", "agent", "component"} <= on_disk


def test_a_new_kind_of_document_needs_only_its_file(tmp_path: Path) -> None:
    (tmp_path / "somewhere" / "deep").mkdir(parents=True)
    other = {"$id": "urn:x:other:1", "title": "Other", "$defs": {"b": {"type": "integer"}}}
    new = {"$id": "urn:x:new:1", "title": "New", "properties": {"a": {"$ref": "urn:x:other:1#/$defs/b"}}}
    (tmp_path / "somewhere/other.schema.json").write_text(json.dumps(other))
    (tmp_path / "somewhere/deep/new.schema.json").write_text(json.dumps(new))
    files = schema_files(tmp_path)
    assert list(files) == ["new", "other"]
    complete = complete_schema(files["new"], tmp_path)
    assert complete["properties"]["a"] == {"$ref": "#/$defs/b"}
    assert complete["$defs"] == {"b": {"type": "integer"}}


@pytest.mark.parametrize("name", schema_files())
def test_a_schema_is_complete_in_itself(run: Runner, name: str) -> None:
    schema = json.loads(run("schema", name).out)
    assert schema == complete_schema(schema_files()[name])

    def references(part: Any) -> list[str]:
        if isinstance(part, dict):
            own = [part["$ref"]] if isinstance(part.get("$ref"), str) else []
            return own + [r for value in part.values() for r in references(value)]
        return [r for item in part for r in references(item)] if isinstance(part, list) else []

    for reference in references(schema):
        assert reference.removeprefix("#/$defs/") in schema["$defs"], reference


def test_a_file_is_written_with_the_line_to_paste(run: Runner, folder: Path) -> None:
    outcome = run("schema", "profile", "-o", "p.json")
    assert outcome.out == ""
    assert outcome.err == "first line of a file next to it: # yaml-language-server: $schema=p.json\n"
    assert (folder / "p.json").read_text(encoding="utf-8") == run("schema", "profile").out


def test_an_unknown_name_gets_the_nearest(run: Runner) -> None:
    outcome = run("schema", "applications")
    assert outcome.status == 2
    assert "unknown schema 'applications'. Did you mean 'application'? [MG-9240]" in outcome.err


def test_valid_files_are_valid(run: Runner, folder: Path) -> None:
    """Files of each kind that the repository has, and a good value of each key of the application file."""
    kinds: dict[str, list[Path]] = {
        "application": sorted((ROOT / "examples").glob("*/microros.yaml")),
        "profile": [p for p in sorted((ROOT / "profiles").glob("*.yaml")) if p.name != "middleware.yaml"],
        "target": sorted((ROOT / "microros_gen/targets").glob("*.yaml")),
        "component": sorted((ROOT / "microros_gen/components").glob("p*/component.yaml")),
        "system": [folder / "system.yaml"],
    }
    for index, case in enumerate(CASES.values()):
        kinds["application"].append(folder / f"case_{index}.yaml")
        kinds["application"][-1].write_text(case.good, encoding="utf-8")
    boards = "boards: {a: {application: a.yaml}, b: {application: b.yaml}}"
    links = 'links: [{type: udp, ends: {a: "192.168.1.20:7500", b: "192.168.1.21:7500"}}]'
    (folder / "system.yaml").write_text(f"version: 1\n{boards}\n{links}\n", encoding="utf-8")
    for name, files in kinds.items():
        assert files, name
        run("schema", name, "-o", f"{name}.json")
        report = judged(folder / f"{name}.json", files)
        assert report["status"] == "ok", report["errors"][:3]


def test_each_kind_of_mistake_is_found(run: Runner, folder: Path) -> None:
    run("schema", "application", "-o", "schema.json")
    files = [folder / f"mistake_{index}.yaml" for index in range(len(MISTAKES))]
    for path, (text, _, _) in zip(files, MISTAKES.values(), strict=True):
        path.write_text(text, encoding="utf-8")
    report = judged(folder / "schema.json", files)
    errors = [*report["errors"], *report.get("parse_errors", [])]
    for path, (what, (_, place, message)) in zip(files, MISTAKES.items(), strict=True):
        found = [(e["path"], e["message"]) for e in errors if Path(e["filename"]).name == path.name]
        assert any(p == place and message in m for p, m in found), (what, found)


@pytest.mark.parametrize("from_sources", [False, True])
def test_a_new_application_names_its_schema(run: Runner, folder: Path, from_sources: bool) -> None:
    """By a path that holds wherever the folder is moved, without the tool and without a network."""
    more = ("--from", str(ROOT / "examples/ping_pong")) if from_sources else ()
    assert run("init", "robot", *more).status == 0
    (folder / "robot").rename(folder / "moved")
    first = (folder / "moved/microros.yaml").read_text(encoding="utf-8").splitlines()[0]
    lead = "# yaml-language-server: $schema="
    assert first.startswith(lead)
    schema = folder / "moved" / first.removeprefix(lead)
    assert schema.read_text(encoding="utf-8") == run("schema", "application").out
    assert judged(schema, [folder / "moved/microros.yaml"])["status"] == "ok"
