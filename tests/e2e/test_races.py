# SPDX-License-Identifier: Apache-2.0
"""Every component in programs of several tasks, under the sanitizers; the agent is killed, and another one comes."""

from __future__ import annotations

import json
import os
import re
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from socket import SOCK_DGRAM, SOCK_STREAM

import pytest

from microros_gen.selection.find_components import load_catalogue
from tests.support.agent.line_process import serving
from tests.support.agent.process import running_agent
from tests.support.e2e.graph_server import graph_server
from tests.support.e2e.races import (
    APPLICATIONS,
    ELSEWHERE,
    MEMORY,
    THREADS,
    build_other,
    build_program,
    free_ports,
    selected,
)
from tests.support.patience import deadline, seconds
from tests.support.runtime.harness import quick

KILLED_S = 1.5
"""How long there is no agent."""
EXCHANGED = ("count", "/rosout", "/diagnostics", "/add", "/ros/add", "/ros/sum", "/ros/walk", "/walk")
"""What rclpy exchanges with the device, and must continue with the second agent."""


def test_every_component_is_in_one_of_the_programs(tmp_path: Path) -> None:
    ready = {
        name for name, component in load_catalogue().items() if component.ready and component.layer != "port"
    }
    found: set[str] = set()
    for name in APPLICATIONS:
        (tmp_path / name).mkdir()
        found |= selected(tmp_path / name, name)
    assert ready - found == set(ELSEWHERE), "name a new component in APPLICATIONS, or here why it is in none"


@contextmanager
def agent_at(transport: str, port: int, domain: int) -> Iterator[None]:
    """Run an agent, and kill it afterwards as a computer that fails does."""
    kind = ("tcp4" if transport == "tcp" else "udp4", "--port", str(port))
    with running_agent(domain, "--domain", str(domain), transport=kind) as agent:
        yield
        agent.process.kill()


def calls_of(report: str) -> dict[str, tuple[int, int, str]]:
    """Return how often each call succeeded and was made, and its last error, from what the program prints."""
    report_lines = re.findall(r"^(\d+)/(\d+) (.*): (.*)$", report, re.MULTILINE)
    return {name: (int(succeeded), int(called), error) for succeeded, called, name, error in report_lines}


class Running:
    """The program and its peers in ROS and on its link."""

    def __init__(self, folder: Path, program: Path, peer: subprocess.Popen[str]) -> None:
        self._peer = peer
        self._report = folder / "report"
        self.races = folder / "races"
        with self._report.open("w") as report, (folder / "printed").open("w") as printed:
            self.process = subprocess.Popen(
                [program],
                stdin=subprocess.PIPE,
                stdout=printed,
                stderr=report,
                cwd=folder,
                env={**os.environ, "TSAN_OPTIONS": f"log_path={self.races}"},
            )

    def exchanged(self) -> dict[str, int]:
        assert self._peer.stdin is not None
        assert self._peer.stdout is not None
        self._peer.stdin.write("\n")
        self._peer.stdin.flush()
        found: dict[str, int] = json.loads(self._peer.stdout.readline())
        return found

    def await_exchanges(self) -> None:
        """Wait until everything in EXCHANGED was exchanged again."""
        before, end = self.exchanged(), deadline(30)
        while missing := [
            name for name in EXCHANGED if self.exchanged().get(name, 0) < before.get(name, 0) + 2
        ]:
            assert self.process.poll() is None, self.report()
            assert time.monotonic() < end, (missing, self.exchanged(), self.report())
            time.sleep(0.2)

    def report(self) -> str:
        reports = [path.read_text() for path in self._report.parent.glob("races*") if path.is_file()]
        return "\n".join([*reports, self._report.read_text()[-20_000:]])

    def end(self) -> dict[str, tuple[int, int, str]]:
        assert self.process.stdin is not None
        self.process.stdin.close()
        try:
            status = self.process.wait(timeout=seconds(60))
        finally:
            self.process.kill()
        assert status == 0, self.report()
        return calls_of(self.report())


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.parametrize(
    ("name", "flags"),
    [
        pytest.param("udp", THREADS, id="udp-threads"),
        pytest.param("tcp", THREADS, id="tcp-threads", marks=pytest.mark.variant),
        pytest.param("udp", MEMORY, id="udp-memory", marks=pytest.mark.variant),
        pytest.param("tcp", MEMORY, id="tcp-memory", marks=pytest.mark.variant),
    ],
)
def test_no_two_tasks_race(tmp_path: Path, domain: int, name: str, flags: tuple[str, ...]) -> None:
    """Each call succeeds some time, with either agent; the sanitizer has nothing to say."""
    kind = SOCK_STREAM if name == "tcp" else SOCK_DGRAM
    ports = free_ports(2, kind) if name == "udp" else free_ports(1, kind)
    program = build_program(tmp_path, name, ports, flags)
    with ExitStack() as stack:
        peer = stack.enter_context(serving("tests.support.e2e.races_peer", domain))
        stack.enter_context(graph_server(domain))
        if name == "udp":
            other = stack.enter_context(
                subprocess.Popen(
                    [build_other(tmp_path, *quick())], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
                )
            )
            stack.callback(other.kill)
        with agent_at(name, ports[0], domain):
            running = Running(tmp_path, program, peer)
            stack.callback(running.process.kill)
            running.await_exchanges()
        time.sleep(KILLED_S)
        with agent_at(name, ports[-1], domain):
            running.await_exchanges()
            calls = running.end()
    never = {call: found for call, found in calls.items() if found[0] == 0}
    assert not never, never
