# SPDX-License-Identifier: Apache-2.0
"""A serial line between two devices, each of which can be unplugged as a USB converter can."""

from __future__ import annotations

import contextlib
import os
import select
import threading
import tty
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

Ends = tuple[int, int]
"""The two ends of a pseudo-terminal. The second one stays open, so that its device is there without a reader."""


class Plugs:
    """The line. `names` are the paths of its devices; that of an unplugged one does not exist."""

    def __init__(self, names: Sequence[Path]) -> None:
        self.names = tuple(names)
        self._ends: list[Ends | None] = [None, None]
        self._lock = threading.Lock()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Plugs:
        for side in (0, 1):
            self.plug(side)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._thread.join(10)
        for side in (0, 1):
            self.unplug(side)

    def plug(self, side: int) -> None:
        """Plug a device in."""
        ends = os.openpty()
        tty.setraw(ends[1])
        os.set_blocking(ends[0], False)
        with self._lock:
            self._ends[side] = ends
        self.names[side].symlink_to(os.ttyname(ends[1]))

    def unplug(self, side: int) -> None:
        """Unplug it, if it is there: whoever has opened it finds that it has hung up."""
        self.names[side].unlink(missing_ok=True)
        with self._lock:
            ends, self._ends[side] = self._ends[side], None
        for end in ends or ():
            os.close(end)

    def _serve(self) -> None:
        while not self._over.is_set():
            with self._lock:
                first, second = (ends[0] if ends else -1 for ends in self._ends)
                ready = select.select([end for end in (first, second) if end >= 0], [], [], 0)[0]
                for end in ready:
                    _pass(end, second if end == first else first)
            self._over.wait(0.001)


def _pass(source: int, target: int) -> None:
    """Pass what has arrived; a device that is unplugged gets nothing."""
    data = os.read(source, 4096)
    if target >= 0:
        with contextlib.suppress(BlockingIOError):
            os.write(target, data)
