# SPDX-License-Identifier: Apache-2.0
"""What waits for a stream that takes less than it is given: whole frames, not more than a limit."""

from __future__ import annotations

import os
from collections import deque
from itertools import islice

_AT_ONCE = 64  # frames for one system call; POSIX lets a system stop at 16, Linux at 1,024


class Outbox:
    """Frames in order; one that the limit has no room for is not taken, so the stream stays well-formed."""

    def __init__(self, limit: int) -> None:
        """Hold at most `limit` bytes."""
        self._limit = limit
        self._frames: deque[bytes] = deque()
        self._bytes = 0

    def __bool__(self) -> bool:
        return bool(self._frames)

    def put(self, frame: bytes) -> bool:
        """Add a frame, or the rest of one; False when there is no room for it."""
        if self._bytes + len(frame) > self._limit:
            return False
        self._frames.append(frame)
        self._bytes += len(frame)
        return True

    def write(self, descriptor: int) -> bool:
        """Write what the descriptor takes without waiting; return whether it took anything. OSError: it is broken."""
        before = self._bytes
        while self._frames:
            try:
                done = os.writev(descriptor, list(islice(self._frames, _AT_ONCE)))
            except BlockingIOError:
                break
            self._bytes -= done
            while done:
                first = self._frames[0]
                if done < len(first):
                    self._frames[0] = first[done:]
                    break
                done -= len(first)
                self._frames.popleft()
        return self._bytes < before

    def clear(self) -> None:
        """Forget everything."""
        self._frames.clear()
        self._bytes = 0
