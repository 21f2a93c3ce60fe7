# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes`: what its commands print and end with."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.support.command_line import Runner
from tests.support.modes.models import MODELS, changed, model_text

SCRIPT = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 1500 ms, fail: joint, state: inactive}
"""


@pytest.fixture
def models(folder: Path) -> Path:
    """The current folder with the model files and a script."""
    for path in MODELS.glob("*.yaml"):
        shutil.copy(path, folder / path.name)
    (folder / "faults.yaml").write_text(SCRIPT, encoding="utf-8")
    return folder


@pytest.mark.usefixtures("models")
def test_check_prints_the_properties(run: Runner) -> None:
    outcome = run("modes", "check", "arm.yaml", "--application", "microros.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    assert (
        outcome.out
        == """\
parameters       proven      nodes as in application files: 1, as in __DEFAULT__: 1
start order      proven      parts that wait for another one: 0
inference        proven      modes of systems: 3
reachable modes  proven      modes: 9
stable rules     proven      rules: 3; combinations of failures: 225, different: 17
single commands  proven      parts with one system: 2; pairs of rules of which the last by name is applied: 1
"""
    )


@pytest.mark.usefixtures("models")
def test_check_refuses_a_misspelled_part(run: Runner) -> None:
    outcome = run("modes", "check", "two_arms.yaml")
    assert (outcome.status, outcome.out) == (2, "")
    assert (
        outcome.err
        == """\
two_arms.yaml:15:9: error: unknown part 'right/arn' in the mode 'BOTH'. Did you mean 'right/arm'? [MG-8813]
          right/arn: active.SLOW
          ^~~~~~~~~
"""
    )


@pytest.mark.usefixtures("models")
def test_check_as_json(run: Runner) -> None:
    outcome = run("modes", "check", "two_arms.yaml", "--format", "json")
    assert (outcome.status, outcome.err) == (2, "")
    assert json.loads(outcome.out) == {
        "version": 1,
        "model": "two_arms.yaml",
        "result": "refuted",
        "properties": [],
        "findings": [
            {
                "id": "MG-8813",
                "severity": "error",
                "message": "unknown part 'right/arn' in the mode 'BOTH'",
                "hint": "Did you mean 'right/arm'?",
                "file": "two_arms.yaml",
                "line": 15,
                "column": 9,
                "trace": [],
            }
        ],
    }


@pytest.mark.usefixtures("models")
def test_what_is_not_proven_ends_with_1(run: Runner) -> None:
    outcome = run("modes", "check", "arm.yaml", "--limit", "2")
    assert outcome.status == 1
    assert "stable rules     not proven" in outcome.out
    assert (
        "arm.yaml:5:1: warning: not proven for 'arm': more than 2 different combinations of failures"
        in outcome.err
    )
    data = json.loads(run("modes", "check", "arm.yaml", "--limit", "2", "--format", "json").out)
    assert data["result"] == "not proven"


def test_an_oscillation_has_its_trace_in_json(run: Runner, models: Path) -> None:
    text = changed(model_text("arm"), "        new_target: inactive\n", "        new_target: active.QUICK\n")
    (models / "bad.yaml").write_text(text, encoding="utf-8")
    outcome = run("modes", "check", "bad.yaml", "--format", "json")
    assert outcome.status == 2
    (finding,) = json.loads(outcome.out)["findings"]
    assert finding["id"] == "MG-8844"
    assert finding["trace"][:3] == [
        "failed joint inactive",
        "request arm active.QUICK",
        "command arm active.QUICK",
    ]
    (models / "s.yaml").write_text(SCRIPT, encoding="utf-8")
    outcome = run("modes", "simulate", "bad.yaml", "s.yaml")
    assert outcome.status == 1
    assert "  arm: its rules oscillate, and are not applied until the next request\n" in outcome.out


@pytest.mark.usefixtures("models")
def test_simulate_prints_the_trace(run: Runner) -> None:
    outcome = run("modes", "simulate", "arm.yaml", "faults.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    assert (
        outcome.out
        == """\
0 s       request arm active.QUICK
            status arm activating
            call gripper change_state configure
            call joint change_state configure
0.01 s      status gripper inactive
            status joint inactive
            call gripper set_parameters_atomically
            call joint set_parameters_atomically
0.02 s      call gripper change_state activate
            call joint change_state activate
0.03 s      status gripper active.FIRM
            status joint active.RUSH
            status arm active.QUICK
1.5 s     fail joint inactive
            joint: others changed it from active.RUSH to inactive
            arm: rule without_joint: inactive
            status joint inactive
            status arm deactivating
            call gripper change_state deactivate
1.51 s      status gripper inactive
            status arm inactive
end       arm inactive
          gripper inactive
          joint inactive
"""
    )


@pytest.mark.usefixtures("models")
def test_simulate_as_json(run: Runner) -> None:
    data = json.loads(run("modes", "simulate", "arm.yaml", "faults.yaml", "--format", "json").out)
    assert (data["version"], data["stable"]) == (1, True)
    steps = [(step["time_us"], step["kind"], step["part"], step["text"]) for step in data["steps"]]
    assert steps[0] == (0, "event", "arm", "request arm active.QUICK")
    assert (0, "call", "joint", "change_state configure") in steps
    at = steps.index((1_500_000, "event", "joint", "fail joint inactive"))
    assert steps[at + 2] == (1_500_000, "log", "arm", "rule without_joint: inactive")
    end = {"part": "arm", "status": "inactive", "target": "inactive", "failure": ""}
    assert data["end"][0] == end


@pytest.mark.usefixtures("models")
def test_simulate_takes_the_options_of_the_manager(run: Runner) -> None:
    options = ("--reconfigure", "gripper", "--mode-services", "joint", "--timeout", "0.5")
    outcome = run("modes", "simulate", "arm.yaml", "faults.yaml", *options)
    assert (outcome.status, outcome.err) == (0, "")
    assert "  call joint change_mode RUSH\n" in outcome.out
    outcome = run("modes", "simulate", "arm.yaml", "faults.yaml", "--mode-services", "arm")
    assert outcome.status == 2
    assert "'arm' is no node of the scope. Nodes: gripper, joint [MG-8873]" in outcome.err


def test_graph_writes_what_it_prints(run: Runner, models: Path) -> None:
    printed = run("modes", "graph", "robot.yaml")
    assert (printed.status, printed.err) == (0, "")
    outcome = run("modes", "graph", "robot.yaml", "-o", "robot.svg")
    assert (outcome.status, outcome.out, outcome.err) == (0, "", "")
    assert (models / "robot.svg").read_text(encoding="utf-8") == printed.out
    assert printed.out.startswith("<svg xmlns=")


@pytest.mark.usefixtures("models")
@pytest.mark.parametrize("command", [("graph",), ("simulate", "faults.yaml")])
def test_others_refuse_a_file_with_mistakes(run: Runner, command: tuple[str, ...]) -> None:
    outcome = run("modes", command[0], "two_arms.yaml", *command[1:])
    assert (outcome.status, outcome.out) == (2, "")
    assert "[MG-8813]" in outcome.err


def test_a_wrong_command_gets_the_nearest(run: Runner) -> None:
    outcome = run("modes", "checks")
    assert outcome.status == 2
    assert "unknown command 'checks'. Did you mean 'check'?" in outcome.err


@pytest.mark.usefixtures("models")
def test_manage_refuses_a_misspelled_part_before_it_starts(run: Runner) -> None:
    outcome = run("modes", "manage", "two_arms.yaml")
    assert (outcome.status, outcome.out) == (2, "")
    assert "unknown part 'right/arn' in the mode 'BOTH'. Did you mean 'right/arm'? [MG-8813]" in outcome.err


@pytest.mark.usefixtures("models")
@pytest.mark.parametrize(
    ("options", "error"),
    [
        (("--scope", "bas"), "error: unknown part 'bas'. Did you mean 'base'? [MG-8870]"),
        (
            ("--scope", "robot", "--scope", "base"),
            "'base' is twice in the scope. Name only the upper one [MG-8871]",
        ),
        (("--without", "camera"), "'camera' is no subsystem of the scope. "),
        (
            ("--reconfigure", "base"),
            "'base' is no node of the scope. Nodes: wheels/left, wheels/right, camera",
        ),
    ],
)
def test_manage_with_a_wrong_scope(run: Runner, options: tuple[str, ...], error: str) -> None:
    outcome = run("modes", "manage", "robot.yaml", *options)
    assert (outcome.status, outcome.out) == (2, "")
    assert error in outcome.err


@pytest.mark.usefixtures("models")
def test_monitor_refuses_a_page_for_other_machines(run: Runner) -> None:
    outcome = run("modes", "monitor", "arm.yaml", "--page", "0.0.0.0:8080")
    assert outcome.status == 2
    assert "'0.0.0.0:8080' is no place for a page" in outcome.err


CELL = """\
cell:
  ros__parameters:
    type: system
    parts: [arm/device]
    modes:
      __DEFAULT__: {arm/device: active.SLOW, ros__parameters: {limit: 0.3}}
      HIGH: {arm/device: active.SLOW, ros__parameters: {limit: 0.9}}
"""
DEVICE = """\
version: 1
profiles: [managed_service]
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}
      - {name: limit, type: double, default: 1.0}
    modes:
      SLOW: {speed: 0.2}
"""


@pytest.fixture
def cell(folder: Path) -> Path:
    """The current folder with a model whose part is in an application file alone, and a script."""
    (folder / "cell.yaml").write_text(CELL, encoding="utf-8")
    (folder / "device.yaml").write_text(DEVICE, encoding="utf-8")
    (folder / "s.yaml").write_text("- {at: 0 s, request: cell, target: active}\n", encoding="utf-8")
    return folder


@pytest.mark.usefixtures("cell")
def test_simulate_plays_a_device_of_an_application_file_with_its_mode_services(run: Runner) -> None:
    outcome = run("modes", "simulate", "cell.yaml", "s.yaml", "--application", "device.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    calls = [line.split("call ")[1] for line in outcome.out.splitlines() if "call " in line]
    device = "arm/device change"
    assert calls == [f"{device}_state configure", f"{device}_mode SLOW", f"{device}_state activate"]


@pytest.mark.usefixtures("cell")
def test_graph_draws_a_device_of_an_application_file(run: Runner) -> None:
    outcome = run("modes", "graph", "cell.yaml", "--application", "device.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    assert "arm/device" in outcome.out
    assert ">SLOW</text>" in outcome.out


@pytest.mark.usefixtures("cell")
@pytest.mark.parametrize(
    ("words", "options", "error"),
    [
        (("manage", "cell.yaml"), ("--scope", "cel"), "MG-8870"),
        (("monitor", "cell.yaml"), ("--page", "0.0.0.0:1"), "MG-8875"),
        (("simulate", "cell.yaml", "s.yaml"), ("--reconfigure", "cell"), "MG-8873"),
        (("graph", "cell.yaml"), ("--output", "there/is/no/folder.svg"), ""),
    ],
)
def test_a_part_of_an_application_file_is_known_with_the_option_alone(
    run: Runner, words: tuple[str, ...], options: tuple[str, ...], error: str
) -> None:
    """With the option, the first mistake is the one of the other options."""
    assert "MG-8806" in run("modes", *words).err
    outcome = run("modes", *words, "--application", "device.yaml", *options)
    assert "MG-8806" not in outcome.err
    assert error in outcome.err


def test_values_of_a_parent_are_given_to_a_device(run: Runner, cell: Path) -> None:
    text = changed(
        DEVICE,
        "      SLOW: {speed: 0.2}",
        "      __DEFAULT__: {limit: $(parent limit)}\n      SLOW: {speed: 0.2}",
    )
    (cell / "device.yaml").write_text(text, encoding="utf-8")
    (cell / "s.yaml").write_text("- {at: 0 s, request: cell, target: active.HIGH}\n", encoding="utf-8")
    outcome = run("modes", "simulate", "cell.yaml", "s.yaml", "--application", "device.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    calls = [line.split("device ")[1] for line in outcome.out.splitlines() if "call " in line]
    assert calls == [
        "change_state configure",
        "set_parameters_atomically",
        "change_mode SLOW",
        "change_state activate",
    ]
    assert "          cell active.HIGH" in outcome.out


@pytest.mark.usefixtures("cell")
@pytest.mark.parametrize("words", [("manage", "cell.yaml"), ("simulate", "cell.yaml", "s.yaml")])
def test_an_application_file_that_is_not_there(run: Runner, words: tuple[str, ...]) -> None:
    outcome = run("modes", *words, "--application", "devices.yaml")
    assert (outcome.status, outcome.out) == (2, "")
    assert "devices.yaml" in outcome.err
    assert "MG-8806" not in outcome.err
