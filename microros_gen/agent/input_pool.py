# SPDX-License-Identifier: Apache-2.0
"""What one kind of thing (unfinished input, objects, histories) takes of all clients and connections together.

Half of the total is for whoever comes first. The other half is divided: each holder has its share for itself, so those
who take all that they can get keep nobody else from having something.
"""

from __future__ import annotations


class InputPool:
    """At most `total` bytes for at most `holders` holders."""

    def __init__(self, total: int, holders: int) -> None:
        self.share = total // 2 // max(1, holders)
        self.free = total - self.share * holders
        """Bytes without an owner; below 0 when holders took bytes that could not be refused."""


class Holder:
    """What one client or connection uses of a pool; without a pool it is not limited."""

    def __init__(self, pool: InputPool | None = None, most: int = 1 << 62) -> None:
        """Use at most `most` bytes of what can be refused."""
        self._pool = pool
        self._most = most
        self.held = 0

    def take(self, size: int) -> bool:
        """Reserve `size` more bytes; return False if they do not fit."""
        if not self.has_room(size):
            return False
        self.add(size)
        return True

    def has_room(self, size: int) -> bool:
        """Return whether `take` would reserve `size` bytes."""
        if self._pool is None:
            return True
        more = self._beyond(self.held + size) - self._beyond(self.held)
        return self.held + size <= self._most and more <= max(0, self._pool.free)

    def add(self, size: int) -> None:
        """Reserve `size` bytes that cannot be refused; release them if `size` is negative."""
        before, self.held = self._beyond(self.held), self.held + size
        if self._pool is not None:
            self._pool.free -= self._beyond(self.held) - before

    def clear(self) -> None:
        """Release everything."""
        self.add(-self.held)

    def _beyond(self, size: int) -> int:
        """Return how much of `size` is beyond the share."""
        return max(0, size - self._pool.share) if self._pool is not None else 0
