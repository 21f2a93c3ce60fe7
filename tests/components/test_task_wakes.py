# SPDX-License-Identifier: Apache-2.0
"""Tasks that have nothing to do sleep: the system counts how often they wake."""

from __future__ import annotations

import socket
import subprocess
import threading
from pathlib import Path

from tests.support.components.rendered import program_of, rendered, run
from tests.support.patience import seconds
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.runtime.tcp import TcpAgent

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
FULL = """\
version: 1
profiles: [pure_sender]
components: [+executor]
session: {{key: 7}}
liveliness: none
pools: {{best_effort_history: 64}}
transport: {{type: tcp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    publishers:
      - {{topic: kept, type: std_msgs/msg/Int32}}
      - {{topic: fast, type: std_msgs/msg/Int32, qos: {{reliability: best_effort}}}}
    executors: [{{name: a}}]
tasks: [{{name: idle, executor: a}}]
"""
SHARED = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +multithread]
session: {{key: 7}}
liveliness: acknack
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
"""
WRITE_DATA = 7
QUIET_MS = 3500
FULL_MS = 1500
READ = 100
"""Messages that the agent reads before it stops."""
TIMER = 1
"""The main thread sleeps once."""
SOME_ROOM = 20
"""The system may find some room in its buffers still; a task that tries each millisecond sleeps 1500 times."""


def serve(agent: ReadingAgent, served: socket.socket, lost: int = 0) -> None:
    """Answer datagrams, and offer a sample for each message of the device, until the socket is closed.

    The first `lost` datagrams with a message of the device do not arrive.
    """
    offered = 0
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        if lost and datagram[4] == WRITE_DATA:
            lost -= 1
            continue
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
        command = [str(program), str(QUIET_MS)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert int(done.stdout) <= TIMER


def test_a_thread_that_shares_the_library_sleeps_until_there_is_something_to_do(tmp_path: Path) -> None:
    """Another thread publishes once: the one that sleeps repeats the message, which was lost."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(ReadingAgent(), served, 1), daemon=True).start()
        out = rendered(tmp_path, SHARED.format(port=served.getsockname()[1]))
        program = program_of(out, "shared_quiet.c", more=("-pthread",))
        command = [str(program), str(QUIET_MS)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(90), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert int(done.stdout) <= TIMER


def test_a_line_without_room_wakes_its_task_when_it_has_some(tmp_path: Path) -> None:
    """Without that, the task tries once each millisecond."""
    agent, reads_on = TcpAgent(), threading.Event()

    def before(count: int) -> bool:
        return count < READ or reads_on.wait(seconds(60))

    agent.before = before
    agent.start()
    program = program_of(rendered(tmp_path, FULL.format(port=agent.port)), "task_full.c", more=("-pthread",))
    with subprocess.Popen([program, str(FULL_MS)], stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        sleeps = int(running.stdout.readline())
        reads_on.set()
        assert running.wait(seconds(60)) == 0
    assert sleeps <= SOME_ROOM


def test_a_submessage_that_is_too_short_for_any_counts_as_malformed(tmp_path: Path) -> None:
    """Otherwise a message would hold more of them than the bound of the session's hold of the lock supposes."""
    out = rendered(tmp_path, FULL.format(port=8888))
    run(program_of(out, "unit_short.c", more=("-pthread",)))
