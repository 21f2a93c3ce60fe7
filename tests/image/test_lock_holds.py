# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock in an image of POSIX threads: what cannot be bounded there is named with its place."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen.cli import locks
from tests.support.command_line import Runner
from tests.support.sharing import ShareResult

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


@pytest.mark.system
def test_what_a_shared_library_has_is_no_bound(folder: Path, run: Runner, share_result: ShareResult) -> None:
    share_result(locks, "_measured", lambda image, port: (image.path, port))
    (folder / "microros.yaml").write_text(APPLICATION, encoding="utf-8")
    assert run("build", "-o", "out").status == 0
    done = run("locks", "out", "--format", "json")
    assert done.status == 0, "no task has `lock: auto`"
    assert done.err.count("[MG-9874]") == 1
    assert done.err.startswith("microros.yaml:11:5: warning: how long a task holds the lock has no bound")
    assert "  - {name: control, executor: motor, rate: 1 kHz}\n" in done.err
    rows = {row["task"]: row for row in json.loads(done.out)["tasks"]}
    assert all(row["instructions"] is None for row in rows.values())
    named = rows["control"]["open"]
    assert "memcpy: in a shared library, whose code is not in the image" in named
    assert any(": a loop without a bound (src/" in why for why in named), named
    bounds = {hold["function"]: hold["instructions"] for hold in rows["control"]["holds"]}
    assert 1 < bounds["task_count"] < 200, "nothing of a library is called within it"
    timers = [hold for hold in rows["control"]["holds"] if hold["function"] == "rcl_timer_call_with_info"]
    assert timers[0]["instructions"] > 500, "its loops have bounds, and it calls nothing of a library"
    table = run("locks", "out").out
    assert "more (--format json)" in table
