# SPDX-License-Identifier: Apache-2.0
"""Computes bytes by name in a second process, while this one goes on.

It is for commands, which have one thread and end.
"""

from __future__ import annotations

import marshal
import os
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import BinaryIO

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Ahead:
    """A process that computes, and the pipe for its result."""

    process: int
    result: BinaryIO

    def take(self) -> Mapping[str, bytes]:
        """Wait for the process; return its result, an empty one if it failed."""
        found: Mapping[str, bytes] = {}
        with self.result, suppress(OSError, ValueError, EOFError, TypeError):
            found = marshal.loads(self.result.read())
        with suppress(OSError):
            os.waitpid(self.process, 0)
        return found


def compute_ahead(compute: Callable[[], Mapping[str, bytes]]) -> Ahead | None:
    """Start `compute` in another process.

    None where there is no second processor or no fork (Windows), or where threads make it unsafe.
    """
    if not hasattr(os, "fork") or (os.cpu_count() or 1) < 2 or threading.active_count() > 1:
        return None
    reading, writing = os.pipe()
    process = os.fork()
    if process:
        os.close(writing)
        return Ahead(process, os.fdopen(reading, "rb"))
    with suppress(BaseException):
        os.close(reading)
        _let_go_of_terminal()
        with os.fdopen(writing, "wb") as pipe:
            pipe.write(marshal.dumps(dict(compute())))
    os._exit(0)


def _let_go_of_terminal() -> None:
    """Let whoever waits for the end of the command's output wait for the command alone."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nowhere, stream)
