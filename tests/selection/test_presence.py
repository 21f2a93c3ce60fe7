# SPDX-License-Identifier: Apache-2.0
"""A component brings its own part of the example, the manifest, the reports, the sizes and migrated sources."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml
from microros_gen.migrate.missing import selected_by
from microros_gen.selection.extension_file import SCHEMA
from microros_gen.selection.find_components import declared_functions, load_catalogue
from microros_gen.selection.presence import (
    EXAMPLE_POINTS,
    ExamplePart,
    ManifestEntry,
    MemoryUse,
    Presence,
    ReportRow,
    SelectingCall,
)
from microros_gen.selection.presence_file import KEYS, read_presence
from tests.support.command_line import Runner
from tests.support.outside import BEACON, write_files
from tests.support.paths import ROOT

TRIAL = ROOT / "tests" / "e2e" / "components" / "session_diagnostics"
APPLICATION = f"""\
version: 1
profiles: [pure_sender]
components: [+executor, +timers, {TRIAL}]
session: {{key: 1}}
nodes:
  - name: board
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    timers: [{{name: tick, period: 100 ms}}]
"""
BEACON_APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [./beacon]
interfaces: [std_msgs/msg/Int32]
session: {key: 1}
"""


def test_every_key_is_read() -> None:
    text = """\
example: {includes: [a.h], handles: executor.max, when: {component.executor: true}}
manifest: {mtu: streams.mtu, number: 3, sometimes: {value: 4, when: {streams.on_full: error}}}
reports: [{name: a, value: "{streams.mtu} bytes", why: because}]
size: {store: the store, "rows[]": {use: "row {}", when: {streams.on_full: error}}}
calls: [a_*, b, {name: c, conversions: fe}]
"""
    tree = parse_yaml(Source("x", text), Diagnostics())
    assert isinstance(tree, MappingNode)
    full = (("streams.on_full", "error"),)
    assert read_presence(tree) == Presence(
        example=(
            ExamplePart(includes=("a.h",), handles="executor.max", when=(("component.executor", True),)),
        ),
        manifest=(
            ManifestEntry(name="mtu", value="streams.mtu"),
            ManifestEntry(name="number", value=3),
            ManifestEntry(name="sometimes", value=4, when=full),
        ),
        reports=(ReportRow(name="a", value="{streams.mtu} bytes", why="because"),),
        memory=(
            MemoryUse(variable="store", use="the store"),
            MemoryUse(variable="rows[]", use="row {}", when=full),
        ),
        calls=(SelectingCall("a_*"), SelectingCall("b"), SelectingCall("c", "fe")),
    )


def test_the_trial_component_uses_every_key_and_every_point() -> None:
    text = (TRIAL / "component.yaml").read_text(encoding="utf-8")
    assert [key for key in KEYS if f"\n{key}:" not in text] == []
    assert set(KEYS) <= json.loads(SCHEMA.read_text(encoding="utf-8"))["properties"].keys()
    template = (TRIAL / "example.c.j2").read_text(encoding="utf-8")
    assert [point for point in EXAMPLE_POINTS if f"macro {point}()" not in template] == []


@pytest.mark.system
@pytest.mark.builds
def test_its_part_is_in_all_of_them(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(APPLICATION)
    done = run("build", "-o", "out")
    assert done.status == 0, done.err
    assert "\ndiagnosis  1 publisher, once a second (/diagnostics)\n" in done.out
    example = (folder / "out/examples/pure_sender/main.c").read_text()
    before, _, main = example.partition("int main(void)")
    assert "#include <session_diagnostics/session_diagnostics.h>\n" in before
    order = (
        "static uint32_t sessions_lost;",
        "/* executor also publishes",
        "  sessions_lost = 0;\n  return result",
        "  sessions_lost = 0;\n  (void)rcl_publisher_fini",
        "static void watch_sessions(void)",
    )
    places = [before.index(text) for text in order]
    assert places == sorted(places)
    assert "    watch_sessions();\n" in main
    manifest = json.loads((folder / "out/manifest.json").read_text())
    assert manifest["features"]["session_diagnostics"]["values"] == {"period_ms": 1000, "publishers": 1}
    size = json.loads(run("size", "out", "--format", "json").out)
    uses = {p["symbol"]: p["use"] for p in size["ram"] if p["use"] == "session diagnostics"}
    assert "diagnostics_publisher" in uses
    assert any(p["path"].startswith(".diagnostics") for p in size["ram"] if p["use"] == "session diagnostics")
    pools = json.loads(run("resolve", "--format", "json").out)["pools"]
    assert pools["diagnosis"] == {"reason": "/diagnostics", "size": "1 publisher, once a second"}


def test_nothing_of_it_is_there_without_it(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text(APPLICATION.replace(f", {TRIAL}", ""))
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    assert "diagnos" not in (folder / "out/examples/pure_sender/main.c").read_text()
    assert "session_diagnostics" not in json.loads((folder / "out/manifest.json").read_text()).get(
        "features", {}
    )


def test_a_call_selects_who_declares_it_or_else_who_lists_it() -> None:
    catalogue = load_catalogue()
    declared = declared_functions(catalogue)
    assert selected_by("rcl_publish", declared, catalogue) == ("publish",)
    assert selected_by("RCUTILS_LOG_INFO_NAMED", declared, catalogue) == ("logging_console", "logging_rosout")
    floating = selected_by("RCUTILS_LOG_INFO", declared, catalogue, ['"name"', '"%d %5.1lf"'])
    assert floating == ("logging_console", "logging_float", "logging_rosout")
    wide = selected_by("RCUTILS_LOG_INFO", declared, catalogue, ['"%d %-5ls"'])
    assert wide == ("logging_console", "logging_rosout", "logging_wide")
    assert "logging_wide" in selected_by("RCUTILS_LOG_INFO", declared, catalogue, ['"%lc"'])
    for text in ('"%s %c"', '"%lld %ld"', '"%%ls"', '"%S"'):
        assert "logging_wide" not in selected_by("RCUTILS_LOG_INFO", declared, catalogue, [text]), text
    for text in ('"%d%%f"', '"100 %"', '"%hhx %zu f"', '"f %lld"'):
        assert "logging_float" not in selected_by("RCUTILS_LOG_INFO", declared, catalogue, [text]), text
    assert selected_by("rcutils_logging_set_logger_level", declared, catalogue) == ("logging",)
    assert selected_by("rclc_make_node_a_lifecycle_node", {}, catalogue) == ("lifecycle",)
    assert selected_by("printf", declared, catalogue) == ()


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (
            {"component.yaml": "manifest: {x: streams.mtv}\n"},
            "a component.yaml names 'streams.mtv', which is not a value of the plan",
        ),
        (
            {"component.yaml": "calls: ['a b']\n"},
            "beacon/component.yaml:9:9: error: 'calls[0]' must be the name of a function",
        ),
        (
            {"component.yaml": "calls: [{name: a, conversions: '%f'}]\n"},
            "beacon/component.yaml:9:9: error: 'calls[0]' must be the name of a function, how names begin",
        ),
        (
            {
                "component.yaml": "example: {}\n",
                "example.c.j2": "{% macro vars() %}\n{% endmacro %}\n",
            },
            "unknown macro 'vars' in",
        ),
        (
            {
                "component.yaml": "example: {}\n",
                "example.c.j2": "{% macro turn() %}\n{{ view.typo }}\n{% endmacro %}\n",
            },
            "beacon/example.c.j2:2:1: error: the template cannot be rendered",
        ),
        ({"component.yaml": "example: {}\n"}, "missing file 'example.c.j2'"),
    ],
)
def test_a_mistake_is_reported(files: dict[str, str], expected: str, folder: Path, run: Runner) -> None:
    own = {**files, "component.yaml": BEACON["component.yaml"] + files["component.yaml"]}
    write_files(folder / "beacon", {**BEACON, **own})
    (folder / "microros.yaml").write_text(BEACON_APPLICATION)
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert expected in done.err
