# SPDX-License-Identifier: Apache-2.0
"""The two other processes of the soak: the agent with three transports, and the rclpy process that keeps the ledger."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.support.agent.process import environment
from tests.support.patience import seconds


@dataclass
class Agent:
    """The agent's process."""

    process: subprocess.Popen[str]
    places: dict[str, str]
    log: Path
    timeout_s: float

    @property
    def rss_kib(self) -> int:
        """Memory in use."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0])

    def events(self) -> list[dict[str, object]]:
        """Return what it logged."""
        return [json.loads(line) for line in self.log.read_text().splitlines()]


@contextlib.contextmanager
def agent_process(folder: Path, domain: int, timeout_s: float, forget_s: float) -> Iterator[Agent]:
    """Run an agent with UDP, TCP and a pseudo-terminal."""
    limits = ("--limit", f"client_timeout_s={timeout_s}", "--limit", f"sleep_timeout_s={forget_s}")
    # A hundred with nine objects each, and those that vanished and are not forgotten yet.
    most = ("--max-clients", "512")
    ways = ("udp4", "--port", "0", "tcp4", "--port", "0", "pty", "--link", str(folder / "line"))
    log = folder / "agent.log"
    with log.open("w") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "microros_gen", "agent", "--log-format", "json", *limits, *most, *ways],
            env=environment(domain),
            stdout=subprocess.PIPE,
            stderr=out,
            text=True,
        )
    assert process.stdout is not None
    try:
        reported = [json.loads(process.stdout.readline()) for _ in range(3)]
        yield Agent(process, {t["transport"]: t["address"] for t in reported}, log, timeout_s)
    finally:
        if process.poll() is None:
            process.terminate()
        process.wait(timeout=seconds(60))
        process.stdout.close()


class Peer:
    """The rclpy process."""

    def __init__(self, domain: int) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tests.support.agent.soak_peer"],
            env={**environment(domain), "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._answer()

    def nodes(self) -> list[str]:
        """Return the names of all other nodes."""
        assert self._process.stdin is not None
        self._process.stdin.write("\n")
        self._process.stdin.flush()
        return self._answer()

    def _answer(self) -> list[str]:
        assert self._process.stdout is not None
        found: list[str] = json.loads(self._process.stdout.readline())
        return found

    def close(self) -> None:
        """End it."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        self._process.wait(timeout=seconds(60))
        self._process.stdout.close()
