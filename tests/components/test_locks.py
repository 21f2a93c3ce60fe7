# SPDX-License-Identifier: Apache-2.0
"""Functions that tasks may call at once take the lock, also those that ThreadSanitizer hardly meets."""

from __future__ import annotations

from pathlib import Path

from tests.support.components.rendered import program_of, rendered, run

APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+clock, +multithread]
clock: ros
pools: {jump_callbacks: 2}
nodes:
  - name: device
    subscriptions: [{topic: target, type: std_msgs/msg/Int32, on_silence: {after: 1 s, call: stop_motors}}]
"""


def test_they_wait_while_another_task_has_it(tmp_path: Path) -> None:
    run(program_of(rendered(tmp_path, APPLICATION), "unit_locks.c", more=("-pthread",)))
