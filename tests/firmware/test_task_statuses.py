# SPDX-License-Identifier: Apache-2.0
"""What a board with tasks reports of each of them over its serial line, compared with its memory."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.board import C_FILES, Board, Built, board, target
from tests.support.firmware.running import started
from tests.support.firmware.tasks import BOARD, REPORTED, built_tasks
from tests.support.patience import deadline

STACKS = {"control": 3072, "worker": 2048, "session": 4096}
USED, LATE_US, PERIOD_US = 1200, 100_000, 20_000
"""What a late run of `control` takes (c/task_statuses.c): bytes of its stack, and its time."""
PAINT, WARN = 0xA5, 1
FRAME = 104
"""Bytes that an interrupt can put on a stack after a report."""


def touched(running: Board, built: Built, image: Path, task: str) -> int:
    """Return how many bytes of the stack of a task have been used up to now."""
    stack = running.memory(built.symbols(image)[f"stack_of_{task}"], STACKS[task])
    return len(stack) - next(i for i, byte in enumerate(stack) if byte != PAINT)


def reported(observer: Observer, task: str, overruns: int) -> dict[str, Any]:
    """Return a status of a task with so many overruns at least."""
    end = deadline(60)
    while True:
        for topic, array in observer.ask(do="samples"):
            for status in array["status"] if topic == "/diagnostics" else ():
                if status["name"] == f"arm/device: task {task}":
                    values = {pair["key"]: int(pair["value"]) for pair in status["values"]}
                    if values["overruns"] >= overruns:
                        return {**status, "values": values}
        assert time.monotonic() < end, task
        time.sleep(0.02)


@pytest.mark.variant  # of tests/e2e/test_diagnosis_tasks.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_each_task_of_a_board_has_a_status(tmp_path: Path, domain: int, observer: Observer) -> None:
    """One is late once, and uses more of its stack then; the paint of each stack is looked at from outside."""
    built = built_tasks(tmp_path, "serial", REPORTED)
    image = built.link(C_FILES / "task_statuses.c", tmp_path / "statuses.elf")
    observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
    with (
        board(replace(built, target=target(BOARD)), image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        late = reported(observer, "control", 1)
        statuses = {task: reported(observer, task, 0) for task in STACKS}
        used = {task: touched(running, built, image, task) for task in STACKS}
        assert running.words("task_report")[0] == 0
    assert late["level"] == WARN
    assert late["message"] in ("overruns has changed", "missed has changed")
    assert late["hardware_id"] == "board-7"
    assert late["values"]["response_us"] >= LATE_US
    assert late["values"]["missed"] >= LATE_US // PERIOD_US - 1
    assert late["values"]["stack_peak"] >= USED
    for task, status in statuses.items():
        values = status["values"]
        assert values["stack_size"] == STACKS[task]
        assert 0 < values["stack_peak"] <= used[task] <= values["stack_peak"] + FRAME, task
        assert values["failed"] == 0
    assert statuses["worker"]["values"]["overruns"] == statuses["session"]["values"]["overruns"] == 0
