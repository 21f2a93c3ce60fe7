# SPDX-License-Identifier: Apache-2.0
"""Clients that read, serve and call, and do everything wrong meanwhile: nothing raises, hangs, grows or mixes up."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Acknack, Delete, Fragment, Heartbeat
from microros_gen.agent.wire.message import Header, join, split
from microros_gen.agent.wire.session_messages import GetInfo
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent import captured
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities, sample
from tests.support.agent.storm import bench_with_everything, check
from tests.support.agent.strategies import BY_NAME
from tests.support.examples import examples

IDS = st.sampled_from((0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18, 0x1B, 0x1C, 0x26, 0xFFFE))
STREAMS = st.sampled_from((0, 1, 2, 0x80, 0x81, 0xFF))
CONTROLS = st.builds(
    DeliveryControl,
    st.sampled_from((0, 1, 3, 0xFFFF)),
    st.sampled_from((0, 1)),
    st.sampled_from((0, 50, 0xFFFF)),
    st.sampled_from((0, 100, 0xFFFF)),
)
SUBMESSAGES = st.one_of(
    st.builds(
        ReadData,
        st.just(5),
        IDS,
        STREAMS,
        st.sampled_from((0, 2, 8, 10, 14, 1)),
        st.none(),
        st.none() | CONTROLS,
    ),
    st.builds(WriteData, st.just(6), IDS, st.binary(max_size=40), st.sampled_from((0, 2, 8, 10, 14, 4))),
    st.builds(Delete, st.just(7), IDS),
    st.builds(GetInfo, st.just(8), IDS, st.integers(0, 3)),
    st.builds(Acknack, st.integers(0, 40), st.integers(0, 0xFFFF), st.sampled_from((0x80, 0x81, 1))),
    st.builds(Heartbeat, st.integers(0, 20), st.integers(0, 20), st.sampled_from((0x80, 0x81))),
    st.sampled_from([*entities(), *reader_entities()]),
    st.one_of(*BY_NAME.values()),
)


def say(submessage: Submessage, stream: int, sequence: int) -> Callable[[Bench], object]:
    return lambda bench: bench.say(message(submessage, stream=stream, sequence=sequence))


def arrive(size: int, count: int) -> Callable[[Bench], object]:
    def put(bench: Bench) -> None:
        for source in bench.bridge.sources:
            for number in range(count):
                body = b"\0" + bytes([number & 1]) + b"\0\0" + bytes(size)
                items: dict[str, Any] = {
                    "FakeReader": body,
                    "FakeReplier": (number.to_bytes(24, "little"), body),
                    "FakeRequester": (number, body),
                }
                source.put(items[type(source).__name__])
        bench.agent.take()

    return put


ACTIONS = st.one_of(
    st.builds(say, SUBMESSAGES, STREAMS, st.integers(0, 12)),
    st.builds(arrive, st.sampled_from((0, 4, 600, 3_000, 70_000)), st.integers(1, 30)),
    st.builds(lambda seconds: lambda bench: bench.wait(seconds, step=0.1), st.sampled_from((0.1, 0.5, 2.5))),
    st.just(lambda bench: bench.say(captured.CREATE_CLIENT)),
    st.just(lambda bench: bench.say("81 00 00 00 0c 01 00 00")),
)


@settings(max_examples=examples(120), deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(ACTIONS, max_size=20))
def test_any_conversation_of_one_that_reads(actions: list[Callable[[Bench], object]]) -> None:
    bench = bench_with_everything()
    for action in actions:
        action(bench)
        check(bench)
    bench.agent.close()
    assert bench.bridge.graph == []
    assert bench.agent.due() is None


@pytest.mark.long
@settings(max_examples=5_000, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(ACTIONS, max_size=40))
def test_any_conversation_of_one_that_reads_at_length(actions: list[Callable[[Bench], object]]) -> None:
    bench = bench_with_everything()
    for action in actions:
        action(bench)
    check(bench)


class LossyClient:
    """Reads on a reliable stream over a line that loses, doubles and reorders both ways."""

    def __init__(self, bench: Bench, chance: random.Random, header: Header) -> None:
        self.bench, self.chance, self.header = bench, chance, header
        self.expected = 0
        self.held: dict[int, bytes] = {}
        self.chunks = b""
        self.received: list[bytes] = []

    def hear(self) -> None:
        arrived = [
            data for _, data in self.bench.transport.sent for _ in range(self.chance.choice((0, 1, 1, 2)))
        ]
        self.chance.shuffle(arrived)
        for data in arrived:
            if data[1] == 0x80:
                self.held.setdefault(data[2] | data[3] << 8, data)
        while (data := self.held.pop(self.expected, b"")) != b"":
            self.expected = (self.expected + 1) & 0xFFFF
            self.take(data, 4 if data[0] >= 0x80 else 8)
        self.held = {n: d for n, d in self.held.items() if 0 < (n - self.expected) & 0xFFFF < 16}
        self.bench.transport.sent.clear()

    def take(self, data: bytes, start: int) -> None:
        for identifier, flags, at, end in split(data, start, rest_when_zero=True):
            submessage = decode(identifier, flags, data, at, end)
            if isinstance(submessage, Fragment):
                self.chunks += submessage.data
                if submessage.last:
                    whole, self.chunks = self.chunks, b""
                    self.take(whole, 0)
            elif isinstance(submessage, Data):
                self.received.append(submessage.data)

    def acknowledge(self) -> None:
        if self.chance.random() < 0.6:
            missing = sum(1 << i for i in range(16) if (self.expected + i) & 0xFFFF not in self.held) & 0x0F
            answer = join(self.header, [encode(Acknack(self.expected, missing, 0x80))])
            self.bench.agent.receive(answer, "a", self.bench.transport)
            self.bench.agent.flush()


@pytest.mark.parametrize("keyed", [False, True], ids=["keyless", "keyed"])
@pytest.mark.parametrize("seed", range(4))
def test_every_sample_arrives_once_and_in_order_over_a_bad_line(seed: int, keyed: bool) -> None:
    """8.4.14: heartbeats, acknowledgements and repetition, with samples of all sizes, in either kind of session."""
    chance = random.Random(seed)
    bench = Bench(Limits(client_timeout_s=1e6))
    bench.say(captured.CREATE_CLIENT_KEYED if keyed else captured.CREATE_CLIENT)
    header = Header(1, 0, 0, bytes.fromhex("a1b2c3d4")) if keyed else Header(0x81, 0, 0)
    requests: list[Submessage] = [*reader_entities(), ReadData(9, 0x16, 0x80, delivery=FOREVER)]
    for request in requests:
        bench.say(join(header, [encode(request)]))
    wanted = [sample(i)[4:] + chance.randbytes(chance.choice((0, 3, 60, 700, 3_000))) for i in range(200)]
    todo = [b"\0\1\0\0" + body for body in wanted]
    client = LossyClient(bench, chance, header)
    source = bench.bridge.sources[0]
    for _ in range(20_000):
        if len(client.received) == len(wanted):
            break
        bench.transport.sent.clear()
        if todo and chance.random() < 0.5:
            source.put(*(todo.pop(0) for _ in range(min(len(todo), chance.randrange(8)))))
        bench.agent.take()
        client.acknowledge()
        bench.now += 0.06
        bench.agent.tick()
        client.hear()
    assert client.received == wanted
    assert not bench.log.counters
