# SPDX-License-Identifier: Apache-2.0
"""The commands that only print: tables for people, JSON and graphs for programs, and help that helps."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from microros_gen.cli.main import _COMMANDS
from tests.support.command_line import Runner
from tests.support.paths import ROOT
from tests.support.selection.profiles import ALL_PROFILES, BUILTIN_PROFILES

IDL = str(ROOT / "microros_gen" / "idl")
ALL_COMMANDS = [*_COMMANDS, "agent udp4", "system check", "modes check", "modes simulate", "modes graph"]


def data_of(run: Runner, *arguments: str) -> Any:
    outcome = run(*arguments, "--format", "json")
    assert (outcome.status, outcome.err) == (0, "")
    return json.loads(outcome.out)


def table_of(run: Runner, *arguments: str) -> list[str]:
    outcome = run(*arguments)
    assert (outcome.status, outcome.err) == (0, "")
    assert not [line for line in outcome.out.splitlines() if line != line.rstrip()], "no blanks at line ends"
    return outcome.out.splitlines()


def graph_of(run: Runner, *arguments: str) -> str:
    """Return a graph whose braces, quotes and brackets are balanced, and whose edges have both ends."""
    outcome = run(*arguments, "--format", "dot")
    assert (outcome.status, outcome.err) == (0, "")
    unquoted = re.sub(r'"(?:[^"\\]|\\.)*"', "Q", outcome.out)
    assert '"' not in unquoted
    assert outcome.out.startswith("digraph ")
    assert unquoted.count("{") == unquoted.count("}") == 1
    assert unquoted.count("[") == unquoted.count("]")
    name = r'"((?:[^"\\]|\\.)*)"'
    nodes = set(re.findall(rf"^  {name} \[", outcome.out, re.MULTILINE))
    edges = re.findall(rf"^  {name} -> {name}", outcome.out, re.MULTILINE)
    assert edges
    assert {end for edge in edges for end in edge} <= nodes
    return outcome.out


def test_profiles_lists_all(run: Runner) -> None:
    lines = table_of(run, "profiles")
    assert lines[0].split() == ["PROFILE", "STATUS", "COMPONENTS", "WHAT", "FOR"]
    assert [line.split()[0] for line in lines[1:]] == list(ALL_PROFILES)
    listed = data_of(run, "profiles")
    assert {entry["name"]: entry["status"] for entry in listed}["pure_sender"] == "ready"
    assert set(listed[0]) == {"name", "summary", "status", "components", "axes"}
    graph = graph_of(run, "profiles")
    assert '"profile pure_sender" -> "publish"' in graph


@pytest.mark.parametrize("profile", BUILTIN_PROFILES)
def test_profiles_shows_each(run: Runner, profile: str) -> None:
    assert any(line.startswith("COMPONENT") for line in table_of(run, "profiles", profile))
    data = data_of(run, "profiles", profile)
    assert data["profiles"] == [profile]
    assert all(component["reasons"] for component in data["components"])
    graph_of(run, "profiles", profile)


def test_resolve_has_sizes_and_reasons(run: Runner) -> None:
    selection = ("resolve", "--profile", "pure_sender", "--interface-path", IDL)
    lines = table_of(run, *selection)
    for head in ("AXIS", "COMPONENT", "XRCE PROFILE", "SUBMESSAGE", "KIND", "POOL", "TYPE"):
        assert [line for line in lines if line.startswith(head)], head
    data = data_of(run, *selection)
    assert data["types"]["std_msgs/msg/Int32"]["max_encoded_size"] == 4
    assert data["types"]["std_msgs/msg/Int32"]["hash"].startswith("RIHS01_")
    assert data["streams"]["reliable_slots"] == 4
    assert all(pool["reason"] for pool in data["pools"].values())
    assert '"publish" -> "cdr"' in graph_of(run, *selection)


def test_resolve_and_the_manifest_agree(run: Runner, folder: Path) -> None:
    selection = ("--profile", "pure_sender", "--interface", "sensor_msgs/msg/Imu", "--interface-path", IDL)
    assert run("generate", *selection, "-o", "out").status == 0
    manifest = json.loads((folder / "out" / "manifest.json").read_text())
    resolved = data_of(run, "resolve", *selection)
    assert [c["name"] for c in resolved["components"]] == manifest["selection"]["components"]
    for name, entry in manifest["types"].items():
        assert resolved["types"][name]["hash"] == entry["hash"]
        assert resolved["types"][name]["max_encoded_size"] == entry["max_encoded_size"]
    assert resolved["streams"]["reliable_slot_size"] == manifest["pools"]["reliable_slot_size"]


def test_interfaces(run: Runner) -> None:
    lines = table_of(run, "interfaces", "--interface-path", IDL)
    assert lines[0].split() == ["package", "types", "origin", "folder"]
    packages = data_of(run, "interfaces", "--interface-path", IDL)
    assert "sensor_msgs" in {entry["package"] for entry in packages}
    package = data_of(run, "interfaces", "sensor_msgs", "--interface-path", IDL)
    assert "sensor_msgs/msg/Imu" in [entry["type"] for entry in package["types"]]
    described = data_of(run, "interfaces", "sensor_msgs/msg/Imu", "--interface-path", IDL)
    assert described["fields"][0]["name"] == "header"
    assert "std_msgs/msg/Header" in described["dependencies"]
    assert any("linear_acceleration" in line for line in table_of(run, "interfaces", "sensor_msgs/Imu"))


def test_targets(run: Runner) -> None:
    assert any(line.startswith("host") for line in table_of(run, "targets"))
    (host,) = [entry for entry in data_of(run, "targets") if entry["name"] == "host"]
    assert host["parts"] == {"network": "port_posix_sockets", "os": "port_posix"}
    assert data_of(run, "targets", "host") == [host]
    assert any(line.startswith("compilers") for line in table_of(run, "targets", "host"))


@pytest.mark.parametrize(
    "arguments",
    [
        ("profiles", "pure_sendr"),
        ("interfaces", "sensor_mgs"),
        ("interfaces", "sensor_msgs/Imuu"),
        ("targets", "hots"),
    ],
)
def test_a_wrong_name_gets_the_nearest(run: Runner, arguments: tuple[str, ...]) -> None:
    outcome = run(*arguments)
    assert outcome.status == 2
    assert outcome.out == ""
    assert "Did you mean" in outcome.err


@pytest.mark.parametrize("command", ALL_COMMANDS)
def test_help_has_an_example_and_explains_every_option(run: Runner, command: str) -> None:
    outcome = run(*command.split(), "--help")
    assert outcome.status == 0
    body, _, options = outcome.out.partition("Options:")
    assert re.search(rf"^  microros-gen {command}( |$)", body, re.MULTILINE), "an example"
    entries = re.split(r"^  (?=-)", options.split("Commands:")[0], flags=re.MULTILINE)[1:]
    assert entries
    for entry in entries:
        words = re.sub(r"\[(default|required|x|\d).*?\]|\s+", " ", entry.split("  ", 1)[-1], flags=re.DOTALL)
        assert len(words.split()) >= 2, f"{entry.split()[0]} is not explained"


def test_help_of_all_names_every_command(run: Runner) -> None:
    for arguments in (("--help",), ("-h",)):
        outcome = run(*arguments)
        assert outcome.status == 0
        assert all(re.search(rf"^  {name} +\w", outcome.out, re.MULTILINE) for name in _COMMANDS)
        assert "Exit status: 0 success; 1 a check differs, a build" in outcome.out


def test_without_a_command_the_help_is_shown(run: Runner) -> None:
    outcome = run()
    assert "Usage: microros-gen" in outcome.out + outcome.err
    assert outcome.status in (0, 2)


def test_a_wrong_command_gets_the_nearest(run: Runner) -> None:
    outcome = run("biuld")
    assert outcome.status == 2
    assert "Did you mean 'build'?" in outcome.err


def test_interfaces_of_services_and_actions(run: Runner) -> None:
    package = data_of(run, "interfaces", "std_srvs", "--interface-path", IDL)
    assert [entry["type"] for entry in package["types"]] == [
        f"std_srvs/srv/{name}" for name in ("Empty", "SetBool", "Trigger")
    ]
    described = data_of(run, "interfaces", "std_srvs/SetBool", "--interface-path", IDL)
    assert described["type_description_msg"]["type_description"]["type_name"] == "std_srvs/srv/SetBool"
    assert "  request" in table_of(run, "interfaces", "std_srvs/SetBool")


def test_components_without_a_profile_make_an_application(run: Runner, folder: Path) -> None:
    """A node alone, which has no type of a message: it has a name and a folder (tests/e2e compiles such a one)."""
    text = "version: 1\ncomponents: [+node]\nnodes: [{name: alone}]\n"
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    outcome = run("generate")
    assert (outcome.status, outcome.err) == (0, "")
    assert outcome.out.startswith("profile    application for host: node ")
    assert (folder / "build/application/examples/application/main.c").is_file()
    assert (folder / "build/application/include/microros/message_type.h").is_file()


@pytest.mark.parametrize("component", ["time_sync", "executor"])
def test_what_needs_no_message_gets_none(run: Runner, folder: Path, component: str) -> None:
    """The default type is for who sends or receives; type support without an encoder does not compile."""
    (folder / "microros.yaml").write_text(f"version: 1\ncomponents: [+{component}]\n", encoding="utf-8")
    outcome = run("generate")
    assert (outcome.status, outcome.err) == (0, "")
    assert not list((folder / "build/application").rglob("*__type_support.c"))


def test_a_message_that_is_never_sent_is_refused(run: Runner, folder: Path) -> None:
    text = "version: 1\ncomponents: [+ping]\ninterfaces: [std_msgs/msg/String]\n"
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    outcome = run("generate")
    assert outcome.status == 2
    assert "microros.yaml:3:14: error: no selected component sends or receives messages" in outcome.err
