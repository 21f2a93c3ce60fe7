# SPDX-License-Identifier: Apache-2.0
"""Streams to a client (DDS-XRCE 1.0, 8.4): they number messages; reliable ones repeat them until acknowledged."""

from __future__ import annotations

from collections import deque
from typing import Final

from microros_gen.agent.input_pool import Holder
from microros_gen.agent.output_queue import Queue
from microros_gen.agent.streams_in import HALF
from microros_gen.agent.wire.constants import FLAG_LAST_FRAGMENT, FLAG_LITTLE, RELIABLE_WINDOW, SubmessageId
from microros_gen.agent.wire.entity_messages import Heartbeat
from microros_gen.agent.wire.message import SUBMESSAGE_HEADER, header_bytes
from microros_gen.records import dataclass

HEARTBEAT_PERIOD_S: Final = 0.2
"""Minimum seconds that a message waits for its acknowledgement before a HEARTBEAT requests it."""
SILENT_PERIOD_S, SLOW_PERIOD_S = 1.0, 5.0
"""The maximum, for silent clients and slow answers."""

NEVER: Final = float("-inf")
STEP_BYTES: Final = 4_096
"""Bytes that a stream may use without a reservation in the budget of all clients."""
FRAGMENT: Final = int(SubmessageId.FRAGMENT)
MANY: Final = 512
"""Number of messages over which the rate of repetitions is measured."""
REPEAT_S: Final = 0.01
"""Minimum seconds between two repetitions of a message."""

Kept = tuple[int, tuple[bytes, ...]]
"""The object and the samples of a submessage, stored until all of it is acknowledged."""


@dataclass(frozen=True)
class Link:
    """Common data of all messages to one client: session id, client key, largest message in bytes."""

    session: int
    key: bytes
    mtu: int

    def header(self, stream: int, sequence: int) -> bytes:
        """Return a message header."""
        return header_bytes(self.session, stream, sequence, self.key)

    def room(self) -> int:
        """Return the number of bytes of submessages, with their headers, that fit into one message."""
        return self.mtu - (4 if self.session >= 0x80 else 8)


class BestEffortOut:
    """Best-effort stream: numbers messages and stores none."""

    def __init__(self, link: Link, stream: int) -> None:
        self._link = link
        self._stream = stream
        self._sequence = 0
        self._room = link.room()

    def has_room(self) -> bool:
        """Return whether a submessage is accepted: always."""
        return True

    def may_take(self, size: int) -> bool:
        """Return whether a submessage of `size` bytes is not too large."""
        return size <= self._room

    def push(self, submessage: bytes, now: float = 0.0, kept: Kept | None = None) -> list[bytes] | None:
        """Return the message with `submessage`, or None if it does not fit into one message."""
        if len(submessage) > self._room:
            return None
        message = self._link.header(self._stream, self._sequence) + submessage
        self._sequence = (self._sequence + 1) & 0xFFFF
        return [message]

    def acknowledge(self, first: int, missing: int, now: float) -> list[bytes]:
        """Ignore an ACKNACK, which has no meaning here."""
        return []

    def asks(self, now: float) -> bool:
        """Return whether a HEARTBEAT is due: never."""
        return False

    def heartbeat(self, now: float) -> Heartbeat | None:
        """Return the HEARTBEAT that is due: none."""
        return None


class ReliableOut:
    """Reliable stream: a window of unacknowledged messages, followed by a backlog of at most `backlog_bytes`.

    A submessage of up to `largest` bytes is accepted if the backlog is empty.
    """

    def __init__(
        self, link: Link, stream: int, backlog_bytes: int, largest: int = 0, holder: Holder | None = None
    ) -> None:
        """Use `holder` as the budget of all clients; one submessage may wait in any case."""
        self._holder = holder or Holder()
        self._bytes = 0
        """Bytes in the window and the backlog, samples included; `_told` of them are reserved at the holder."""
        self._reported = 0
        self._link = link
        header = link.header(0, 0)
        self._head = len(header)
        self._before, self._after = bytes((link.session, stream)), header[4:]
        """The parts of a message header before and after the sequence number."""
        self._part = (link.room() - SUBMESSAGE_HEADER) & ~3
        """Number of bytes in each FRAGMENT but the last, and its header."""
        self._part_head = _fragment_head(self._part, 0) if 0 < self._part <= 0xFFFF else b""
        self.stream = stream
        self._sequence = 0
        self._unacknowledged: deque[bytes] = deque()
        self._backlog: deque[bytes] = deque()
        self._kept: deque[tuple[int, Kept, int]] = deque()
        """Each with the number of messages sent up to its last one, and its bytes."""
        self._backlog_bytes = 0
        self._backlog_limit = backlog_bytes
        self._largest = max(largest, backlog_bytes)
        self._room = link.room()
        self._heartbeat_at = 0.0
        self._round_trip = 0.0
        self._pause_s = self._pause()
        """Seconds to wait for an answer of a client that was not silent before."""
        self._timed: tuple[int, float] | None = None
        """Number and time of a message whose acknowledgement will measure the round trip."""
        self._progress_at = 0.0
        self._numbered = 0
        """Number of messages sent, and of repetitions among recent ones."""
        self._recent = 0
        self._again = 0
        self.resent = 0
        """Messages that were sent again, of all."""
        self._repeated: dict[int, float] = {}
        """When messages of the window were sent again."""

    def has_room(self) -> bool:
        """Return whether the next submessage, if it fits into one message, would be sent at once."""
        if self._backlog or len(self._unacknowledged) >= RELIABLE_WINDOW:
            return False
        return self._bytes < STEP_BYTES or self._holder.has_room(STEP_BYTES)

    def may_take(self, size: int) -> bool:
        """Return whether a submessage of `size` bytes is not too large, whether or not it is accepted now."""
        return size <= self._largest

    def push(self, submessage: bytes, now: float, kept: Kept | None = None) -> list[bytes] | None:
        """Accept a submessage of any size; return the messages to send now, or None if there is no space.

        `undelivered` returns `kept` until the client has acknowledged all of the submessage.
        """
        size = len(submessage)
        if self._bytes + size > STEP_BYTES and self._bytes and not self._holder.has_room(size):
            return None
        if size <= self._room and not self._backlog and len(self._unacknowledged) < RELIABLE_WINDOW:
            message = self._number(submessage, now)
            if kept is not None:
                self._kept.append((self._numbered, kept, size))
                size += size
            self._bytes += size
            if self._bytes - self._reported >= STEP_BYTES:
                self._report()
            return [message]
        if self._backlog_bytes + size > (self._backlog_limit if self._backlog else self._largest):
            return None
        fragments = self._fragments(submessage) if size > self._room else [submessage]
        taken = sum(map(len, fragments))
        self._backlog.extend(fragments)
        self._backlog_bytes += taken
        if kept is not None:
            self._kept.append((self._numbered + len(self._backlog), kept, size))
            taken += size
        self._bytes += taken
        self._report()
        return self._release(now)

    def acknowledge(self, first: int, missing: int, now: float) -> list[bytes]:
        """Process an ACKNACK; return the messages to send: the missing ones, then waiting ones that now fit."""
        done = (first - self._first()) & 0xFFFF
        if done > len(self._unacknowledged):
            return []  # older than the last ACKNACK, or never sent
        if done:
            unacknowledged, kept = self._unacknowledged, self._kept
            size = -done * self._head
            for _ in range(done):
                size += len(unacknowledged.popleft())
            arrived = self._numbered - len(unacknowledged)
            while kept and kept[0][0] <= arrived:
                size += kept.popleft()[2]
            self._bytes -= size
            if self._reported - self._bytes >= STEP_BYTES:
                self._report()
            self._went_on(first, now)
        again = self._repeat(first, missing, now) if missing else []
        return again + self._release(now) if self._backlog else again

    def _went_on(self, first: int, now: float) -> None:
        """Record that the client has received everything before `first`."""
        if self._timed is not None and 0 < (first - self._timed[0]) & 0xFFFF < HALF:
            self._round_trip, self._timed = now - self._timed[1], None
            self._pause_s = self._pause()
        self._progress_at = now
        self._heartbeat_at = now + self._pause_s

    def _pause(self, silent: float = 0.0) -> float:
        """Return the seconds to wait for an answer: more than the last round trip and a quarter of the silence."""
        slow = min(1.5 * self._round_trip, SLOW_PERIOD_S)
        return max(HEARTBEAT_PERIOD_S, slow, min(silent / 4, SILENT_PERIOD_S))

    def _repeat(self, first: int, missing: int, now: float) -> list[bytes]:
        """Return the messages to send again, without those just sent: a client names all missing ones each time."""
        again = []
        repeated: dict[int, float] = {}
        for i, message in enumerate(self._unacknowledged):
            sequence = (first + i) & 0xFFFF
            before = self._repeated.get(sequence, NEVER)
            if missing >> i & 1 and now - before >= max(REPEAT_S, 0.8 * self._round_trip):
                self._timed = None  # its acknowledgement covers this message, or comes with this one's
                again.append(message)
                before = now
            repeated[sequence] = before
        self._repeated = repeated
        self._again += len(again)
        self.resent += len(again)
        return again

    @property
    def queue(self) -> Queue:
        """What waits: for an acknowledgement, or to be sent."""
        waiting = len(self._unacknowledged) + len(self._backlog)
        window = len(self._unacknowledged) / RELIABLE_WINDOW
        return Queue(
            waiting, self._bytes, max(window, min(1.0, self._backlog_bytes / max(1, self._backlog_limit)))
        )

    @property
    def round_trip_s(self) -> float | None:
        """Seconds from a message to its acknowledgement, as last measured; None: never."""
        return self._round_trip or None

    def repeated_part(self) -> float:
        """Return the fraction of recent messages that were sent again, 0 to 1; 0 after few messages."""
        sent = self._numbered - self._recent + self._again
        part = self._again / sent if sent >= RELIABLE_WINDOW else 0.0
        if sent >= MANY:  # old messages count less
            self._recent += (self._numbered - self._recent) // 2
            self._again //= 2
        return part

    def asks(self, now: float) -> bool:
        """Return whether a HEARTBEAT is due at `now` (seconds, monotonic)."""
        return bool(self._unacknowledged) and now >= self._heartbeat_at

    def heartbeat(self, now: float) -> Heartbeat | None:
        """Return the HEARTBEAT that is due at `now` (seconds, monotonic), if one is."""
        if not self.asks(now):
            return None
        self._heartbeat_at = now + self._pause(now - self._progress_at)
        return self.probe()

    def probe(self) -> Heartbeat:
        """Return a HEARTBEAT, even if there is nothing to repeat: a client answers it with an ACKNACK."""
        return Heartbeat(self._first(), (self._sequence - 1) & 0xFFFF, self.stream)

    def _first(self) -> int:
        return (self._sequence - len(self._unacknowledged)) & 0xFFFF

    def last_acknowledged(self) -> int:
        """Return the sequence number before the first message that is not acknowledged."""
        return (self._first() - 1) & 0xFFFF

    def undelivered(self) -> list[Kept]:
        """Return the samples that the client has not acknowledged completely, in order."""
        return [kept for _, kept, _ in self._kept]

    def _report(self) -> None:
        """Reserve the stored bytes at the holder, in steps, since they change with each message."""
        self._holder.add(self._bytes - self._reported)
        self._reported = self._bytes

    def _release(self, now: float) -> list[bytes]:
        released = []
        while self._backlog and len(self._unacknowledged) < RELIABLE_WINDOW:
            body = self._backlog.popleft()
            self._backlog_bytes -= len(body)
            released.append(self._number(body, now))
        return released

    def _number(self, body: bytes, now: float) -> bytes:
        message = self._before + self._sequence.to_bytes(2, "little") + self._after + body
        self._sequence = (self._sequence + 1) & 0xFFFF
        if not self._unacknowledged:
            self._progress_at = now
            self._heartbeat_at = now + self._pause_s
        if self._timed is None:
            self._timed = (self._sequence - 1) & 0xFFFF, now
        self._numbered += 1
        self._unacknowledged.append(message)
        return message

    def _fragments(self, submessage: bytes) -> list[bytes]:
        size, head = self._part, self._part_head
        rest = (len(submessage) - 1) // size * size
        fragments = [head + submessage[at : at + size] for at in range(0, rest, size)]
        fragments.append(_fragment_head(len(submessage) - rest, FLAG_LAST_FRAGMENT) + submessage[rest:])
        return fragments


def _fragment_head(size: int, last: int) -> bytes:
    """Return the header of a FRAGMENT with `size` bytes (at most 65,535); `last`: FLAG_LAST_FRAGMENT or 0."""
    return bytes((FRAGMENT, FLAG_LITTLE | last, size & 0xFF, size >> 8))


assert RELIABLE_WINDOW < HALF
