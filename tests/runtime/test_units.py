# SPDX-License-Identifier: Apache-2.0
"""Unit tests written in C, compiled with sanitizers."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.selection.find_components import components_folder, parts_folder
from tests.support.patience import seconds
from tests.support.plans import POOL, READER, changed
from tests.support.runtime.harness import SANITIZE, SANITIZER, Tree, build, compilers, components, render

DROP_OLDEST = changed(POOL, streams__on_full="drop_oldest")
SERVES = changed(
    DROP_OLDEST,
    streams__mtu=256,
    streams__best_effort_size=256,
    entities__services__max=1,
    input__queues=(QueuePlan(2, 40),),
)
ARENA = changed(POOL, memory__arena_size=1024)


@pytest.mark.parametrize(
    ("unit", "plan", "flags"),
    [
        ("unit_stream.c", POOL, SANITIZE),
        ("unit_stream_replaced.c", DROP_OLDEST, SANITIZE),
        ("unit_drop_reserved.c", SERVES, SANITIZE),
        ("unit_memory.c", changed(POOL, memory__arena_size=512), SANITIZE),
        ("unit_strings.c", ARENA, SANITIZE),
        pytest.param("unit_strings.c", POOL, ("-O2",), marks=pytest.mark.variant),
        pytest.param(
            *("unit_memory.c", changed(POOL, memory__arena_size=512), ("-m32", "-Os")),
            marks=pytest.mark.variant,
        ),
    ],
    ids=["stream", "stream-replaced", "drop-reserved", "memory", "strings", "strings-no-arena", "memory-m32"],
)
def test_unit(unit: str, plan: RuntimePlan, flags: tuple[str, ...], tmp_path: Path) -> None:
    names = [name for name in components(plan) if name != "port_posix"]
    tree = render(tmp_path, plan, names)
    program = build(tree, ["port_fake.c", unit], "unit", SANITIZER, flags)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


def saturated(slots: int, loss: int, latency_ms: int, folder: Path) -> tuple[int, int, int, int]:
    """Return what a saturated line can carry, what arrived meanwhile and in the end, and what was dropped."""
    plan = changed(DROP_OLDEST, streams__reliable_slots=slots)
    tree = render(folder, plan, components(plan))
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.parent.name == "stream_reliable"))
    program = build(alone, ["unit_stream_saturated.c"], "unit", SANITIZER, SANITIZE)
    command = [str(program), str(loss), str(latency_ms), "3"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr
    carries, _, meanwhile, delivered, dropped = map(int, done.stdout.split())
    return carries, meanwhile, delivered, dropped


@pytest.mark.parametrize(
    ("slots", "loss", "latency_ms"), [(2, 0, 0), (4, 0, 10), (4, 5, 0), (4, 5, 5), (8, 10, 5), (16, 20, 5)]
)
def test_a_line_that_is_always_full(slots: int, loss: int, latency_ms: int, tmp_path: Path) -> None:
    """It carries a tenth of what is published: the agent gets as much, in order, and the rest was dropped, unsent."""
    carries, meanwhile, delivered, dropped = saturated(slots, loss, latency_ms, tmp_path)
    assert meanwhile >= 0.9 * carries * (100 - loss) / 100
    assert delivered + dropped == 10 * carries


@pytest.mark.parametrize("loss", [0, 10])
def test_a_line_that_is_always_full_and_one_slot(loss: int, tmp_path: Path) -> None:
    """Only what is on its way can be dropped: a HEARTBEAT follows at once, and the agent goes on."""
    carries, meanwhile, delivered, dropped = saturated(1, loss, 0, tmp_path)
    assert meanwhile >= 0.4 * carries
    assert delivered + dropped >= 10 * carries


FRAGMENTS = changed(
    POOL,
    streams__mtu=32,
    streams__fragments=True,
    streams__reliable_slots=3,
    streams__reliable_slot_size=200,
)
STORED = {
    "ring": POOL,
    "one": changed(POOL, streams__reliable_slots=1),
    "replaced": DROP_OLDEST,
    "fragments": FRAGMENTS,
    "fragments-dropped": changed(FRAGMENTS, streams__on_full="drop_oldest"),
}


@pytest.mark.parametrize("stored", STORED)
def test_waiting_for_what_a_stream_has_stored(stored: str, tmp_path: Path) -> None:
    """Others write, the numbers wrap, sessions are lost: the wait ends neither early nor never."""
    tree = render(tmp_path, STORED[stored], components(STORED[stored]))
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.parent.name == "stream_reliable"))
    program = build(alone, ["unit_mark.c"], "unit", SANITIZER, SANITIZE)
    for seed in range(1, 4):
        command = [str(program), str(seed)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
        assert done.returncode == 0, done.stderr


def test_waiting_for_what_a_queue_holds(tmp_path: Path) -> None:
    plan = changed(POOL, streams__best_effort_slots=3, streams__best_effort_places=4)
    tree = render(tmp_path, plan, components(plan))
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.parent.name == "stream_best_effort"))
    program = build(alone, ["unit_mark_queue.c"], "unit", SANITIZER, SANITIZE)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


def test_a_sample_in_the_input_buffer_and_a_message_in_parts(tmp_path: Path) -> None:
    """With a task for the session a part of a message ends a receive call; it is no message that was discarded."""
    plan = changed(
        READER,
        transport__kind="tcp",
        input__size=440,
        input__queues=(QueuePlan(1, 400), QueuePlan(3, 16)),
        input__reader=0,
        input__free=64,
    )
    tree = render(tmp_path, plan, [name for name in components(plan) if name != "port_posix"])
    header = Path("microros") / "xrce_turn_bytes.h"
    (tree.include / header).unlink()
    shutil.copy(components_folder() / "tasks" / "include" / header, tree.include / header)
    program = build(tree, ["port_fake.c", "unit_input_parts.c"], "unit", SANITIZER, SANITIZE)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


BOARD = """\
#pragma once
#define PORT_BOARD_RING_SIZE 64u
#define PORT_BOARD_OUTPUT_SIZE 61u
#define PORT_BOARD_UART_BAUD 115200u
#define PORT_BOARD_KEEPS_OUTPUT true
"""


def test_messages_that_the_line_does_not_copy(tmp_path: Path) -> None:
    """The stream, the framing and a board's line, without the board."""
    plan = changed(
        POOL,
        transport__kind="serial",
        transport__keeps_output=True,
        streams__reliable_slots=1,
        streams__reliable_slot_size=300,
    )
    tree = render(tmp_path, plan, [name for name in components(plan) if name != "port_posix"])
    bare = parts_folder() / "os" / "bare"
    shutil.copytree(bare / "include", tree.include, dirs_exist_ok=True)
    shutil.copy(bare / "src" / "port_bare_wait.c", tree.include)
    shutil.copy(bare / "src" / "port_bare_serial.c", tree.include)
    (tree.include / "microros" / "port_board.h").write_text(BOARD)
    program = build(tree, ["port_fake.c", "unit_kept.c"], "unit", SANITIZER, SANITIZE)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("slots", "compiler", "flags"),
    [
        (1, "gcc", SANITIZE),
        (2, "clang", SANITIZE),
        pytest.param(4, "gcc", SANITIZE, marks=pytest.mark.variant),
        (16, "gcc", ("-m32", "-Os")),
        pytest.param(1, "clang", ("-m32", "-O1"), marks=pytest.mark.variant),
    ],
)
def test_reliable_input(slots: int, compiler: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    """The stream alone: what it hands on and what it answers goes to the unit."""
    if compiler not in compilers():
        pytest.skip(f"no {compiler}")
    plan = changed(POOL, input__reliable_slots=slots, input__reliable_slot_size=64)
    tree = render(tmp_path, plan, components(plan))
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.parent.name == "stream_reliable_input"))
    program = build(alone, ["unit_input.c"], "unit", compiler, flags)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert done.returncode == 0, done.stderr
