# SPDX-License-Identifier: Apache-2.0
"""Texts, requests and replies that are longer than a frame of CAN FD, between two boards of a bus, without an agent."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

from microros_gen.agent.transport.canfd import decode as decode_frame
from microros_gen.agent.wire.entity_messages import Fragment
from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.submessages import decode
from tests.support.e2e.can_bus import CanBus, Fate
from tests.support.runtime.peers import PAIR, board_program, system, unreliable
from tests.support.runtime.text_boards import (
    LONGEST,
    TEXT_APPLICATION,
    Text,
    meet,
    pair,
    publish,
    renumber,
    running,
    until,
)

CANFD = TEXT_APPLICATION + "transport: {type: canfd}\n"
A_TO_B, B_TO_A = 0x10102, 0x10201
MTU = 63
PART = MTU - 8
"""Bytes of a message in a fragment (OMG DDS-XRCE 1.0, 8.3.5.14)."""
SUBMESSAGE = 13
"""Where a record has the kind of its first submessage: after eight bytes, the length, and four of the message."""
FRAGMENT = 0x0D
WRAPS = 0xFFFF - 20


@pytest.fixture(scope="module")
def bus() -> Iterator[CanBus]:
    with CanBus() as running_bus:
        yield running_bus


@pytest.fixture(autouse=True)
def fresh(bus: CanBus) -> None:
    bus.fate = lambda frame: (frame,)
    bus.frames.clear()


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, bus: CanBus) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("boards")
    ends = system(bus.device, bus.device, "canfd")
    first, second = (
        board_program(folder, own, ends, CANFD, CANFD, source="peer_fragments_board.c") for own in PAIR
    )
    return first, second


def arbitrated(seed: int) -> Fate:
    """Return a bus that is busy: of the frames that wait for it, those with the lowest identifiers come first."""
    chance = random.Random(seed)
    waiting: list[bytes] = []

    def fate(frame: bytes) -> Sequence[bytes]:
        waiting.append(frame)
        if chance.randrange(4):
            return ()
        passed = sorted(waiting, key=lambda each: int.from_bytes(each[:4], "little"))
        waiting.clear()
        return passed

    return fate


def lengths(count: int) -> list[Text]:
    """Return texts around the boundaries of fragments, and some of the longest."""
    edges = [MTU - 17, MTU - 16, 2 * PART - 13, 2 * PART - 12, 16 * PART - 13, 17 * PART, LONGEST, 1]
    return [(i % 26, edges[i % len(edges)]) for i in range(count)]


def test_the_fragments_that_a_sniffer_sees(programs: tuple[Path, Path], bus: CanBus) -> None:
    """Their lengths around each boundary, and that only the two identifiers of the link are used."""
    with pair(programs) as (first, second):
        bus.frames.clear()
        for size in (MTU - 17, MTU - 16, 2 * PART - 13, 2 * PART - 12):
            before = len(second.received)
            publish(first, second, [(3, size)])
            until(lambda: len(second.received) > before, first, second)  # noqa: B023
        until(lambda: not first.waiting(), first, second)
    parts = []
    for found in map(decode_frame, bus.frames):
        assert found is not None
        number, data = found
        for span in split(data, header_size(data)):
            submessage = decode(*span[:2], data, *span[2:])
            if number == A_TO_B and isinstance(submessage, Fragment):
                parts.append((len(bytes(submessage.data)), submessage.last))
    # headers of submessage and object, length and end of the string: 13 bytes besides the text
    assert parts == [
        (PART, False),
        (MTU - 16 + 13 - PART, True),
        (PART, False),
        (PART, True),
        (PART, False),
        (PART, False),
        (1, True),
    ]
    assert bus.identifiers() == {A_TO_B, B_TO_A}


@pytest.mark.parametrize("fate", [unreliable(1), arbitrated(2)], ids=["unreliable", "arbitrated"])
def test_a_bad_bus_while_the_numbers_wrap(programs: tuple[Path, Path], bus: CanBus, fate: Fate) -> None:
    """Each text once and in order; the numbers of fragments wrap within a message."""
    texts = lengths(16)
    with pair(programs) as (first, second):
        renumber(bus, first, second, WRAPS)
        bus.fate = fate
        publish(first, second, texts)
        publish(second, first, texts)
        until(lambda: len(first.received) == len(second.received) == len(texts), first, second)
        until(lambda: not first.waiting() and not second.waiting(), first, second)
        for board in (first, second):
            assert board.received == texts
            assert (board.counts[0], board.counts[2]) == (0, 0)


@pytest.mark.parametrize("fate", [unreliable(5), arbitrated(6)], ids=["unreliable", "arbitrated"])
def test_each_request_is_executed_once(programs: tuple[Path, Path], bus: CanBus, fate: Fate) -> None:
    """Requests and replies from one frame to 17, both ways at once, with messages of a topic between them."""
    requests = [(i, 20 + 53 * i) for i in range(8)]
    with pair(programs) as (first, second):
        renumber(bus, first, second, WRAPS)
        bus.fate = fate
        for seed, size in requests:
            for caller, other in ((first, second), (second, first)):
                publish(caller, other, [(seed, 300)])
                until(lambda: not caller.tell(f"ask {seed} {size}"), first, second)  # noqa: B023
            until(lambda: len(first.replies) == len(second.replies) == seed + 1, first, second)  # noqa: B023
        until(lambda: len(first.received) == len(second.received) == len(requests), first, second)
        for board in (first, second):
            assert board.served == requests
            assert board.replies == [(seed + 1, 2 * size) for seed, size in requests]
            assert board.received == [(seed, 300) for seed, _ in requests]


def cut(bus: CanBus, fragments: int) -> Callable[[], bool]:
    """Let so many fragments pass, and nothing after them; return whether that is so."""
    passed: list[bytes] = []

    def fate(frame: bytes) -> Sequence[bytes]:
        if len(passed) >= fragments:
            return ()
        if frame[SUBMESSAGE] == FRAGMENT:
            passed.append(frame)
        return (frame,)

    bus.fate = fate
    return lambda: len(passed) >= fragments


def test_the_receiver_restarts_within_a_message(programs: tuple[Path, Path], bus: CanBus) -> None:
    with running(programs[0]) as first:
        with running(programs[1]) as second:
            meet(first, second)
            is_cut = cut(bus, 5)
            publish(first, second, [(4, LONGEST), (5, 600)])
            until(is_cut, first, second)
            second.tell("spin 5")
            assert second.received == []
        with running(programs[1]) as second:
            bus.fate = unreliable(3)
            until(lambda: len(second.received) == 2, first, second)
            assert second.received == [(4, LONGEST), (5, 600)]


def test_the_sender_restarts_within_a_message(programs: tuple[Path, Path], bus: CanBus) -> None:
    """What arrived of it is dropped, and does not become part of the next one."""
    with running(programs[1]) as second:
        with running(programs[0]) as first:
            meet(first, second)
            is_cut = cut(bus, 5)
            publish(first, second, [(4, LONGEST)])
            until(is_cut, first, second)
            second.tell("spin 5")
        bus.fate = lambda frame: (frame,)
        with running(programs[0]) as first:
            publish(first, second, [(6, 900)])
            until(lambda: second.received, first, second)
            assert second.received == [(6, 900)]
            assert not second.waiting()
            assert second.counts[:2] == (0, 0)


def test_a_request_in_fragments_that_a_restart_interrupts(programs: tuple[Path, Path], bus: CanBus) -> None:
    """The server restarts within a request: the client says so once, and the new life executes it whole, once."""
    with running(programs[0]) as client:
        with running(programs[1]) as server:
            meet(client, server)
            is_cut = cut(bus, 3)
            until(lambda: not client.tell("ask 7 400"), client, server)
            until(is_cut, client, server)
            assert server.served == []
        with running(programs[1]) as server:
            bus.fate = lambda frame: (frame,)
            errors: list[str] = []

            def answered() -> bool:
                errors.append(client.tell("spin 2"))
                server.tell("spin 2")
                return bool(client.replies)

            until(answered)
            assert (server.served, client.replies) == ([(7, 400)], [(8, 800)])
            lost = "service /b/check: a session was lost with 1 requests under way"
            assert [error for error in errors if error] == [lost]
