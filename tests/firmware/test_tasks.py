# SPDX-License-Identifier: Apache-2.0
"""Instructions of the jobs of tasks on a Cortex-M4, counted in the emulator, against what the analysis used."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from tests.support.firmware.board import C_FILES, Built, build, need
from tests.support.firmware.footprint import AGENT_FUNCTIONS, EXIT, INTERRUPTS
from tests.support.firmware.instructions import trace_regions

BOARD = "qemu-mps2-an386"
TARGET = f"""\
target: tasked
summary: The tasks run one after the other, in the program
extends: {BOARD}
provides: [tasks, lock, wait, wake, udp]
"""
INSTRUCTIONS = {"control": 1000, "worker": 760, "session": 660}
"""Bounds of the jobs, as a user would write them: measured here, and rounded up."""
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {{type: udp}}
session: {{key: 1, connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32, local: also}}]
    subscriptions: [{{topic: count, type: std_msgs/msg/Int32, local: only, queue: 8, qos: {{depth: 8}}}}]
    executors: [{{name: fast}}, {{name: slow, handles: [count]}}]
tasks:
  - {{name: control, executor: fast, rate: 100 Hz, instructions: {control}}}
  - {{name: worker, executor: slow, interval: 10 ms, instructions: {worker}}}
  - {{name: session, session: true, interval: 10 ms, instructions: {session}}}
"""
JOBS, ROUNDS = 4, 3
"""Jobs of a task in each of its turns, and turns of each (c/measured_tasks.c): in the order of the application file."""


@pytest.fixture(scope="module")
def tasked(tmp_path_factory: pytest.TempPathFactory) -> Built:
    need(BOARD, emulator=True)
    home = tmp_path_factory.mktemp("tasked")
    (home / "tasked.yaml").write_text(TARGET)
    done = build(home, "tasked.yaml", APPLICATION.format(**INSTRUCTIONS))
    assert done.returncode == 0, done.stderr
    found = read_target("tasked.yaml", home, None, Diagnostics())
    assert found is not None
    return Built(home / "out", found.target)


def counted(built: Built, *flags: str) -> Sequence[int]:
    image = built.link(C_FILES / "measured_tasks.c", built.out.parent / "tasks.elf", *flags)
    emulator = built.target.emulator
    assert emulator is not None
    command = [emulator.program, *emulator.arguments, *EXIT]
    return [region.counted for region in trace_regions(command, image, (*AGENT_FUNCTIONS, *INTERRUPTS))]


def schedule_of(built: Built) -> Mapping[str, Mapping[str, Any]]:
    features = json.loads((built.out / "manifest.json").read_text())["features"]
    return {row["task"]: row for row in features["tasks"]["values"]["schedule"]}


@pytest.mark.system
def test_no_job_has_more_instructions_than_the_analysis_used(tasked: Built) -> None:
    jobs = counted(tasked)[0::2]  # between two of them the task rests
    assert len(jobs) == ROUNDS * JOBS * len(INSTRUCTIONS)
    of_round = [
        jobs[at : at + JOBS * len(INSTRUCTIONS)] for at in range(0, len(jobs), JOBS * len(INSTRUCTIONS))
    ]
    longest = {
        name: max(max(each[at * JOBS : (at + 1) * JOBS]) for each in of_round)
        for at, name in enumerate(INSTRUCTIONS)
    }
    rows, rate = schedule_of(tasked), tasked.target.instructions_per_us
    assert rate is not None
    for name, most in longest.items():
        assert 0.9 * INSTRUCTIONS[name] < most <= INSTRUCTIONS[name], longest
        assert (rows[name]["c_from"], rows[name]["c"] - 1 < INSTRUCTIONS[name] / rate <= rows[name]["c"]) == (
            "instructions",
            True,
        )
