# SPDX-License-Identifier: Apache-2.0
"""Rates, sizes and delays of the last messages of a topic, with the lines that the ros2 command line prints.

Times are in nanoseconds.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

DEFAULT_RATE_WINDOW = 10_000
DEFAULT_SIZE_WINDOW = 100
_UNITS = ((1_000_000, "MB"), (1_000, "KB"))


class Intervals:
    """The times between messages."""

    def __init__(self, window: int = DEFAULT_RATE_WINDOW) -> None:
        """Keep the last `window` intervals."""
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None

    def add(self, now: int) -> None:
        """Add a message; where the clock went back, counting begins again."""
        if self._last is not None and now < self._last:
            self._intervals.clear()
        elif self._last is not None:
            self._intervals.append(now - self._last)
        self._last = now

    def text(self) -> str | None:
        """Return the rate and its spread; None before two messages arrived."""
        if not self._intervals:
            return None
        mean, deviation = _spread(self._intervals)
        rate = 1e9 / mean if mean else 0.0
        return f"average rate: {rate:.3f}\n{_limits(self._intervals, deviation)}"


class Delays:
    """The times from the stamp of each message to its arrival."""

    def __init__(self, window: int = DEFAULT_RATE_WINDOW) -> None:
        """Keep the last `window` delays."""
        self._delays: deque[int] = deque(maxlen=window)

    def add(self, now: int, stamp: int) -> None:
        """Add a message."""
        self._delays.append(now - stamp)

    def text(self) -> str | None:
        """Return the mean delay and its spread; None before a message arrived."""
        if not self._delays:
            return None
        mean, deviation = _spread(self._delays)
        return f"average delay: {mean * 1e-9:.3f}\n{_limits(self._delays, deviation)}"


class Bandwidth:
    """The sizes of messages."""

    def __init__(self, window: int = DEFAULT_SIZE_WINDOW) -> None:
        """Keep the last `window` messages."""
        self._messages: deque[tuple[int, int]] = deque(maxlen=window)

    def add(self, now: int, size: int) -> None:
        """Add a message of `size` bytes."""
        self._messages.append((now, size))

    def text(self, now: int) -> str | None:
        """Return bytes per second and sizes; None before two messages arrived."""
        if len(self._messages) < 2 or now <= self._messages[0][0]:
            return None
        sizes = [size for _, size in self._messages]
        rate = sum(sizes) / ((now - self._messages[0][0]) * 1e-9)
        shown = [_size(value, rate) for value in (rate, sum(sizes) / len(sizes), min(sizes), max(sizes))]
        return (
            f"{shown[0]}/s from {len(sizes)} messages\n"
            f"\tMessage size mean: {shown[1]} min: {shown[2]} max: {shown[3]}"
        )


def _spread(values: Sequence[int]) -> tuple[float, float]:
    """Return mean and standard deviation."""
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))


def _limits(values: Sequence[int], deviation: float) -> str:
    low, high = min(values) * 1e-9, max(values) * 1e-9
    return f"\tmin: {low:.3f}s max: {high:.3f}s std dev: {deviation * 1e-9:.5f}s window: {len(values)}"


def _size(count: float, rate: float) -> str:
    """Return a number of bytes in the unit that fits the rate, so that all sizes of a line have the same."""
    for factor, unit in _UNITS:
        if rate >= factor:
            return f"{count / factor:.2f} {unit}"
    return f"{count:.0f} B"
