# SPDX-License-Identifier: Apache-2.0
"""Where the next block of a recording goes: of one process, or of several that write the same file in turn.

Several share a page of memory that has no name. Its lock belongs to the process, so one that is killed leaves it; and
what such a process had written of a block is removed by the next one.
"""

from __future__ import annotations

import fcntl
import mmap
import os
import struct
import time

_U64 = struct.Struct("=Q")
_SIZE, _WRITES, _COUNTS = 0, 8, 16
MOST_WRITERS = 65
_LENGTH = _COUNTS + MOST_WRITERS * 2 * _U64.size
"""Bytes: size, whether it is being written, and for each process what it has written and lost."""
WAIT_S = 2.0
"""Seconds that a writer waits for the others: on a busy machine the system lets one wait in its turn, and nothing is to
be lost then; but one that was stopped must not stop all."""
AGAIN_S = 30.0
"""Seconds until it waits again after that was not enough; a turn that it gets ends this."""
_QUICK = 50
"""Attempts without a pause: another one is done within some microseconds."""


class End:
    """The end of the whole blocks of a file that one process writes, and its counts."""

    def __init__(self) -> None:
        self._memory: bytearray | mmap.mmap = bytearray(_LENGTH)
        self._written_at = _COUNTS

    @property
    def size(self) -> int:
        """Bytes of the blocks that are whole."""
        return self._get(_SIZE)

    @size.setter
    def size(self, value: int) -> None:
        self._set(_SIZE, value)

    @property
    def is_cut(self) -> bool:
        """Whether more than that may be in the file."""
        return bool(self._get(_WRITES))

    @is_cut.setter
    def is_cut(self, value: bool) -> None:
        self._set(_WRITES, value)

    def count(self, is_written: bool) -> None:
        """Count a message that the file took, or did not."""
        at = self._written_at + (0 if is_written else _U64.size)
        self._set(at, self._get(at) + 1)

    @property
    def totals(self) -> tuple[int, int]:
        """Messages written and lost, of all processes."""
        counts = [self._get(at) for at in range(_COUNTS, _LENGTH, _U64.size)]
        return sum(counts[::2]), sum(counts[1::2])

    def acquire(self) -> bool:
        """Begin to write; return whether this is possible now."""
        return True

    def release(self) -> None:
        """End to write."""

    def _get(self, at: int) -> int:
        value: int = _U64.unpack_from(self._memory, at)[0]
        return value

    def _set(self, at: int, value: int) -> None:
        _U64.pack_into(self._memory, at, value)


class SharedEnd(End):
    """The same, for one of several processes."""

    def __init__(self, writer: int, descriptor: int | None = None) -> None:
        """Be the process `writer` (from 0); the memory is that of `descriptor`, or is made. Raises OSError."""
        super().__init__()
        if descriptor is None:
            descriptor = os.memfd_create("recording")
            os.ftruncate(descriptor, _LENGTH)
        self.descriptor = descriptor
        self._memory = mmap.mmap(descriptor, _LENGTH)
        self._written_at = _COUNTS + writer * 2 * _U64.size
        self._again_at = 0.0

    def acquire(self) -> bool:
        """See End."""
        attempts, end = 0, 0.0
        while True:
            try:
                fcntl.lockf(self.descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                attempts += 1
                now = time.monotonic()
                end = end or now + WAIT_S
                if now < self._again_at:
                    return False
                if now > end:
                    self._again_at = now + AGAIN_S
                    return False
                time.sleep(0 if attempts < _QUICK else 0.001)
            else:
                self._again_at = 0.0
                return True

    def release(self) -> None:
        """See End."""
        fcntl.lockf(self.descriptor, fcntl.LOCK_UN)
