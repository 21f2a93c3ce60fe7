# SPDX-License-Identifier: Apache-2.0
"""The agent of fake_agent.py with data readers: samples wait in it until READ_DATA asks for them."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from tests.support.runtime.fake_agent import FakeAgent

READ_DATA, DATA, FRAGMENT = 0x08, 0x09, 0x0D
READING = 0x81
UNLIMITED = 0xFFFF


@dataclass
class Read:
    """A READ_DATA that the agent acted on; `left` of its samples may still be sent."""

    request: bytes
    reader: bytes
    stream: int
    samples: int
    left: int


@dataclass
class ReadingAgent(FakeAgent):
    """`reads` are all READ_DATA that it acted on, `history` what waits in DDS for a reader.

    Messages above `mtu` go in fragments. `read_status` answers READ_DATA when it is not 0. `flags` are those of DATA.
    `preconfigured`: it has every reader that it is asked for.
    """

    reads: list[Read] = field(default_factory=list)
    history: dict[bytes, list[bytes]] = field(default_factory=dict)
    reading: dict[bytes, Read] = field(default_factory=dict)
    read_next: int = 0
    read_status: int = 0
    mtu: int = 64
    flags: int = 1
    preconfigured: bool = False

    def restart(self) -> None:
        super().restart()
        self.reading.clear()

    def _begin_streams(self) -> None:
        super()._begin_streams()
        self.read_next = 0
        self.answers = 0

    def offer(self, reader: int, *bodies: bytes) -> list[bytes]:
        """Return the datagrams that go out when DDS has these samples for the reader of this index."""
        identity = ((reader << 4) | 6).to_bytes(2, "big")
        self.history.setdefault(identity, []).extend(bodies)
        return self._kept([] if not self.connected else self._flow(identity))

    def numbers(self, reader: int, *values: int) -> list[bytes]:
        """Offer Int32 messages."""
        return self.offer(reader, *(struct.pack("<i", value) for value in values))

    def tick(self) -> list[bytes]:
        """Return the HEARTBEAT that is due."""
        return self._kept(self.announce())

    def _kept(self, datagrams: list[bytes]) -> list[bytes]:
        return [] if self.silent else [d for d in datagrams if not self.drop_answer(d)]

    def _answers(self, datagram: bytes) -> list[bytes]:
        if self.connected and datagram[0] == 0x81 and datagram[1] == READING:
            return self._read_stream(datagram)
        answers = super()._answers(datagram)
        for identity in list(self.reading):
            answers += self._flow(identity)
        return answers

    def _delete(self, payload: bytes) -> bytes:
        self.reading.pop(payload[2:4], None)
        return super()._delete(payload)

    def _read_stream(self, datagram: bytes) -> list[bytes]:
        (sequence,) = struct.unpack_from("<H", datagram, 2)
        answers: list[bytes] = []
        if sequence == self.read_next:
            self.read_next = (self.read_next + 1) & 0xFFFF
            answers = self._read(datagram)
        acknack = b"\x81\0\0\0\x0a\x01\x05\0" + struct.pack("<HH", self.read_next, 0) + b"\x81"
        return [acknack, *answers]

    def _read(self, datagram: bytes) -> list[bytes]:
        assert datagram[4:8] == b"\x08\x01\x10\x00"
        assert len(datagram) == 24
        request, reader = datagram[8:10], datagram[10:12]
        stream, form, content, control, samples = struct.unpack_from("<BBBBH", datagram, 12)
        assert (form, content, control, datagram[18:]) == (0, 0, 1, bytes(6))
        read = Read(request, reader, stream, samples, samples)
        self.reads.append(read)
        if self.read_status or (reader not in self.objects and not self.preconfigured):
            return [self._status(request + reader, self.read_status or 0x84)]
        if stream == 0:
            self.reading.pop(reader, None)
            return []
        self.reading[reader] = read
        return self._flow(reader)

    def _flow(self, identity: bytes) -> list[bytes]:
        read, history = self.reading.get(identity), self.history.get(identity, [])
        sent: list[bytes] = []
        while read is not None and history and read.left:
            if read.stream == 0x80 and len(self.unacknowledged) >= 10:
                break
            read.left -= read.samples != UNLIMITED
            sent += self._data(read, history.pop(0))
        return sent

    def _data(self, read: Read, body: bytes) -> list[bytes]:
        payload = read.request + read.reader + body
        submessage = struct.pack("<BBH", DATA, self.flags, len(payload)) + payload
        if read.stream == 1:
            self.answers += 1
            return [b"\x81\x01" + struct.pack("<H", (self.answers - 1) & 0xFFFF) + submessage]
        if len(submessage) + 4 <= self.mtu:
            return [self._reliably(bytes(4) + submessage)]
        room = self.mtu - 8
        chunks = [submessage[i : i + room] for i in range(0, len(submessage), room)]
        return [
            self._reliably(bytes(4) + struct.pack("<BBH", FRAGMENT, 3 if p is chunks[-1] else 1, len(p)) + p)
            for p in chunks
        ]
