# SPDX-License-Identifier: Apache-2.0
"""The agent of this project, without sockets and ROS, in the place of the scripted one."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from tests.support.agent.fakes import Bench
from tests.support.runtime.fake_agent import FakeAgent

_ENCAPSULATION = 4


@dataclass
class CoreAgent(FakeAgent):
    """`drop`, `drop_answer` and `silent` are those of the scripted agent; nothing else of it is used."""

    bench: Bench = field(default_factory=Bench)

    def receive(self, datagram: bytes) -> list[bytes]:
        """Return what the agent answers."""
        if self.silent or self.drop(datagram):
            return []
        answers = (bytes.fromhex(answer) for answer in self.bench.say(datagram))
        return [answer for answer in answers if not self.drop_answer(answer)]

    def values(self, writer: int = 0) -> list[int]:
        """Return the Int32 values that it published; of its only writer."""
        assert writer == 0
        return [
            struct.unpack_from("<i", message, _ENCAPSULATION)[0] for _, message in self.bench.bridge.published
        ]
