# SPDX-License-Identifier: Apache-2.0
"""An agent of a few lines that answers as the public one was seen to, and can be told to misbehave.

It is written from captured bytes alone and shares no code with the agent of this project.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass, field

LOGIN_TAIL = bytes.fromhex("58524345 0100 010f")
KINDS = {1: "participant", 2: "topic", 3: "publisher", 4: "subscriber", 5: "datawriter", 6: "datareader"}
KINDS |= {7: "requester", 8: "replier"}
WINDOW = 16


@dataclass
class FakeAgent:
    """State of one agent; `receive` returns the datagrams that it answers with. `leaving`: it says that it ends.

    `drop` is asked for each datagram that comes in: true loses it. `refuse` maps an object kind to the status
    that its creation gets. `chunks` of fragments outlive a gap and a session, as in the public agent; `spoiled` counts
    wholes that are none, `discarded` messages beyond the window.
    """

    silent: bool = False
    leaving: bool = False
    session_status: int = 0
    refuse: dict[str, int] = field(default_factory=dict)
    drop: Callable[[bytes], bool] = lambda datagram: False
    drop_answer: Callable[[bytes], bool] = lambda datagram: False
    connected: bool = False
    objects: dict[bytes, bytes] = field(default_factory=dict)
    written: list[tuple[bytes, bytes]] = field(default_factory=list)
    log: list[bytes] = field(default_factory=list)
    last_handled: int = 0xFFFF
    last_announced: int = 0xFFFF
    waiting: dict[int, bytes] = field(default_factory=dict)
    chunks: bytes = b""
    unacknowledged: dict[int, bytes] = field(default_factory=dict)
    statuses: int = 0
    discarded: int = 0
    spoiled: int = 0
    answers: int = 0

    def restart(self) -> None:
        """Forget every session and entity, as a new process has none."""
        self.connected = False
        self.objects.clear()
        self._begin_streams()

    def _begin_streams(self) -> None:
        self.waiting.clear()
        self.unacknowledged.clear()
        self.statuses = 0
        self.last_handled = self.last_announced = 0xFFFF

    def receive(self, datagram: bytes) -> list[bytes]:
        self.log.append(datagram)
        if self.leaving:
            return [bytes.fromhex("81000000 05010600 0002fffe 0000")]
        if self.silent or self.drop(datagram):
            return []
        return [answer for answer in self._answers(datagram) if not self.drop_answer(answer)]

    def _answers(self, datagram: bytes) -> list[bytes]:
        session, stream, sequence = struct.unpack_from("<BBH", datagram)
        submessages = list(_split(datagram))
        if session == 0x80:
            return [self._out_of_session(*submessages[0])]
        if not self.connected:
            return self._unknown_client(*submessages[0])
        if stream == 0x80:
            return self._reliable(datagram, sequence)
        return [answer for identifier, payload in submessages for answer in self._handle(identifier, payload)]

    def _out_of_session(self, identifier: int, payload: bytes) -> bytes:
        if identifier == 0x02:
            return _info(0x80, 0)
        assert identifier == 0x00
        if self.session_status <= 1:
            self.connected = True
            self._begin_streams()
        status = bytes([self.session_status, 0])
        return bytes([0x81, 0, 0, 0, 4, 1, 11, 0]) + status + LOGIN_TAIL + b"\0"

    def _unknown_client(self, identifier: int, payload: bytes) -> list[bytes]:
        if identifier == 0x02:
            return [_info(0x81, 0)]
        if identifier == 0x03 and payload[2:4] == b"\xff\xfe":
            return [self._status(payload[:4], 0, 0)]
        return []

    def _reliable(self, datagram: bytes, sequence: int) -> list[bytes]:
        distance = (sequence - self.last_handled) & 0xFFFF
        if 0 < distance <= WINDOW:
            self.waiting[sequence] = datagram
            if (sequence - self.last_announced) & 0xFFFF <= WINDOW:
                self.last_announced = sequence
        elif distance < 0x8000:
            self.discarded += 1
        answers = self._pop()
        return [self._acknack(), *answers]

    def _pop(self) -> list[bytes]:
        answers = []
        while (following := (self.last_handled + 1) & 0xFFFF) in self.waiting:
            self.last_handled = following
            datagram = self.waiting.pop(following)
            whole = self._join(datagram) if datagram[4] == 0x0D else datagram
            answers += self._handle_reliable(_split(whole))
        return answers

    def _reliably(self, status: bytes) -> bytes:
        """Return a STATUS as a message of the reliable stream, which is kept until it is acknowledged."""
        message = bytes([0x81, 0x80]) + struct.pack("<H", self.statuses) + status[4:]
        self.unacknowledged[self.statuses] = message
        self.statuses += 1
        return message

    def announce(self) -> list[bytes]:
        """Return the HEARTBEAT that is due while something is unacknowledged."""
        if not self.unacknowledged:
            return []
        first, last = min(self.unacknowledged), max(self.unacknowledged)
        return [b"\x81\0\0\0\x0b\x01\x05\0" + struct.pack("<HH", first, last) + b"\x80"]

    def _acknowledged(self, payload: bytes) -> list[bytes]:
        first, missing = struct.unpack_from("<H", payload)[0], struct.unpack_from(">H", payload, 2)[0]
        self.unacknowledged = {n: m for n, m in self.unacknowledged.items() if n >= first}
        return [m for n, m in self.unacknowledged.items() if missing >> (n - first) & 1]

    def _handle_reliable(self, submessages: list[tuple[int, bytes]]) -> list[bytes]:
        answers = []
        for identifier, payload in submessages:
            assert identifier in (0x01, 0x03, 0x07)
            answers += [self._reliably(answer) for answer in self._handle(identifier, payload)]
        return answers

    def _join(self, datagram: bytes) -> bytes:
        """Return the message that a fragment completes; a header alone: none."""
        ((_, payload),) = _split(datagram)
        self.chunks += payload
        if not datagram[5] & 2:
            return datagram[:4]
        whole, self.chunks = datagram[:4] + self.chunks, b""
        if len(whole) > 4 and len(whole) < 8 + struct.unpack_from("<H", whole, 6)[0]:
            self.spoiled += 1
            return datagram[:4]
        return whole

    def _acknack(self) -> bytes:
        first = (self.last_handled + 1) & 0xFFFF
        count = (self.last_announced - self.last_handled) & 0xFFFF
        missing = sum(
            1 << i
            for i in range(min(count, 16))
            if count < 0x8000 and (first + i) & 0xFFFF not in self.waiting
        )
        body = struct.pack("<H", first) + struct.pack(">H", missing) + b"\x80"
        return b"\x81\0\0\0\x0a\x01\x05\0" + body

    def _handle(self, identifier: int, payload: bytes) -> list[bytes]:
        if identifier == 0x01:
            return [self._create(payload)]
        if identifier == 0x02:
            return [_info(0x81, 1)]
        if identifier == 0x03:
            return [self._delete(payload)]
        if identifier == 0x07:
            self._write(payload)
            return []
        if identifier == 0x0A:
            return self._acknowledged(payload)
        assert identifier == 0x0B, identifier
        first, last = struct.unpack_from("<HH", payload)
        if 0 < (first - 1 - self.last_handled) & 0xFFFF < 0x8000:
            self.last_handled = (first - 1) & 0xFFFF
            self.waiting = {k: v for k, v in self.waiting.items() if (k - first) & 0xFFFF < 0x8000}
        if (last - self.last_handled) & 0xFFFF < 0x8000:
            self.last_announced = last
        answers = self._pop()
        return [self._acknack(), *answers]

    def _create(self, payload: bytes) -> bytes:
        request, identity, kind = payload[:2], payload[2:4], KINDS[payload[4]]
        if kind in self.refuse:
            return self._status(request + identity, self.refuse[kind])
        known = self.objects.get(identity) == payload[4:]
        self.objects[identity] = payload[4:]
        return self._status(request + identity, 1 if known else 0)

    def _delete(self, payload: bytes) -> bytes:
        identity = payload[2:4]
        if identity == b"\xff\xfe":
            self.connected = False
            self.objects.clear()
            return self._status(payload[:4], 0, 0)
        return self._status(payload[:4], 0 if self.objects.pop(identity, None) is not None else 0x84)

    def _status(self, related: bytes, status: int, stream: int = 1) -> bytes:
        sequence = struct.pack("<H", self.answers if stream else 0)
        self.answers += stream
        return bytes([0x81, stream]) + sequence + b"\x05\x01\x06\0" + related + bytes([status, 0])

    def _write(self, payload: bytes) -> None:
        if payload[2:4] in self.objects:
            self.written.append((payload[2:4], payload[4:]))

    def values(self, writer: int = 0) -> list[int]:
        """Return the Int32 values that the writer of place `writer` has sent."""
        identity = ((writer << 4) | 5).to_bytes(2, "big")
        return [struct.unpack("<i", body)[0] for target, body in self.written if target == identity]


def _split(datagram: bytes) -> list[tuple[int, bytes]]:
    found, at = [], 4
    while at < len(datagram):
        identifier, flags, size = struct.unpack_from("<BBH", datagram, at)
        assert flags & 1, "little endian"
        assert at + 4 + size <= len(datagram), "a submessage ends within its message"
        found.append((identifier, datagram[at + 4 : at + 4 + size]))
        at += (4 + size + 3) & ~3
    return found


def _info(session: int, in_session: int) -> bytes:
    return bytes([session, 0, 0, 0]) + bytes.fromhex(
        f"06011c00 000afffd 00{in_session:02x} 010d 58524345 0100010f 00 010d 00 0100 0000 00000000"
    )
