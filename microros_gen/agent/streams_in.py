# SPDX-License-Identifier: Apache-2.0
"""Streams from a client (DDS-XRCE 1.0, 8.4): best effort drops old messages, reliable restores the order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from microros_gen.agent.input_pool import Holder
from microros_gen.agent.wire.constants import RELIABLE_WINDOW
from microros_gen.agent.wire.errors import MalformedError

HALF: Final = 0x8000
"""Sequence numbers are modulo 2^16: a difference of this or more means 'older'."""


class BestEffortIn:
    """Best-effort stream: accepts each message newer than the last one; gaps are losses."""

    def __init__(self) -> None:
        self._last: int | None = None
        self.lost = 0
        """Messages that a later one overtook."""

    def accept(self, sequence: int) -> bool:
        """Return whether the message is newer and has to be processed."""
        if self._last is not None:
            ahead = (sequence - self._last) & 0xFFFF
            if ahead == 0 or ahead >= HALF:
                return False
            self.lost += ahead - 1
        self._last = sequence
        return True


class ReliableIn:
    """Reliable stream: returns each message once, in order; stores up to `hold_bytes` bytes of messages after a gap.

    `holder` limits the bytes together with those of other clients.
    """

    def __init__(self, hold_bytes: int, holder: Holder | None = None) -> None:
        self._holder = holder or Holder()
        self.next = 0
        self.lost = 0
        """Messages that the sender abandoned before they arrived."""
        self.repeated = 0
        """Messages that arrived again."""
        self._announced = 0  # messages from `next` on that are known to exist
        self._held: dict[int, bytes] = {}
        self._held_bytes = 0
        self._hold_bytes = hold_bytes
        self._stopped = False

    @property
    def stopped(self) -> bool:
        """Whether it was stopped and not continued yet."""
        return self._stopped

    def stop(self, followers: Sequence[bytes]) -> None:
        """Stop acknowledging: the caller could not finish a message, and passes back its `followers`.

        No message is returned until `go_on`; those that arrive meanwhile are stored as after a gap.
        """
        self._stopped = True
        returned = (b"", *followers)  # the caller keeps the first
        self.next = (self.next - len(returned)) & 0xFFFF
        self._announced = min(self._announced + len(returned), RELIABLE_WINDOW)
        for i, message in enumerate(returned):
            self._held[(self.next + i) & 0xFFFF] = message
            self._count(len(message))

    def go_on(self) -> tuple[bytes, ...]:
        """Return the messages after the one at which it was stopped; the caller continues that one itself."""
        self._stopped = False
        del self._held[self.next]
        self._advance()
        return self._ready()

    def push(self, sequence: int, data: bytes) -> tuple[bytes, ...]:
        """Add a message; return those that can be processed now, in order. Duplicates are dropped."""
        if sequence == self.next and not self._stopped:
            self._advance()
            return (data, *self._ready()) if self._held else (data,)
        ahead = (sequence - self.next) & 0xFFFF
        if ahead >= RELIABLE_WINDOW or sequence in self._held:
            self.repeated += ahead >= HALF or sequence in self._held
            return ()
        self._announced = max(self._announced, ahead + 1)
        if self._held_bytes + len(data) <= self._hold_bytes and self._holder.take(len(data)):
            self._held[sequence] = data
            self._held_bytes += len(data)
        return ()  # a message that is not stored is not acknowledged, so the client sends it again

    def announce(self, first: int, last: int) -> tuple[tuple[bytes, ...], bool]:
        """Process a HEARTBEAT: the sender can repeat messages `first` to `last` and no earlier ones.

        Return the messages to process now, and whether missing messages were skipped.
        """
        skip = (first - self.next) & 0xFFFF
        lost = 0 < skip < HALF
        if lost:
            self._skip_to(first, skip)
        ready = self._ready()
        known = (last - self.next + 1) & 0xFFFF
        if known < HALF:
            self._announced = max(self._announced, min(known, RELIABLE_WINDOW))
        return ready, lost

    def missing(self, unfinished: int = 0) -> tuple[int, int]:
        """Return the content of an ACKNACK: the first unacknowledged message, and a bit for each missing one.

        The last `unfinished` messages (0 to the window) that were returned are neither acknowledged nor missing.
        """
        bitmap = 0
        for i in range(self._announced):
            if (self.next + i) & 0xFFFF not in self._held:
                bitmap |= 1 << i
        return (self.next - unfinished) & 0xFFFF, bitmap << unfinished & 0xFFFF

    def _ready(self) -> tuple[bytes, ...]:
        if self._stopped:
            return ()
        ready = []
        while (data := self._held.pop(self.next, None)) is not None:
            self._count(-len(data))
            self._advance()
            ready.append(data)
        return tuple(ready)

    def _skip_to(self, first: int, skip: int) -> None:
        self._stopped = False
        overtaken = [s for s in self._held if (s - self.next) & 0xFFFF < skip]
        self.lost += skip - len(overtaken)
        for sequence in overtaken:
            self._count(-len(self._held.pop(sequence)))
        self.next = first
        self._announced = max(0, self._announced - skip)

    def forget(self) -> None:
        """Drop messages after a gap: the client sends them again."""
        if not self._stopped:
            for data in self._held.values():
                self._count(-len(data))
            self._held.clear()

    def _count(self, size: int) -> None:
        self._held_bytes += size
        self._holder.add(size)

    def _advance(self) -> None:
        self.next = (self.next + 1) & 0xFFFF
        if self._announced:
            self._announced -= 1


class Reassembly:
    """Reassembly of the FRAGMENTs of one reliable stream, of up to `limit` bytes, within the budget of `holder`."""

    def __init__(self, limit: int, holder: Holder | None = None) -> None:
        self._holder = holder or Holder()
        self._limit = limit
        self._received = bytearray()
        self._refusing = False

    def add(self, fragment: bytes, last: bool) -> bytes | None:
        """Add a fragment; return the complete message with the last one, else None.

        Raises MalformedError once per message that exceeds the limit or the budget; all of its fragments are dropped.
        """
        if self._refusing:
            self._refusing = not last
            return None
        if len(self._received) + len(fragment) > self._limit:
            self._refuse(last)
            raise MalformedError("fragments_too_large", f"more than {self._limit} bytes")
        if not self._holder.take(len(fragment)):
            self._refuse(last)
            raise MalformedError("input_full", "no room for fragments: all clients together use too much")
        self._received += fragment
        if not last:
            return None
        whole = bytes(self._received)
        self._forget()
        return whole

    @property
    def unfinished(self) -> bool:
        """Whether a message is incomplete."""
        return bool(self._received)

    def drop(self) -> None:
        """Drop the collected fragments, since a message between them is lost; later ones are dropped, too."""
        self._refuse(last=False)

    def _refuse(self, last: bool) -> None:
        self._forget()
        self._refusing = not last

    def _forget(self) -> None:
        self._holder.add(-len(self._received))
        self._received = bytearray()
