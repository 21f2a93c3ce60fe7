# SPDX-License-Identifier: Apache-2.0
"""One client of the soak: a session with reliable streams both ways, which waits for nothing."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from microros_gen.agent.wire.constants import OBJECT_CLIENT, SubmessageId
from microros_gen.agent.wire.data_messages import Data
from microros_gen.agent.wire.entity_messages import Acknack, Delete, Fragment, Heartbeat, StatusReply
from microros_gen.agent.wire.message import Header, header_size, join, split
from microros_gen.agent.wire.session_messages import CreateClient, StatusAgent
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent.soak_links import Link

RELIABLE = 0x80
WINDOW = 16
BEAT_S = 0.3


class SoakClient:
    """Sends and takes; who drives it looks at `statuses`, `connected` and what `on_data` was given."""

    def __init__(self, key: int, session: int, mtu: int, on_data: Callable[[Data], None]) -> None:
        self.key = key.to_bytes(4, "big")
        self.session = session
        self.mtu = mtu
        self.on_data = on_data
        self.link: Link | None = None
        self.deaf = False
        self._request = 0
        self._reset()

    def _reset(self) -> None:
        self.connected = self._leaving = False
        self.statuses: dict[int, int] = {}
        self._sequence = 0
        self._sent: deque[tuple[int, bytes]] = deque()
        self._queue: deque[bytes] = deque()
        self._beat_at = 0.0
        self._next_in = 0
        self._held: dict[int, bytes] = {}
        self._fragments = b""

    @property
    def acknowledged(self) -> bool:
        """Whether the agent has everything."""
        return not self._sent and not self._queue

    def introduce(self) -> None:
        """Open the session with a new state."""
        self._reset()
        key = self.key if self.session < 0x80 else b""
        hello = encode(CreateClient(self.key, self.session, self.mtu))
        self._send(join(Header(self.session & 0x80, 0, 0, key), [hello]))

    def ask(self, make: Callable[[int], Submessage]) -> int:
        """Send what `make` gives for a request number; return the number."""
        self._request = self._request % 0xFFFF + 1
        self._push(encode(make(self._request)))
        return self._request

    def leave(self) -> int:
        """Delete the client; return the request number."""
        self._request = self._request % 0xFFFF + 1
        self._leaving = True  # what it heard before may be answered too late: when the session is gone
        self._send(join(self._head(0, 0), [encode(Delete(self._request, OBJECT_CLIENT))]))
        return self._request

    def tick(self, now: float) -> None:
        """Say again what is not acknowledged."""
        if self._sent and now >= self._beat_at and self.connected:
            self._beat_at = now + BEAT_S
            beat = Heartbeat(self._sent[0][0], self._sent[-1][0], RELIABLE)
            self._send(join(self._head(0, 0), [encode(beat)]))

    def hear(self, data: bytes) -> None:
        """Take one message of the agent."""
        if self.deaf:
            return
        head = Header.decode(data)
        if head.session != self.session:
            return
        if not self.connected and data[header_size(data)] != SubmessageId.STATUS_AGENT:
            return  # meant for the one before, which had the same address, key and session id
        if head.stream >= RELIABLE:
            ahead = (head.sequence - self._next_in) & 0xFFFF
            if ahead < WINDOW:
                self._held[head.sequence] = data
            while (ready := self._held.pop(self._next_in, None)) is not None:
                self._next_in = (self._next_in + 1) & 0xFFFF
                self._take(ready, header_size(ready))
            self._acknowledge()
        else:
            self._take(data, header_size(data))

    def _take(self, data: bytes, start: int) -> None:
        for identifier, flags, at, end in split(data, start, rest_when_zero=start == 0):
            self._handle(decode(identifier, flags, data, at, end))

    def _handle(self, submessage: Submessage) -> None:
        if isinstance(submessage, Data):
            self.on_data(submessage)
        elif isinstance(submessage, Fragment):
            self._fragments += submessage.data
            if submessage.last:
                whole, self._fragments = self._fragments, b""
                self._take(whole, 0)
        elif isinstance(submessage, Heartbeat):
            ahead = (submessage.first - self._next_in) & 0xFFFF
            assert ahead == 0 or ahead >= 0x8000, "the agent gave up a reliable message"
            self._acknowledge((submessage.last + 1 - self._next_in) & 0xFFFF)
        elif isinstance(submessage, Acknack):
            self._acknowledged(submessage)
        elif isinstance(submessage, StatusAgent):
            assert submessage.status == 0, f"refused: {submessage.status:#04x}"
            self.connected = True
        elif isinstance(submessage, StatusReply):
            self.statuses[submessage.request] = submessage.status

    def _acknowledge(self, announced: int = 0) -> None:
        """Say what lacks of what came in part, and of so many that the agent says to have sent."""
        if self._leaving:
            return
        known = [(s - self._next_in) & 0xFFFF for s in self._held]
        last = max((announced if announced <= WINDOW else 0, *known))
        missing = sum(1 << i for i in range(last) if (self._next_in + i) & 0xFFFF not in self._held)
        self._send(join(self._head(0, 0), [encode(Acknack(self._next_in, missing, RELIABLE))]))

    def _acknowledged(self, acknack: Acknack) -> None:
        while self._sent and (acknack.first - self._sent[0][0] - 1) & 0xFFFF < 0x8000:
            self._sent.popleft()
        for i, (_, message) in enumerate(self._sent):
            if acknack.missing >> i & 1:
                self._send(message)
        self._release()

    def _push(self, submessage: bytes) -> None:
        room = self.mtu - (4 if self.session >= 0x80 else 8)
        if len(submessage) <= room:
            self._queue.append(submessage)
        else:
            size = (room - 4) & ~3
            chunks = [submessage[at : at + size] for at in range(0, len(submessage), size)]
            self._queue.extend(encode(Fragment(p, p is chunks[-1])) for p in chunks)
        self._release()

    def _release(self) -> None:
        while self._queue and len(self._sent) < WINDOW:
            message = join(self._head(RELIABLE, self._sequence), [self._queue.popleft()])
            self._sent.append((self._sequence, message))
            self._sequence = (self._sequence + 1) & 0xFFFF
            self._send(message)

    def _send(self, message: bytes) -> None:
        if self.link is not None and not self.deaf:
            self.link.send(message)

    def _head(self, stream: int, sequence: int) -> Header:
        return Header(self.session, stream, sequence, self.key if self.session < 0x80 else b"")
