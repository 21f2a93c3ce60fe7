# SPDX-License-Identifier: Apache-2.0
"""The agent of serving_agent.py with the topic of micro_ros_agent: each new reader gets the last sample."""

from __future__ import annotations

import struct
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

from tests.support.ros_graph_message import Entity, encoded
from tests.support.runtime.fake_agent import WINDOW
from tests.support.runtime.reading_agent import DATA, FRAGMENT, Read
from tests.support.runtime.serving_agent import ServingAgent

DATAREADER = 6


@dataclass
class GraphTopicAgent(ServingAgent):
    """`reader` is the index of the graph's reader on the wire; without `offers` it gets nothing.

    `damage` changes the bytes of each sample. `stated`: the length in front of a fragmented sample.
    """

    nodes: dict[str, Sequence[Entity]] = field(default_factory=dict)
    reader: int = 0
    offers: bool = True
    readers: int = 0
    """That were created."""
    stated: int | None = None
    big_endian: bool = False
    backlog: deque[bytes] = field(default_factory=deque)

    @property
    def identity(self) -> bytes:
        """The object id of the reader."""
        return ((self.reader << 4) | DATAREADER).to_bytes(2, "big")

    def sample(self) -> bytes:
        """Return the CDR body of the graph; a test can replace this."""
        return encoded(self.nodes, not self.big_endian)

    def publish(self) -> list[bytes]:
        """Return the datagrams of a new sample."""
        self.history[self.identity] = []
        return self.offer(self.reader, self.sample())

    def _create(self, payload: bytes) -> bytes:
        if payload[2:4] == self.identity:
            self.readers += 1
            self.history[self.identity] = [self.sample()] if self.offers else []
        return super()._create(payload)

    def _data(self, read: Read, body: bytes) -> list[bytes]:
        self.flags = 0 if self.big_endian else 1
        payload = read.request + read.reader + body
        stated = len(payload) & 0xFFFF if self.stated is None else self.stated
        submessage = struct.pack("<BBH", DATA, self.flags, stated) + payload
        if len(submessage) + 4 <= self.mtu:
            return [self._reliably(bytes(4) + submessage)]
        room = self.mtu - 8
        chunks = [submessage[i : i + room] for i in range(0, len(submessage), room)]
        self.backlog += [
            struct.pack("<BBH", FRAGMENT, 3 if p is chunks[-1] else 1, len(p)) + p for p in chunks
        ]
        return self._release()

    def restart(self) -> None:
        super().restart()
        self.backlog.clear()

    def _release(self) -> list[bytes]:
        """Return what fits the window of the stream."""
        sent = []
        while self.backlog and len(self.unacknowledged) < WINDOW:
            sent.append(self._reliably(bytes(4) + self.backlog.popleft()))
        return sent

    def _acknowledged(self, payload: bytes) -> list[bytes]:
        return [*super()._acknowledged(payload), *self._release()]
