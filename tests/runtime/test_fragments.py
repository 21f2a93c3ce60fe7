# SPDX-License-Identifier: Apache-2.0
"""Reliable messages above the MTU: fragments, window, loss, dropped messages, and new sessions."""

from __future__ import annotations

import random
import struct
from dataclasses import dataclass, field

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.support.examples import examples
from tests.support.plans import POOL, changed
from tests.support.runtime.bench import Bench, ProgramFactory
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent

MTU = 32
CHUNK = MTU - 8
FRAGMENT, HEARTBEAT, WRITE_DATA = 0x0D, 0x0B, 0x07
LARGE = changed(
    POOL,
    streams__mtu=MTU,
    streams__fragments=True,
    streams__reliable_slots=3,
    streams__reliable_slot_size=1024,
)
LARGE_DROP = changed(LARGE, streams__on_full="drop_oldest")
LAST = 0x02
WRITER = b"\0\x05"


def body(size: int, seed: int) -> bytes:
    """Return what `large 0 size seed` writes."""
    return bytes((seed * 31 + i * 7 + i // 256) & 0xFF for i in range(size))


def reliable(datagrams: list[bytes]) -> list[bytes]:
    return [d for d in datagrams if d[1] == 0x80]


def sequence(datagram: bytes) -> int:
    return int(struct.unpack_from("<H", datagram, 2)[0])


def bodies(agent: FakeAgent) -> list[bytes]:
    return [data for target, data in agent.written if target == WRITER]


@pytest.mark.parametrize(
    "size", [1, 20, 21, CHUNK - 8, CHUNK - 7, 2 * CHUNK - 8, 2 * CHUNK - 7, 200, 600, 1008]
)
def test_fragments_join_to_the_submessage(bench: Bench, size: int) -> None:
    client = bench.connected(LARGE)
    client.ok(f"large 0 {size} 3")
    client.ok("flush 1000")
    sent = reliable(client.sent)
    assert all(len(d) <= MTU for d in sent)
    assert [sequence(d) for d in sent] == list(range(1, len(sent) + 1)), "0 has ended what was before"
    whole = struct.pack("<BBHHH", WRITE_DATA, 1, 4 + size, 0, 0x0500) + body(size, 3)
    if len(whole) <= MTU - 4:
        assert [d[4:] for d in sent] == [whole]
    else:
        assert b"".join(d[8:] for d in sent) == whole
        assert [d[4:6] for d in sent] == [bytes((FRAGMENT, 1))] * (len(sent) - 1) + [
            bytes((FRAGMENT, 1 | LAST))
        ]
        assert all(struct.unpack_from("<H", d, 6)[0] == len(d) - 8 for d in sent)
        assert len(sent) == -(-len(whole) // CHUNK)
    assert bodies(client.agent) == [body(size, 3)]
    assert (client.agent.discarded, client.agent.spoiled) == (0, 0)


def test_a_session_begins_with_an_empty_last_fragment(bench: Bench) -> None:
    client = bench.start(LARGE)
    client.agent.chunks = b"\x07\x01\xff\0 what another session left"
    for call in ("init", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
        client.ok(call)
    client.ok("large 0 300 5")
    client.ok("flush 1000")
    assert reliable(client.sent)[0] == bytes.fromhex("81800000 0d030000")
    assert (bodies(client.agent), client.agent.spoiled) == ([body(300, 5)], 1)


def test_a_serialized_message_above_the_slot_is_refused(bench: Bench) -> None:
    client = bench.connected(LARGE)
    result = client.call("large 0 1009 1")
    assert result.code == 1
    assert "1013" in result.error
    assert "1012" in result.error
    client.ok("large 0 1008 1")


def test_no_more_than_sixteen_numbers_are_in_use(bench: Bench) -> None:
    client = bench.connected(LARGE)
    client.spin(3)
    client.sent.clear()
    client.agent.silent = True
    client.ok("large 0 1000 1")
    client.ok("large 0 1000 2")
    client.spin(3)
    assert [sequence(d) for d in reliable(client.sent)] == list(range(1, 17))
    client.agent.silent = False
    client.ok("flush 2000")
    assert bodies(client.agent) == [body(1000, 1), body(1000, 2)]
    assert client.agent.discarded == 0
    assert client.statistics()["resent"] == 16, "each that was lost, once"


def test_only_the_missing_fragment_is_sent_again(bench: Bench) -> None:
    client = bench.connected(LARGE)
    lost = {4, 9}

    def drop(datagram: bytes) -> bool:
        if datagram[1] != 0x80 or sequence(datagram) not in lost:
            return False
        lost.discard(sequence(datagram))
        return True

    client.agent.drop = drop
    client.ok("large 0 300 7")
    client.ok("flush 2000")
    assert bodies(client.agent) == [body(300, 7)]
    assert client.statistics()["resent"] == 2, "though every later piece was answered with both"


def test_small_messages_between_large_ones_go_whole(bench: Bench) -> None:
    client = bench.connected(LARGE)
    client.ok("large 0 100 1")
    client.ok("publish 0 77")
    client.ok("large 0 100 2")
    client.ok("flush 1000")
    assert bodies(client.agent) == [body(100, 1), struct.pack("<i", 77), body(100, 2)]
    assert sum(d[4] == WRITE_DATA for d in reliable(client.sent)) == 1


def test_a_full_stream_counts_messages(bench: Bench) -> None:
    client = bench.connected(LARGE)
    client.agent.silent = True
    for seed in range(3):
        client.ok(f"large 0 500 {seed}")
    result = client.call("large 0 500 9")
    full = "stream full, 3 unacknowledged: the agent is away, or raise pools: {history: 4} in microros.yaml"
    assert result.error == f"publisher /chatter: {full}"


def test_a_new_session_sends_the_whole_again(bench: Bench) -> None:
    client = bench.connected(LARGE)
    client.agent.drop = lambda datagram: datagram[1] == 0x80 and sequence(datagram) > 9
    client.ok("large 0 600 1")
    client.spin(5, 1)
    assert client.agent.chunks, "the agent has a part of it"
    client.agent.restart()
    client.agent.drop = lambda datagram: False
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.agent.silent = False
    client.spin(30, 20)
    client.ok("flush 2000")
    assert client.statistics()["reconnects"] == 1
    assert bodies(client.agent) == [body(600, 1)]
    assert client.agent.spoiled == 1, "a fragment of the previous session"


def test_drop_oldest_leaves_alone_what_is_on_its_way(bench: Bench) -> None:
    client = bench.connected(LARGE_DROP)
    client.spin(3)
    client.agent.silent = True
    for seed in range(1, 8):
        client.ok(f"large 0 900 {seed}")
    assert client.statistics()["dropped"] == 4
    client.agent.silent = False
    client.ok("flush 3000")
    assert bodies(client.agent) == [body(900, 1), body(900, 6), body(900, 7)]
    assert client.agent.spoiled == 0


def test_a_partly_sent_message_is_not_dropped(bench: Bench) -> None:
    """One slot, which the plan refuses with drop_oldest: the newer message is refused."""
    client = bench.connected(changed(LARGE_DROP, streams__reliable_slots=1))
    client.ok("flush 500")
    client.agent.silent = True
    client.ok("large 0 100 1")
    assert client.call("large 0 101 2").code == 1
    client.agent.silent = False
    client.ok("flush 3000")
    client.ok("large 0 102 3")
    client.ok("flush 3000")
    assert bodies(client.agent) == [body(100, 1), body(102, 3)]
    assert client.agent.spoiled == 0


@dataclass
class RoughAgent(FakeAgent):
    """An agent after a network that loses, doubles and reorders, in both directions, while `rough`."""

    chance: random.Random = field(default_factory=lambda: random.Random(0))
    rough: bool = False
    loss: float = 0.2

    def receive(self, datagram: bytes) -> list[bytes]:
        if not self.rough:
            return super().receive(datagram)
        self._on_their_way.append(datagram)
        answers: list[bytes] = []
        while self._on_their_way and self.chance.random() < 0.8:
            arrived = self._on_their_way.pop(self.chance.randrange(len(self._on_their_way)))
            for _ in range(self._copies()):
                answers += super().receive(arrived)
        answers = [a for a in answers for _ in range(self._copies())]
        if self.chance.random() < 0.3:
            self.chance.shuffle(answers)
        return answers

    def _copies(self) -> int:
        return 0 if self.chance.random() < self.loss else self.chance.choice([1, 1, 1, 2])

    def __post_init__(self) -> None:
        self._on_their_way: list[bytes] = []


OPERATIONS = st.lists(
    st.one_of(
        st.tuples(st.just("large"), st.integers(1, 1008)),
        st.tuples(st.just("large"), st.integers(1, 60)),
        st.tuples(st.just("wait"), st.sampled_from([0, 1, 20, 110])),
    ),
    min_size=4,
    max_size=40,
)
PROPERTY = settings(
    max_examples=examples(15),
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def run(programs: ProgramFactory, drop_oldest: bool, operations: list[tuple[str, int]], seed: int) -> None:
    agent = RoughAgent(chance=random.Random(seed))
    accepted = []
    plan = LARGE_DROP if drop_oldest else LARGE
    with Client(programs(plan, "none"), agent) as client:
        for call in ("init", "node 0 talker -", "publisher 0 0 Int32 chatter reliable"):
            client.ok(call)
        agent.rough = True
        for number, (what, value) in enumerate(operations):
            if what == "wait":
                client.spin(2, value)
            elif client.call(f"large 0 {value} {number}").code == 0:
                accepted.append(body(value, number))
        agent.rough = False
        client.ok("flush 6000")
        client.ok("large 0 700 99")
        client.ok("flush 6000")
        accepted.append(body(700, 99))
        found = bodies(agent)
        if drop_oldest:
            places = [accepted.index(b) for b in found]
            assert places == sorted(set(places)), "in order, once each, and nothing else"
            assert found[-1] == accepted[-1]
            assert len(found) + client.statistics()["dropped"] >= len(accepted)
        else:
            assert found == accepted
        assert agent.spoiled == 0


@PROPERTY
@given(operations=OPERATIONS, seed=st.integers(0, 1 << 30))
def test_everything_arrives_once_in_order_and_whole(
    programs: ProgramFactory, operations: list[tuple[str, int]], seed: int
) -> None:
    run(programs, False, operations, seed)


@PROPERTY
@given(operations=OPERATIONS, seed=st.integers(0, 1 << 30))
def test_what_is_dropped_spoils_nothing(
    programs: ProgramFactory, operations: list[tuple[str, int]], seed: int
) -> None:
    run(programs, True, operations, seed)


def test_fragments_that_the_transport_refused_go_out_in_the_next_pump(bench: Bench) -> None:
    client = bench.connected(LARGE)
    client.tell("send_fails 1")
    client.ok("large 0 200 3")
    client.spin(3, 20)
    assert reliable(client.sent) == []
    client.tell("send_fails 0")
    client.spin()
    assert len([d for d in reliable(client.sent) if d[4] == FRAGMENT]) == 9, "208 bytes"
    client.ok("flush 1000")
    assert bodies(client.agent) == [body(200, 3)]
