# SPDX-License-Identifier: Apache-2.0
"""A reader of ROS 2 that wants everything and takes nothing: what is reliable waits, and none is lost."""

from __future__ import annotations

import io
import time

import pytest

from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.wire.constants import RELIABLE_WINDOW, Format
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.bridging import Bridged
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import dds_type, int32_body, participant_blob, topic_blob, writer_blob
from tests.support.agent.fakes import FakeTransport
from tests.support.agent.observer import Observer
from tests.support.agent.stream_messages import acknacks
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

RELIABLE_KEEP_ALL, BEST_EFFORT = 1, 2
EACH = 64
"""Samples in a message."""
MESSAGES = 220
"""More than the 5,000 samples that Fast DDS keeps in a writer, and as many in a reader, and the window."""


class Sender:
    """A client at the core; its line is a list."""

    def __init__(self, bridged: Bridged, key: str, address: str, agent: Agent | None = None) -> None:
        self.log = EventLog(io.StringIO())
        self.agent = agent or Agent(bridged.bridge, self.log, Limits())
        self.address = address
        self.transport = FakeTransport()
        self.sent = 0
        self.acknowledged = 0
        self._say(bytes.fromhex(CREATE_CLIENT.replace("a1 b2 c3 d4", key)))
        topic = dds_type("std_msgs/msg/Int32")
        for object_id, body, parent in (
            (0x11, participant_blob(f"/starved_{address}"), 0),
            (0x12, topic_blob(f"rt/starved_{address}", topic), 0x11),
            (0x13, b"\0\0", 0x11),
            (0x15, writer_blob(0x12, RELIABLE_KEEP_ALL, 0), 0x13),
        ):
            kind, domain = object_id & 0x0F, bridged.domain * (object_id == 0x11)
            self._say(
                message(0, 0, Create(1, object_id, kind, Format.BINARY, body, parent, domain, True, True))
            )
        self.bridged = bridged

    def write(self) -> None:
        """Say what the window has room for, and let the agent work for a moment."""
        while self.sent < MESSAGES and self.sent - self.acknowledged < RELIABLE_WINDOW:
            first = self.sent * EACH
            some = (WriteData(1, 0x15, int32_body(value)) for value in range(first, first + EACH))
            self._say(message(0x80, self.sent, *some))
            self.sent += 1
        self.agent.tick()
        self.agent.flush()
        self.bridged.named(0.002)
        for first, _ in acknacks([answer.hex() for _, answer in self.transport.sent]):
            self.acknowledged = max(self.acknowledged, first)
        self.transport.sent.clear()

    def _say(self, data: bytes) -> None:
        self.agent.receive(data, self.address, self.transport)
        self.agent.flush()


def message(stream: int, sequence: int, *submessages: Create | WriteData) -> bytes:
    return join(Header(0x81, stream, sequence), [encode(submessage) for submessage in submessages])


@pytest.mark.system
def test_nothing_is_lost_to_a_reader_that_takes_nothing_for_long(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    bridge_observer.ask(do="starve", topic="/starved_a", type="std_msgs/msg/Int32")
    sender = Sender(bridged, "00 00 00 0a", "a")
    bridged.wait(lambda: any(getattr(reported, "count", 0) == 1 for reported in bridged.reports))
    stuck_since, before = time.monotonic(), -1
    while sender.acknowledged < MESSAGES and time.monotonic() < stuck_since + 2:
        sender.write()
        if sender.acknowledged != before:
            stuck_since, before = time.monotonic(), sender.acknowledged
    assert 0 < sender.acknowledged < MESSAGES, "the client was not held back"
    assert set(sender.log.counters) == {"publish_waits"}
    other = Sender(bridged, "00 00 00 0b", "b", sender.agent)
    while other.acknowledged < 5:  # who has no such reader is not held back
        other.write()
    taken: list[str] = []
    end = deadline(60)
    while len(taken) < MESSAGES * EACH and time.monotonic() < end:
        sender.write()
        taken += bridge_observer.ask(do="feed")
    assert taken == [int32_body(value).hex() for value in range(MESSAGES * EACH)]
    sender.write()
    assert sender.acknowledged == MESSAGES
    sender.agent.clients.with_key(bytes((0, 0, 0, 10))).objects.clear()  # type: ignore[union-attr]
    sender.agent.clients.with_key(bytes((0, 0, 0, 11))).objects.clear()  # type: ignore[union-attr]
