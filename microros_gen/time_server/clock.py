# SPDX-License-Identifier: Apache-2.0
"""A clock that is paused, runs at a speed, and is set, over one that is none of these."""

from __future__ import annotations

from collections.abc import Callable

NS_PER_S = 1_000_000_000
LATEST_S = (1 << 31) - 1
"""The last second that builtin_interfaces/msg/Time has."""
SLOWEST, FASTEST = 0.001, 1000.0
"""Speeds, seconds of this clock in a second."""


class SimulatedClock:
    """Nanoseconds of its time follow from `elapsed_ns`, a clock that never stops. The last second is the end."""

    def __init__(
        self, elapsed_ns: Callable[[], int], start_ns: int = 0, speed: float = 1.0, paused: bool = False
    ) -> None:
        """Begin at `start_ns`."""
        self._elapsed_ns = elapsed_ns
        self._since_ns, self._then_ns = elapsed_ns(), start_ns
        self._speed, self._paused = speed, paused

    @property
    def speed(self) -> float:
        """Return how many of its seconds are in one second while it is not paused."""
        return self._speed

    @property
    def paused(self) -> bool:
        """Return whether it stands still."""
        return self._paused

    def now_ns(self) -> int:
        """Return its time."""
        passed = 0 if self._paused else self._elapsed_ns() - self._since_ns
        exact = passed if self._speed == 1.0 else round(passed * self._speed)
        return min(self._then_ns + exact, LATEST_S * NS_PER_S)

    def change(
        self, time_ns: int | None = None, speed: float | None = None, paused: bool | None = None
    ) -> None:
        """Change what is not None, all at one moment. The time continues where it was unless it is set."""
        now_ns = self.now_ns() if time_ns is None else time_ns
        self._since_ns, self._then_ns = self._elapsed_ns(), now_ns
        self._speed = self._speed if speed is None else speed
        self._paused = self._paused if paused is None else paused
