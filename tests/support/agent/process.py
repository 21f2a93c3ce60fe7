# SPDX-License-Identifier: Apache-2.0
"""An agent in a separate process, for tests."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.patience import deadline, seconds

READY = "agent ready: "


class AgentProcess:
    """A running agent: its port, and what it logs."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.port = 0
        self.device = ""
        self.log: list[str] = []
        self._lines: queue.Queue[str | None] = queue.Queue()
        for stream in (process.stdout, process.stderr):
            threading.Thread(target=self._read, args=(stream,), daemon=True).start()

    def _read(self, stream) -> None:  # type: ignore[no-untyped-def]
        for line in stream:
            self._lines.put(line.rstrip("\n"))
        self._lines.put(None)

    def wait_for(self, part: str, timeout_s: float = 15.0) -> str:
        """Return the next line of the log that contains `part`."""
        end = deadline(timeout_s)
        while True:
            try:
                line = self._lines.get(timeout=max(0.0, end - time.monotonic()))
            except queue.Empty:
                raise AssertionError(f"no '{part}' in the agent's log:\n" + "\n".join(self.log)) from None
            if line is None:
                continue
            self.log.append(line)
            if part in line:
                return line

    def rest(self, timeout_s: float = 15.0) -> list[str]:
        """Return every line of the log, after both streams have ended."""
        end, ended = deadline(timeout_s), 0
        while ended < 2:
            line = self._lines.get(timeout=max(0.0, end - time.monotonic()))
            if line is None:
                ended += 1
            else:
                self.log.append(line)
        return self.log

    def stop(self, number: int = signal.SIGTERM) -> int:
        """Send a signal; return the exit status."""
        self.process.send_signal(number)
        return self.process.wait(timeout=seconds(15))


def own_domain() -> int:
    """Return a ROS domain that other test processes hardly use; larger ones meet Linux's ephemeral ports."""
    return 1 + os.getpid() % 100


def environment(domain: int) -> dict[str, str]:
    """Return an environment that keeps ROS to itself: own domain, this machine only."""
    return {
        **os.environ,
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONUNBUFFERED": "1",
    }


def enter_domain(monkeypatch: pytest.MonkeyPatch) -> int:
    """Let nodes of this process and its children have a separate ROS domain until a test ends; return it."""
    number = own_domain()
    for name, value in environment(number).items():
        monkeypatch.setenv(name, value)
    return number


UDP = ("udp4", "--port", "0")


@contextmanager
def running_agent(
    domain: int,
    *options: str,
    command: Sequence[str] = (),
    transport: Sequence[str] = UDP,
    program: Sequence[str] = (),
) -> Iterator[AgentProcess]:
    """Start `microros-gen agent TRANSPORT OPTIONS`, wait until it is ready, end it afterwards.

    `command` replaces `microros-gen`, `program` replaces `microros-gen agent`.
    """
    start = list(program) or [*(list(command) or [sys.executable, "-m", "microros_gen"]), "agent"]
    process = subprocess.Popen(
        [*start, *transport, *options],
        env=environment(domain),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    agent = AgentProcess(process)
    try:
        place = agent.wait_for(READY).rpartition(" ")[2].rstrip('"}')
        if transport[0] in ("udp4", "udp6"):
            agent.port = int(place.rpartition(":")[2])
        agent.device = place
        yield agent
    finally:
        if process.poll() is None:
            process.terminate()
        try:
            process.wait(timeout=seconds(10))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def agent_options(out: Path) -> list[str]:
    """Return the options for the files that a generated library has for its agent; none: it creates its entities."""
    return [
        word
        for path in sorted((out / "agent").glob("*"))
        for word in ("--references" if path.suffix == ".xml" else "--entities", str(path))
    ]
