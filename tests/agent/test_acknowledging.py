# SPDX-License-Identifier: Apache-2.0
"""A message that is one ACKNACK takes fewer steps, with the same effects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.agent.fakes import Bench
from tests.support.agent.readers import Listener, put, subscribing

Step = Callable[[Bench], object]


def acknack(session: int, sequence: int, flags: int, first: int, missing: int, stream: int) -> bytes:
    head = bytes((session, 0)) + sequence.to_bytes(2, "little") + bytes((0x0A, flags, 5, 0))
    return head + first.to_bytes(2, "little") + missing.to_bytes(2, "big") + bytes((stream,))


def sent(data: bytes) -> Step:
    return lambda bench: bench.say(data)


def arrived(count: int) -> Step:
    def arrive(bench: Bench) -> None:
        put(bench, *range(count))
        bench.take()

    return arrive


def limited(messages: int) -> Step:
    def limit(bench: Bench) -> None:
        for client in bench.agent.clients:
            client.messages_per_second = messages

    return limit


ACKNACKS = st.builds(
    acknack,
    st.sampled_from([0x81] * 8 + [0x80, 0x82, 0x01, 0xFF]),
    st.integers(0, 0xFFFF),
    st.sampled_from([1] * 8 + [0, 3]),
    st.integers(0, 40) | st.integers(0, 0xFFFF),
    st.sampled_from([0, 0, 0, 1, 3]) | st.integers(0, 0xFFFF),
    st.sampled_from([0x80] * 8 + [0, 1, 0x81, 0xFF]),
)
STEPS = st.lists(
    ACKNACKS.map(sent)
    | st.builds(arrived, st.integers(1, 20))
    | st.sampled_from([0.01, 0.3, 1.1, 20.0]).map(lambda s: lambda bench: bench.wait(s))
    | st.sampled_from([1, 3, 1000]).map(limited)
    | st.binary(min_size=13, max_size=13).map(sent),
    max_size=30,
)


def observed(bench: Bench) -> list[Any]:
    return [
        bench.transport.sent[:],
        dict(bench.log.counters),
        [
            (c.received, c.received_bytes, c.last_received, c.sent, c.sent_bytes, c.asleep, len(c.ready))
            for c in bench.agent.clients
        ],
        [(c.account.messages, c.account.second, c.account.refused) for c in bench.agent.clients],
        bench.agent.due(),
    ]


def listening(is_short: bool) -> Bench:
    bench = subscribing()
    Listener(bench).read(0x80)
    if not is_short:
        bench.agent._processor.acknack = lambda *_: None  # type: ignore[method-assign]
    return bench


@settings(max_examples=150, deadline=None)
@given(STEPS)
def test_both_ways_do_the_same(steps: list[Step]) -> None:
    short, long = listening(True), listening(False)
    for step in steps:
        step(short)
        step(long)
        assert observed(short) == observed(long)


def test_the_short_way_is_taken() -> None:
    bench = listening(True)
    now, address = bench.now, "a"
    (client,) = bench.agent.clients
    assert client.address == address
    assert bench.agent._processor.acknack(acknack(0x81, 0, 1, 1, 0, 0x80), address, now) is client.account
    assert bench.agent._processor.acknack(acknack(0x81, 0, 0, 1, 0, 0x80), address, now) is None
