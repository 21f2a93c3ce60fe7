# SPDX-License-Identifier: Apache-2.0
"""`creation: reliable`: CREATE and DELETE on the client's reliable stream, STATUS on the agent's."""

from __future__ import annotations

import random

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent

RELIABLE = changed(
    POOL,
    creation__stream="reliable",
    creation__size=128,
    input__reliable_slots=1,
    input__reliable_slot_size=64,
)
PLANS = {
    "small": RELIABLE,
    "held": changed(RELIABLE, input__reliable_slots=4),
    "fragments": changed(RELIABLE, streams__mtu=24, streams__fragments=True, streams__reliable_slot_size=256),
}
SMALL = changed(RELIABLE, creation__fragments=True, creation__size=132, streams__mtu=63, input__size=63)
"""Messages as small as a frame of CAN FD."""
ACKNACK, FRAGMENT = 0x0A, 0x0D


def connect(client: Client) -> None:
    for call in ("init", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        client.ok(call)


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_requests_and_answers_are_reliable(bench: Bench, plan: RuntimePlan) -> None:
    client = bench.start(plan)
    connect(client)
    client.ok("publish 0 5")
    client.ok("flush 500")
    assert client.agent.values() == [5]
    assert {d[1] for d in client.sent} == {0x00, 0x80}, "nothing on the best-effort stream"
    assert not client.agent.unacknowledged
    acknacks = [d for d in client.sent if d[4] == ACKNACK]
    assert acknacks == [bytes.fromhex(f"81000000 0a010500 {n:02x}00 0000 80") for n in range(1, 5)]
    client.ok("publisher_fini 0 0")
    client.spin(20, 10)
    assert len(client.agent.objects) == 1


def test_an_answer_that_is_lost_or_doubled_is_acknowledged_in_the_end(bench: Bench) -> None:
    agent = FakeAgent()
    chance = random.Random(4)
    client = bench.start(RELIABLE, agent=agent)
    agent.drop = lambda datagram: datagram[1] == 0x80 and chance.random() < 0.3
    agent.drop_answer = lambda answer: answer[1] == 0x80 and chance.random() < 0.5
    client.on_sleep = lambda: client.queued.extend(agent.announce())
    connect(client)
    client.queued += list(agent.unacknowledged.values()) * 2
    client.spin(5, 10)
    client.ok("publish 0 6")
    client.ok("flush 2000")
    client.queued += agent.announce()
    client.spin(5, 10)
    assert agent.values() == [6]
    assert not agent.unacknowledged


def test_fragments_from_the_agent_are_malformed_and_acknowledged(bench: Bench) -> None:
    client = bench.start(RELIABLE)
    connect(client)
    client.sent.clear()
    client.queued.append(bytes.fromhex("81800400 0d010400 00000000"))
    client.queued.append(bytes.fromhex("81810000 05010600 000000000000"))
    client.spin(2)
    assert client.sent == [bytes.fromhex("81000000 0a010500 0500 0000 80")]
    assert client.statistics()["malformed"] == 2


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_a_new_session_counts_from_zero_in_both_directions(bench: Bench, plan: RuntimePlan) -> None:
    client = bench.start(changed(plan, streams__on_full="drop_oldest"))
    connect(client)
    client.ok("publish 0 1")
    client.ok("flush 500")
    client.agent.restart()
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    for value in range(2, 9):
        client.ok(f"publish 0 {value}")
    client.agent.silent = False
    client.spin(40, 20)
    assert client.agent.values() == [1, 5, 6, 7, 8]
    assert not client.agent.unacknowledged
    assert client.statistics()["reconnects"] == 1


def test_requests_that_are_larger_than_a_message_go_in_fragments(bench: Bench) -> None:
    """A stream's first number ends what an earlier session left; CREATE of the topic takes two, the others one."""
    client = bench.start(SMALL)
    connect(client)
    client.ok("publish 0 5")
    client.ok("flush 500")
    assert client.agent.values() == [5]
    assert max(map(len, client.sent)) == 63
    reliable = [d for d in client.sent if d[1] == 0x80]
    assert [(d[2], d[4], d[5]) for d in reliable] == [
        (0, FRAGMENT, 3),
        (1, 1, 7),
        (2, FRAGMENT, 1),
        (3, FRAGMENT, 3),
        (4, 1, 7),
        (5, 1, 7),
        (6, 7, 1),
    ]
    topic = b"".join(d[8:] for d in reliable[2:4])
    assert topic[:1] == b"\x01"
    assert len(topic) == 4 + int.from_bytes(topic[2:4], "little")
    assert b"rt/chatter" in topic
    client.ok("publisher_fini 0 0")
    client.spin(20, 10)
    assert len(client.agent.objects) == 1


@pytest.mark.parametrize("seed", range(3))
def test_lost_fragments_of_requests_are_sent_again(bench: Bench, seed: int) -> None:
    """The same numbers have the same bytes: the agent creates each object once."""
    agent, chance = FakeAgent(), random.Random(seed)
    client = bench.start(SMALL, agent=agent)
    bytes_of: dict[int, set[bytes]] = {}

    def drop(datagram: bytes) -> bool:
        if datagram[1] == 0x80:
            bytes_of.setdefault(datagram[2], set()).add(datagram)
        return datagram[1] == 0x80 and chance.random() < 0.4

    agent.drop = drop
    agent.drop_answer = lambda answer: answer[1] == 0x80 and chance.random() < 0.3
    client.on_sleep = lambda: client.queued.extend(agent.announce())
    connect(client)
    for value in range(5):
        client.ok(f"publish 0 {value}")
        client.ok("flush 2000")
    assert agent.values() == list(range(5))
    assert all(len(found) == 1 for found in bytes_of.values())


def test_a_request_that_was_left_in_the_middle_spoils_none_of_the_next_session(bench: Bench) -> None:
    """The agent joins fragments over a session, as the public one: the first number ends what it has."""
    agent = FakeAgent()
    client = bench.start(SMALL, agent=agent)
    connect(client)
    agent.drop = lambda datagram: datagram[1:5] == b"\x80\x03\x00\x0d"
    agent.restart()
    client.spin(60, 100)
    assert agent.chunks, "half of a topic"
    agent.drop = lambda datagram: False
    agent.restart()
    client.spin(60, 100)
    assert agent.spoiled == 1
    client.ok("publish 0 6")
    client.ok("flush 2000")
    assert agent.values() == [6]
