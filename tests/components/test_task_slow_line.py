# SPDX-License-Identifier: Apache-2.0
"""A line that is slower than what is published: a task keeps its period; nobody holds the lock while it is written."""

from __future__ import annotations

import socket
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path

from microros_gen.components.tasks.plan import TasksPlan
from tests.support.components.rendered import planned, program_of, rendered
from tests.support.patience import seconds
from tests.support.runtime.reading_agent import ReadingAgent

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+executor]
session: {key: 7}
transport: {type: custom, framing: false, read_polls: true}
on_full: drop_oldest
nodes:
  - name: device
    publishers:
      - {topic: fast, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}
      - {topic: kept, type: std_msgs/msg/Int32}
    executors: [{name: a}]
"""
TASKS = """\
tasks:
  - {name: control, executor: a, rate: 1 kHz, time: 400 us, lock: 300 us}
  - {name: line, session: true, interval: 20 ms, time: 500 us, lock: 500 us}
"""
WRITE_MS = 20


@dataclass
class Seen:
    """What a program did while the line was full; `values` is what the agent received of each publisher."""

    runs: int
    missed: int
    writes: int
    most_in_a_write: int
    longest_us: int
    dropped: int
    jitter_us: int
    values: list[list[int]]


def ran(folder: Path, text: str, *flags: str) -> Seen:
    """Run a program against an agent."""
    folder.mkdir()
    agent = ReadingAgent()
    program = program_of(
        rendered(folder, text), "task_slow_line.c", without=("port_posix_lock.c",), more=("-pthread", *flags)
    )
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(agent, served), daemon=True).start()
        command = [str(program), str(served.getsockname()[1])]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(120), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    runs, missed, writes, most, longest_us, dropped, jitter_us = map(int, done.stdout.split())
    values = [agent.values(0), agent.values(1)]
    return Seen(runs, missed, writes, most, longest_us, dropped, jitter_us, values)


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams until the socket is closed."""
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        for answer in agent.receive(datagram):
            served.sendto(answer, peer)


def test_a_task_keeps_its_period_while_the_line_is_full(tmp_path: Path) -> None:
    """Without tasks each publish that sends waits for the line, so that this test can fail."""
    part = planned(tmp_path, APPLICATION + TASKS).project.runtime.features.of("tasks")
    assert isinstance(part, TasksPlan)
    (longest,) = {task.lock_us for task in part.tasks if task.name == "line"}
    plain = ran(tmp_path / "plain", APPLICATION, "-DPLAIN=1")
    tasks = ran(tmp_path / "tasks", APPLICATION + TASKS)
    assert plain.most_in_a_write == 0
    assert tasks.most_in_a_write > WRITE_MS // 4
    assert tasks.runs > 3 * plain.runs
    assert tasks.missed / tasks.runs < plain.missed / plain.runs / 3
    assert tasks.jitter_us < plain.jitter_us / 3, "half of the releases are as near to their millisecond"
    assert tasks.longest_us <= longest
    fast, kept = tasks.values
    assert fast == sorted(set(fast))
    assert kept == sorted(set(kept))
    assert len(fast) > tasks.writes // 4
    assert kept == list(range(0, 64 * len(kept), 64)), (
        "all of the reliable ones, beside a queue that is always full"
    )
    assert len(kept) > tasks.runs // 64 // 2
    assert tasks.dropped > tasks.runs // 2, "what was not sent was counted"
    assert tasks.dropped + len(fast) + len(kept) >= tasks.runs
