# SPDX-License-Identifier: Apache-2.0
"""`microros-gen system`: what it prints and ends with."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.command_line import Runner
from tests.support.components.boards import MOTOR, SYSTEM, written


@pytest.fixture
def system(folder: Path) -> Path:
    """The current folder with a system whose boards agree."""
    return written(folder)


@pytest.mark.usefixtures("system")
def test_boards_that_agree(run: Runner) -> None:
    outcome = run("system", "check", "system.yaml")
    assert (outcome.status, outcome.err) == (0, "")
    assert (
        outcome.out
        == """\
BOARD   RESULT  NEIGHBORS     EXCHANGES
sensor  agrees  motor (udp)   peers: motor (/a); no agent is needed
motor   agrees  sensor (udp)  peers: sensor (/a); no agent is needed
"""
    )


def test_a_difference(run: Runner, system: Path) -> None:
    (system / "motor" / "microros.yaml").write_text(MOTOR.replace("string: 20", "string: 10"))
    outcome = run("system", "check", "system.yaml")
    assert outcome.status == 2
    assert (
        outcome.out
        == """\
BOARD   RESULT   NEIGHBORS     EXCHANGES
sensor  1 error  motor (udp)
motor   1 error  sensor (udp)
"""
    )
    assert outcome.err.splitlines()[0] == (
        "sensor/microros.yaml:8:9: error: 'data' of '/a': up to 20 characters from the publisher, and 10 fit the"
        " subscription of the board 'motor' (motor/microros.yaml:8). Write the same `limits:` in both applications"
        " [MG-7206]"
    )
    assert sum("[MG-7206]" in line for line in outcome.err.splitlines()) == 2


def test_json(run: Runner, system: Path) -> None:
    (system / "motor" / "microros.yaml").write_text(MOTOR.replace("profiles:", "profile:"))
    outcome = run("system", "check", "system.yaml", "--format", "json")
    assert (outcome.status, outcome.err) == (2, "")
    data = json.loads(outcome.out)
    assert (data["version"], data["system"], data["result"]) == (1, "system.yaml", "differs")
    sensor, motor = data["boards"]
    assert sensor == {
        "name": "sensor",
        "application": "sensor/microros.yaml",
        "result": "not compared",
        "errors": 0,
        "not_compared_with": ["motor"],
        "neighbors": [{"board": "motor", "over": "udp"}],
        "reports": {},
    }
    assert (motor["result"], motor["errors"]) == ("differs", 1)
    [finding] = data["findings"]
    assert (finding["id"], finding["severity"], finding["file"]) == (
        "MG-1002",
        "error",
        "motor/microros.yaml",
    )
    assert (finding["line"], finding["column"]) == (2, 1)
    assert "profile" in finding["message"]


def test_without_a_file(run: Runner) -> None:
    outcome = run("system", "check", "robot.yaml")
    assert (outcome.status, outcome.out) == (2, "")
    assert outcome.err == (
        "microros-gen: error: cannot read the system file 'robot.yaml': No such file or directory [MG-3190]\n"
    )


def test_an_application_is_no_system(run: Runner, system: Path) -> None:
    outcome = run("system", "check", "sensor/microros.yaml")
    assert outcome.status == 2
    assert "missing key 'boards'" in outcome.err
    assert (system / "system.yaml").read_text() == SYSTEM


def test_an_unknown_command(run: Runner) -> None:
    outcome = run("system", "checks")
    assert outcome.status == 2
    assert "unknown command 'checks'. Did you mean 'check'?" in outcome.err
