# SPDX-License-Identifier: Apache-2.0
"""A Python process next to the test that answers each line, a JSON object, with another one."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.process import environment
from tests.support.patience import seconds

ANSWER_S = 60.0
"""A command may wait for a service itself, for half of that."""


class LineProcess:
    """The test's side of it."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def ask(self, **command: Any) -> Any:
        """Send a command and return the answer."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()
        # One line an answer: nothing of it was read before.
        assert select.select([self._process.stdout], [], [], seconds(ANSWER_S))[0], f"no answer to {command}"
        return json.loads(self._process.stdout.readline())

    @contextmanager
    def stopped(self) -> Iterator[None]:
        """Let nothing of the process run meanwhile, the threads of DDS neither."""
        self._process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self._process.send_signal(signal.SIGCONT)


@contextmanager
def serving(module: str, domain: int) -> Iterator[subprocess.Popen[str]]:
    """Run `module` in a ROS domain, with pipes for its commands and answers."""
    process = subprocess.Popen(
        [sys.executable, "-m", module],
        env={**environment(domain), "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            if stream:
                stream.close()
