# SPDX-License-Identifier: Apache-2.0
"""The mobile robot of examples/: four boards and two ROS nodes with modes; its lidar fails, and it goes on slowly."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest

from tests.support.agent.process import environment
from tests.support.e2e.images import run
from tests.support.firmware.board import need
from tests.support.paths import ROOT

TARGETS = {
    "CRUISE": {
        "drive_base": "active.FAST",
        "left_wheel": "active.FAST",
        "right_wheel": "active.FAST",
        "perception": "active.FULL",
        "lidar": "active.DENSE",
        "bumper": "active.__DEFAULT__",
        "navigation": "active.GLOBAL",
        "localizer": "active.MAP",
        "planner": "active.GLOBAL",
    },
    "CAREFUL": {
        "drive_base": "active.__DEFAULT__",
        "left_wheel": "active.__DEFAULT__",
        "right_wheel": "active.__DEFAULT__",
        "perception": "active.CONTACT",
        "lidar": "unconfigured",
        "bumper": "active.SENSITIVE",
        "navigation": "active.__DEFAULT__",
        "localizer": "active.__DEFAULT__",
        "planner": "active.__DEFAULT__",
    },
}


@pytest.mark.ros
@pytest.mark.system
def test_the_robot_continues_without_its_lidar(tmp_path: Path, domain: int) -> None:
    need("qemu-mps2-an386", emulator=True)
    for name in ("mobile_robot", "cmake_app"):
        shutil.copytree(ROOT / "examples" / name, tmp_path / "examples" / name)
    shutil.copy(ROOT / "examples" / "processes.py", tmp_path / "examples")
    program = tmp_path / "examples" / "mobile_robot" / "robot.py"
    done = run([sys.executable, str(program)], env=environment(domain), timeout_s=300)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = [line.split() for line in done.stdout.splitlines()]
    tables = [i for i, words in enumerate(lines) if words[:3] == ["part", "target", "actual"]]
    assert len(tables) == len(TARGETS)
    for table, (mode, expected) in zip(tables, TARGETS.items(), strict=True):
        assert lines[table + 1][:3] == ["robot", f"active.{mode}", f"active.{mode}"]
        shown = {words[0]: words[2] for words in lines[table + 2 : table + 2 + len(expected)]}
        assert shown == expected
    assert done.stdout.count("rule without_lidar") == 1
