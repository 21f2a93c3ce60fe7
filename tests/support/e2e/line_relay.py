# SPDX-License-Identifier: Apache-2.0
"""A serial line between a device and its agent: two pseudo-terminals, bytes at the pace of a baud rate, and noise."""

from __future__ import annotations

import contextlib
import os
import random
import select
import threading
import time
import tty
from pathlib import Path
from types import TracebackType

BITS_PER_BYTE = 10
"""With start and stop bit."""


class LineRelay:
    """`device` and `agent` are the names of the two ends. Used as a context manager.

    `noise`: the share of all chunks, of about ten bytes each, in which a byte is changed, and from which a few
    bytes are missing.
    """

    def __init__(self, device: Path, baud: int, noise: float, seed: int) -> None:
        self._byte_s = BITS_PER_BYTE / baud
        self._noise, self._chance = noise, random.Random(seed)
        self._ends = [os.openpty() for _ in range(2)]
        for _, slave in self._ends:
            tty.setraw(slave)
        for master, _ in self._ends:
            os.set_blocking(master, False)
        self.device = device
        device.symlink_to(os.ttyname(self._ends[0][1]))
        self.agent = os.ttyname(self._ends[1][1])
        self.changed = self.missing = 0
        self._stop = threading.Event()
        masters = [master for master, _ in self._ends]
        self._threads = [
            threading.Thread(target=self._carry, args=way, daemon=True) for way in (masters, masters[::-1])
        ]

    def __enter__(self) -> LineRelay:
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop.set()
        for thread in self._threads:
            thread.join(10)
        for descriptor in (d for end in self._ends for d in end):
            os.close(descriptor)
        self.device.unlink()

    def _carry(self, source: int, target: int) -> None:
        free = time.monotonic()  # when the line has sent what it has
        while not self._stop.is_set():
            if not select.select([source], [], [], 0.05)[0]:
                continue
            with contextlib.suppress(OSError):
                chunk = os.read(source, 16)
                free = max(free, time.monotonic()) + len(chunk) * self._byte_s
                time.sleep(max(0.0, free - time.monotonic()))
                os.write(target, self._spoil(chunk))

    def _spoil(self, chunk: bytes) -> bytes:
        fate = self._chance.random()
        at = self._chance.randrange(len(chunk))
        if fate < self._noise:
            self.changed += 1
            return chunk[:at] + bytes([chunk[at] ^ (1 << self._chance.randrange(8))]) + chunk[at + 1 :]
        if fate < 2 * self._noise:
            self.missing += 1
            return chunk[:at] + chunk[at + self._chance.randrange(1, 8) :]
        return chunk
