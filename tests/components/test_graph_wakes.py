# SPDX-License-Identifier: Apache-2.0
"""A node with an event of the graph sleeps while nothing changes, and hears of each change at once."""

from __future__ import annotations

import socket
import subprocess
import threading
import time
from pathlib import Path

import pytest

from tests.support.components.rendered import program_of, rendered
from tests.support.patience import seconds
from tests.support.runtime.graph_agent import GraphAgent, MadeGraph, endpoint
from tests.support.slices import first

THREADS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +multithread, +graph_events]
session: {{key: 7}}
liveliness: none
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
"""
TASKS = (
    THREADS
    + """\
    executors: [{{name: a, handles: [target]}}]
tasks: [{{name: reader, executor: a}}]
"""
)
QOS = {"reliability": 1, "durability": 2, "deadline": 9223372036854775807}
READER, FIRST_CLIENT = 1, 3
"""The subscription of changes is opened with the node, before that of the application."""
QUIET_MS, ROUNDS = 3500, 40
TIMER = 1
"""The main thread sleeps once."""
POLL_S = 1.0
"""A thread that is not woken looks after this time."""


class ServedGraph:
    """The agent on a socket, and changes of its graph from another thread."""

    def __init__(self, served: socket.socket) -> None:
        graph = MadeGraph(
            publishing={"/count": (endpoint("/device", 9, **QOS),)},
            subscribing={"/count": (endpoint("/other", 1, **QOS),)},
        )
        self.agent = GraphAgent(mtu=256, graph=graph, reader=READER, first_client=FIRST_CLIENT)
        self.served, self.lock, self.number = served, threading.Lock(), 1
        self.peer: tuple[str, int] | None = None

    def serve(self) -> None:
        while True:
            try:
                datagram, self.peer = self.served.recvfrom(2048)
            except OSError:
                return
            with self.lock:
                self._send(self.agent.receive(datagram))

    def change(self) -> None:
        """Let the subscription of the topic be another one, and send a notice."""
        with self.lock:
            self.number += 1
            self.agent.graph.subscribing["/count"] = (endpoint("/other", self.number, **QOS),)
            self._send(self.agent.notice())

    def _send(self, datagrams: list[bytes]) -> None:
        assert self.peer is not None
        for datagram in datagrams:
            self.served.sendto(datagram, self.peer)


@pytest.mark.parametrize("text", first([THREADS, TASKS], 2), ids=["threads", "tasks"])
def test_a_node_with_an_event_of_the_graph_sleeps_until_it_changes(tmp_path: Path, text: str) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        graph = ServedGraph(served)
        threading.Thread(target=graph.serve, daemon=True).start()
        out = rendered(tmp_path, text.format(port=served.getsockname()[1]))
        program = program_of(out, "graph_wakes.c", more=("-pthread",))
        command = [str(program), str(QUIET_MS), str(ROUNDS)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
            assert running.stdout is not None
            wakes = running.stdout.readline()
            began = time.monotonic()
            for _ in range(ROUNDS):
                if running.stdout.readline() != "change\n":
                    break
                graph.change()
            last = running.stdout.readline()
            elapsed_s = time.monotonic() - began
            _, errors = running.communicate(timeout=seconds(60))
    assert (running.returncode, errors, last) == (0, "", "end\n")
    assert int(wakes) <= TIMER
    assert elapsed_s < ROUNDS * POLL_S / 4, "each of them waited for a poll"
