# SPDX-License-Identifier: Apache-2.0
"""The reliable stream under loss, when it is full, and what `on_full` says then."""

from __future__ import annotations

import random

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.core_agent import CoreAgent
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent

DROP_OLDEST = changed(POOL, streams__on_full="drop_oldest")
BLOCK = changed(POOL, streams__on_full="block", streams__on_full_block_ms=30)
ACKNACK = 0x0A
HEARTBEAT = 0x0B
WRITE_DATA = 0x07


def test_full_stream_names_what_to_raise(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    for value in range(POOL.streams.reliable_slots):
        client.ok(f"publish 0 {value}")
    result = client.call("publish 0 9")
    assert (result.code, result.slept) == (1, 0)
    expected = (
        "publisher /chatter: stream full, 4 unacknowledged: the agent is away,"
        " or raise pools: {history: 5} in microros.yaml"
    )
    assert result.error == expected
    assert client.statistics()["dropped"] == 1
    client.agent.silent = False
    client.ok("flush 1000")
    assert client.agent.values() == [0, 1, 2, 3]


def test_a_full_stream_of_a_lost_session_advises_no_larger_history(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    for value in range(POOL.streams.reliable_slots):
        client.ok(f"publish 0 {value}")
    client.spin(500, 20)
    assert client.call("publish 0 9").error == "publisher /chatter: no session with the agent"


def test_heartbeats_only_while_something_is_unacknowledged(bench: Bench) -> None:
    client = bench.connected()
    client.agent.drop = lambda datagram: datagram[4] == WRITE_DATA
    client.ok("publish 0 1")
    client.ok("publish 0 2")
    client.spin(50, 1)
    assert not any(d[4] == HEARTBEAT for d in client.sent)
    client.spin(50, 1)
    assert bytes.fromhex("81000000 0b010500 0000 0100 80") in client.sent
    client.agent.drop = lambda datagram: False
    client.ok("flush 300")
    client.sent.clear()
    client.spin(10, 50)
    assert not any(d[4] == HEARTBEAT for d in client.sent)
    assert client.agent.values() == [1, 2]


def test_only_what_is_missing_is_sent_again(bench: Bench) -> None:
    client = bench.connected()
    lost = [True, False, True, False]
    client.agent.drop = lambda datagram: datagram[4] == WRITE_DATA and bool(lost) and lost.pop(0)
    for value in range(3):
        client.ok(f"publish 0 {value}")
    client.spin(60, 10)
    assert client.agent.values() == [0, 1, 2]
    assert client.statistics()["resent"] == 2


@pytest.mark.parametrize("seed", range(3))
def test_every_message_arrives_once_and_in_order_under_loss(bench: Bench, seed: int) -> None:
    chance = random.Random(seed)
    client = bench.connected()
    client.agent.drop = lambda datagram: datagram[4] in (WRITE_DATA, HEARTBEAT) and chance.random() < 0.3
    client.agent.drop_answer = lambda answer: answer[4] == ACKNACK and chance.random() < 0.3
    accepted = []
    for value in range(200):
        client.wait(10)
        if client.call(f"publish 0 {value}").code == 0:
            accepted.append(value)
    client.ok("flush 5000")
    assert client.agent.values() == accepted
    assert len(accepted) > 60


def test_drop_oldest_keeps_the_newest(bench: Bench) -> None:
    """What was sent in this session may have arrived, so it is not dropped; one slot is left for the newest."""
    client = bench.connected(DROP_OLDEST)
    client.agent.silent = True
    for value in range(10):
        client.ok(f"publish 0 {value}")
    assert client.statistics()["dropped"] == 6
    client.agent.silent = False
    client.ok("flush 1000")
    assert client.agent.values() == [0, 1, 2, 9]


def test_drop_oldest_keeps_the_newest_that_the_line_did_not_take(bench: Bench) -> None:
    client = bench.connected(DROP_OLDEST)
    client.tell("send_fails 1")
    for value in range(10):
        client.ok(f"publish 0 {value}")
    assert client.statistics()["dropped"] == 6
    client.tell("send_fails 0")
    client.ok("flush 1000")
    assert client.agent.values() == [6, 7, 8, 9]


def test_drop_oldest_with_one_slot_skips_the_gap_at_once(bench: Bench) -> None:
    """Each message that replaces one which was sent follows a HEARTBEAT: the agent does not wait for the other one."""
    client = bench.connected(changed(DROP_OLDEST, streams__reliable_slots=1))
    lost = [True]
    client.agent.drop = lambda datagram: datagram[4] == WRITE_DATA and bool(lost) and lost.pop()
    client.ok("publish 0 1")
    client.ok("publish 0 2")
    assert [d[4] for d in client.sent if d[1] == 0x80 or d[4] == HEARTBEAT] == [
        WRITE_DATA,
        HEARTBEAT,
        WRITE_DATA,
    ]
    assert client.agent.values() == [2]
    assert client.statistics()["dropped"] == 1


def test_drop_oldest_holds_the_newest_over_a_lost_session(bench: Bench) -> None:
    client = bench.connected(DROP_OLDEST)
    client.agent.restart()
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    for value in range(7):
        client.ok(f"publish 0 {value}")
    client.agent.silent = False
    client.spin(20, 50)
    assert client.agent.values() == [3, 4, 5, 6]
    assert client.statistics()["dropped"] == 3


def test_drop_oldest_gives_best_effort_up_without_a_session(bench: Bench) -> None:
    client = bench.connected(DROP_OLDEST, qos="best_effort")
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.ok("publish 0 1")
    assert client.statistics()["dropped"] == 1


def saturated(client: Client, count: int, first: int = 0) -> None:
    """Publish each millisecond on a line that carries a message in ten."""
    client.round_trip_ms = 10
    for value in range(first, first + count):
        if value % 10 == 0:
            client.tell("send_room 1")
        client.wait(1)
        client.ok(f"publish 0 {value}")


@pytest.mark.parametrize("loss", [0.0, 0.05])
@pytest.mark.parametrize("agent", [FakeAgent, CoreAgent])
def test_drop_oldest_delivers_what_a_saturated_line_carries(
    bench: Bench, agent: type[FakeAgent], loss: float
) -> None:
    chance = random.Random(3)
    client = bench.connected(DROP_OLDEST, agent=agent())
    client.agent.drop = lambda datagram: datagram[4] in (WRITE_DATA, HEARTBEAT) and chance.random() < loss
    client.agent.drop_answer = lambda answer: answer[4] == ACKNACK and chance.random() < loss
    saturated(client, 3000)
    assert len(client.agent.values()) >= 0.9 * 300 * (1 - loss)
    client.tell("send_room 1000000")
    client.ok("flush 3000")
    values = client.agent.values()
    assert values == sorted(set(values))
    assert values[-1] == 2999
    assert len(values) + client.statistics()["dropped"] == 3000


def test_drop_oldest_on_a_saturated_line_over_a_restart(bench: Bench) -> None:
    client = bench.connected(DROP_OLDEST)
    saturated(client, 500)
    before = len(client.agent.values())
    client.agent.restart()
    saturated(client, 9500, 500)
    after = client.agent.values()[before:]
    assert after == sorted(set(after)), (
        "in order; the first ones of a session may have arrived in the one before"
    )
    assert len(after) > 300
    client.tell("send_room 1000000")
    client.ok("flush 3000")
    assert client.agent.values()[-1] == 9999


def test_drop_oldest_under_loss_stays_in_order_and_ends_with_the_last(bench: Bench) -> None:
    chance = random.Random(5)
    client = bench.connected(DROP_OLDEST)
    client.agent.drop = lambda datagram: chance.random() < 0.5
    for value in range(300):
        client.wait(5)
        client.ok(f"publish 0 {value}")
    client.agent.drop = lambda datagram: False
    client.ok("flush 3000")
    values = client.agent.values()
    assert values == sorted(set(values))
    assert values[-1] == 299
    assert len(values) + client.statistics()["dropped"] == 300


def test_block_waits_for_room_and_no_longer(bench: Bench) -> None:
    client = bench.connected(BLOCK)
    client.agent.silent = True
    for value in range(4):
        assert client.ok(f"publish 0 {value}").slept == 0
    result = client.call("publish 0 4")
    assert result.code == 1
    assert BLOCK.streams.on_full_block_ms <= result.slept <= BLOCK.streams.on_full_block_ms + 1

    def answer_late() -> None:
        client.agent.silent = False
        client.queued += client.agent.receive(client.sent[0])

    client.on_sleep = answer_late
    assert client.ok("publish 0 5").slept == 1


def test_a_transport_that_takes_nothing(bench: Bench) -> None:
    client = bench.connected(qos="best_effort")
    client.ok("publisher 1 0 Int32 sure reliable")
    client.tell("send_fails 1")
    result = client.call("publish 0 1")
    assert (result.code, result.error) == (1, "publisher /chatter: the transport has no room for it")
    client.ok("publish 1 2")
    client.tell("send_fails 0")
    client.ok("flush 500")
    assert client.agent.values(1) == [2]
    assert client.statistics()["dropped"] == 1


def test_what_a_transport_refused_goes_out_in_the_next_pump(bench: Bench) -> None:
    """Nobody waits for a HEARTBEAT and an ACKNACK to find out what was not even sent."""
    client = bench.connected()
    client.tell("send_fails 1")
    client.ok("publish 0 1")
    client.ok("publish 0 2")
    client.spin(3, 20)
    client.tell("send_fails 0")
    before = len(client.sent)
    client.spin()
    sent = [d[4] for d in client.sent[before:] if d[1] == 0x80 or d[4] == HEARTBEAT]
    assert sent[:2] == [WRITE_DATA, WRITE_DATA]
    client.ok("flush 500")
    assert client.agent.values() == [1, 2]


def test_blocking_waits_for_the_line_too(bench: Bench) -> None:
    """A best-effort message that finds no room is sent within the time of `on_full: block`, or refused and counted."""
    client = bench.connected(BLOCK, qos="best_effort")
    client.tell("send_fails 1")
    result = client.call("publish 0 1")
    assert (result.code, result.error) == (1, "publisher /chatter: the transport has no room for it")
    assert BLOCK.streams.on_full_block_ms <= result.slept <= BLOCK.streams.on_full_block_ms + 1
    assert client.statistics()["dropped"] == 1
    client.on_sleep = lambda: client.tell("send_fails 0")
    assert client.ok("publish 0 2").slept == 1
    client.spin()
    assert client.agent.values() == [2]


def test_all_acked_waits_for_the_agent(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    client.ok("publish 0 1")
    result = client.call("acked 0 25")
    assert (result.code, result.slept) == (2, 25)
    client.agent.silent = False
    assert client.call("acked 0 -1").code == 0


@pytest.mark.parametrize(
    "plan", [POOL, changed(POOL, streams__fragments=True)], ids=["whole", "in fragments"]
)
def test_held_messages_wait_for_their_writers_however_long_creation_takes(
    bench: Bench, plan: RuntimePlan
) -> None:
    """Ten objects, each within its time and all after more than that; an agent drops what comes before its writer."""
    client = bench.connected(plan)
    client.ok("publisher 1 0 Int32 second reliable")
    client.ok("publisher 2 0 Int32 third reliable")
    client.agent.silent = True
    for index in range(3):
        client.ok(f"publish {index} {index}")
    client.agent.restart()
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.agent.silent = False
    client.round_trip_ms = POOL.times.create_timeout_ms // 5
    client.spin(200, 10)
    assert [client.agent.values(index) for index in range(3)] == [[0], [1], [2]]


def test_held_messages_go_out_when_one_entity_stays_refused(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    client.ok("publish 0 1")
    client.agent.restart()
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.agent.silent = False
    client.agent.refuse = {"datawriter": 0x80}
    client.spin(100, 10)
    assert client.statistics()["refused"] > 1, "it goes on trying"
    client.agent.refuse = {}
    client.spin(20, 50)
    client.ok("publish 0 2")
    assert client.agent.values()[-1] == 2
