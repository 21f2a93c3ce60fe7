# SPDX-License-Identifier: Apache-2.0
"""Connecting, losing the session and reconnecting, and whatever a network can throw at a client."""

from __future__ import annotations

import random
import struct

import pytest

from tests.support.plans import DECLARED, POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.fake_agent import FakeAgent

PERIOD = POOL.times.liveliness_period_ms
LOGIN = bytes.fromhex("80000000 0001")


def test_no_agent_is_a_timeout_that_says_where(bench: Bench) -> None:
    client = bench.start(agent=FakeAgent(silent=True))
    result = client.call("init")
    assert result.code == 2
    assert result.error == "no agent answers at 127.0.0.1:8888 within 400 ms"
    assert POOL.times.connect_timeout_ms <= result.slept <= POOL.times.connect_timeout_ms + 1
    assert [d[:6] for d in client.sent] == [LOGIN] * 5, "at 0, 40, 80, 160 and 320 ms"
    client.agent.silent = False
    client.ok("init")


def test_a_transport_that_does_not_open(bench: Bench) -> None:
    client = bench.start()
    client.tell("open_fails 1")
    result = client.call("init")
    assert (result.code, result.error) == (1, "no transport to 127.0.0.1:8888")
    client.tell("open_fails 0")
    client.ok("init")


@pytest.mark.parametrize(
    ("status", "name"), [(0x80, "DDS_ERROR"), (0x85, "INVALID_DATA"), (0x87, "RESOURCES")]
)
def test_an_agent_that_refuses_the_session(bench: Bench, status: int, name: str) -> None:
    client = bench.start(agent=FakeAgent(session_status=status))
    result = client.call("init")
    assert (result.code, result.error) == (1, f"the agent at 127.0.0.1:8888 refuses the session: {name}")


def test_a_matched_session_is_a_success(bench: Bench) -> None:
    bench.start(agent=FakeAgent(session_status=1)).ok("init")


def test_lost_datagrams_of_every_kind_are_repeated(bench: Bench) -> None:
    seen: set[bytes] = set()

    def first_time(datagram: bytes) -> bool:
        fresh = datagram[4:] not in seen
        seen.add(datagram[4:])
        return fresh

    client = bench.start(agent=FakeAgent(drop=first_time))
    for call in (
        "init",
        "node 0 n -",
        "publisher 0 0 Int32 x reliable",
        "publisher_fini 0 0",
        "node_fini 0",
        "fini",
    ):
        client.ok(call)
    assert len(client.sent) == 2 * 10
    assert not client.agent.objects
    assert not client.agent.connected


def test_lost_answers_are_asked_for_again(bench: Bench) -> None:
    seen: set[bytes] = set()

    def first_time(answer: bytes) -> bool:
        fresh = answer[8:] not in seen
        seen.add(answer[8:])
        return fresh

    client = bench.start(agent=FakeAgent(drop_answer=first_time))
    for call in ("init", "node 0 n -", "publisher 0 0 Int32 x reliable"):
        client.ok(call)
    assert len(client.agent.objects) == 4


def test_one_session_at_a_time(bench: Bench) -> None:
    client = bench.start()
    client.ok("init")
    result = client.call("init")
    assert (result.code, result.error) == (1, "a context is open already: there is one session")


def test_everything_can_be_done_again_after_fini(bench: Bench) -> None:
    client = bench.connected()
    client.ok("publish 0 1")
    client.ok("fini")
    assert client.call("publish 0 2").code == 300
    assert client.call("fini").code != 0
    for call in ("init", "node 0 talker -", "publisher 0 0 Int32 chatter reliable", "publish 0 3"):
        client.ok(call)
    assert client.agent.values() == [1, 3]
    assert client.statistics()["reconnects"] == 0, "counted since rcl_init"


def test_fini_without_an_agent_ends(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    result = client.ok("publisher_fini 0 0")
    assert POOL.times.close_timeout_ms <= result.slept <= POOL.times.close_timeout_ms + 1
    client.ok("destroy_timeout 0")
    assert client.ok("node_fini 0").slept == 0
    sent = len(client.sent)
    assert client.ok("fini").slept == 0
    assert client.sent[sent:] == [bytes.fromhex("81000000 03010400 0002fffe")], "says goodbye once"


def test_silence_is_asked_about_and_then_the_session_is_lost(bench: Bench) -> None:
    client = bench.connected()
    client.spin()
    client.agent.silent = True
    client.sent.clear()
    client.spin(PERIOD - 1, 1)
    assert client.sent == []
    client.spin(1, 1)
    ping = bytes.fromhex("81000000 02010800 000afffd 02000000")
    assert client.sent == [ping]
    client.spin(POOL.times.liveliness_attempts * PERIOD - 1, 1)
    assert client.sent == [ping] * POOL.times.liveliness_attempts
    client.spin(1, 1)
    assert client.sent[-1][:6] == LOGIN
    assert client.call("connected").code == 0


def test_an_agent_that_answers_pings_keeps_the_session(bench: Bench) -> None:
    client = bench.connected()
    client.spin(50, PERIOD)
    assert client.statistics()["reconnects"] == 0
    assert sum(d[4] == 2 for d in client.sent) >= 20


@pytest.mark.parametrize("liveliness", ["ping", "acknack"])
@pytest.mark.parametrize("plan", [POOL, DECLARED], ids=["pool", "declared"])
def test_publishing_alone_finds_back_to_a_restarted_agent(bench: Bench, liveliness: str, plan) -> None:  # type: ignore[no-untyped-def]
    client = bench.connected(plan, liveliness)
    for value in range(3):
        client.ok(f"publish 0 {value}")
    client.spin()
    client.agent.restart()
    failed = 0
    for value in range(3, 100):
        client.wait(20)
        failed += client.call(f"publish 0 {value}").code != 0
    client.ok("flush 1000")
    values = client.agent.values()
    assert values[-1] == 99
    assert values == sorted(set(values)), "none twice, none out of order"
    assert len(values) == 100 - failed, "every accepted message arrived: unacknowledged ones were sent again"
    assert failed == client.statistics()["dropped"]
    assert client.statistics()["reconnects"] == 1
    assert client.call("connected").code == 1
    assert len(client.agent.objects) == 4


def test_the_ping_finds_a_restart_at_once(bench: Bench) -> None:
    client = bench.connected(qos="best_effort")
    client.agent.restart()
    client.spin(1, PERIOD)
    client.spin(8)
    assert client.call("connected").code == 1
    client.ok("publish 0 1")
    assert client.agent.values() == [1]


def test_without_liveliness_nothing_is_asked(bench: Bench) -> None:
    client = bench.connected(liveliness="none", qos="best_effort")
    client.agent.restart()
    client.spin(50, 1000)
    assert client.sent == []
    assert client.call("connected").code == 1


def test_no_session_refuses_at_once_and_counts(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, PERIOD)
    result = client.call("publish 0 1")
    assert (result.code, result.slept) == (1, 0)
    assert result.error == "publisher /chatter: no session with the agent"
    assert client.statistics()["dropped"] == 1


def test_reconnection_slows_down(bench: Bench) -> None:
    client = bench.connected()
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, PERIOD)
    client.sent.clear()
    client.spin(1600, 1)
    assert len(client.sent) in (10, 11), "every retry_most_ms = 160"


def test_ping_api(bench: Bench) -> None:
    client = bench.start()
    assert client.call("ping 10 1").code == 0, "without a session, over its own transport"
    assert client.sent == [bytes.fromhex("80000000 02010800 000afffd 02000000")]
    client.agent.silent = True
    result = client.call("ping 10 3")
    assert result.code == 1
    assert 30 <= result.slept <= 33
    assert (
        client.call("ping_options 10 1 10.1.1.1 99").error == "no agent answers at 10.1.1.1:99 within 10 ms"
    )
    client.agent.silent = False
    client.ok("init")
    client.sent.clear()
    assert client.call("ping 10 1").code == 0
    assert client.sent == [bytes.fromhex("81000000 02010800 000afffd 02000000")]
    client.agent.silent = True
    assert client.call("ping 10 2").code == 1


GARBAGE = {
    "empty header": "81",
    "foreign session": "42010000 05010600 000a0001 0000",
    "header of a submessage cut": "81010000 0501",
    "payload cut": "81010000 05010600 000a",
    "length beyond the end": "81010000 0501ffff 000a0001 0000",
    "status too short": "81010000 05010400 000a0001",
    "info too short": "81000000 06010400 000afffd",
    "acknack too short": "81000000 0a010400 00000000",
    "status_agent too short": "81000000 04010100 00",
    "larger than the input": "81010000 0501c800" + "00" * 200,
}


@pytest.mark.parametrize("datagram", GARBAGE.values(), ids=GARBAGE.keys())
def test_garbage_is_counted_and_harmless(bench: Bench, datagram: str) -> None:
    client = bench.connected()
    if "04010100" in datagram:
        client.agent.restart()
        client.spin(2, PERIOD)
    before = client.statistics()
    client.queued.append(bytes.fromhex(datagram))
    client.spin()
    after = client.statistics()
    assert after["malformed"] == before["malformed"] + 1
    client.spin(20, 50)
    client.ok("publish 0 1")
    assert client.agent.values() == [1]


def test_what_is_not_for_this_client_is_passed_over(bench: Bench) -> None:
    client = bench.connected()
    unknown = "81010000 0f010400 01020304 09010300 010203 00 0a010500 00000000 80"
    client.queued.append(bytes.fromhex(unknown))
    client.spin()
    assert client.statistics()["malformed"] == 0


def test_acknacks_in_either_byte_order(bench: Bench) -> None:
    client = bench.connected()
    client.agent.drop_answer = lambda answer: True
    client.ok("publish 0 1")
    assert client.call("flush 0").code == 2
    client.queued.append(bytes.fromhex("81000000 0a000500 00010000 80"))
    client.ok("flush 0")


@pytest.mark.parametrize("seed", range(3))
def test_random_datagrams_never_leave_the_bounds(bench: Bench, seed: int) -> None:
    chance = random.Random(seed)
    client = bench.connected()
    client.ok("publish 0 1")
    for _ in range(300):
        client.queued.append(_random_datagram(chance))
        if chance.random() < 0.2:
            client.call(f"publish 0 {chance.randrange(100)}")
    client.agent.drop_answer = lambda answer: False
    client.spin(100, 50)
    assert client.call("connected").code == 1, "it found back"


def _random_datagram(chance: random.Random) -> bytes:
    body = b""
    for _ in range(chance.randrange(1, 4)):
        payload = chance.randbytes(chance.randrange(0, 24))
        size = len(payload) if chance.random() < 0.7 else chance.randrange(0x10000)
        body += bytes([chance.randrange(0, 17), chance.randrange(4)]) + struct.pack("<H", size) + payload
        body += b"\0" * (-len(body) % 4)
    header = bytes([chance.choice([0x81, 0x80, 0]), chance.choice([0, 1, 0x80]), 0, 0])
    return (header + body)[: chance.randrange(1, 120)]


def test_times_of_the_plan_hold(bench: Bench) -> None:
    plan = changed(POOL, times__connect_timeout_ms=50)
    client = bench.start(plan, agent=FakeAgent(silent=True))
    assert 50 <= client.call("init").slept <= 51
