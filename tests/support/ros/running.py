# SPDX-License-Identifier: Apache-2.0
"""Modules in processes with their output, and nodes in threads of the test."""

from __future__ import annotations

import queue
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from microros_gen.ros.peer import Peer
from tests.support.agent.process import environment
from tests.support.patience import deadline


class Running:
    """A module in a process; `lines` are those of its output so far."""

    def __init__(self, domain: int, module: str, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", module, *arguments],
            env=environment(domain),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.lines: list[str] = []
        self._new: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._new.put(line.rstrip("\n"))

    def count(self, text: str) -> int:
        """Return the number of lines with a text."""
        while not self._new.empty():
            self.lines.append(self._new.get())
        return sum(text in line for line in self.lines)

    def says_match(self, pattern: str) -> bool:
        """Return whether a regular expression matches a line."""
        self.count("")
        return any(re.search(pattern, line) for line in self.lines)

    def read_to_end(self) -> None:
        """Wait for the last line of a process that has ended."""
        self._reader.join()
        self.count("")

    def says(self, text: str) -> bool:
        return self.count(text) > 0

    def wait_for(self, text: str, idle_s: float = 30.0) -> None:
        end = deadline(idle_s)
        while not self.says(text):
            assert time.monotonic() < end, (text, self.lines)
            assert self.process.poll() is None, self.lines
            time.sleep(0.05)

    def begin(self) -> None:
        """Send an empty line."""
        assert self.process.stdin is not None
        self.process.stdin.write("\n")
        self.process.stdin.flush()


@contextmanager
def running(domain: int, module: str, *arguments: str) -> Iterator[Running]:
    """Run a module; kill it afterwards."""
    started = Running(domain, module, *arguments)
    try:
        yield started
    finally:
        started.process.kill()
        started.process.wait()


@contextmanager
def node_in_thread(name: str, begin: Callable[[Peer], Callable[[], object]]) -> Iterator[None]:
    """Let a node be there, in a thread, which calls what `begin` returns for its peer again and again."""
    stop = threading.Event()

    def run() -> None:
        with Peer(name) as peer:
            turn = begin(peer)
            while not stop.is_set():
                turn()
                peer.spin_once(0.05)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()
