# SPDX-License-Identifier: Apache-2.0
"""A message to another board is news for tasks that wait: a wake-up that ends the wait of another task is not lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.components.boards import application, ends, written
from tests.support.components.rendered import program_of, rendered, run
from tests.support.slices import first

END = ends("publishers", "topic: /a, peer: only")
TASKS = application("sensor", f"{END}    executors: [{{name: a}}]\n", "components: [+executor]\n")
TASKS += "tasks: [{name: idle, executor: a}]\n"
THREADS = application("sensor", END, "components: [+executor, +multithread]\n")


@pytest.mark.builds
@pytest.mark.parametrize("text", first([TASKS, THREADS]), ids=["tasks", "threads"])
def test_a_message_that_makes_a_heartbeat_due_is_news(tmp_path: Path, text: str) -> None:
    written(tmp_path)
    run(program_of(rendered(tmp_path / "sensor", text), "unit_peer_news.c", more=("-pthread",)))
