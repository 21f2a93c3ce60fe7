# SPDX-License-Identifier: Apache-2.0
"""`microros-gen interfaces`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from microros_gen.cli.interfaces import command
from microros_gen.diagnostics import UserError


def run(*arguments: str) -> Result:
    return CliRunner().invoke(command, list(arguments), catch_exceptions=True)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "my_msgs/msg").mkdir(parents=True)
    fields = "std_msgs/Header header\nfloat32 speed 0.5  # [m/s]\nstring<=5[<=2] a ['x']\n"
    text = f"# What it is.\n\nuint8 ON = 1\n\n{fields}"
    (tmp_path / "my_msgs/msg/Drive.msg").write_text(text, encoding="utf-8")
    return tmp_path


def test_packages(folder: Path) -> None:
    result = run("--interface-path", str(folder))
    assert result.exit_code == 0
    rows = [line.split() for line in result.stdout.splitlines()]
    assert ["my_msgs", "1", "path", str(folder / "my_msgs")] in rows
    assert any(row[0] == "sensor_msgs" and row[2] in ("pip", "ament", "shipped") for row in rows)


def test_types_of_a_package(folder: Path) -> None:
    result = run("my_msgs", "--interface-path", str(folder))
    assert result.exit_code == 0
    assert result.stdout.splitlines()[-1].split(maxsplit=1) == ["my_msgs/msg/Drive", "What it is."]
    data = json.loads(run("my_msgs", "--interface-path", str(folder), "--format", "json").stdout)
    assert [entry["type"] for entry in data["types"]] == ["my_msgs/msg/Drive"]
    assert data["origin"] == "path"


def test_one_type(folder: Path) -> None:
    result = run("my_msgs/Drive", "--interface-path", str(folder))
    lines = [" ".join(line.split()) for line in result.stdout.splitlines()]
    assert "ON uint8 1" in lines
    assert "speed float32 0.5 [m/s]" in lines
    assert 'a string<=5[<=2] ["x"]' in lines
    assert "builtin_interfaces/msg/Time" in lines


def test_one_type_for_machines(folder: Path) -> None:
    data = json.loads(run("my_msgs/msg/Drive", "--interface-path", str(folder), "--format", "json").stdout)
    assert data["hash"].startswith("RIHS01_")
    assert data["comment"] == ["What it is."]
    assert data["constants"] == [{"name": "ON", "type": "uint8", "value": 1, "comment": []}]
    assert data["fields"][1] == {"name": "speed", "type": "float32", "default": 0.5, "comment": ["[m/s]"]}
    assert data["dependencies"] == ["builtin_interfaces/msg/Time", "std_msgs/msg/Header"]
    assert data["file"] == str(folder / "my_msgs/msg/Drive.msg")


def test_a_service_shows_its_parts(folder: Path) -> None:
    (folder / "my_msgs/srv").mkdir()
    text = "# Drive there.\nfloat64 x\n---\nuint8 LATE=2\nbool done true # or not\n"
    (folder / "my_msgs/srv/Go.srv").write_text(text, encoding="utf-8")
    lines = [
        " ".join(x.split()) for x in run("my_msgs/Go", "--interface-path", str(folder)).stdout.splitlines()
    ]
    assert lines[:2] == ["my_msgs/srv/Go", "Drive there."]
    assert lines.index("request") < lines.index("x float64") < lines.index("response")
    assert lines.index("response") < lines.index("LATE uint8 2") < lines.index("done bool true or not")
    data = json.loads(run("my_msgs/Go", "--interface-path", str(folder), "--format", "json").stdout)
    assert list(data["parts"]) == ["request", "response"]
    assert data["parts"]["response"]["constants"][0]["name"] == "LATE"
    assert [entry["type"].split("_")[-1] for entry in data["derived"]] == ["Request", "Response", "Event"]
    assert all(entry["hash"].startswith("RIHS01_") for entry in data["derived"])
    members = data["type_description_msg"]["type_description"]["fields"]
    assert [member["name"] for member in members] == ["request_message", "response_message", "event_message"]


def test_an_action_shows_its_parts() -> None:
    result = run("example_interfaces/Fibonacci", "--format", "json")
    data = json.loads(result.stdout)
    assert list(data["parts"]) == ["goal", "result", "feedback"]
    assert len(data["derived"]) == 12
    assert "  goal\n" in run("example_interfaces/action/Fibonacci").stdout


def test_a_derived_message_is_shown(folder: Path) -> None:
    lines = run("std_srvs/srv/SetBool_Event").stdout.splitlines()
    assert any(line.split()[:2] == ["request", "std_srvs/SetBool_Request[<=1]"] for line in lines)
    assert "(empty)" in run("std_srvs/Trigger").stdout
    name = "example_interfaces/action/Fibonacci_SendGoal"
    data = json.loads(run(name, "--format", "json").stdout)
    assert list(data["parts"]) == ["request", "response"]
    assert [entry["type"] for entry in data["derived"]] == [
        f"{name}_{part}" for part in ("Request", "Response", "Event")
    ]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["nope"], "unknown interface package 'nope'"),
        (["std_msgs/Nope"], "has no type 'Nope'"),
        (["std_srvs/action/SetBool"], "has no type 'SetBool'. It has std_srvs/srv/SetBool"),
        (["--interface-path", "/does/not/exist"], "the interface path '/does/not/exist' does not exist"),
    ],
)
def test_faults_end_with_their_diagnostics(arguments: list[str], expected: str) -> None:
    result = run(*arguments)
    assert isinstance(result.exception, UserError)
    assert expected in str(result.exception)
