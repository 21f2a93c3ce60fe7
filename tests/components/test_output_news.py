# SPDX-License-Identifier: Apache-2.0
"""A reliable message is news for tasks that wait: a wake-up that ends the wait of another task is not lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.components.rendered import program_of, rendered, run
from tests.support.slices import first

THREADS = """\
version: 1
profiles: [pure_sender]
components: [+executor, +multithread]
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
"""
TASKS = THREADS + "    executors: [{name: a}]\ntasks: [{name: idle, executor: a}]\n"


@pytest.mark.builds
@pytest.mark.parametrize("text", first([THREADS, TASKS]), ids=["threads", "tasks"])
def test_a_message_that_makes_a_heartbeat_due_ends_each_wait(tmp_path: Path, text: str) -> None:
    program = program_of(
        rendered(tmp_path, text), "unit_output_news.c", without=("port_posix_wait.c",), more=("-pthread",)
    )
    run(program)
