# SPDX-License-Identifier: Apache-2.0
"""Output queue of a stream that is slower than its input: whole frames, up to a limit in bytes.

Of best-effort samples, only the newest wait, so that sent samples are recent, and acknowledgements, answers and
reliable samples find room. When the queue is full, new frames of these kinds are refused: their receivers request them
again.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from itertools import islice

from microros_gen.agent.input_pool import Holder
from microros_gen.agent.wire.constants import STREAM_NONE, STREAM_RELIABLE, SubmessageId

SHARE = 8
"""Best-effort samples take at most this part (1/8) of the room."""
DATA = int(SubmessageId.DATA)
_AT_ONCE = 64  # frames for one system call; POSIX lets a system stop at 16, Linux at 1,024


class SealedRecord(bytes):
    """A sealed message, which says itself whether its message is a best-effort sample."""

    is_sample = False


class SealedSample(SealedRecord):
    """One with a best-effort sample in it."""

    is_sample = True


class Refusal(bytes):
    """A message to somebody whose message was not accepted: it is no sign that the sender is a client."""


def is_sample(message: bytes) -> bool:
    """Return whether a message of the agent is a best-effort sample, which a newer one replaces."""
    if isinstance(message, SealedRecord):
        return message.is_sample
    if isinstance(message, Refusal):
        return False
    start = 4 if message[0] >= 0x80 else 8
    return STREAM_NONE < message[1] < STREAM_RELIABLE and message[start : start + 1] == bytes((DATA,))


class Outbox:
    """Queue of frames; a frame beyond the limit is refused as a whole, so the stream stays well-formed."""

    def __init__(self, limit: int, dropped: Callable[[], None], holder: Holder | None = None) -> None:
        """Store at most `limit` bytes, within the budget of `holder`; call `dropped` for each replaced sample."""
        self._limit = limit
        self._holder = holder or Holder()
        self._dropped = dropped
        self._frames: deque[bytes] = deque()
        self._samples: deque[bool] = deque()
        """Whether each of the frames is a best-effort sample."""
        self._bytes = 0
        self._sample_bytes = 0

    def __bool__(self) -> bool:
        return bool(self._frames)

    def put(self, frame: bytes, sample: bool = False) -> bool:
        """Add a frame, or the rest of one; False when it does not fit. `sample`: see `is_sample`."""
        size = len(frame)
        while sample and self._sample_bytes and self._sample_bytes + size > self._limit // SHARE:
            self._drop_oldest()
        while self._sample_bytes and self._bytes + size > self._limit:
            self._drop_oldest()
        if self._bytes + size > self._limit or (self._frames and not self._holder.has_room(size)):
            return False
        self._holder.add(size)  # always for the first one, which may be the rest of a partly sent frame
        self._frames.append(frame)
        self._samples.append(sample)
        self._bytes += size
        self._sample_bytes += size if sample else 0
        return True

    def write(self, descriptor: int) -> bool:
        """Write what the descriptor accepts without waiting; return whether it accepted anything. Raises OSError."""
        before = self._bytes
        while self._frames:
            try:
                done = os.writev(descriptor, list(islice(self._frames, _AT_ONCE)))
            except BlockingIOError:
                break
            self._bytes -= done
            self._holder.add(-done)
            while done:
                first = self._frames[0]
                if self._samples[0]:  # partly sent, so it is not dropped any more
                    self._samples[0] = False
                    self._sample_bytes -= len(first)
                if done < len(first):
                    self._frames[0] = first[done:]
                    break
                done -= len(first)
                self._frames.popleft()
                self._samples.popleft()
        return self._bytes < before

    def clear(self) -> None:
        """Drop everything."""
        self._frames.clear()
        self._samples.clear()
        self._holder.clear()
        self._bytes = self._sample_bytes = 0

    def _drop_oldest(self) -> None:
        place = self._samples.index(True)
        size = len(self._frames[place])
        del self._frames[place], self._samples[place]
        self._bytes -= size
        self._holder.add(-size)
        self._sample_bytes -= size
        self._dropped()
