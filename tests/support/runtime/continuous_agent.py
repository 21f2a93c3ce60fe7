# SPDX-License-Identifier: Apache-2.0
"""The agent of fake_agent.py with the stream of continuous messages, which it joins as the public agent does."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from tests.support.runtime.fake_agent import FakeAgent

CONTINUOUS, FRAGMENT, WRITE_DATA, LAST = 0x83, 0x0D, 0x07, 0x02


@dataclass
class ContinuousAgent(FakeAgent):
    """`fragments` are the payloads in order; what was joined outlives a session."""

    fragments: list[bytes] = field(default_factory=list)
    next: int = 0
    joined: bytes = b""

    def _begin_streams(self) -> None:
        super()._begin_streams()
        self.next = 0

    def _answers(self, datagram: bytes) -> list[bytes]:
        if not (self.connected and datagram[0] == 0x81 and datagram[1] == CONTINUOUS):
            return super()._answers(datagram)
        (sequence,) = struct.unpack_from("<H", datagram, 2)
        if sequence == self.next:
            self.next = (self.next + 1) & 0xFFFF
            self._take(datagram)
        acknack = b"\x81\0\0\0\x0a\x01\x05\0" + struct.pack("<HH", self.next, 0)
        return [acknack + bytes([CONTINUOUS])]

    def _take(self, datagram: bytes) -> None:
        identifier, flags, size = struct.unpack_from("<BBH", datagram, 4)
        assert len(datagram) == 8 + size
        if identifier == WRITE_DATA:
            assert not self.joined, "fragments without an end before a whole message"
            self._write(datagram[8:])
            return
        assert identifier == FRAGMENT
        self.fragments.append(datagram[8:])
        self.joined += datagram[8:]
        if flags & LAST:
            whole, self.joined = self.joined, b""
            if len(whole) < 4 or len(whole) < 4 + struct.unpack_from("<H", whole, 2)[0]:
                self.spoiled += bool(whole)
            else:
                assert whole[0] == WRITE_DATA
                assert len(whole) == 4 + struct.unpack_from("<H", whole, 2)[0]
                self._write(whole[4:])
