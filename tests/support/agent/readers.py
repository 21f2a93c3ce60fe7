# SPDX-License-Identifier: Apache-2.0
"""A client that reads, and the samples for it."""

from __future__ import annotations

import struct
from typing import Any

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData
from microros_gen.agent.wire.entity_messages import Acknack, Create
from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.submessages import Submessage, decode
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import dds_type, participant_blob, reader_blob, topic_blob
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench

READER = 0x16
LABEL = "/a [std_msgs/msg/Int32]"
FOREVER = DeliveryControl(0xFFFF)


def subscribing(
    limits: Limits | None = None, mtu: int = 508, references: Any = None, **filters: Any
) -> Bench:
    """Return a bench whose client has reader 0x16 on /a."""
    bench = Bench(limits)
    (answer,) = bench.say(CREATE_CLIENT.replace("fc 01", mtu.to_bytes(2, "little").hex(" ")))
    assert answer[24:26] == "00"
    for sequence, create in enumerate(reader_entities(**filters)):
        (answer,) = bench.say(message(create, sequence=sequence))
        assert answer.endswith("00 00"), answer
    return bench


def reader_entities(number: int = 1, topic: str = "a", **filters: Any) -> list[Create]:
    node, topic_id, subscriber, reader = (number << 4 | kind for kind in (1, 2, 4, 6))
    int32 = dds_type("std_msgs/msg/Int32")
    return [
        Create(10, node, 1, Format.BINARY, participant_blob("a"), 0, 0, True, True),
        Create(11, topic_id, 2, Format.BINARY, topic_blob(f"rt/{topic}", int32), node, 0, True, True),
        Create(12, subscriber, 4, Format.BINARY, b"\0\0", node, 0, True, True),
        Create(
            13, reader, 6, Format.BINARY, reader_blob(topic_id, 3, 10, **filters), subscriber, 0, True, True
        ),
    ]


class Listener:
    """The client's side of a bench: asks, takes, and knows the next number of its best-effort stream."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.sequence = 100

    def say(self, submessage: Submessage, stream: int = 1) -> list[Submessage]:
        self.sequence += stream == 1
        self.bench.say(message(submessage, stream=stream, sequence=self.sequence if stream == 1 else 0))
        return self.answers()

    def read(
        self, stream: int = 1, control: DeliveryControl | None = FOREVER, request: int = 0x20, **more: Any
    ) -> list[Submessage]:
        return self.say(ReadData(request, READER, stream, delivery=control, **more))

    def take(self) -> list[Submessage]:
        self.bench.take()
        return self.answers()

    def pass_time(self, seconds: float) -> list[Submessage]:
        """Let time pass as the server does it: when the agent is due."""
        del self.bench.transport.sent[:]
        end = self.bench.now + seconds
        while (due := self.bench.agent.due()) is not None and due <= end:
            self.bench.now = max(due, self.bench.now)
            self.bench.agent.tick()
        self.bench.now = end
        self.bench.agent.tick()
        return self.answers()

    def acknowledge(self, first: int, missing: int = 0, stream: int = 0x80) -> list[Submessage]:
        return self.say(Acknack(first, missing, stream), stream=0)

    def answers(self) -> list[Submessage]:
        return [submessage for _, submessage in self.messages()]

    def messages(self) -> list[tuple[bytes, Submessage]]:
        found = []
        for _, data in self.bench.transport.sent:
            for span in split(data, header_size(data)):
                found.append((data, decode(*span[:2], data, *span[2:])))
        return found


def sample(value: int, little: bool = True) -> bytes:
    return (b"\0\1\0\0" if little else b"\0\0\0\0") + struct.pack("<i" if little else ">i", value)


def values(answers: list[Submessage]) -> list[int]:
    return [struct.unpack("<i", a.data)[0] for a in answers if isinstance(a, Data)]


def put(bench: Bench, *numbers: int) -> None:
    bench.bridge.source(LABEL).put(*map(sample, numbers))
