# SPDX-License-Identifier: Apache-2.0
"""A program that takes commands by lines, and answers each with lines and `ret CODE ERROR`."""

from __future__ import annotations

import subprocess


class CommandedProgram:
    """The program on the other side of two pipes."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def call(self, command: str) -> tuple[int, str, list[str]]:
        """Return code, error text and printed lines."""
        self.begin(command)
        return self.result()

    def begin(self, command: str) -> None:
        """Let it do something, until `result`."""
        assert self._process.stdin is not None
        self._process.stdin.write(command + "\n")
        self._process.stdin.flush()

    def result(self) -> tuple[int, str, list[str]]:
        """Return code, error text and printed lines of what it does."""
        assert self._process.stdout is not None
        lines: list[str] = []
        while not (line := self._process.stdout.readline()).startswith("ret "):
            assert line, self._process.stderr.read() if self._process.stderr else ""
            lines.append(line.rstrip("\n"))
        _, code, error = line.rstrip("\n").split(" ", 2)
        return int(code), error, lines
