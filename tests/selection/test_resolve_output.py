# SPDX-License-Identifier: Apache-2.0
"""A selection in print: golden copies of each profile, the table, the graph, and the command `profiles`."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

from microros_gen.cli.main import cli
from microros_gen.cli.profile_lists import select_profile
from microros_gen.cli.tables import format_selection, selection_data
from microros_gen.selection.component import Catalogue
from microros_gen.selection.model import Selection
from tests.support.selection.profiles import ALL_PROFILES, BUILTIN_PROFILES

GOLDEN = Path(__file__).parent / "golden"
UPDATE = os.environ.get("MICROROS_UPDATE_GOLDEN") == "1"


@pytest.fixture(params=BUILTIN_PROFILES)
def selection(request: pytest.FixtureRequest, real_catalogue: Catalogue) -> Selection:
    return select_profile(request.param, Path(), real_catalogue)


def test_the_resolution_is_the_golden_copy(selection: Selection) -> None:
    path = GOLDEN / f"{selection.profiles[0]}.json"
    text = format_selection(selection, "json")
    if UPDATE:
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


def test_json_holds_everything_in_a_fixed_order(selection: Selection) -> None:
    data = json.loads(format_selection(selection, "json"))
    assert data == selection_data(selection)
    assert list(data) == sorted(data)
    assert [c["name"] for c in data["components"]] == [c.component.name for c in selection.components]


def test_the_table_names_every_component_with_its_reasons(selection: Selection) -> None:
    table = format_selection(selection, "table")
    for chosen in selection.components:
        assert re.search(rf"^{chosen.component.name} ", table, re.MULTILINE)
        assert all(reason in table for reason in chosen.reasons)
    assert not any(line.endswith(" ") for line in table.splitlines())


def test_the_graph_is_one(selection: Selection) -> None:
    text = format_selection(selection, "dot")
    assert text.startswith("digraph selection {\n")
    assert text.endswith("}\n")
    declared = set(re.findall(r'^  ("(?:[^"\\]|\\.)*") \[', text, re.MULTILINE))
    for start, end in re.findall(r'^  ("(?:[^"\\]|\\.)*") -> ("(?:[^"\\]|\\.)*")', text, re.MULTILINE):
        assert {start, end} <= declared
    if shutil.which("dot"):
        subprocess.run(["dot", "-Tsvg"], input=text, text=True, check=True, capture_output=True)


def test_an_unknown_format_is_refused(selection: Selection) -> None:
    with pytest.raises(ValueError, match="no format 'xml'"):
        format_selection(selection, "xml")


def run(*arguments: str) -> str:
    result = CliRunner().invoke(cli, ["profiles", *arguments], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def test_profiles_lists_all() -> None:
    lines = run().splitlines()
    assert [line.split()[0] for line in lines] == ["PROFILE", *ALL_PROFILES]
    assert lines[1].split()[1:4] == ["ready", "node,", "publish"]
    assert [entry["name"] for entry in json.loads(run("--format", "json"))] == list(ALL_PROFILES)
    assert run("--format", "dot").startswith("digraph profiles {")


def test_profiles_shows_one() -> None:
    assert "profile pure_sender" in run("pure_sender")
    assert json.loads(run("pure_sender", "--format", "json"))["profiles"] == ["pure_sender"]
    assert run("pure_sender", "--format", "dot").startswith("digraph selection {")


def test_profiles_shows_a_users_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "mine.yaml").write_text("profile: mine\nextends: [pure_sender]\n")
    monkeypatch.chdir(tmp_path)
    assert json.loads(run("mine", "--format", "json"))["profiles"] == ["mine"]
    assert json.loads(run("./mine.yaml", "--format", "json"))["profiles"] == ["mine"]
