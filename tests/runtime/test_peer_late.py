# SPDX-License-Identifier: Apache-2.0
"""Reliable messages of a link that arrive before the program has opened their subscription."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from tests.support.free_ports import free_ports
from tests.support.runtime import peers
from tests.support.runtime.peers import (
    HOST,
    Board,
    Relay,
    board_program,
    calm,
    started,
    system,
    unreliable,
)

BEST, SURE = 0, 1
SHORTLY_BEFORE_WRAP = 0xFFFFFFFF - 300
EARLY_MS = 10_000
HEARTBEAT_MS, STEP_MS, PERIODS = 10, 2, 80


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """Return board a, which publishes, and board b, which opens its subscriptions later."""
    folder = tmp_path_factory.mktemp("late")
    own = free_ports(2)
    first = system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}")
    second = system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}")
    return board_program(folder, "a", first), board_program(folder, "b", second, late=True)


@pytest.fixture(autouse=True)
def fresh(relay: Relay) -> Iterator[None]:
    relay.fate = lambda data: (data,)
    relay.seen.clear()
    yield
    assert not relay.faults


until = partial(peers.until, at_most_s=20)


def run(*boards: Board) -> None:
    """Let boards run for some HEARTBEATs."""
    for _ in range(30):
        for board in boards:
            board.spin()


def send(board: Board, other: Board, values: range) -> None:
    """Publish each value; repeat a call that finds no room, or no board."""
    for value in values:
        until(lambda value=value: not board.publish(SURE, value), board, other)  # type: ignore[misc]


def writes(relay: Relay) -> int:
    """Return how many WRITE_DATA the first board has sent."""
    return sum(sender == 0 for sender, _ in relay.of("WriteData"))


def test_a_message_waits_for_its_subscription(programs: tuple[Path, Path], relay: Relay) -> None:
    with started(programs[0], SHORTLY_BEFORE_WRAP) as a, started(programs[1], SHORTLY_BEFORE_WRAP) as b:
        send(a, b, range(4))
        run(a, b)
        assert "has not acknowledged 4 messages" in a.publish(SURE, 4)
        assert writes(relay) <= 4 + len(relay.of("Heartbeat")), "no flood: the first one after a HEARTBEAT"
        b.open(BEST)
        until(lambda: not a.publish(BEST, 7) and b.values[BEST], a, b)
        assert b.values[SURE] == []
        b.open(SURE)
        send(a, b, range(4, 30))
        until(lambda: len(b.values[SURE]) == 30, a, b)
        assert b.values[SURE] == [*range(30)]
        assert b.dropped() == 0


@pytest.mark.parametrize("seed", [1, 2])
def test_a_message_waits_on_a_bad_network(programs: tuple[Path, Path], relay: Relay, seed: int) -> None:
    relay.fate = unreliable(seed)
    with started(programs[0]) as a, started(programs[1]) as b:
        send(a, b, range(4))
        run(a, b)
        b.open(SURE)
        send(a, b, range(4, 40))
        until(lambda: len(b.values[SURE]) == 40, a, b)
        assert b.values[SURE] == [*range(40)]


def test_a_message_waits_for_a_board_that_starts_again(programs: tuple[Path, Path], relay: Relay) -> None:
    with started(programs[0]) as a:
        with started(programs[1]) as b:
            send(a, b, range(3))
            run(a, b)
            b.kill()
        with started(programs[1]) as b:
            run(a, b)
            b.open(SURE)
            send(a, b, range(3, 10))
            until(lambda: len(b.values[SURE]) == 10, a, b)
            assert b.values[SURE] == [*range(10)]


def test_a_message_that_waits_is_asked_for_in_each_period(programs: tuple[Path, Path], relay: Relay) -> None:
    """The answers are at once: the subscription gets its messages as soon as it is open, however late that is."""
    with started(programs[0], SHORTLY_BEFORE_WRAP) as a, started(programs[1], SHORTLY_BEFORE_WRAP) as b:
        send(a, b, range(4))
        run(a, b)
        relay.seen.clear()
        for _ in range(PERIODS * HEARTBEAT_MS // STEP_MS):
            for board in (a, b):
                board.spin(STEP_MS)
                calm(relay, lambda: None)
        heartbeats = sum(sender == 0 for sender, _ in relay.of("Heartbeat"))
        assert heartbeats >= PERIODS // 2
        assert b.values[SURE] == []
        b.open(SURE)
        until(lambda: len(b.values[SURE]) == 4, a, b)


def test_messages_without_a_subscription_are_counted(programs: tuple[Path, Path], relay: Relay) -> None:
    """Ten seconds after the first one, the messages of other subscriptions go on."""
    with started(programs[0]) as a, started(programs[1]) as b:
        send(a, b, range(4))
        run(a, b)
        assert b.dropped() == 0
        b.let_pass(EARLY_MS)
        send(a, b, range(4, 20))
        until(lambda: b.dropped() == 20, a, b)
        b.open(SURE)
        send(a, b, range(20, 30))
        until(lambda: len(b.values[SURE]) == 10, a, b)
        assert b.values[SURE] == [*range(20, 30)]
        assert b.dropped() == 20


def test_messages_for_a_closed_subscription_are_counted(programs: tuple[Path, Path], relay: Relay) -> None:
    with started(programs[0]) as a, started(programs[1]) as b:
        b.open(SURE)
        send(a, b, range(5))
        until(lambda: len(b.values[SURE]) == 5, a, b)
        b.close(SURE)
        send(a, b, range(5, 12))
        until(lambda: b.dropped() == 7, a, b)
        b.open(SURE)
        send(a, b, range(12, 15))
        until(lambda: len(b.values[SURE]) == 8, a, b)
        assert b.values[SURE] == [*range(5), *range(12, 15)]
