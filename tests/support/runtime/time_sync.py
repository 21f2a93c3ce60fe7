# SPDX-License-Identifier: Apache-2.0
"""A fake agent that tells the time."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass, field

from tests.support.runtime.fake_agent import FakeAgent

TIMESTAMP = bytes.fromhex("81000000 0e010800")
EPOCH_NS = 1_790_000_000_123_456_789


@dataclass
class TimedAgent(FakeAgent):
    """Answers TIMESTAMP with what `reply` makes of the originate time."""

    reply: Callable[[bytes], list[bytes]] = lambda originate: []
    requests: list[int] = field(default_factory=list)

    def receive(self, datagram: bytes) -> list[bytes]:
        if datagram[:8] != TIMESTAMP:
            return super().receive(datagram)
        assert len(datagram) == 16
        seconds, nanoseconds = struct.unpack_from("<iI", datagram, 8)
        self.requests.append(seconds * 10**9 + nanoseconds)
        return self.reply(datagram[8:])


def moment(nanoseconds: int, order: str = "<") -> bytes:
    return struct.pack(f"{order}II", nanoseconds // 10**9, nanoseconds % 10**9)


def answer(transmit: bytes, receive: bytes, originate: bytes, flags: int = 1) -> bytes:
    payload = transmit + receive + originate
    return bytes([0x81, 0, 0, 0, 0x0F, flags, len(payload), 0]) + payload
