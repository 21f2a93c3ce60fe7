# SPDX-License-Identifier: Apache-2.0
"""The other end of a board's serial line: a scripted agent, and a relay that spoils bytes."""

from __future__ import annotations

import contextlib
import os
import pty
import random
import select
import threading
import time
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.frames import AGENT, CLIENT, events, frame

# What becomes of a byte on its way.
Fault = Callable[[int], bytes]


def clean(byte: int) -> bytes:
    """Pass it on."""
    return bytes([byte])


def noisy(seed: int, one_in: int) -> Fault:
    """Return a bad line: of `one_in` bytes one is lost, and one has a bit turned round."""
    chance = random.Random(seed)

    def fault(byte: int) -> bytes:
        what = chance.randrange(one_in)
        return b"" if what == 0 else bytes([byte ^ 1 << chance.randrange(8)]) if what == 1 else bytes([byte])

    return fault


def open_raw(device: str) -> int:
    """Open a terminal as a line of bytes, and discard what has arrived: as a cable that is plugged in now.

    For the first byte of a board, open its terminal with `os.open`, and before the board starts.
    """
    handle = os.open(device, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    tty.setraw(handle)
    return handle


@contextmanager
def scripted_agent(device: str, agent: FakeAgent) -> Iterator[FakeAgent]:
    """Let `agent` answer at `device`, until the end of `with`."""
    handle, ends = open_raw(device), threading.Event()
    thread = threading.Thread(target=_serve, args=(handle, agent, ends), daemon=True)
    thread.start()
    try:
        yield agent
    finally:
        ends.set()
        thread.join(10)
        os.close(handle)


def _serve(handle: int, agent: FakeAgent, ends: threading.Event) -> None:
    waiting = b""
    while not ends.is_set():
        waiting += _read(handle)
        last = max(waiting.rfind(b"\x7e"), 0)
        found = events(waiting[:last], source=CLIENT, destination=AGENT)
        ended = events(waiting[last:], source=CLIENT, destination=AGENT)  # none: its end is still to come
        found, waiting = found + ended, b"" if ended else waiting[last:]
        for event in found:
            for answer in agent.receive(event.message) if event.message else ():
                _write(handle, frame(answer))


def _read(handle: int) -> bytes:
    ready, _, _ = select.select([handle], [], [], 0.02)
    try:
        return os.read(handle, 4096) if ready else b""
    except OSError:
        time.sleep(0.02)  # nobody holds the other end
        return b""


def _write(handle: int, data: bytes) -> None:
    with contextlib.suppress(OSError):  # as a cable that nobody holds
        os.write(handle, data)


class Relay:
    """Joins a board's line to its own pseudo-terminal, `device`, or to that of another board; a context manager."""

    def __init__(self, board_device: str, other_device: str = "") -> None:
        self.fault: Fault = clean
        self.stopped = False  # nothing that the board sends is taken: its line stands still
        self.lost = 0
        self.spoiled = 0
        self._board = open_raw(board_device)
        handles = [open_raw(other_device)] if other_device else list(pty.openpty())
        if not other_device:
            tty.setraw(handles[1])
        self.device = other_device or os.ttyname(handles[1])
        self._handles = handles
        self._master = handles[0]  # the end that the relay has
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Relay:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.set()
        self._thread.join(10)
        for handle in (self._board, *self._handles):
            os.close(handle)

    def _serve(self) -> None:
        while not self._ends.is_set():
            taken = [self._master] if self.stopped else [self._board, self._master]
            ready, _, _ = select.select(taken, [], [], 0.02)
            for handle in ready:
                _write(self._master if handle == self._board else self._board, self._passed(_read(handle)))

    def _passed(self, data: bytes) -> bytes:
        passed = [self.fault(byte) for byte in data]
        self.lost += sum(not part for part in passed)
        self.spoiled += sum(bool(part) and part[0] != byte for part, byte in zip(passed, data, strict=True))
        return b"".join(passed)
