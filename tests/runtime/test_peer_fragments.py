# SPDX-License-Identifier: Apache-2.0
"""Messages between boards that are larger than the MTU of their link, over a bad network, restarts, and wrap."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

from microros_gen.agent.wire.entity_messages import Fragment
from tests.support.runtime.peers import HOST, Fate, Relay, board_program, system, unreliable
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

MTU = 128
PART = MTU - 8
"""Bytes of a message in a fragment (OMG DDS-XRCE 1.0, 8.3.5.14)."""
FRAGMENT, LAST = 0x0D, 0x02
WRAPS = 0xFFFF - 20


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """The programs of both boards, each of which sees the relay as the other one."""
    folder = tmp_path_factory.mktemp("fragments")
    with Relay() as unused:
        own = unused.ports
    ends = (
        system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}"),
        system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}"),
    )
    texts = [text.replace("type: udp", f"type: udp, mtu: {MTU}") for text in ends]
    first, second = (
        board_program(folder, own, text, TEXT_APPLICATION, TEXT_APPLICATION, source="peer_fragments_board.c")
        for own, text in zip("ab", texts, strict=True)
    )
    return first, second


@pytest.fixture(autouse=True)
def fresh(relay: Relay) -> Iterator[None]:
    relay.fate = lambda data: (data,)
    relay.seen.clear()
    yield
    assert not relay.faults


def lengths(count: int) -> list[Text]:
    """Return texts around the boundaries of fragments, and some of the longest."""
    edges = [MTU - 17, MTU - 16, 2 * PART - 13, 2 * PART - 12, 16 * PART - 13, 17 * PART, LONGEST, 1]
    return [(i % 26, edges[i % len(edges)]) for i in range(count)]


@pytest.mark.parametrize("seed", [None, 4])
def test_fragments_wait_for_their_subscription(
    programs: tuple[Path, Path], relay: Relay, seed: int | None
) -> None:
    """None of them is acknowledged; requests of the other board, which follow them, wait as well."""
    if seed is not None:
        relay.fate = unreliable(seed)
    with running(programs[0]) as first, running(programs[1], "late") as second:
        publish(first, second, [(3, LONGEST), (4, 1)])
        until(lambda: not first.tell("ask 5 300"), first, second)
        for _ in range(50):
            first.tell("spin 1")
            second.tell("spin 1")
        assert first.waiting() == 3
        assert not second.tell("open")
        until(lambda: second.received == [(3, LONGEST), (4, 1)] and first.replies, first, second)
        assert second.counts[:2] == (0, 0)


def test_messages_around_each_boundary(programs: tuple[Path, Path], relay: Relay) -> None:
    """The lengths of messages and fragments, as a decoder of the standard sees them."""
    with pair(programs) as (first, second):
        relay.seen.clear()
        for size in (MTU - 17, MTU - 16, 2 * PART - 13, 2 * PART - 12):
            before = len(second.received)
            publish(first, second, [(3, size)])
            until(lambda: len(second.received) > before, first, second)  # noqa: B023
        until(lambda: not first.waiting(), first, second)
        assert second.received == [(3, MTU - 17), (3, MTU - 16), (3, 2 * PART - 13), (3, 2 * PART - 12)]
    parts = [sub for sender, _, sub in relay.seen if sender == 0 and isinstance(sub, Fragment)]
    # headers of submessage and object, length and end of the string: 13 bytes besides the text
    assert [(len(bytes(sub.data)), sub.last) for sub in parts] == [
        (PART, False),
        (MTU - 16 + 13 - PART, True),
        (PART, False),
        (PART, True),
        (PART, False),
        (PART, False),
        (1, True),
    ]


def test_a_message_of_more_fragments_than_the_window(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, second):
        publish(first, second, [(7, LONGEST)])
        publish(second, first, [(9, LONGEST)])
        until(lambda: first.received and second.received, first, second)
        assert (first.received, second.received) == ([(9, LONGEST)], [(7, LONGEST)])


@pytest.mark.parametrize("seed", [1, 2])
def test_a_bad_network(programs: tuple[Path, Path], relay: Relay, seed: int) -> None:
    """Loss, repetition and another order, while the numbers of fragments wrap within a message."""
    texts = lengths(16)
    with pair(programs) as (first, second):
        renumber(relay, first, second, WRAPS)
        relay.fate = unreliable(seed)
        publish(first, second, texts)
        publish(second, first, texts)
        until(lambda: len(first.received) == len(second.received) == len(texts), first, second)
        until(lambda: not first.waiting() and not second.waiting(), first, second)
        for board in (first, second):
            assert board.received == texts
            assert (board.counts[0], board.counts[2]) == (0, 0)


def test_services(programs: tuple[Path, Path], relay: Relay) -> None:
    """Requests and replies in fragments, each once, over a bad network."""
    requests = [(i, 20 + 53 * i) for i in range(8)]
    with pair(programs) as (first, second):
        relay.fate = unreliable(5)
        for seed, size in requests:
            for caller in (first, second):
                until(lambda: not caller.tell(f"ask {seed} {size}"), first, second)  # noqa: B023
            until(lambda: len(first.replies) == len(second.replies) == seed + 1, first, second)  # noqa: B023
        for board in (first, second):
            assert board.served == requests
            assert board.replies == [(seed + 1, 2 * size) for seed, size in requests]


def cut(relay: Relay, fragments: int) -> Callable[[], bool]:
    """Let so many fragments pass, and nothing after them; return whether that is so."""
    passed: list[bytes] = []

    def fate(data: bytes) -> Sequence[bytes]:
        if len(passed) >= fragments:
            return ()
        if data[4] == FRAGMENT:
            passed.append(data)
        return (data,)

    relay.fate = fate
    return lambda: len(passed) >= fragments


def test_the_receiver_restarts_within_a_message(programs: tuple[Path, Path], relay: Relay) -> None:
    with running(programs[0]) as first:
        with running(programs[1]) as second:
            meet(first, second)
            is_cut = cut(relay, 5)
            publish(first, second, [(4, LONGEST), (5, 600)])
            until(is_cut, first, second)
            second.tell("spin 5")
            assert second.received == []
        with running(programs[1]) as second:
            relay.fate = unreliable(3)
            until(lambda: len(second.received) == 2, first, second)
            assert second.received == [(4, LONGEST), (5, 600)]


def test_the_sender_restarts_within_a_message(programs: tuple[Path, Path], relay: Relay) -> None:
    """What arrived of it is dropped, and does not become part of the next one."""
    with running(programs[1]) as second:
        with running(programs[0]) as first:
            meet(first, second)
            is_cut = cut(relay, 5)
            publish(first, second, [(4, LONGEST)])
            until(is_cut, first, second)
            second.tell("spin 5")
        relay.fate = lambda data: (data,)
        with running(programs[0]) as first:
            publish(first, second, [(6, 900)])
            until(lambda: second.received, first, second)
            assert second.received == [(6, 900)]
            assert not second.waiting()
            assert second.counts[:2] == (0, 0)


def test_a_serialized_message_above_the_largest_one(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, _):
        body = LONGEST + 5  # length and end of the string
        assert not first.tell(f"serialized {4 + body}")
        assert f"{body + 1} bytes above {body}" in first.tell(f"serialized {4 + body + 1}")


def changed(wrong: Callable[[bytes], bytes]) -> Fate:
    """Return a network that changes each last fragment once."""
    known: set[bytes] = set()

    def fate(data: bytes) -> Sequence[bytes]:
        if data[4] == FRAGMENT and data[5] & LAST and data not in known:
            known.add(data)
            return (wrong(data),)
        return (data,)

    return fate


@pytest.mark.parametrize(
    ("wrong", "counted"),
    [
        (lambda data: data[:5] + bytes([data[5] & ~LAST]) + data[6:], 1),  # the next message follows it
        (lambda data: data[:6] + b"\x08\x00" + data[8:16], 1),  # shorter than its submessage says
    ],
)
def test_a_message_that_does_not_end_is_counted(
    programs: tuple[Path, Path], relay: Relay, wrong: Callable[[bytes], bytes], counted: int
) -> None:
    """A wrong board: the message is lost, the next ones are not."""
    with pair(programs) as (first, second):
        relay.fate = changed(wrong)
        publish(first, second, [(4, 300)])
        until(lambda: not first.waiting(), first, second)
        relay.fate = lambda data: (data,)
        publish(first, second, [(8, 20), (9, 300)])
        until(lambda: len(second.received) == 2, first, second)
        assert second.received == [(8, 20), (9, 300)]
        second.waiting()
        assert second.counts[:2] == (0, counted)
