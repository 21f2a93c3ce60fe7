# SPDX-License-Identifier: Apache-2.0
"""The agent of reading_agent.py with repliers and requesters: requests and replies as the public agent carries them."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from tests.support.runtime.reading_agent import ReadingAgent

GUID = bytes.fromhex("010f78fdca70321302000300 00000103")


def identity(sequence: int) -> bytes:
    """Return the SampleIdentity of a request in DDS."""
    return GUID + struct.pack("<iI", sequence >> 32, sequence & 0xFFFFFFFF)


@dataclass
class ServingAgent(ReadingAgent):
    """`calls` are the requests that a client wrote, `answered` the replies, each as (object, request id, body)."""

    calls: list[tuple[bytes, bytes, bytes]] = field(default_factory=list)
    answered: list[bytes] = field(default_factory=list)

    def give(self, target: bytes, *samples: bytes) -> list[bytes]:
        """Return the datagrams that go out when DDS has these samples for a replier or requester."""
        self.history.setdefault(target, []).extend(samples)
        return self._kept([] if not self.connected else self._flow(target))

    def reply(self, number: int, value: int) -> list[bytes]:
        """Answer the `number`-th request of all."""
        target, request, _ = self.calls[number]
        return self.give(target, request + target + struct.pack("<i", value))

    def _write(self, payload: bytes) -> None:
        if payload[2:4] not in self.objects:
            return
        if payload[3] & 15 == 7:
            self.calls.append((payload[2:4], payload[:2], payload[4:]))
        elif payload[3] & 15 == 8:
            self.answered.append(payload[4:])
        else:
            super()._write(payload)
