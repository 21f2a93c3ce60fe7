# SPDX-License-Identifier: Apache-2.0
"""A page in headless Chromium that a test looks at while it lives: the DevTools protocol over a pipe."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.support.patience import deadline, seconds

_OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--remote-debugging-pipe",
)


class Page:
    """An open page."""

    def __init__(self, commands: int, answers: int) -> None:
        """`commands` and `answers` are descriptors of pipes, in which each message ends with a zero byte."""
        self._commands = commands
        self._answers = answers
        self._buffer = b""
        self._number = 0
        self._session = ""

    def open(self, address: str) -> None:
        """Open a page in a new tab."""
        target = self._do("Target.createTarget", url=address)["targetId"]
        self._session = self._do("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]

    def value(self, expression: str) -> Any:
        """Return the value of an expression of JavaScript."""
        return self._do("Runtime.evaluate", expression=expression, returnByValue=True)["result"].get("value")

    def wait_for(self, expression: str, expected: Any, idle_s: float = 20.0) -> None:
        """Wait until an expression has a value."""
        end = deadline(idle_s)
        while (value := self.value(expression)) != expected:
            assert time.monotonic() < end, f"{expression} is {value!r}"
            time.sleep(0.1)

    def _do(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        command: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            command["sessionId"] = self._session
        os.write(self._commands, json.dumps(command).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == self._number:
                assert "error" not in answer, answer
                result: dict[str, Any] = answer["result"]
                return result

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            more = os.read(self._answers, 65_536)
            assert more, "Chromium has ended"
            self._buffer += more
        message, _, self._buffer = self._buffer.partition(b"\0")
        answer: dict[str, Any] = json.loads(message)
        return answer


@contextmanager
def opened(address: str, profile: Path) -> Iterator[Page]:
    """Open a page within the context, or skip the test without Chromium."""
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("no chromium: apt-get install chromium")
    commands_out, commands_in = os.pipe()
    answers_out, answers_in = os.pipe()
    script = f'exec "$@" 3<&{commands_out} 4>&{answers_in}'
    process = subprocess.Popen(
        ["bash", "-c", script, "sh", chromium, *_OPTIONS, f"--user-data-dir={profile}"],
        pass_fds=(commands_out, answers_in),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(commands_out)
    os.close(answers_in)
    try:
        page = Page(commands_in, answers_out)
        page.open(address)
        yield page
    finally:
        process.kill()
        process.wait(seconds(20))
        os.close(commands_in)
        os.close(answers_out)
