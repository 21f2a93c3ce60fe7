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

    def take(self, now: float) -> bool:
        """Count one more operation if it is within the rate at `now` (s of a monotonic clock); return whether it is."""
        most = self._per_second * BURST_S
        self._credit = min(most, self._credit + max(0.0, now - self._at) * self._per_second)
        self._at = now
        if self._credit < 1:
            return False
        self._credit -= 1
        return True


class Rates:
    """Rates by client key, at most `limit`. They outlast the client's session."""

    def __init__(self, per_second: int, limit: int) -> None:
        self._per_second = per_second
        self._limit = limit
        self._by_key: dict[bytes, Rate] = {}

    def of(self, key: bytes) -> Rate:
        """Return the rate of a key."""
        rate = self._by_key.pop(key, None) or Rate(self._per_second)
        self._by_key[key] = rate
        if len(self._by_key) > self._limit:
            del self._by_key[next(iter(self._by_key))]
        return rate
