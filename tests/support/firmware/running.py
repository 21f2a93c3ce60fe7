# SPDX-License-Identifier: Apache-2.0
"""`microros-gen run` with an image for a board."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from tests.support.agent.process import AgentProcess, environment
from tests.support.patience import seconds

BOARD = "qemu-mps2-an386"


def program(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "microros_gen", *arguments]


@contextmanager
def started(*arguments: str, domain: int = 0) -> Iterator[AgentProcess]:
    """Start a command of the tool; end it and all that it started afterwards."""
    process = subprocess.Popen(
        program(*arguments),
        env=environment(domain),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield AgentProcess(process)
    finally:
        if process.poll() is None:
            process.terminate()
        try:
            process.wait(timeout=seconds(15))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
