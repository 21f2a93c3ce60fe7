# SPDX-License-Identifier: Apache-2.0
"""Tasks that have nothing to do sleep: the system counts how often they wake."""

from __future__ import annotations

import socket
import subprocess
import threading
from pathlib import Path

import pytest

from tests.support.components.rendered import program_of, rendered, run
from tests.support.patience import seconds
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.runtime.tcp import TcpAgent
from tests.support.slices import first

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
LOGS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +multithread]
session: {{key: 7}}
liveliness: none
logging: [{{to: console, level: warn}}, {{to: rosout, level: warn}}, {{to: ring, level: warn, size: 2048}}]
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
"""
CONSOLE = LOGS.replace(", {{to: rosout, level: warn}}, {{to: ring, level: warn, size: 2048}}", "")
WITH_TASK = """\
    executors: [{{name: a, handles: [target]}}]
tasks: [{{name: reader, executor: a}}]
"""
WRITERS, ROUNDS = 4, 300
WRITE_DATA = 7
READER = 1
QUIET_MS = 3500
FULL_MS = 1500
AGAIN_MS, SOME_TRIES = 1000, 4
"""By the log call itself and by the wake-up of its line."""
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


def serve_lines(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams, and offer a sample whenever each writer's line of a round has arrived."""
    offered = 0
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        while offered < len(agent.written) // WRITERS:
            answers += agent.numbers(READER, offered)
            offered += 1
        for answer in answers:
            served.sendto(answer, peer)


def lines_of(tmp_path: Path, text: str, more: tuple[str, ...] = ()) -> tuple[int, str, ReadingAgent]:
    """Return how often a node with log writers wakes while it is quiet, its console, and the agent."""
    agent = ReadingAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve_lines, args=(agent, served), daemon=True).start()
        out = rendered(tmp_path, text.format(port=served.getsockname()[1]))
        program = program_of(out, "log_wakes.c", more=("-pthread", *more))
        command = [str(program), str(QUIET_MS), str(ROUNDS)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(120), check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return int(done.stdout), done.stderr, agent


@pytest.mark.parametrize(
    ("text", "more"),
    [
        pytest.param(LOGS, (), id="plain-threads"),
        pytest.param(LOGS + WITH_TASK, (), id="plain-tasks", marks=pytest.mark.variant),
        pytest.param(LOGS, ("-fsanitize=thread",), id="tsan-threads", marks=pytest.mark.variant),
        pytest.param(LOGS + WITH_TASK, ("-fsanitize=thread",), id="tsan-tasks"),
    ],
)
def test_a_node_that_logs_sleeps_until_a_line_is_to_be_sent(
    tmp_path: Path, text: str, more: tuple[str, ...]
) -> None:
    """Each line of another thread is sent at once: no wake-up is lost, as the wait would not end by itself."""
    wakes, console, agent = lines_of(tmp_path, text, more)
    assert more or wakes <= TIMER, "the sanitizer has its own thread"
    assert "data race" not in console
    bodies = b"".join(body for _, body in agent.written)
    for writer in range(WRITERS):
        for number in range(ROUNDS):
            assert b"writer %d round %d\0" % (writer, number) in bodies


@pytest.mark.parametrize("text", first([CONSOLE + WITH_TASK, CONSOLE]), ids=["tasks", "threads"])
def test_a_console_that_is_full_is_tried_each_second_until_it_takes_the_report(
    tmp_path: Path, text: str
) -> None:
    """While it takes nothing, the node wakes each second; after the report, it sleeps."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve_lines, args=(ReadingAgent(), served), daemon=True).start()
        out = rendered(tmp_path, text.format(port=served.getsockname()[1]))
        program = program_of(out, "console_wakes.c", ("port_posix_console.c",), ("-pthread",))
        done = subprocess.run(
            [program, str(QUIET_MS)], capture_output=True, text=True, timeout=seconds(60), check=False
        )
    assert (done.returncode, done.stderr) == (0, "")
    tries, reports, wakes = (int(word) for word in done.stdout.split())
    assert QUIET_MS // AGAIN_MS <= tries <= QUIET_MS // AGAIN_MS + SOME_TRIES
    assert (reports, wakes <= TIMER) == (1, True)


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
