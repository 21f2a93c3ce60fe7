# SPDX-License-Identifier: Apache-2.0
"""The time that the agent spends on a client, without that in which the system gave the processor to other programs.

Clients pay for the agent's time, waiting for DDS included: who makes the agent wait takes time from the others. They do
not pay for the load of the machine. Linux counts how long a thread was ready to run and did not (the second number of
/proc/thread-self/schedstat, in ns). Asking takes a system call, so it is only done while that number grows, once
for each round of the main loop and after long work.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Final

LONG_S: Final = 0.0005
"""Seconds of work from which on it may have been interrupted: the system lets another program run for longer."""
LOOK_S: Final = 0.1
"""Seconds between two checks whether the machine is busy."""
BUSY: Final = 0.02
"""Part of the time for which the thread waits for a processor when the machine is busy."""

SCHEDSTAT_BYTES: Final = 64
"""More than three numbers of 64 bits need."""


class OwnTime:
    """The time of one thread; all calls are in that thread."""

    def __init__(self, waited: Callable[[], float]) -> None:
        """Use `waited`: the seconds for which the thread was ready to run and did not, since any time."""
        self._waited = waited
        self._busy = False
        self._mark = 0.0
        self._looked_at = float("-inf")
        self._looked = 0.0

    def begin(self, now: float) -> None:
        """Begin a round of work at `now` (s, monotonic)."""
        if now >= self._looked_at + LOOK_S:
            waited = self._waited()
            self._busy = waited - self._looked > BUSY * (now - self._looked_at)
            self._looked, self._looked_at = waited, now
            self._mark = waited
        elif self._busy:
            self._mark = self._waited()

    def of(self, seconds: float) -> float:
        """Return the thread's part of `seconds` of work in this round that ended just now."""
        if seconds < LONG_S or not self._busy:
            return seconds
        before, self._mark = self._mark, self._waited()
        return max(0.0, seconds - (self._mark - before))


class Waited:
    """The seconds for which a thread was ready to run and did not, since its start; 0 if unknown.

    The thread is that of the first call; all calls are in it.
    """

    def __init__(self) -> None:
        self._descriptor = -1
        self._last = 0.0

    def __del__(self) -> None:
        if self._descriptor >= 0:
            os.close(self._descriptor)

    def __call__(self) -> float:
        """Ask the system. Where it does not count this time, the load of the machine is charged, too."""
        try:
            if self._descriptor < 0:
                self._descriptor = os.open("/proc/thread-self/schedstat", os.O_RDONLY | os.O_CLOEXEC)
            self._last = int(os.pread(self._descriptor, SCHEDSTAT_BYTES, 0).split()[1]) / 1e9
        except (OSError, ValueError, IndexError):
            return self._last
        return self._last
