# SPDX-License-Identifier: Apache-2.0
"""Queries of the graph and logger services while several tasks receive, watched by ThreadSanitizer."""

from __future__ import annotations

import socket
import subprocess
import threading
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.patience import seconds
from tests.support.runtime.graph_agent import GraphAgent, MadeGraph, endpoint
from tests.support.runtime.harness import Tree, build
from tests.support.runtime.serving_agent import identity
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph, +logger_services, +multithread]
logging: callback
memory: {arena: 2500}
transport: {agent: "127.0.0.1:%d"}
pools: {guard_conditions: 1}
session: {create_timeout: 20 s, connect_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: device, namespace: /arm}]
"""
THREAD_SANITIZER = ("-g", "-O1", "-fsanitize=thread")
READER, SET_LEVELS, FIRST_CLIENT = 1, 3, 4
"""Places on the wire: one for a publisher, the changes, two services, two clients."""
TASKS, QUERIES, EVERY = 4, 150, 1
KNOWN = "race:rcl_guard_condition_is_ready\nrace:rcl_trigger_guard_condition\nrace:rcl_guard_condition_acknowledge\n"
"""The counters of a guard condition are volatile words with one writer each: interrupts trigger it, too."""


def codec() -> Codec:
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(
        resolve_interfaces((Named("rcl_interfaces/srv/SetLoggerLevels", None),), finder, Diagnostics())
    )


class Serving:
    """The agent; with each EVERY-th query it announces a change and requests a level."""

    def __init__(self, agent: GraphAgent, served: socket.socket) -> None:
        self._agent, self._served, self._codec = agent, served, codec()
        self.requested: list[str] = []

    def run(self) -> None:
        """Answer datagrams until the socket is closed."""
        while True:
            try:
                datagram, peer = self._served.recvfrom(2048)
            except OSError:
                return
            answers = self._agent.receive(datagram)
            if len(self._agent.requests) // EVERY > len(self.requested):
                answers += [*self._agent.notice(), *self._request()]
            for answer in [*answers, *self._agent.tick()]:
                self._served.sendto(answer, peer)

    def _request(self) -> list[bytes]:
        self.requested.append(f"logger{len(self.requested) % 3}")
        levels = [{"name": name, "level": 10} for name in self.requested[-2:]]
        body = self._codec.encode("rcl_interfaces/srv/SetLoggerLevels_Request", {"levels": levels})
        target = (SET_LEVELS << 4 | 8).to_bytes(2, "big")
        return self._agent.give(target, identity(len(self.requested)) + body[ENCAPSULATION_BYTES:])

    def results(self) -> list[list[bool]]:
        """Return whether the levels of each request were set."""
        size = len(identity(1))
        replies = [
            self._codec.decode("rcl_interfaces/srv/SetLoggerLevels_Response", b"\0\1\0\0" + body[size:])
            for body in self._agent.answered
        ]
        return [[result["successful"] for result in reply["results"]] for reply in replies]


def watched(program: Path, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a program; ThreadSanitizer says on stderr what it finds."""
    (folder / "known").write_text(KNOWN)
    options = f"suppressions={folder / 'known'}:print_suppressions=0"
    return subprocess.run(
        [program],
        capture_output=True,
        text=True,
        timeout=seconds(120),
        env={"TSAN_OPTIONS": options},
        check=False,
    )


@pytest.mark.system
def test_tasks_that_query_while_an_executor_answers(tmp_path: Path) -> None:
    graph = MadeGraph(subscribing={"/arm/count": (endpoint("/root", 1), endpoint("/a/b/deep", 2))})
    agent = GraphAgent(mtu=256, graph=graph, reader=READER, first_client=FIRST_CLIENT)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        serving = Serving(agent, served)
        threading.Thread(target=serving.run, daemon=True).start()
        tree = write_application(tmp_path / "tree", APPLICATION % served.getsockname()[1])
        program = build(tree, ["graph_threads.c"], "threads", "gcc", THREAD_SANITIZER)
        done = watched(program, tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "changes seen\n", "")
    assert len(agent.requests) >= TASKS * QUERIES
    assert len(serving.results()) > TASKS * QUERIES / EVERY / 2
    assert all(all(found) for found in serving.results())


EVENTS = """\
version: 1
profiles: [pure_sender]
components: [+graph_events, +multithread]
memory: {arena: 2500}
transport: {agent: "127.0.0.1:%d"}
pools: {guard_conditions: 1}
session: {create_timeout: 20 s, connect_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: first}, {name: second}]
"""


def test_the_node_of_the_graph_is_closed_while_others_spin_and_query(tmp_path: Path) -> None:
    agent = GraphAgent(mtu=256, graph=MadeGraph(), reader=1, first_client=2)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=answer, args=(agent, served), daemon=True).start()
        tree = write_application(tmp_path / "tree", EVENTS % served.getsockname()[1])
        alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name != "port_posix_time.c"))
        program = build(alone, ["closing_threads.c"], "closing", "gcc", THREAD_SANITIZER)
        done = watched(program, tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


def answer(agent: GraphAgent, served: socket.socket) -> None:
    """Answer datagrams until the socket is closed, and tell of a change of the graph with each."""
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        notices = agent.notice() if agent.requests else []
        for response in [*answers, *notices, *agent.tick()]:
            served.sendto(response, peer)
