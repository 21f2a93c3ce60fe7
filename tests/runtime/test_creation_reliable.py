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
ACKNACK = 0x0A


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
