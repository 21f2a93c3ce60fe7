# SPDX-License-Identifier: Apache-2.0
"""Overruns, missed releases and stacks of each task, as rclpy receives them on /diagnostics."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+executor, +diagnosis]
pools: {guard_conditions: 2}
session: {connect_timeout: 20 s, create_timeout: 20 s}
diagnosis: {period: 200 ms}
nodes: [{name: device, executors: [{name: fast}, {name: slow}]}]
tasks:
  - {name: control, executor: fast, period: 20 ms, deadline: 19 ms}
  - {name: worker, executor: slow}
"""
TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"
WARN = 1
LATE_RUNS, LATE_US = 3, 50_000
"""How often, and for how long at least, the program lets its first task run too long."""
TASKS = ("control", "worker", "session")
SHOWN = ("overruns", "missed", "failed", "stack_size")
"""What the program prints of each task in the end."""


class Reports:
    """All statuses that have arrived, by name."""

    def __init__(self, observer: Observer) -> None:
        self._observer = observer
        self.seen: dict[str, list[dict[str, Any]]] = {}

    def look(self) -> None:
        for topic, array in self._observer.ask(do="samples"):
            for status in array["status"] if topic == TOPIC else ():
                self.seen.setdefault(status["name"], []).append(status)

    def wait(self, task: str, **least: int) -> dict[str, Any]:
        """Return the first status of a task with values of at least these; later ones may have arrived with it."""
        end = deadline(60)
        while True:
            self.look()
            found = self.seen.get(f"device: task {task}", [])
            for status in found:
                if all(values(status)[key] >= value for key, value in least.items()):
                    return status
            assert time.monotonic() < end, self.seen
            time.sleep(0.05)


def values(status: dict[str, Any]) -> dict[str, int]:
    return {pair["key"]: int(pair["value"]) for pair in status["values"]}


def test_overruns_of_each_task(
    images: Images, image_port: Relay, observer: Observer, agent: object, tmp_path: Path
) -> None:
    """A task that is late three times says so itself, the others have their own counters, and stacks are measured."""
    image = images.build(image_port.port, APPLICATION)
    program = image.application(
        C_FILES / "overruns.c", tmp_path / "overruns", "-std=gnu99", "-Wall", "-Werror", "-pthread"
    )
    observer.subscribe(TOPIC, TYPE)
    reports = Reports(observer)
    with started(program) as process:
        late = reports.wait("control", overruns=3, missed=3)
        reported = [values(reports.wait(task, stack_peak=1)) for task in TASKS]
        shown, errors = process.communicate("end\n", timeout=seconds(30))
    assert (process.returncode, errors) == (0, "")
    assert late["level"] == WARN
    assert late["message"] in ("overruns has changed", "missed has changed")
    assert values(late)["response_us"] >= LATE_US
    ended = [dict(zip(SHOWN, map(int, line.split()), strict=True)) for line in shown.splitlines()]
    assert len(ended) == len(reported) == len(TASKS)
    for last, end in zip(reported, ended, strict=True):
        assert all(last[key] <= end[key] for key in SHOWN)
        assert 0 < last["stack_peak"] <= last["stack_size"] == end["stack_size"]
    assert ended[0]["overruns"] >= LATE_RUNS
    assert all(end["overruns"] == end["missed"] == 0 for end in ended[1:])
