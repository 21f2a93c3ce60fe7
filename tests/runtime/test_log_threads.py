# SPDX-License-Identifier: Apache-2.0
"""Tasks that log while another one sets levels, as the logger services do, watched by ThreadSanitizer."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.components.rendered import program_of, rendered
from tests.support.patience import seconds

APPLICATION = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
components: [+multithread]
logging: [{to: console, level: debug}]
"""
TURNS, TASKS = 2000, (1, 2)


@pytest.mark.system
def test_tasks_log_while_levels_change(tmp_path: Path) -> None:
    out = rendered(tmp_path, APPLICATION)
    printed = tmp_path / "printed"
    program = program_of(out, "log_threads.c", by=("gcc", ("-g", "-O1", "-fsanitize=thread", "-pthread")))
    with printed.open("w") as lines:
        done = subprocess.run(
            [program],
            stdout=subprocess.PIPE,
            stderr=lines,
            text=True,
            timeout=seconds(120),
            env={"TSAN_OPTIONS": f"log_path={tmp_path / 'races'}"},
            check=False,
        )
    assert (done.returncode, done.stdout) == (0, "dropped 0\n"), [
        report.read_text() for report in tmp_path.glob("races*")
    ]
    texts = [
        line.rpartition("]: ")[2] for line in printed.read_text().splitlines() if line.startswith("[WARN]")
    ]
    for task in TASKS:
        of_task = [text for text in texts if text.startswith(f"task {task} ")]
        assert of_task == [f"task {task} line {number} end" for number in range(TURNS)]
