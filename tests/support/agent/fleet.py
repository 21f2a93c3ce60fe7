# SPDX-License-Identifier: Apache-2.0
"""Many clients of one agent in one process: each has a node, a writer and a reader of a topic without others.

They are created by XrceClient. Then one loop writes and reads for all of them with what never changes encoded before,
so that the agent and not this process is the bottleneck.
"""

from __future__ import annotations

import select
import socket
import statistics
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from microros_gen.agent.wire.constants import Format, SubmessageId
from microros_gen.agent.wire.data_messages import DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.client import (
    BEST_EFFORT,
    RELIABLE,
    XrceClient,
    dds_type,
    participant_blob,
    reader_blob,
    topic_blob,
    writer_blob,
)

SIZE = 64
"""Bytes of the CDR of a sample."""
REPEAT_S = 2.0
"""Seconds without progress after which a client sends again what was not acknowledged or answered."""
_TYPE = dds_type("std_msgs/msg/String")
_BODY = struct.pack("<I", SIZE - 4) + b"x" * (SIZE - 5) + b"\0"
_EVERY = 0xFFFF
_HEADER = 4
_DATA, _ACKNACK = int(SubmessageId.DATA), int(SubmessageId.ACKNACK)


@dataclass
class Member:
    """A client: what it sends, and what it has got back. `sequence` is the next one, `first` not acknowledged yet.

    `lost` samples did not return in time.
    """

    client: XrceClient
    message: bytearray
    sequence: int
    first: int
    acknowledged: int = 0
    returned: int = 0
    lost: int = 0
    progress: float = 0.0

    @property
    def socket(self) -> socket.socket:
        """Return the socket of the client."""
        assert isinstance(self.client.socket, socket.socket)
        return self.client.socket

    def send(self, sequence: int) -> None:
        """Send a sample with a sequence number."""
        struct.pack_into("<H", self.message, 2, sequence)
        self.socket.send(self.message)

    def take(self, data: bytes) -> None:
        """Take a message of the agent."""
        at = _HEADER
        while at + 4 <= len(data):
            kind, _, size = struct.unpack_from("<BBH", data, at)
            if kind == _ACKNACK:
                (first,) = struct.unpack_from("<H", data, at + 4)
                done = (first - self.first) & 0xFFFF
                if 0 < done <= (self.sequence - self.first) & 0xFFFF:
                    self.first, self.acknowledged = first, self.acknowledged + done
            elif kind == _DATA:
                self.returned += 1
            at += 4 + (size + 3 & ~3)


@dataclass(frozen=True)
class Rates:
    """Samples of each client in some seconds; `resent`: how often one had to repeat what it had sent."""

    counts: tuple[int, ...]
    seconds: float
    resent: int

    @property
    def per_second(self) -> float:
        """Samples a second of all clients."""
        return sum(self.counts) / self.seconds

    @property
    def slowest(self) -> float:
        """Rate of the slowest client in relation to the mean; 1: all are alike."""
        return min(self.counts) / statistics.mean(self.counts)

    @property
    def fastest(self) -> float:
        """The same of the fastest one."""
        return max(self.counts) / statistics.mean(self.counts)


@dataclass
class Fleet:
    """The clients, and the selector of their sockets."""

    members: list[Member] = field(default_factory=list)
    _poll: select.epoll = field(default_factory=select.epoll)
    _by_descriptor: dict[int, Member] = field(default_factory=dict)

    def join(self, port: int, domain: int, count: int) -> None:
        """Add clients until there are `count`. Each has a separate key, node and topic."""
        for number in range(len(self.members), count):
            member = _member(port, domain, number)
            self.members.append(member)
            member.socket.setblocking(False)
            self._by_descriptor[member.socket.fileno()] = member
            self._poll.register(member.socket, select.EPOLLIN)

    def write(self, seconds: float, window: int) -> Rates:
        """Let each client write as fast as it can, with `window` samples not acknowledged; count what is."""
        for member in self.members:
            member.acknowledged = 0
        return self._run(seconds, _writing(window), lambda member: member.acknowledged)

    def exchange(self, seconds: float) -> Rates:
        """Let each client write a sample, wait until its reader has it from ROS 2, write the next one, and so on."""
        for member in self.members:
            member.returned = member.acknowledged = member.lost = 0
        return self._run(seconds, _exchanging, lambda member: member.returned)

    def close(self) -> None:
        """Close all sockets; the agent finds out by itself."""
        for member in self.members:
            member.socket.close()
        self._poll.close()

    def _run(self, seconds: float, goes_on: Callable[[Member], int], count: Callable[[Member], int]) -> Rates:
        resent = 0
        start = now = looked = time.monotonic()
        for member in self.members:
            member.progress = now
            self._go_on(member, goes_on)
        while now < start + seconds:
            for descriptor, _ in self._poll.poll(REPEAT_S / 4):
                member = self._by_descriptor[descriptor]
                member.progress = now
                _drain(member)
                self._go_on(member, goes_on)
            now = time.monotonic()
            if now - looked > REPEAT_S / 4:
                looked = now
                resent += sum(self._repeat(member, now, goes_on) for member in self.members)
        return Rates(tuple(map(count, self.members)), now - start, resent)

    def _go_on(self, member: Member, goes_on: Callable[[Member], int]) -> None:
        for _ in range(goes_on(member)):
            member.send(member.sequence)
            member.sequence = (member.sequence + 1) & 0xFFFF

    def _repeat(self, member: Member, now: float, goes_on: Callable[[Member], int]) -> bool:
        """Send again what a client without progress has not got acknowledged; return whether it was without."""
        if now - member.progress < REPEAT_S:
            return False
        member.progress = now
        waiting = (member.sequence - member.first) & 0xFFFF
        for ahead in range(waiting):
            member.send((member.first + ahead) & 0xFFFF)
        if not waiting:  # its sample was lost on the way from ROS 2
            member.lost = member.acknowledged - member.returned
            self._go_on(member, goes_on)
        return True


def _writing(window: int) -> Callable[[Member], int]:
    return lambda member: window - ((member.sequence - member.first) & 0xFFFF)


def _exchanging(member: Member) -> int:
    """Return 1 if everything that was written has returned."""
    idle = member.sequence == member.first
    return int(idle and member.returned + member.lost >= member.acknowledged)


def _drain(member: Member) -> None:
    while True:
        try:
            member.take(member.socket.recv(2048))
        except BlockingIOError:
            return


def _member(port: int, domain: int, number: int) -> Member:
    client = XrceClient(port, key=0x0F1E0000 + number)
    assert client.connect() == 0, "the agent refuses a session"
    bodies = (
        (1, participant_blob(f"fleet_{number}"), 0),
        (2, topic_blob(f"rt/fleet/t{number}", _TYPE), 0x11),
        (3, b"\0\0", 0x11),
        (5, writer_blob(0x12, 3, 10), 0x13),
        (4, b"\0\0", 0x11),
        (6, reader_blob(0x12, 3, 10), 0x14),
    )
    for kind, body, parent in bodies:
        status = client.create(0x10 | kind, Format.BINARY, body, parent, domain)
        assert status in (0, 1), f"client {number}, object of kind {kind}: status {status:#04x}"
    client.send(RELIABLE, encode(ReadData(0x20, 0x16, BEST_EFFORT, 0, None, DeliveryControl(_EVERY))))
    client.drain()
    sequence = client._sequence[RELIABLE]
    message = join(Header(client.session, RELIABLE, 0, b""), [encode(WriteData(0x30, 0x15, _BODY))])
    return Member(client, bytearray(message), sequence, sequence)


@contextmanager
def fleet() -> Iterator[Fleet]:
    """Give a fleet without clients; its sockets are closed in the end."""
    found = Fleet()
    try:
        yield found
    finally:
        found.close()
