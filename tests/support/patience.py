# SPDX-License-Identifier: Apache-2.0
"""How long a test waits for something that must happen: longer where the machine has other work.

A test names the seconds that suffice on an idle machine. These are limits for what hangs, not measurements: a test
that passes never waits for them. What must *not* happen within a time, and speeds, are no matter of this module.
"""

from __future__ import annotations

import os
import time
from pathlib import Path

LEAST, MOST = 2.0, 20.0
_RUNNING = Path("/proc/loadavg")


def factor(load: float, running: int, processors: int) -> float:
    """Return how many times longer than on an idle machine to wait.

    `load`: mean number of processes that want a processor, over a minute; `running`: their number now.
    """
    return min(MOST, max(LEAST, LEAST * max(load, running) / processors))


def seconds(idle: float) -> float:
    """Return the seconds to wait now for what takes at most `idle` seconds on an idle machine."""
    try:
        running = int(_RUNNING.read_text().split()[3].split("/")[0])
    except (OSError, ValueError, IndexError):  # not Linux
        running = 1
    return idle * factor(os.getloadavg()[0], running, os.cpu_count() or 1)


def deadline(idle: float) -> float:
    """Return when to give up (time.monotonic) what takes at most `idle` seconds on an idle machine."""
    return time.monotonic() + seconds(idle)
