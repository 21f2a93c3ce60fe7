# SPDX-License-Identifier: Apache-2.0
"""Images that the tests of sizes measure: built once a session, by the command line itself."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from microros_gen.cli import main as cli

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu_node
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}
      - {topic: imu/raw, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}
      - {topic: count, type: std_msgs/msg/Int32}
      - {topic: word, type: std_msgs/msg/String}
      - {topic: other, type: example_interfaces/msg/String}
limits:
  "*": {string: 64}
"""
PROBE = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: probe
    publishers:
      - {topic: fast, type: std_msgs/msg/UInt8, qos: {reliability: best_effort}}
      - {topic: sure, type: std_msgs/msg/Int32}
"""
BOARDS: Mapping[str, str] = {"host": "", "qemu-mps2-an385": "arm-none-eabi-"}
"""Target → prefix of the programs that measure its images."""


def build(folder: Path, text: str, target: str = "host", *, status: int = 0) -> Path:
    """Build an application file below `folder`; return the output folder."""
    folder.mkdir(parents=True, exist_ok=True)
    file, out = folder / "microros.yaml", folder / "out"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SystemExit) as end:
        cli.main(["build", "-c", str(file), "--target", target, "-o", str(out)])
    assert end.value.code == status
    return out


def tool(*command: str | Path, text: str = "") -> str:
    """Return what a program of a tool chain says, in English; `text` is its input."""
    environ = {**os.environ, "LC_ALL": "C"}
    words = [str(c) for c in command]
    done = subprocess.run(words, input=text, capture_output=True, text=True, env=environ, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout
