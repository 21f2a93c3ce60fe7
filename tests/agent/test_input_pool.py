# SPDX-License-Identifier: Apache-2.0
"""What unfinished and waiting input takes of all clients together, and how often a client may do what costs much."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.input_pool import Holder, InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.rates import BURST_S, Rate, Rates
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Delete, Fragment
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.captured import CREATE_CLIENT, PING, STATUS_AGENT
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import connected, entities, message, publishing
from tests.support.agent.fakes import Bench
from tests.support.agent.stream_messages import acknacks, heartbeat, write


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(-40, 40)), max_size=60))
def test_a_pool_never_gives_more_than_it_has_nor_less_than_a_share(steps: list[tuple[int, int]]) -> None:
    pool = InputPool(100, 4)
    holders = [Holder(pool) for _ in range(4)]
    for place, size in steps:
        holder = holders[place]
        if size < 0:
            holder.add(-min(-size, holder.held))
            continue
        room = holder.held + size <= pool.share or size <= 100 - sum(max(h.held, pool.share) for h in holders)
        taken = holder.take(size)
        assert taken or not room
    assert sum(holder.held for holder in holders) <= 100
    for holder in holders:
        holder.clear()
    assert pool.free == 100 - 4 * pool.share


def test_what_cannot_be_refused_is_owed() -> None:
    pool = InputPool(100, 2)
    first, second = Holder(pool), Holder(pool)
    first.add(200)
    assert pool.free < 0
    assert second.take(25)
    assert not second.take(1)
    first.clear()
    assert second.take(1)


def begin(bench: Bench, address: str, key: str, size: int) -> None:
    """Connect a client that begins a message of fragments and does not end it."""
    bench.say(CREATE_CLIENT.replace("a1 b2 c3 d4", key), address)
    bench.say(message(Fragment(bytes(size), False), stream=0x80, sequence=0), address)


def test_fragments_of_all_clients_together_are_bounded() -> None:
    """Two take the whole shared part; a third has its own share, and the first gets no more."""
    bench = Bench(Limits(input_bytes=4000, clients=4))
    begin(bench, "a", "00 00 00 0a", 1400)
    begin(bench, "b", "00 00 00 0b", 1400)
    assert not bench.log.counters
    for place, address in enumerate("ab"):
        bench.say(message(Fragment(bytes(400), False), stream=0x80, sequence=1), address)
        assert bench.log.counters == {"input_full": place + 1}
        begin(bench, "a", "00 00 00 0a", 1400) if address == "a" else None
    begin(bench, "c", "00 00 00 0c", 500)
    assert bench.log.counters == {"input_full": 2}


def test_messages_after_a_gap_wait_at_the_client_without_room() -> None:
    bench = publishing(Limits(input_bytes=100, clients=2))
    for sequence in (1, 2, 3, 4, 5, 6, 7, 8, 9):
        bench.say(write(sequence, sequence))
    [(first, missing)] = acknacks(bench.say(heartbeat(0, 9)))
    assert first == 0
    assert 0 < bin(missing).count("1") - 1 < 9, "some are held, some asked for again"
    for sequence in range(10):
        bench.say(write(sequence, sequence))
    assert [int.from_bytes(data[4:8], "little") for _, data in bench.bridge.published] == list(range(10))
    client = bench.agent.clients.with_key(bytes.fromhex("A1B2C3D4"))
    assert client is not None
    assert client.session._holder.held == 0


@pytest.mark.parametrize("end", ["leave", "again", "other session", "reset"])
def test_who_goes_holds_nothing(end: str) -> None:
    bench = Bench()
    begin(bench, "a", "00 00 00 0a", 300)
    (client,) = bench.agent.clients
    holder = client.session._holder
    assert holder.held == 300
    again = CREATE_CLIENT.replace("a1 b2 c3 d4", "00 00 00 0a")
    bench.say(
        {
            "leave": "81 00 00 00 03 01 04 00 00 02 ff fe",
            "again": again,
            "other session": again.replace("81 00 fc", "82 00 fc"),
            "reset": "81 00 00 00 0c 01 00 00",
        }[end]
    )
    assert holder.held == 0


def test_a_client_that_falls_silent_within_a_message_loses_it() -> None:
    bench = publishing()
    whole = encode(WriteData(1, 0x15, int32_body(7)))
    bench.say(message(Fragment(whole[:8], False), stream=0x80, sequence=0))
    bench.say(write(2, 2))
    (client,) = bench.agent.clients
    bench.wait(31)
    assert client.asleep
    assert client.session._holder.held == 0
    assert bench.log.counters == {"unfinished": 1}
    bench.say(message(Fragment(whole[8:], True), stream=0x80, sequence=1))
    bench.say(write(2, 2))
    assert [int.from_bytes(data[4:8], "little") for _, data in bench.bridge.published] == [2]


# Rates


def test_a_rate_has_a_burst_and_then_its_pace() -> None:
    rate = Rate(10)
    assert sum(rate.take(5.0) for _ in range(1000)) == 10 * BURST_S
    assert not rate.take(5.05)
    assert [rate.take(5.31) for _ in range(4)] == [True, True, True, False]
    assert sum(rate.take(1e6) for _ in range(1000)) == 10 * BURST_S


def test_rates_are_remembered_by_key_for_a_bounded_number() -> None:
    rates = Rates(1, 2)
    first = rates.of(b"a")
    assert rates.of(b"b") is not first
    assert rates.of(b"a") is first
    rates.of(b"c")
    assert rates.of(b"a") is first
    rates.of(b"d")
    rates.of(b"e")
    assert rates.of(b"a") is not first


def test_creates_on_a_reliable_stream_wait_and_are_all_done() -> None:
    bench = connected(Limits(operations_per_second=1, objects=50))
    node = entities()[0]
    count = 14
    answers: list[str] = []
    for place in range(count):
        answers += bench.say(message(node, stream=0x80, sequence=place))
    assert sum(" 05 01 " in answer for answer in answers) == BURST_S
    assert acknacks(answers)[-1][0] == BURST_S
    assert bench.log.counters == {"operations_wait": 1}
    bench.wait(5, 0.02)
    assert acknacks(bench.say(heartbeat(0, count - 1))) == [(count, 0)]
    assert bench.log.counters == {"operations_wait": 1}


def test_creates_that_cannot_wait_are_refused() -> None:
    bench = connected(Limits(operations_per_second=1))
    answers = [bench.say(message(Delete(9, 0x15), stream=1, sequence=n))[0] for n in range(12)]
    assert [bytes.fromhex(answer)[-2] for answer in answers] == [0x84] * 10 + [0x87] * 2
    assert bench.log.counters == {"too_many_operations": 2}
    assert bench.say("81 00 00 00 03 01 04 00 00 02 ff fe"), "it may always leave"
    assert not len(bench.agent.clients)
    bench.say(CREATE_CLIENT)
    (answer,) = bench.say(message(Delete(9, 0x15), stream=1, sequence=0))
    assert bytes.fromhex(answer)[-2] == 0x87, "to leave and come again is no way round"


def test_messages_outside_of_its_session_are_limited_for_each_client() -> None:
    bench = connected(Limits(operations_per_second=1))
    answers = [bench.say(PING) for _ in range(15)]
    assert [len(answer) for answer in answers] == [1] * 10 + [0] * 5
    assert bench.say(CREATE_CLIENT) == []
    assert bench.log.counters == {"too_many_operations": 6}
    assert bench.say(CREATE_CLIENT.replace("a1 b2", "a1 b3"), "b") == [STATUS_AGENT], (
        "others are not limited by it"
    )
