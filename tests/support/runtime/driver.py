# SPDX-License-Identifier: Apache-2.0
"""Talks to the client program: every datagram of the client passes through a fake agent, and time stands still."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from tests.support.patience import seconds
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.wires import Datagrams, Wire

# Sleeps of a millisecond in one call; more means that a wait has no end.
MOST_SLEEPS = 20_000


@dataclass(frozen=True)
class Result:
    """What a call gave: return code, error text, how long it slept (ms), and other lines that it printed."""

    code: int
    error: str
    slept: int
    lines: tuple[str, ...]


class Client:
    """The client program with `agent` on the other side; used as a context manager.

    Answers come `round_trip_ms` after what they are for; each byte takes `byte_ms` on the line, which has two
    directions. `group` answers what is sent to the group of agents.
    """

    def __init__(self, program: Path, agent: FakeAgent, wire: Wire | None = None) -> None:
        self.agent = agent
        self.sent: list[bytes] = []
        self.sent_at: list[int] = []
        self.queued: list[bytes] = []
        self.round_trip_ms = 0
        self.byte_ms = 0.0
        self.now_ms = 0
        self.group: Callable[[bytes], bytes] = lambda question: b""
        self._wire = wire or Datagrams()
        self._late: list[tuple[float, bytes]] = []
        self._free_up = self._free_down = 0.0
        self.on_sleep: Callable[[], None] = lambda: None
        self._process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            self._process.kill()
        self._say("quit")
        _, errors = self._process.communicate(timeout=seconds(20))
        if kind is None:
            assert self._process.returncode == 0, errors

    def call(self, command: str) -> Result:
        """Let the client make one call, with the agent's answers of before."""
        self._deliver()
        self._say(command)
        slept = 0
        lines = []
        while True:
            line = self._line()
            word, _, rest = line.partition(" ")
            if word == "tx":
                self._transmit(bytes.fromhex(rest))
            elif word in ("open", "close"):
                self._wire.begin()
                lines.append(line)
            elif word == "group":
                self._say(f"group {self.group(bytes.fromhex(rest.split()[-1])).hex()}")
            elif word == "sleep":
                slept += int(rest)
                self.now_ms += int(rest)
                assert slept < MOST_SLEEPS, f"{command} does not return"
                self.on_sleep()
                self._deliver()
                self._say("go")
            elif word == "ret":
                code, _, error = rest.partition(" ")
                return Result(int(code), error, slept, tuple(lines))
            else:
                lines.append(line)

    def ok(self, command: str) -> Result:
        result = self.call(command)
        assert result.code == 0, f"{command}: {result.code} {result.error}"
        return result

    def wait(self, milliseconds: int) -> None:
        """Let time pass for the client."""
        self.now_ms += milliseconds
        self._say(f"time {milliseconds}")

    def tell(self, line: str) -> None:
        self._say(line)

    def spin(self, times: int = 1, step: int = 0) -> None:
        for _ in range(times):
            self.wait(step)
            self.ok("spin")

    def statistics(self) -> dict[str, int]:
        (line,) = (x for x in self.ok("statistics").lines if x.startswith("statistics"))
        return {key: int(value) for key, value in (pair.split("=") for pair in line.split()[1:])}

    def _transmit(self, data: bytes) -> None:
        for message in self._wire.messages(data):
            self.sent.append(message)
            self.sent_at.append(self.now_ms)
            self._free_up = max(self._free_up, self.now_ms) + len(message) * self.byte_ms
            self.bring(self.agent.receive(message), self._free_up + self.round_trip_ms)

    def bring(self, datagrams: list[bytes], at_ms: float) -> None:
        """Let datagrams of the agent, which sends them at `at_ms`, come when the line has carried them."""
        for datagram in datagrams:
            if self.byte_ms:
                self._free_down = at_ms = max(self._free_down, at_ms) + len(datagram) * self.byte_ms
            self._late.append((at_ms, datagram))

    def _deliver(self) -> None:
        self.queued += [answer for due, answer in self._late if due <= self.now_ms]
        self._late = [(due, answer) for due, answer in self._late if due > self.now_ms]
        for answer in self.queued:
            self._say(f"rx {self._wire.carried(answer).hex()}")
        self.queued.clear()

    def _line(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            assert self._process.stderr is not None
            raise AssertionError(f"the client ended: {self._process.stderr.read()}")
        return line.rstrip("\n")

    def _say(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()
