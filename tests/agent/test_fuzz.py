# SPDX-License-Identifier: Apache-2.0
"""Whatever arrives: nothing raises, hangs or grows. A slice by default, much more with -m long."""

from __future__ import annotations

import random
import time
import tracemalloc

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Fragment
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from tests.support.agent import captured
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.strategies import BY_NAME
from tests.support.examples import examples

LIMITS = Limits(
    clients=20, objects=30, streams=4, message_bytes=20_000, backlog_bytes=4_000, client_timeout_s=5
)
SLOWEST_S = 0.25


def bench_in_session() -> Bench:
    bench = Bench(LIMITS, verbosity=2)
    connect(bench)
    return bench


def connect(bench: Bench) -> None:
    """Let client a begin (again), with a writer to publish on; its streams begin at 0."""
    bench.say(captured.CREATE_CLIENT)
    for create in entities():
        bench.say(message(create, stream=0))


def unharmed(bench: Bench) -> None:
    """No fault of the program was caught, and a new client is served."""
    internal = {k: n for k, n in bench.log.counters.items() if k.startswith("internal_")}
    assert not internal, bench.text.getvalue()
    answer = bench.say(captured.CREATE_CLIENT.replace("a1 b2", "77 77"), "newcomer")
    bench.wait(0.1)
    assert answer[0].startswith("81 00 00 00 04 01 0b 00")
    assert answer[0][24:26] in ("00", "87")


messages = st.one_of(
    st.binary(max_size=100),
    st.builds(
        lambda session, stream, sequence, key, submessages, little: join(
            Header(session, stream, sequence, key if session < 0x80 else b""),
            [encode(s, little) for s in submessages],
        ),
        st.sampled_from((0x00, 0x01, 0x80, 0x81, 0x82)),
        st.sampled_from((0, 1, 2, 0x80, 0x81)),
        st.integers(0, 20) | st.integers(0xFFF0, 0xFFFF),
        st.sampled_from((b"\xa1\xb2\xc3\xd4", b"\1\2\3\4")),
        st.lists(st.one_of(*BY_NAME.values()), max_size=4),
        st.booleans(),
    ),
)
conversation = st.lists(st.tuples(messages, st.sampled_from("abc")), max_size=12)


@settings(
    max_examples=examples(300),
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(conversation)
def test_any_conversation(datagrams: list[tuple[bytes, str]]) -> None:
    bench = bench_in_session()
    for data, address in datagrams:
        bench.say(data, address)
        bench.wait(0.3, step=0.1)
    unharmed(bench)


@pytest.mark.long
@settings(max_examples=20_000, deadline=None, suppress_health_check=list(HealthCheck))
@given(conversation)
def test_any_conversation_at_length(datagrams: list[tuple[bytes, str]]) -> None:
    bench = bench_in_session()
    for data, address in datagrams:
        bench.say(data, address)
    unharmed(bench)


def valid_messages() -> list[bytes]:
    """Every kind of message that a client sends."""
    found = [bytes.fromhex(captured.CREATE_CLIENT), bytes.fromhex(captured.PING)]
    found += [message(create, stream=0x80, sequence=i) for i, create in enumerate(entities(2))]
    found += [
        join(Header(0x81, stream, i), [bytes.fromhex(submessage)])
        for i, submessage in enumerate(captured.SUBMESSAGES.values())
        for stream in (0, 1, 0x80)
    ]
    found.append(message(*(WriteData(1, 0x15, int32_body(i)) for i in range(10)), sequence=40))
    found.append(message(Fragment(bytes(400), False), stream=0x80, sequence=1))
    return found


def mutated(data: bytes, chance: random.Random) -> bytes:
    """Return `data` with some bytes changed, cut, doubled or inserted."""
    out = bytearray(data)
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(out) + 1)
        match chance.randrange(5):
            case 0 if at < len(out):
                out[at] = chance.choice((0, 1, 0x7F, 0x80, 0xFF, chance.randrange(256)))
            case 1 if at < len(out):
                out[at] ^= 1 << chance.randrange(8)
            case 2:
                del out[at : at + chance.randrange(1, 9)]
            case 3:
                out[at:at] = chance.randbytes(chance.randrange(1, 9))
            case _:
                out += out[at : at + 40]
    return bytes(out)


def bombard(rounds: int, seed: int) -> Bench:
    chance = random.Random(seed)
    seeds = valid_messages()
    bench = bench_in_session()
    slowest = 0.0
    for i in range(rounds):
        data = mutated(chance.choice(seeds), chance)
        if chance.random() < 0.7:  # where it reaches further: in session, next in its stream
            data = data[:2] + (i % 20).to_bytes(2, "little") + data[4:]
        start = time.thread_time()
        bench.say(data, chance.choice("aaaab"))
        slowest = max(slowest, time.thread_time() - start)
        if i % 20 == 0:
            bench.wait(0.1)
            connect(bench)
    assert slowest < SLOWEST_S
    return bench


def test_mutations_of_valid_messages() -> None:
    bench = bombard(20_000, seed=1)
    unharmed(bench)
    assert len(bench.bridge.published) > 100, "the mutations reach the writers"
    assert len(bench.log.counters) > 12


@pytest.mark.long
@pytest.mark.parametrize("seed", range(20))
def test_mutations_of_valid_messages_at_length(seed: int) -> None:
    unharmed(bombard(50_000, seed))


@pytest.mark.system
def test_memory_is_bounded() -> None:
    """Strangers, fragments that never end and gaps that never close leave nothing that grows."""
    bench = Bench(LIMITS)
    for number in range(200):
        key = (number + 1).to_bytes(4, "big")
        head = bytes.fromhex("80000000 00011000 58524345 0100 010f") + key
        bench.say(head + bytes.fromhex("81 00 ff ff"), number)
        for sequence in range(40):
            bench.say(message(Fragment(bytes(4_000), False), stream=0x80, sequence=2 * sequence + 1), number)
    assert len(bench.agent.clients) == LIMITS.clients
    tracemalloc.start()
    try:
        for number in range(400):
            for sequence in range(40):
                bench.say(
                    message(Fragment(bytes(4_000), False), stream=0x80, sequence=sequence % 16), number % 30
                )
        assert tracemalloc.get_traced_memory()[0] < LIMITS.clients * 2 * LIMITS.message_bytes
    finally:
        tracemalloc.stop()
