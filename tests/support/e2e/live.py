# SPDX-License-Identifier: Apache-2.0
"""Talks to the program of c/live.c."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from tests.support.e2e.images import kill
from tests.support.patience import seconds


@dataclass(frozen=True)
class Answer:
    """What a call gave: its code, how long it took (microseconds), the error's text, and further lines."""

    code: int
    took_us: int
    text: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Sample:
    """One publish of a burst."""

    value: int
    code: int
    took_us: int


class Live:
    """A running application; used as a context manager. At the end it has to end by itself, cleanly."""

    def __init__(self, program: Path) -> None:
        self.process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def __enter__(self) -> Live:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        killed = self.process.poll() is not None
        if kind is not None and not killed:
            self.process.kill()
        _, errors = self.process.communicate(timeout=seconds(20))
        if kind is None and not killed:
            assert (self.process.returncode, errors) == (0, ""), errors

    def call(self, command: str) -> Answer:
        """Let the application make one call."""
        self.begin(command)
        return self.end()

    def begin(self, command: str) -> None:
        """Start a call that takes its time; `end` waits for its answer."""
        assert self.process.stdin is not None
        self.process.stdin.write(command + "\n")
        self.process.stdin.flush()

    def end(self) -> Answer:
        assert self.process.stdout is not None
        lines: list[str] = []
        for line in self.process.stdout:
            if line.startswith("ret "):
                _, code, elapsed, text = line.rstrip("\n").split(" ", 3)
                return Answer(int(code), int(elapsed), text, tuple(lines))
            lines.append(line.rstrip("\n"))
        assert self.process.stderr is not None
        raise AssertionError(f"the application ended: {self.process.stderr.read()}")

    def ok(self, command: str) -> Answer:
        answer = self.call(command)
        assert answer.code == 0, f"{command}: {answer.code} {answer.text}"
        return answer

    def start(self, port: int, *, key: int = 0x77, topic: str = "chatter", qos: str = "reliable") -> None:
        """Open a session with node 0 `talker` and publisher 0 (Int32) on `topic`."""
        for command in (f"open {key} {port}", "node 0 talker -", f"publisher 0 0 Int32 {topic} {qos}"):
            self.ok(command)

    def burst(self, first: int, count: int, period_ms: int, publisher: int = 0) -> list[Sample]:
        """Publish `count` values in turn; return what each publish gave."""
        self.begin(f"burst {publisher} {first} {count} {period_ms}")
        return self.samples()

    def samples(self) -> list[Sample]:
        """Wait for the end of a burst; return what each publish gave."""
        return [Sample(*map(int, line.split()[1:])) for line in self.end().lines]

    def statistics(self) -> dict[str, int]:
        (line,) = self.ok("statistics").lines
        return {key: int(value) for key, value in (pair.split("=") for pair in line.split()[1:])}

    def kill(self) -> None:
        """End it without a goodbye."""
        kill(self.process)
