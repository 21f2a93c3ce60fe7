# SPDX-License-Identifier: Apache-2.0
"""Memory budget of one kind (unfinished input, objects, histories), shared by all clients and connections.

Half of the total is first come, first served. The other half is divided equally among the possible holders, so greedy
holders leave the others their share.
"""

from __future__ import annotations


class InputPool:
    """At most `total` bytes for at most `holders` holders."""

    def __init__(self, total: int, holders: int) -> None:
        self.share = total // 2 // max(1, holders)
        self.free = total - self.share * holders
        """Free bytes of the common half; negative if holders took bytes that could not be refused."""
        self.held = 0
        """Bytes of all holders."""


class Holder:
    """The use of a pool by one client or connection; without a pool it is unlimited."""

    def __init__(self, pool: InputPool | None = None, most: int = 1 << 62) -> None:
        """Limit bytes that can be refused to `most`."""
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
        held = self.held + size
        if self._pool is None or (held <= self._pool.share and held <= self._most):  # asked for each fragment
            return True
        more = self._beyond(held) - self._beyond(self.held)
        return held <= self._most and more <= max(0, self._pool.free)

    def add(self, size: int) -> None:
        """Reserve `size` bytes that cannot be refused; release them if `size` is negative."""
        pool, before = self._pool, self.held
        after = self.held = before + size
        if pool is not None:
            pool.held += size
            if before > pool.share or after > pool.share:
                pool.free -= self._beyond(after) - self._beyond(before)

    def clear(self) -> None:
        """Release everything."""
        self.add(-self.held)

    def _beyond(self, size: int) -> int:
        """Return how many of `size` bytes exceed the holder's share."""
        return max(0, size - self._pool.share) if self._pool is not None else 0
