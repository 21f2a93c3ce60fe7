# SPDX-License-Identifier: Apache-2.0
"""The agent of serving_agent.py with the stream of replies in fragments, which it joins as the public agent does."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from tests.support.runtime.serving_agent import ServingAgent

PARTS, FRAGMENT, WRITE_DATA, LAST = 0x82, 0x0D, 0x07, 0x02


@dataclass
class PartsAgent(ServingAgent):
    """`parts` are the sizes of what came; what was joined outlives a session, as in the public agent."""

    parts: list[int] = field(default_factory=list)
    part_next: int = 0
    joined: bytes = b""

    def _begin_streams(self) -> None:
        super()._begin_streams()
        self.part_next = 0

    def _answers(self, datagram: bytes) -> list[bytes]:
        if not (self.connected and datagram[0] == 0x81 and datagram[1] == PARTS):
            return super()._answers(datagram)
        (sequence,) = struct.unpack_from("<H", datagram, 2)
        if sequence == self.part_next:
            self.part_next = (self.part_next + 1) & 0xFFFF
            self._part(datagram)
        acknack = b"\x81\0\0\0\x0a\x01\x05\0" + struct.pack("<HH", self.part_next, 0)
        return [acknack + bytes([PARTS])]

    def _part(self, datagram: bytes) -> None:
        identifier, flags, size = struct.unpack_from("<BBH", datagram, 4)
        assert identifier == FRAGMENT
        assert len(datagram) == 8 + size
        self.parts.append(size)
        self.joined += datagram[8:]
        if flags & LAST:
            whole, self.joined = self.joined, b""
            if len(whole) < 4 or len(whole) < 4 + struct.unpack_from("<H", whole, 2)[0]:
                self.spoiled += bool(whole)
            else:
                assert whole[0] == WRITE_DATA
                self._write(whole[4:])
