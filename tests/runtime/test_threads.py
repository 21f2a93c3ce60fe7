# SPDX-License-Identifier: Apache-2.0
"""Several tasks in one client, watched by ThreadSanitizer; and what the option leaves where it is not selected."""

from __future__ import annotations

import shutil
import socket
import subprocess
import threading
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime_entities import QueuePlan
from tests.support.patience import seconds
from tests.support.plans import EXECUTOR, changed
from tests.support.runtime.harness import SANITIZER, Tree, build, components, render
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.slices import first

TASKS, PUBLISHERS, VALUES, TASK_VALUES, RECEIVED = 4, 3, 150, 100_000, 300
PLAN = changed(
    EXECUTOR,
    session__multithread=True,
    entities__subscriptions__max=1,
    input__queues=(QueuePlan(8, 16),),
    input__reliable_slots=4,
    timers__max=0,
    executor__guard_conditions_max=1,
    streams__on_full="block",
    streams__on_full_block_ms=20_000,
    times__create_timeout_ms=20_000,
    times__connect_timeout_ms=20_000,
    times__liveliness_period_ms=5000,
)
THREAD_SANITIZER = ("-g0", "-O0", "-fsanitize=thread")


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams until the socket is closed; offer the samples when the reader is there."""
    offered = False
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        if agent.reads and not offered:
            offered = True
            answers += agent.numbers(PLAN.entities.publisher_places, *range(RECEIVED))
        for answer in [*answers, *(agent.tick() if agent.unacknowledged else [])]:
            served.sendto(answer, peer)


@pytest.mark.parametrize("system", ["any", "none", "late"])
def test_a_system_without_priority_inheritance_has_a_lock(tmp_path: Path, system: str) -> None:
    tree = render(tmp_path, PLAN, components(PLAN))
    source = next(s for s in tree.sources if s.name == "port_posix_lock.c")
    shutil.copy(source, tree.include / "lock_source.c")
    program = build(Tree(tree.folder, ()), ["lock_kinds.c"], "kinds")
    done = subprocess.run([program, system], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stdout) == (0, "40000\n")


@pytest.mark.parametrize("queue", first([QueuePlan(8, 16, 24), QueuePlan(8, 16)]), ids=["bytes", "slots"])
def test_nothing_is_lost_and_nothing_races(tmp_path: Path, queue: QueuePlan) -> None:
    agent = ReadingAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        thread = threading.Thread(target=serve, args=(agent, served), daemon=True)
        thread.start()
        plan = changed(PLAN, transport__agent_port=served.getsockname()[1], input__queues=(queue,))
        tree = render(tmp_path, plan, components(plan))
        program = build(tree, ["types_read.c", "threads.c"], "threads", SANITIZER, THREAD_SANITIZER)
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(120), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    for task in range(TASKS):
        values = agent.values(task if task < PUBLISHERS else 0)
        of_task = [value - task * TASK_VALUES for value in values if value // TASK_VALUES == task]
        assert of_task == list(range(VALUES))


def test_two_tasks_that_search_for_agents_do_not_share_answers(tmp_path: Path) -> None:
    plan = changed(EXECUTOR, session__multithread=True, transport__kind="custom", transport__framing="on")
    tree = render(tmp_path, plan, components(plan))
    program = build(tree, ["unit_inquiry.c"], "unit", SANITIZER, THREAD_SANITIZER)
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_what_is_ready_for_several_tasks_wakes_each_of_them(tmp_path: Path) -> None:
    """On a system whose wake-up ends one wait, such as that with a semaphore in docs/howto/port.md."""
    agent = ReadingAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(agent, served), daemon=True).start()
        port = served.getsockname()[1]
        plan = changed(PLAN, transport__agent_port=port, executor__guard_conditions_max=3)
        plan = changed(plan, executor__wait_sets_max=3)
        tree = render(tmp_path, plan, components(plan))
        alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name != "port_posix_wait.c"))
        program = build(
            alone,
            ["port_one_wake.c", "types_read.c", "waking_threads.c"],
            "waking",
            SANITIZER,
            THREAD_SANITIZER,
        )
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(120), check=False)
    assert (done.returncode, done.stderr) == (0, "")
