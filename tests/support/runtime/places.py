# SPDX-License-Identifier: Apache-2.0
"""A client with several subscriptions, what waits in their queues, and their agent."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.reading_agent import DATA, ReadingAgent

TAKE_FAILED = 401


def text(size: int, letter: str) -> bytes:
    return struct.pack("<I", size + 1) + letter.encode() * size + b"\0"


@dataclass
class Places:
    """`opened`: TYPE TOPIC QOS of each subscription; texts are of type String."""

    bench: Bench
    plan: RuntimePlan
    opened: tuple[str, ...]
    agent: ReadingAgent = field(default_factory=ReadingAgent)

    def __post_init__(self) -> None:
        self.client: Client = self.bench.start(self.plan, agent=self.agent)
        self.client.ok("init")
        name = (
            f"{self.plan.entities.nodes.declared[0].name} {self.plan.entities.nodes.declared[0].namespace}"
            if self.plan.entities.declared
            else "listener -"
        )
        self.client.ok(f"node 0 {name}")
        for index, what in enumerate(self.opened):
            self.client.ok(f"read_init {index} 0 {what}")
        self.client.spin(4)

    def send(self, datagrams: list[bytes]) -> None:
        self.client.queued += datagrams

    def take(self, index: int) -> str | None:
        command = f"read_text {index} 1000" if "String" in self.opened[index] else f"read_take {index}"
        result = self.client.call(command)
        assert result.code in (0, TAKE_FAILED), result
        return result.lines[0].split()[1] if result.code == 0 else None

    def counted(self, index: int = 0) -> tuple[int, int]:
        (line,) = self.client.ok(f"read_statistics {index}").lines
        _, dropped, refused = line.split()
        return int(dropped), int(refused)

    def data(self, index: int, body: bytes) -> bytes:
        """Return DATA as the agent answers the last READ_DATA of this subscription."""
        reader = (((self.plan.entities.publisher_places + index) << 4) | 6).to_bytes(2, "big")
        request = next(r.request for r in reversed(self.agent.reads) if r.reader == reader)
        return struct.pack("<BBH", DATA, 1, 4 + len(body)) + request + reader + body

    def message(self, submessages: bytes) -> bytes:
        """Return the next message of the best-effort stream."""
        self.agent.answers += 1
        return b"\x81\x01" + struct.pack("<H", (self.agent.answers - 1) & 0xFFFF) + submessages
