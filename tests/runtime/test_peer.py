# SPDX-License-Identifier: Apache-2.0
"""Two boards on one link without an agent: both streams, a bad network, restarts, and what a decoder sees."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.session_messages import CreateClient, StatusAgent
from tests.support.free_ports import free_ports
from tests.support.runtime.peer_scenarios import BEST, SURE, meet, restart_one, send
from tests.support.runtime.peers import (
    HOST,
    Board,
    Relay,
    board_program,
    received,
    started,
    system,
    unreliable,
    until,
)

BEST_EFFORT = 1
"""The stream."""
SHORTLY_BEFORE_WRAP = 0xFFFFFFFF - 300
HALF_BEFORE_WRAP = 0x7FFFFFFF - 300


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """The programs of both boards, each of which sees the relay as the other one."""
    folder = tmp_path_factory.mktemp("peers")
    own = own_ports()
    first = system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}")
    second = system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}")
    return board_program(folder, "a", first), board_program(folder, "b", second)


@pytest.fixture(autouse=True)
def fresh(relay: Relay) -> Iterator[None]:
    relay.fate = lambda data: (data,)
    relay.seen.clear()
    yield
    assert not relay.faults


def own_ports() -> tuple[int, int]:
    """Return two ports that nobody has now."""
    first, second = free_ports(2)
    return first, second


@contextmanager
def pair(programs: tuple[Path, Path], clock: int = 0) -> Iterator[tuple[Board, Board]]:
    with started(programs[0], clock) as first, started(programs[1], clock) as second:
        meet(first, second)
        yield first, second


def test_both_ways_on_both_streams(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, second):
        for topic in (BEST, SURE):
            send(first, [second], topic, range(10))
            send(second, [first], topic, range(100, 110))
        until(lambda: all(len(g) == 10 for board in (first, second) for g in board.values), first, second)
        assert first.values == ([*range(100, 110)], [*range(100, 110)])
        assert second.values == ([*range(10)], [*range(10)])
        first.end()
        second.end()


def test_one_number_far_ahead_stops_no_messages(programs: tuple[Path, Path], relay: Relay) -> None:
    """Forged, or after a silence of minutes: the numbers between are not older ones."""
    with pair(programs) as (first, second):
        meet(first, second)

        def forged(data: bytes) -> Sequence[bytes]:
            if data[1] != BEST_EFFORT:
                return (data,)
            relay.fate = lambda other: (other,)
            number = int.from_bytes(data[2:4], "little") + 0x7FFE
            return (data[:2] + (number & 0xFFFF).to_bytes(2, "little") + data[4:],)

        relay.fate = forged
        send(first, [second], BEST, range(5))
        until(partial(received, second, BEST, 5), first, second)
        assert second.values[BEST] == [*range(5)]


def test_what_a_sniffer_sees(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, second):
        send(first, [second], SURE, range(1))
        until(lambda: second.values[SURE] and relay.of("Acknack"), first, second)
    creates = {(sender, sub.session) for sender, _, sub in relay.seen if isinstance(sub, CreateClient)}
    assert {(sender, session % 2) for sender, session in creates} == {(0, 1), (1, 0)}
    # A client sends in its own session, and the other board answers in it as the agent.
    clients = {session: sender for sender, session in creates}
    for name, own in (("WriteData", True), ("Heartbeat", True), ("Acknack", False), ("StatusAgent", False)):
        assert all((clients[session] == sender) == own for sender, session in relay.of(name)), name
    assert {sub.status for _, _, sub in relay.seen if isinstance(sub, StatusAgent)} <= {0, 0x82}
    sure = [sub for _, _, sub in relay.seen if isinstance(sub, WriteData) and bytes(sub.data) == bytes(4)]
    assert [sub.object for sub in sure] == [0x0015]  # /a/best, /a/sure, /b/best, /b/sure: the second topic


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_network_that_loses_repeats_and_reorders(
    programs: tuple[Path, Path], relay: Relay, seed: int
) -> None:
    with pair(programs) as (first, second):
        relay.fate = unreliable(seed)
        for start in range(0, 60, 20):
            for topic in (BEST, SURE):
                send(first, [second], topic, range(start, start + 20))
                send(second, [first], topic, range(start, start + 20))
            for board in (first, second):
                until(partial(received, board, SURE, start + 20), first, second)
        for board in (first, second):
            assert board.values[SURE] == [*range(60)]
            best = board.values[BEST]
            assert best == sorted(set(best))
            assert 20 < len(best) < 60


def test_a_board_restarts(programs: tuple[Path, Path], relay: Relay) -> None:
    restart_one(programs, 4)


def test_what_is_not_acknowledged_outlasts_a_restart_of_the_other_board(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    with started(programs[0]) as first:
        with started(programs[1]) as second:
            meet(first, second)
            second.kill()
        send(first, [first], SURE, range(4))
        assert "the board b has not acknowledged 4 messages" in first.publish(SURE, 4)
        relay.fate = lambda data: ()  # what arrives before its subscription is open is for nobody
        with started(programs[1]) as second:
            second.spin()
            relay.fate = lambda data: (data,)
            until(lambda: len(second.values[SURE]) == 4, first, second)
            assert second.values[SURE] == [*range(4)]


def test_without_the_other_board(programs: tuple[Path, Path], relay: Relay) -> None:
    with started(programs[0]) as first:
        for topic in (BEST, SURE):
            assert "the board b does not answer" in first.publish(topic, 1)
        first.end()


def test_a_repeated_request_for_a_session_ends_none(programs: tuple[Path, Path], relay: Relay) -> None:
    kept: list[bytes] = []

    def fate(data: bytes) -> list[bytes]:
        if data[4] == 0:  # CREATE_CLIENT
            kept.append(data)
        return [*kept, data] if data[4] == 7 else [data]

    with pair(programs) as (first, second):
        relay.fate = fate
        first.kill()
        with started(programs[0]) as again:
            meet(again, second)
            send(again, [second], SURE, range(20))
            until(lambda: len(second.values[SURE]) == 20, again, second)
            assert second.values[SURE] == [*range(20)]
    assert kept


def test_a_wait_ends_when_a_message_of_the_other_board_arrives_and_not_before(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    with pair(programs) as (first, second):
        first.spin(50)
        first.begin("rest 1000")
        assert first.heard() < 100  # with a look at the link in each millisecond, thousands
        start = time.monotonic()
        first.begin("rest 30000")
        time.sleep(0.2)
        assert not second.publish(BEST, 5)
        first.heard()
        assert first.values[BEST] == [5]
        assert time.monotonic() - start < 15


@pytest.mark.parametrize("clock", [SHORTLY_BEFORE_WRAP, HALF_BEFORE_WRAP])
def test_the_clock_wraps(programs: tuple[Path, Path], relay: Relay, clock: int) -> None:
    with pair(programs, clock) as (first, second):
        relay.fate = unreliable(4)
        end = time.monotonic() + 0.6
        count = 0
        while time.monotonic() < end:
            send(first, [second], SURE, range(count, count + 4))
            count += 4
        until(lambda: len(second.values[SURE]) == count, first, second)
        assert second.values[SURE] == [*range(count)]
