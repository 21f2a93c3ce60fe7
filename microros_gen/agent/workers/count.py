# SPDX-License-Identifier: Apache-2.0
"""How many workers an agent has: a number, or that of the processors that this process may use."""

from __future__ import annotations

import os
from pathlib import Path

AUTO = "auto"
MOST = 64
_QUOTA = Path("/sys/fs/cgroup/cpu.max")
"""Limit of a container's processor time (Linux, cgroup-v2, cpu.max): microseconds, and in how many of them."""


def worker_count(text: str, quota: Path = _QUOTA) -> int | None:
    """Return the number of workers in `text`: 1 to `MOST`, or `auto`; None if it is neither."""
    if text == AUTO:
        return min(MOST, processors(quota))
    return (
        int(text)
        if text.isascii() and text.isdecimal() and len(text) < 4 and 1 <= int(text) <= MOST
        else None
    )


def processors(quota: Path = _QUOTA) -> int:
    """Return how many processors this process may use: its affinity, and the limit of its container."""
    allowed = len(os.sched_getaffinity(0))
    try:
        most, period = quota.read_text(encoding="ascii").split()
        limit = -(-int(most) // int(period)) if most != "max" else allowed
    except (OSError, ValueError, ZeroDivisionError):
        limit = allowed
    return max(1, min(allowed, limit))
