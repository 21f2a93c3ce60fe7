# SPDX-License-Identifier: Apache-2.0
"""Tasks that have nothing to do sleep: the system counts how often they wake."""

from __future__ import annotations

import socket
import subprocess
import threading
from pathlib import Path

from tests.support.components.rendered import program_of, rendered
from tests.support.patience import seconds
from tests.support.runtime.reading_agent import ReadingAgent

QUIET = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
session: {{key: 7}}
liveliness: none
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
    executors: [{{name: a, handles: [target]}}, {{name: b}}, {{name: c}}]
tasks: [{{name: reader, executor: a}}, {{name: idle, executor: b}}, {{name: other, executor: c}}]
"""
QUIET_MS = 3500
TIMER = 1
"""The main thread sleeps once."""


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams, and offer a sample for each message of the device, until the socket is closed."""
    offered = 0
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        if offered < len(agent.values(0)):
            answers += agent.numbers(1, offered)
            offered += 1
        for answer in answers:
            served.sendto(answer, peer)


def test_tasks_without_work_do_not_wake(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(ReadingAgent(), served), daemon=True).start()
        out = rendered(tmp_path, QUIET.format(port=served.getsockname()[1]))
        program = program_of(out, "task_quiet.c", more=("-pthread",))
        command = [program, str(QUIET_MS)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert int(done.stdout) <= TIMER
