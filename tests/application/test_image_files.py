# SPDX-License-Identifier: Apache-2.0
"""Numbers of an image beside an application file, for the tasks with `stack: auto` and `lock: auto`."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.application.image_files import with_image_files
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source

TEXT = """\
version: 1
profiles: [pure_sender]
nodes: [{name: n, executors: [{name: a}, {name: b}, {name: c}]}]
tasks:
  - {name: first, executor: a, stack: auto}
  - {name: second, executor: b, stack: 2 KiB}
  - {name: third, executor: c, stack: auto}
"""


def sizes(folder: Path, content: str | None, text: str = TEXT) -> tuple[list[int | None], list[str]]:
    """Return the sizes of the tasks, and what is wrong."""
    diagnostics = Diagnostics()
    application = parse_application(Source("robot.yaml", text), diagnostics)
    assert application is not None
    if content is not None:
        (folder / "robot.stacks.yaml").write_text(content, encoding="utf-8")
    found, _ = with_image_files(application, folder / "robot.yaml", diagnostics)
    return [task.stack for task in found.tasks], [d.headline() for d in diagnostics]


def test_tasks_with_auto_have_the_sizes_of_the_file(tmp_path: Path) -> None:
    assert sizes(tmp_path, None) == ([None, 2048, None], [])
    assert sizes(tmp_path, "first: 600\nsecond: 700\ngone: 800\n") == ([600, 2048, None], [])


def test_without_such_a_task_the_file_is_not_read(tmp_path: Path) -> None:
    assert sizes(tmp_path, "- nonsense", TEXT.replace("stack: auto", "stack: 1 KiB")) == (
        [1024, 2048, 1024],
        [],
    )


@pytest.mark.parametrize(
    ("content", "place"),
    [
        ("- 1\n", "1:1"),
        ("first: 600\nthird: some\n", "2:8"),
        ("first: 0\n", "1:8"),
        ("third: 1073741825\n", "1:8"),
    ],
)
def test_another_content_is_refused(tmp_path: Path, content: str, place: str) -> None:
    found, (message,) = sizes(tmp_path, content)
    assert found == [None, 2048, None]
    assert (
        f"robot.stacks.yaml:{place}: error: the sizes of stacks are no mapping of tasks to bytes" in message
    )


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    (tmp_path / "robot.stacks.yaml").write_bytes(b"\xff")
    _, (message,) = sizes(tmp_path, None)
    assert message.startswith("robot.yaml:5:39: error: cannot read the sizes of stacks in")


LOCKS = TEXT.replace("stack: auto", "time: 2 ms, lock: auto")


def holds(folder: Path, content: str | None, text: str = LOCKS) -> tuple[list[int], list[str]]:
    """Return for how many instructions the tasks hold the lock, and what is wrong."""
    diagnostics = Diagnostics()
    application = parse_application(Source("robot.yaml", text), diagnostics)
    assert application is not None
    if content is not None:
        (folder / "robot.locks.yaml").write_text(content, encoding="utf-8")
    found, files = with_image_files(application, folder / "robot.yaml", diagnostics)
    assert set(files) <= {"holds of the lock"}
    return [task.lock_instructions for task in found.tasks], [d.headline() for d in diagnostics]


def test_tasks_hold_the_lock_for_the_instructions_of_the_file(tmp_path: Path) -> None:
    assert holds(tmp_path, None) == ([0, 0, 0], [])
    assert holds(tmp_path, "first: 600\nsecond: 700\ngone: 800\n") == ([600, 0, 0], [])
    assert holds(tmp_path, "- nonsense", LOCKS.replace("lock: auto", "lock: 1 ms")) == ([0, 0, 0], [])


def test_other_holds_are_refused(tmp_path: Path) -> None:
    found, (message,) = holds(tmp_path, "first: 600\nthird: some\n")
    assert found == [0, 0, 0]
    assert "robot.locks.yaml:2:8: error: the holds of the lock are no mapping of tasks to" in message
    (tmp_path / "robot.locks.yaml").write_bytes(b"\xff")
    _, (message,) = holds(tmp_path, None)
    assert message.startswith("robot.yaml:5:50: error: cannot read the holds of the lock in")
