# SPDX-License-Identifier: Apache-2.0
"""Work at 1 kHz beside a saturated link: as a task it keeps its period, where the loop of one executor does not."""

from __future__ import annotations

import socket
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.bench.tasks import APPLICATIONS, COMMON
from tests.support.components.rendered import program_of, rendered
from tests.support.paths import TESTS
from tests.support.patience import seconds
from tests.support.runtime.fake_agent import FakeAgent

SOURCE = TESTS / "bench" / "tasks.c"
TRANSPORT = 'transport: {{type: udp, agent: "127.0.0.1:{port}"}}\n'
SAMPLES, ROUNDS = 200, 5
LINK_S = 0.004
"""Time of the link for a message. The stream is full meanwhile, and who publishes waits."""
USUALLY, SELDOM = 10, 3
"""How many times less the deviation of the task is: half of its runs, and 99 in 100."""


@dataclass
class Deviations:
    """By how many microseconds the time between two runs differed from the period."""

    median_us: int
    most_us: int
    has_priorities: bool


def serve(served: socket.socket) -> None:
    """Answer each datagram after the time of the link, until the socket is closed."""
    agent = FakeAgent()
    with suppress(OSError):
        while True:
            datagram, peer = served.recvfrom(2048)
            time.sleep(LINK_S)
            for answer in agent.receive(datagram):
                served.sendto(answer, peer)


@contextmanager
def linked(folder: Path, name: str) -> Iterator[Path]:
    """Build one of the programs, and run its agent."""
    folder.mkdir()
    flags = ("-pthread", f"-DSAMPLES={SAMPLES}", *(["-DBENCH_TASKS"] if name == "tasks" else []))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(served,), daemon=True).start()
        text = COMMON + APPLICATIONS[name] + TRANSPORT.format(port=served.getsockname()[1])
        yield program_of(rendered(folder, text), str(SOURCE), more=flags)


def ran(program: Path) -> Deviations:
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    median_us, most_us, _, published, has_priorities = map(int, done.stdout.split())
    assert published > 0
    return Deviations(median_us, most_us, has_priorities != 0)


def test_a_task_keeps_its_period_with_a_saturated_link(tmp_path: Path) -> None:
    """A round of a few in which the machine lets the task run is enough; the executor has the best of as many."""
    plain: list[Deviations] = []
    tasks: list[Deviations] = []
    with (
        linked(tmp_path / "executor", "executor") as executor,
        linked(tmp_path / "tasks", "tasks") as prioritized,
    ):
        for _ in range(ROUNDS):
            tasks.append(ran(prioritized))
            if not tasks[-1].has_priorities:
                pytest.skip("skipped: the process may not use SCHED_FIFO (ulimit -r, or CAP_SYS_NICE)")
            plain.append(ran(executor))
            usually = USUALLY * min(d.median_us for d in tasks) < min(d.median_us for d in plain)
            seldom = SELDOM * min(d.most_us for d in tasks) < min(d.most_us for d in plain)
            if usually and seldom:
                return
    pytest.fail(f"tasks {tasks}, executor {plain}")
