# SPDX-License-Identifier: Apache-2.0
"""Instructions and stacks of tasks on a Cortex-M4, as the emulator counts them, against what the tool says of them."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.support.firmware.board import C_FILES, Built, board, build, target
from tests.support.firmware.tasks import (
    APPLICATION,
    BOARD,
    HOLDS,
    INSTRUCTIONS,
    built_tasks,
    counted,
    holds_of,
    locks_of,
)
from tests.support.ids import without_id

FULL = 10
"""How much longer a message full of submessages may take than those that the agent of the firmware sends."""
ACKNACK, HEARTBEAT = 0x0A, 0x0B
CLOSE = 3
"""How far above the heaviest message its bound may be: a submessage takes another path than the longest one."""
JOBS, ROUNDS = 4, 3
"""Jobs of a task in each of its turns, and turns of each (c/measured_tasks.c): in the order of the application file."""


@pytest.fixture(scope="module")
def tasked(tmp_path_factory: pytest.TempPathFactory) -> Built:
    return built_tasks(tmp_path_factory.mktemp("tasked"))


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


def stacks_of(built: Built, image: Path, *options: str) -> subprocess.CompletedProcess[str]:
    call = [sys.executable, "-m", "microros_gen", "stacks", "out", "--image", str(image), *options]
    return subprocess.run(call, cwd=built.out.parent, text=True, capture_output=True, check=False)


def budgets_of(built: Built, image: Path) -> subprocess.CompletedProcess[str]:
    """Do what CMake does after each link of an image of a library that has something to compare with."""
    call = [sys.executable, "-m", "microros_gen", "size", "out", "--image", str(image), "--budgets"]
    return subprocess.run(call, cwd=built.out.parent, text=True, capture_output=True, check=False)


def rows_of(built: Built, image: Path) -> Mapping[str, Mapping[str, Any]]:
    return tasks_in(stacks_of(built, image, "--format", "json"))


def tasks_in(done: subprocess.CompletedProcess[str]) -> Mapping[str, Mapping[str, Any]]:
    return {row["task"]: row for row in json.loads(done.stdout)["tasks"]}


@pytest.mark.system
def test_two_passes_give_each_task_the_stack_that_it_needs(tasked: Built) -> None:
    home, sizes = tasked.out.parent, tasked.out.parent / "microros.stacks.yaml"
    first = tasked.link(C_FILES / "measured_tasks.c", home / "first.elf", "-DMEASURED_STACKS")
    written = stacks_of(tasked, first, "-o", str(sizes))
    assert (written.returncode, written.stderr) == (0, "")
    done = build(home, "tasked.yaml", APPLICATION.format(**INSTRUCTIONS, **HOLDS))
    assert (done.returncode, "MG-7146" in done.stderr) == (0, False), done.stderr
    second = tasked.link(C_FILES / "measured_tasks.c", home / "second.elf", "-DMEASURED_STACKS")
    rows = rows_of(tasked, second)
    assert {name: row["has"] for name, row in rows.items()} == yaml.safe_load(sizes.read_text())
    assert all(row["has"] == row["needs"] and row["open"] == [] for row in rows.values()), rows
    with board(replace(tasked, target=target(BOARD)), second) as running:
        running.go_on()
        running.wait_for(lambda: running.words("stack_report", len(rows) + 1)[-1])
        peaks = dict(zip(rows, running.words("stack_report", len(rows)), strict=True))
    for name, row in rows.items():
        assert row["chain"] // 4 < peaks[name] <= row["chain"] + row["context"] < row["has"], (peaks, rows)


@pytest.mark.system
@pytest.mark.parametrize("size", [pytest.param(1000, marks=pytest.mark.variant), 3000])
def test_a_large_variable_of_a_callback_is_in_the_stack_of_its_task(tasked: Built, size: int) -> None:
    home = tasked.out.parent
    (home / "microros.stacks.yaml").write_text("{control: 1600, worker: 1600, session: 1600}\n")
    assert build(home, "tasked.yaml", APPLICATION.format(**INSTRUCTIONS, **HOLDS)).returncode == 0
    plain = tasked.link(C_FILES / "measured_tasks.c", home / "plain.elf")
    large = tasked.link(C_FILES / "measured_tasks.c", home / "large.elf", f"-DLARGE_SIZE={size}")
    done = stacks_of(tasked, large, "--format", "json")
    before, after = rows_of(tasked, plain), tasks_in(done)
    assert size <= after["control"]["chain"] - before["control"]["chain"] <= size + 16
    assert after["worker"]["chain"] == before["worker"]["chain"]
    assert (done.returncode == 1) == (after["control"]["chain"] + 256 > 1600), done.stderr
    assert ("the task 'control' may need" in done.stderr) == (done.returncode == 1)
    linked = budgets_of(tasked, large)
    assert (linked.returncode, linked.stdout, linked.stderr) == (done.returncode, "", done.stderr)


@pytest.mark.system
def test_what_has_no_bound_is_named(tasked: Built) -> None:
    home = tasked.out.parent
    image = tasked.link(C_FILES / "measured_tasks.c", home / "recurses.elf", "-DRECURSES")
    sizes = home / "none.yaml"
    done = stacks_of(tasked, image, "-o", str(sizes))
    assert (done.returncode, sizes.exists()) == (1, False)
    assert without_id(done.stderr).splitlines()[0] == (
        "microros-gen: error: the stack of the task 'control' has no bound: recurse: recursion."
        " Write its size instead of auto: `stack: 4 KiB`"
    )


@pytest.mark.system
def test_no_task_holds_the_lock_for_more_instructions_than_the_analysis_used(tasked: Built) -> None:
    rate, rows = tasked.target.instructions_per_us, schedule_of(tasked)
    assert rate is not None
    longest = {}
    for name in INSTRUCTIONS:
        regions = counted(tasked, f"-DMEASURED_HOLDS=RCLC_TASK_{name.upper()}")
        longest[name] = max(regions[0::2])  # between two of them the task does not hold it
    for name, most in longest.items():
        assert 0.9 * HOLDS[f"{name}_lock"] < most <= HOLDS[f"{name}_lock"], longest
    chain = {blocker["task"]: blocker["time"] for row in rows.values() for blocker in row["blocked_by"]}
    assert {"worker", "session"} & set(chain)
    for name, time_us in chain.items():
        assert longest[name] <= time_us * rate


@pytest.mark.system
def test_no_hold_of_the_lock_is_longer_than_the_call_graph_says(tasked: Built) -> None:
    image = tasked.link(C_FILES / "measured_tasks.c", tasked.out.parent / "held.elf")
    rows = holds_of(tasked, image)
    assert all(row["open"] == [] for row in rows.values()), rows
    measured = {
        name: max(counted(tasked, f"-DMEASURED_HOLDS=RCLC_TASK_{name.upper()}")[0::2])
        for name in INSTRUCTIONS
    }
    for name, most in measured.items():
        assert most <= rows[name]["instructions"], (measured, rows)
    bounds = {
        (name, hold["function"]): hold["instructions"] for name, row in rows.items() for hold in row["holds"]
    }
    assert measured["control"] <= bounds["control", "rmw_publisher_write"] <= 3 * measured["control"]
    receiving = "xrce_session_spin"
    assert bounds["worker", receiving] < 100 < bounds["session", receiving], (
        "tasks of the application neither receive nor send"
    )
    assert rows["session"]["instructions"] < FULL * measured["session"], (
        "one message, not all that have arrived"
    )


@pytest.mark.system
def test_a_message_full_of_submessages_is_below_the_bound_and_close_to_it(tasked: Built) -> None:
    """ACKNACKs that ask for all messages of the stream once more; HEARTBEATs, each of which is answered."""
    longest = []
    for kind in (ACKNACK, HEARTBEAT):
        full = f"-DMEASURED_FULL={kind}"
        image = tasked.link(C_FILES / "measured_tasks.c", tasked.out.parent / "full.elf", full)
        bound = holds_of(tasked, image)["session"]["instructions"]
        longest.append(max(counted(tasked, full, "-DMEASURED_HOLDS=RCLC_TASK_SESSION")[0::2]))
        assert 1.5 * HOLDS["session_lock"] < longest[-1] <= bound, (longest, bound)
    assert bound < CLOSE * max(longest), (longest, bound)


@pytest.mark.system
def test_two_passes_give_the_analysis_the_holds_of_the_image(tasked: Built) -> None:
    home, numbers = tasked.out.parent, tasked.out.parent / "microros.locks.yaml"
    text = APPLICATION.format(**INSTRUCTIONS, **HOLDS)
    text = text.replace(f"lock_instructions: {HOLDS['worker_lock']}}}", "lock: auto}")
    text = text.replace(f"instructions: {INSTRUCTIONS['worker']}", "instructions: 9000")
    first = build(home, "tasked.yaml", text)
    assert (first.returncode, "MG-7150" in first.stderr) == (0, True), first.stderr
    image = tasked.link(C_FILES / "measured_tasks.c", home / "first_locks.elf")
    assert (locks_of(tasked, home / "none.elf").returncode, numbers.exists()) == (2, False)
    written = locks_of(tasked, image, "-o", str(numbers))
    assert (written.returncode, written.stderr) == (0, "")
    assert yaml.safe_load(numbers.read_text()) == {
        "worker": holds_of(tasked, image)["worker"]["instructions"]
    }
    second = build(home, "tasked.yaml", text)
    assert (second.returncode, "MG-7150" in second.stderr) == (0, False), second.stderr
    blockers = [blocker for row in schedule_of(tasked).values() for blocker in row["blocked_by"]]
    assert {blocker["task"]: blocker["from"] for blocker in blockers}["worker"] == "call graph"
    assert budgets_of(tasked, image).returncode == 0
    numbers.write_text("worker: 100\n")
    assert build(home, "tasked.yaml", text).returncode == 0
    longer = budgets_of(tasked, tasked.link(C_FILES / "measured_tasks.c", home / "third_locks.elf"))
    assert (longer.returncode, "the analysis of deadlines used 100" in longer.stderr) == (1, True), longer
    numbers.unlink()


@pytest.mark.system
def test_what_bounds_no_hold_is_named(tasked: Built) -> None:
    manifest = tasked.out / "manifest.json"
    written = manifest.read_text()
    image = tasked.link(C_FILES / "measured_tasks.c", tasked.out.parent / "named.elf")
    command = [sys.executable, "-m", "microros_gen", "locks", "out"]
    alone = subprocess.run(command, cwd=tasked.out.parent, text=True, capture_output=True, check=False)
    assert (alone.returncode, "only a linked one has every path" in alone.stderr) == (1, True)
    data = json.loads(written)
    tasks = data["features"]["tasks"]["values"]["tasks"]
    tasks[2]["lock_auto"] = True
    manifest.write_text(json.dumps(data))
    try:
        open_ends = locks_of(tasked, image)
        tasks.clear()
        manifest.write_text(json.dumps(data))
        none = locks_of(tasked, image)
    finally:
        manifest.write_text(written)
    assert (open_ends.returncode, none.returncode) == (1, 2)
    assert "how long the task 'session' holds the lock has no bound: " in open_ends.stderr
    assert "out has no tasks" in none.stderr
