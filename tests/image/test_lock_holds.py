# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock in an image of POSIX threads: what cannot be bounded there is named with its place."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers]
nodes:
  - name: arm
    publishers: [{topic: position, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: target, type: std_msgs/msg/Int32}]
    timers: [{name: report, period: 100 ms}]
    executors: [{name: motor, handles: [report]}, {name: plans, handles: [target]}]
tasks:
  - {name: control, executor: motor, rate: 1 kHz}
  - {name: worker, executor: plans}
"""


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    call = [sys.executable, "-m", "microros_gen", *arguments]
    return subprocess.run(call, cwd=folder, text=True, capture_output=True, check=False)


@pytest.mark.system
def test_what_a_shared_library_has_is_no_bound(tmp_path: Path) -> None:
    (tmp_path / "microros.yaml").write_text(APPLICATION, encoding="utf-8")
    assert run(tmp_path, "build", "-o", "out").returncode == 0
    done = run(tmp_path, "locks", "out", "--format", "json")
    assert done.returncode == 0, "no task has `lock: auto`"
    assert done.stderr.count("[MG-9874]") == 1
    assert done.stderr.startswith("microros.yaml:11:5: warning: how long a task holds the lock has no bound")
    assert "  - {name: control, executor: motor, rate: 1 kHz}\n" in done.stderr
    rows = {row["task"]: row for row in json.loads(done.stdout)["tasks"]}
    assert all(row["instructions"] is None for row in rows.values())
    named = rows["control"]["open"]
    assert "memcpy: in a shared library, whose code is not in the image" in named
    assert any(": a loop without a bound (src/" in why for why in named), named
    bounds = {hold["function"]: hold["instructions"] for hold in rows["control"]["holds"]}
    assert 1 < bounds["task_count"] < 200, "nothing of a library is called within it"
    timers = [hold for hold in rows["control"]["holds"] if hold["function"] == "rcl_timer_call_with_info"]
    assert timers[0]["instructions"] > 500, "its loops have bounds, and it calls nothing of a library"
    table = run(tmp_path, "locks", "out").stdout
    assert "more (--format json)" in table
