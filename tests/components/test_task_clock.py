# SPDX-License-Identifier: Apache-2.0
"""Clocks and timers that several tasks read and set, with ROS time from /clock, watched by ThreadSanitizer."""

from __future__ import annotations

import socket
import struct
import subprocess
import threading
from pathlib import Path
from select import select

import pytest

from tests.support.components.rendered import program_of, rendered
from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZER
from tests.support.runtime.reading_agent import ReadingAgent

APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+executor, +timers]
session: {{key: 7}}
clock: ros
pools: {{ros_clocks: 2, jump_callbacks: 1, timers: 3}}
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    timers: [{{name: beat, period: 1 ms}}, {{name: pulse, period: 1 ms}}]
    executors: [{{name: a, handles: [beat]}}, {{name: b, handles: [pulse]}}]
tasks: [{{name: first, executor: a}}, {{name: second, executor: b}}]
"""
FLAGS = ("-g", "-O0", "-fsanitize=thread", "-pthread")


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams until the socket is closed; advance /clock by a millisecond in each one."""
    peer: tuple[str, int] = ("", 0)
    now_ms = 1000
    while True:
        answers: list[bytes] = []
        try:
            if select([served], [], [], 0.001)[0]:
                datagram, peer = served.recvfrom(2048)
                answers = agent.receive(datagram)
            elif agent.reads:
                now_ms += 1
                answers = agent.offer(0, struct.pack("<iI", now_ms // 1000, now_ms % 1000 * 1_000_000))
            for answer in answers:
                served.sendto(answer, peer)
        except (OSError, ValueError):  # it is closed
            return


@pytest.mark.system
def test_tasks_share_clocks_and_timers(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(ReadingAgent(), served), daemon=True).start()
        out = rendered(tmp_path, APPLICATION.format(port=served.getsockname()[1]))
        program = program_of(out, "task_clock.c", by=(SANITIZER, FLAGS))
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(120), check=False)
    assert (done.returncode, done.stderr) == (0, "")
