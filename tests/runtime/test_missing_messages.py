# SPDX-License-Identifier: Apache-2.0
"""Requests for missing messages: each once between two HEARTBEATs, so that a loss costs little on the line."""

from __future__ import annotations

import struct

import pytest

from microros_gen.client.plan.runtime_entities import QueuePlan
from tests.support.plans import POOL, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.slices import first

FIRST = POOL.entities.publishers.max
FRAGMENTS_PER_SAMPLE = 9
LARGE = changed(READER, input__queues=(QueuePlan(1, 500), QueuePlan(1, 16)), input__arrives_in_fragments=True)
TEXT = "z" * (FRAGMENTS_PER_SAMPLE * 56 - 8 - 5)
SAMPLE = struct.pack("<I", len(TEXT) + 1) + TEXT.encode() + b"\0"


class Line:
    """A client with a subscription, and an agent that sends all that an ACKNACK names, as the public one does."""

    def __init__(self, bench: Bench, slots: int) -> None:
        self.agent = ReadingAgent()
        plan = changed(LARGE, input__reliable_slots=slots)
        self.client: Client = bench.start(plan, agent=self.agent)
        for call in ("init", "node 0 listener -", "read_init 0 0 String go reliable"):
            self.client.ok(call)
        self.client.spin(2)
        self.sent = 0
        self.lost: set[int] = set()
        self.agent.drop_answer = self._pass

    def _pass(self, answer: bytes) -> bool:
        """Count what the agent sends; lose the first of each number in `lost`."""
        if answer[1] != 0x80:
            return False
        self.sent += 1
        (number,) = struct.unpack_from("<H", answer, 2)
        lost = number in self.lost
        self.lost.discard(number)
        return lost

    def named(self) -> list[int]:
        """Return the numbers that the ACKNACKs so far have requested."""
        found: list[int] = []
        for datagram in self.client.sent:
            if datagram[4] == 0x0A and datagram[12] == 0x80:
                first, missing = (
                    struct.unpack_from("<H", datagram, 8)[0],
                    struct.unpack_from(">H", datagram, 10)[0],
                )
                found += [first + i for i in range(16) if missing >> i & 1]
        return found


@pytest.mark.parametrize("slots", first([2, 1, 16]))
@pytest.mark.parametrize("lost", range(FRAGMENTS_PER_SAMPLE))
def test_a_lost_fragment_is_requested_once(bench: Bench, slots: int, lost: int) -> None:
    """Without a HEARTBEAT the agent sends the lost piece and, where there was no slot, those after it: once each."""
    line = Line(bench, slots)
    first = line.agent.statuses
    line.lost = {first + lost}
    line.client.sent.clear()
    line.client.queued += line.agent.offer(FIRST, SAMPLE)
    line.client.spin(6)
    if lost == FRAGMENTS_PER_SAMPLE - 1:  # nothing after it tells of it
        line.client.queued += line.agent.tick()
        line.client.spin(2)
    assert line.client.ok("read_text 0 1000").lines == ("text " + TEXT,)
    without_slot = max(0, FRAGMENTS_PER_SAMPLE - 1 - lost - (slots - 1))
    assert line.sent == FRAGMENTS_PER_SAMPLE + 1 + without_slot
    again = set(range(first + FRAGMENTS_PER_SAMPLE - without_slot, first + FRAGMENTS_PER_SAMPLE))
    assert sorted(line.named()) == sorted({first + lost, *again})


def test_two_losses_cost_two_fragments(bench: Bench) -> None:
    line = Line(bench, 16)
    first = line.agent.statuses
    line.lost = {first + 1, first + 5}
    line.client.queued += line.agent.offer(FIRST, SAMPLE)
    line.client.spin(6)
    assert line.client.ok("read_text 0 1000").lines == ("text " + TEXT,)
    assert line.sent == FRAGMENTS_PER_SAMPLE + 2


def test_a_lost_request_is_made_again_after_the_next_heartbeat(bench: Bench) -> None:
    line = Line(bench, 16)
    first = line.agent.statuses
    line.agent.drop = lambda datagram: datagram[4] == 0x0A and datagram[12] == 0x80
    line.lost = {first + 1}
    line.client.sent.clear()
    line.client.queued += line.agent.offer(FIRST, SAMPLE)
    line.client.spin(50, 10)
    assert line.named() == [first + 1]
    line.agent.drop = lambda datagram: False
    line.client.queued += line.agent.tick()
    line.client.spin(3)
    assert line.named() == [first + 1] * 2
    assert line.client.ok("read_text 0 1000").lines == ("text " + TEXT,)


def test_a_forged_number_makes_no_storm(bench: Bench) -> None:
    """The messages before it do not exist: they are requested once for each HEARTBEAT, and data goes on."""
    line = Line(bench, 4)
    number = line.agent.statuses
    forged = b"\x81\x80" + struct.pack("<H", number + 15) + b"\x09\x01\x08\0" + bytes(8)
    line.client.sent.clear()
    for _ in range(40):
        line.client.queued += [forged]
        line.client.spin()
    assert len(line.named()) == 15
    for i in range(10):
        line.client.queued += [
            *line.agent.offer(FIRST, struct.pack("<I", 2) + b"%d\0" % i),
            *line.agent.tick(),
        ]
        line.client.spin(3)
        assert line.client.ok("read_text 0 1000").lines == (f"text {i}",)
    assert line.sent < 25


@pytest.mark.parametrize("in_use", [False, True], ids=["old numbers ahead", "old numbers in use"])
def test_what_is_left_of_a_session_does_not_touch_the_next(bench: Bench, in_use: bool) -> None:
    """On a line it comes before the answer to CREATE_CLIENT; with UDP the new session has its own socket."""
    agent = ReadingAgent()
    client = bench.start(READER, agent=agent)
    for call in (
        "init",
        "node 0 both -",
        "publisher 0 0 Int32 out reliable",
        "read_init 0 0 Int32 in reliable",
    ):
        client.ok(call)
    client.spin(3)
    agent.restart()
    agent.silent = True
    client.spin(READER.times.liveliness_attempts + 4, READER.times.liveliness_period_ms)
    assert client.call("connected").code == 0, "not now"
    first, last = (1, 2) if in_use else (100, 105)
    client.queued += [
        b"\x81\0\0\0\x0b\x01\x05\0" + struct.pack("<HH", first, last) + b"\x80",
        b"\x81\0\0\0\x0a\x01\x05\0" + struct.pack("<HH", first, 0) + b"\x80",
    ]
    client.spin()
    agent.silent = False
    client.spin(20, 50)
    assert client.statistics()["reconnects"] == 1
    for value in range(3):
        client.ok(f"publish 0 {value}")
        client.queued += agent.numbers(FIRST, 10 + value)
        client.spin(2)
    client.ok("flush 1000")
    assert agent.values() == [0, 1, 2]
    assert [client.ok("read_take 0").lines[0].split()[1] for _ in range(3)] == ["10", "11", "12"]
