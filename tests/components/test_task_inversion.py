# SPDX-License-Identifier: Apache-2.0
"""Priority inversion, provoked with threads: the blocking that the analysis used bounds it, and nothing else does."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen.components.tasks.plan import TasksPlan
from tests.support.components.rendered import planned, program_of, rendered
from tests.support.patience import seconds

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32, local: only}]
    subscriptions: [{topic: count, type: std_msgs/msg/Int32, local: only}]
    executors: [{name: a}, {name: b}, {name: c}]
tasks:
  - {name: high, executor: a, period: 10 s, deadline: 100 ms, time: 10 ms, lock: 1 ms}
  - {name: middle, executor: b, period: 10 s, deadline: 2 s, time: 400 ms, lock: 1 ms}
  - {name: low, executor: c, period: 10 s, deadline: 4 s, time: 60 ms, lock: 50 ms}
  - {name: session, session: true, interval: 10 s, time: 10 ms, lock: 1 ms}
"""
SPIN_US = 250_000
"""Time of the middle task (c/task_inversion.c)."""
SKIPPED = 77


def waited_us(program: Path, lock: str) -> int:
    done = subprocess.run([program, lock], capture_output=True, text=True, timeout=seconds(60), check=False)
    if done.returncode == SKIPPED:
        pytest.skip("skipped: the process may not use SCHED_FIFO (ulimit -r, or CAP_SYS_NICE)")
    assert (done.returncode, done.stderr) == (0, "")
    return int(done.stdout)


def test_a_lock_with_inheritance_bounds_how_long_a_task_is_blocked(tmp_path: Path) -> None:
    """Without inheritance the same program waits for the middle task, so that this test can fail."""
    part = planned(tmp_path, APPLICATION).project.runtime.features.of("tasks")
    assert isinstance(part, TasksPlan)
    high = next(r for r in part.responses if r.task.name == "high")
    assert (high.blocking_us, high.blockers[0].task, high.response_us) == (50_000, "low", 60_000)
    assert high.response_us is not None
    program = program_of(rendered(tmp_path, APPLICATION), "task_inversion.c", more=("-pthread",))
    assert waited_us(program, "plain") > SPIN_US > high.response_us
    assert waited_us(program, "inherits") <= high.response_us
    assert waited_us(program, "raised") <= high.task.time_us, (
        "no task above the one with the lock ran meanwhile"
    )
