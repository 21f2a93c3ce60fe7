# SPDX-License-Identifier: Apache-2.0
"""Rate limits of expensive operations: create, delete, and messages outside of a session."""

from __future__ import annotations

BURST_S = 10.0
"""Seconds whose unused operations may be used in one burst."""


class Rate:
    """A number of operations per second, on average."""

    def __init__(self, per_second: int) -> None:
        self._per_second = per_second
        self._credit = per_second * BURST_S
        self._at = 0.0

    def set(self, per_second: int) -> None:
        """Change the number per second."""
        if per_second != self._per_second:
            self._per_second = per_second
            self._credit = min(self._credit, per_second * BURST_S)

    def take(self, now: float) -> bool:
        """Count one more operation if it is within the rate at `now` (s of a monotonic clock); return whether it is."""
        most = self._per_second * BURST_S
        self._credit = min(most, self._credit + max(0.0, now - self._at) * self._per_second)
        self._at = now
        if self._credit < 1:
            return False
        self._credit -= 1
        return True


class WorkRate:
    """Time of the agent for one client, per second."""

    def __init__(self, ms_per_second: float) -> None:
        self.ms_per_second = ms_per_second
        self._share = ms_per_second / 1000
        self._left = self._share
        self._at = 0.0

    def allows(self, now: float) -> bool:
        """Return whether time is left at `now` (s of a monotonic clock)."""
        self._refill(now)
        return self._left > 0

    def charge(self, seconds: float, now: float) -> None:
        """Subtract work that ended at `now`; a long piece of it is owed for ten seconds at most."""
        self._refill(now)
        self._left = max(-BURST_S * self._share, self._left - seconds)

    def _refill(self, now: float) -> None:
        self._left = min(self._share, self._left + max(0.0, now - self._at) * self._share)
        self._at = now


class Rates:
    """Rates by client key, at most `limit`. They outlast the client's session."""

    def __init__(self, per_second: int, limit: int) -> None:
        self._per_second = per_second
        self._limit = limit
        self._by_key: dict[bytes, Rate] = {}

    def of(self, key: bytes, per_second: int | None = None) -> Rate:
        """Return the rate of a key, of `per_second` operations instead of the default."""
        wanted = self._per_second if per_second is None else per_second
        rate = self._by_key.pop(key, None) or Rate(wanted)
        rate.set(wanted)
        self._by_key[key] = rate
        if len(self._by_key) > self._limit:
            del self._by_key[next(iter(self._by_key))]
        return rate
