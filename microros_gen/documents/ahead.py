# SPDX-License-Identifier: Apache-2.0
"""Computes bytes by name in a second process, while this one goes on.

It is for commands, which have one thread and end.
"""

from __future__ import annotations

import marshal
import os
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from typing import BinaryIO

from microros_gen.records import dataclass

_LARGEST_REQUEST = 4096
"""Bytes that a pipe takes at once: `ask` never waits for the other process."""


@dataclass(frozen=True)
class Ahead:
    """A process that computes, the pipe for its result, and the pipe for names that it is asked for later."""

    process: int
    result: BinaryIO
    requests: BinaryIO

    def ask(self, names: Iterable[str]) -> None:
        """Name more of what to compute; names that are too many, or come too late, are not computed."""
        request = "".join(f"{name}\n" for name in names).encode()
        if not self.requests.closed and len(request) <= _LARGEST_REQUEST:
            with suppress(OSError):
                self.requests.write(request)

    def take(self) -> Mapping[str, bytes]:
        """Wait for the process; return its result, an empty one if it failed."""
        found: Mapping[str, bytes] = {}
        with self.result, suppress(OSError, ValueError, EOFError, TypeError):
            self.requests.close()
            found = marshal.loads(self.result.read())
        with suppress(OSError):
            os.waitpid(self.process, 0)
        return found


def compute_ahead(compute: Callable[[Iterator[str]], Mapping[str, bytes]]) -> Ahead | None:
    """Start `compute` in another process; its argument yields names as they are asked for, up to `take`.

    None where there is no second processor or no fork (Windows), or where threads make it unsafe.
    """
    if not hasattr(os, "fork") or (os.cpu_count() or 1) < 2 or threading.active_count() > 1:
        return None
    result, result_end = os.pipe()
    requests, requests_end = os.pipe()
    process = os.fork()
    if process:
        os.close(result_end)
        os.close(requests)
        return Ahead(process, os.fdopen(result, "rb"), os.fdopen(requests_end, "wb", buffering=0))
    with suppress(BaseException):
        os.close(result)
        os.close(requests_end)
        _let_go_of_terminal()
        with os.fdopen(requests, encoding="utf-8") as names, os.fdopen(result_end, "wb") as pipe:
            pipe.write(marshal.dumps(dict(compute(line.removesuffix("\n") for line in names))))
    os._exit(0)


def _let_go_of_terminal() -> None:
    """Let whoever waits for the end of the command's output wait for the command alone."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nowhere, stream)
