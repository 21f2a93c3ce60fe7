# SPDX-License-Identifier: Apache-2.0
"""A link whose messages are lost or late: few are repeated, so that a slow line does not fill with copies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import pytest

from microros_gen.agent.wire.entity_messages import Acknack
from tests.support.free_ports import free_ports
from tests.support.runtime import peers
from tests.support.runtime.peers import (
    APPLICATION,
    HOST,
    Board,
    Fate,
    Relay,
    board_program,
    calm,
    started,
    system,
)

SURE = 1
HEARTBEAT_MS = 10
LONGEST_PAUSE_MS = 32 * HEARTBEAT_MS
SHORTLY_BEFORE_WRAP = 0xFFFFFFFF - 300
MESSAGES = 4
TIMES = 300
RELIABLE = 0x80
HEARTBEAT = 0x0B
PATIENCE = 1000
"""So that little of the period passes while a machine is busy."""
PAUSES = 7
until = partial(peers.until, at_most_s=20)


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """Return two boards, each of which sees the relay as the other one."""
    folder = tmp_path_factory.mktemp("slow")
    own = free_ports(2)
    first = system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}")
    second = system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}")
    return board_program(folder, "a", first), board_program(folder, "b", second)


@pytest.fixture(scope="module")
def patient(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> Path:
    """Return board a with a longer period."""
    text = APPLICATION.replace(f"heartbeat: {HEARTBEAT_MS} ms", f"heartbeat: {HEARTBEAT_MS * PATIENCE} ms")
    first = system(f"{HOST}:{free_ports(1)[0]}", f"{HOST}:{relay.ports[0]}")
    return board_program(tmp_path_factory.mktemp("patient"), "a", first, text)


@pytest.fixture
def boards(programs: tuple[Path, Path], relay: Relay) -> Iterator[tuple[Board, Board]]:
    """Start both boards shortly before their clocks wrap, and let them meet."""
    relay.fate = lambda data: (data,)
    with started(programs[0], SHORTLY_BEFORE_WRAP) as a, started(programs[1], SHORTLY_BEFORE_WRAP) as b:
        until(lambda: not a.publish(SURE, 0) and b.values[SURE], a, b)
        calm(relay, partial(both, a, b))
        b.values[SURE].clear()
        relay.seen.clear()
        yield a, b
    assert not relay.faults


def both(a: Board, b: Board) -> None:
    a.spin()
    b.spin()


def is_reliable(data: bytes) -> bool:
    return data[1] == RELIABLE


def is_heartbeat(data: bytes) -> bool:
    return data[4] == HEARTBEAT


def without_first(is_meant: Callable[[bytes], bool], lost: list[bytes]) -> Fate:
    """Return a network that loses the first message that is meant, and adds it to `lost`."""

    def fate(data: bytes) -> Sequence[bytes]:
        if is_meant(data) and not lost:
            lost.append(data)
            return ()
        return (data,)

    return fate


def questions(relay: Relay) -> int:
    """Return how many ACKNACKs of board b have asked for messages."""
    return sum(
        isinstance(found, Acknack) and found.missing != 0 for sender, _, found in relay.seen if sender == 1
    )


def test_a_gap_is_reported_once(boards: tuple[Board, Board], relay: Relay) -> None:
    a, b = boards
    lost: list[bytes] = []
    relay.fate = without_first(is_reliable, lost)
    for value in range(MESSAGES):
        assert not a.publish(SURE, value)
    until(lambda: len(b.values[SURE]) == MESSAGES, a, b)
    calm(relay, partial(both, a, b))
    assert b.values[SURE] == [*range(MESSAGES)]
    assert lost
    heartbeats = len(relay.of("Heartbeat"))
    assert questions(relay) <= 1 + heartbeats
    assert len(relay.of("WriteData")) <= MESSAGES * (2 + heartbeats)


def test_late_answers_make_heartbeats_rare(boards: tuple[Board, Board], relay: Relay) -> None:
    a, b = boards
    relay.fate = lambda data: ()
    for value in range(MESSAGES):
        assert not a.publish(SURE, value)
    for _ in range(TIMES):
        a.spin(HEARTBEAT_MS)
        calm(relay, lambda: None)
    silent = len(relay.of("Heartbeat"))
    expected = 5 + TIMES * HEARTBEAT_MS // LONGEST_PAUSE_MS
    assert expected // 2 <= silent <= 2 * expected, f"not one in each of {TIMES} periods"
    relay.fate = lambda data: (data,)
    until(lambda: len(b.values[SURE]) == MESSAGES, a, b)
    assert b.values[SURE] == [*range(MESSAGES)]


def test_the_pause_is_short_again_when_answers_are(boards: tuple[Board, Board], relay: Relay) -> None:
    a, b = boards
    relay.fate = lambda data: ()
    assert not a.publish(SURE, 0)
    for _ in range(100):
        a.spin(HEARTBEAT_MS)
    relay.fate = lambda data: (data,)
    for value in range(1, 8):  # each answer halves the number of doublings
        until(lambda value=value: not a.publish(SURE, value), a, b)  # type: ignore[misc]
        until(lambda value=value: value in b.values[SURE], a, b)  # type: ignore[misc]
        calm(relay, partial(both, a, b))
    relay.seen.clear()
    relay.fate = lambda data: ()
    assert not a.publish(SURE, 8)
    for _ in range(2):
        a.spin(HEARTBEAT_MS)
    calm(relay, lambda: None)
    assert len(relay.of("Heartbeat")) >= 1
    relay.fate = lambda data: (data,)
    until(lambda: 8 in b.values[SURE], a, b)


def test_a_board_that_starts_again_is_asked_soon(
    patient: Path, programs: tuple[Path, Path], relay: Relay
) -> None:
    """After a long silence, and if the HEARTBEAT that greets it is lost."""
    relay.fate = lambda data: (data,)
    with started(patient, SHORTLY_BEFORE_WRAP) as a:
        with started(programs[1]) as b:
            until(lambda: not a.publish(SURE, 0) and b.values[SURE], a, b)
            calm(relay, partial(both, a, b))
            b.kill()
        relay.fate = lambda data: ()
        assert not a.publish(SURE, 1)
        for _ in range(PAUSES):
            a.let_pass(LONGEST_PAUSE_MS * PATIENCE)
            a.spin()
        relay.fate = without_first(is_heartbeat, [])
        with started(programs[1]) as b:
            periods = 0
            while not b.values[SURE]:
                a.let_pass(HEARTBEAT_MS * PATIENCE)
                for board in (a, b):
                    board.spin()
                    calm(relay, lambda: None)
                periods += 1
                assert periods < LONGEST_PAUSE_MS // HEARTBEAT_MS // 2, (
                    "the pause of the silence does not end first"
                )
            assert b.values[SURE] == [1]
