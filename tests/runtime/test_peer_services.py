# SPDX-License-Identifier: Apache-2.0
"""Services between two boards on one link: requests and replies over a bad network, restarts, and numbers that wrap."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.agent.wire.data_messages import WriteData
from tests.support.free_ports import free_ports
from tests.support.patience import deadline
from tests.support.runtime.peers import HOST, Relay, system, unreliable
from tests.support.runtime.service_boards import ServiceBoard, service_board, service_board_program, until

SLOTS = 4
ADD_REQUESTS, ADD_REPLIES, LATER_REPLIES = 0x0007, 0x0008, 0x0018
"""Objects of /a/add and /a/later, the first two of four services: requester and repliers."""
FIRST_REQUEST = 0x000B
WRAPS = 0xFFFF - 5
SHORTLY_BEFORE_WRAP = 0xFFFFFFFF - 300


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """The programs of both boards, each of which sees the relay as the other one."""
    folder = tmp_path_factory.mktemp("boards")
    own = free_ports(2)
    ends = {
        "a": system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}"),
        "b": system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}"),
    }
    return service_board_program(folder, "a", ends["a"]), service_board_program(folder, "b", ends["b"])


@pytest.fixture(autouse=True)
def fresh(relay: Relay) -> Iterator[None]:
    relay.fate = lambda data: (data,)
    relay.seen.clear()
    yield
    assert not relay.faults


def ask(board: ServiceBoard, other: ServiceBoard, values: range, command: str = "ask") -> None:
    """Call the other board with each value and 1; repeat a call that finds no room."""
    for value in values:
        until(lambda value=value: not board.tell(f"{command} {value} 1"), board, other)  # type: ignore[misc]


def call(board: ServiceBoard, other: ServiceBoard, values: range) -> None:
    """The same, at most as many requests at a time as the queue has room for."""
    for start in range(0, len(values), SLOTS):
        before = len(board.replies)
        some = values[start : start + SLOTS]
        ask(board, other, some)
        until(lambda: len(board.replies) >= before + len(some), board, other)  # noqa: B023


def settle(first: ServiceBoard, second: ServiceBoard) -> None:
    """Let two boards run until nothing is under way: best-effort messages pass after all others of their direction."""
    until(lambda: first.counts()[2] == second.counts()[2] == 0, first, second)
    for value, sender, receiver in ((1001, first, second), (1002, second, first), (1003, first, second)):
        assert not sender.tell(f"signal {value}")
        until(lambda: value in receiver.received, receiver)  # noqa: B023


@contextmanager
def pair(programs: tuple[Path, Path], clock: int = 0) -> Iterator[tuple[ServiceBoard, ServiceBoard]]:
    with service_board(programs[0], clock) as first, service_board(programs[1], clock) as second:
        call(first, second, range(1))
        call(second, first, range(1))
        for board in (first, second):
            board.served.clear()
            board.replies.clear()
        yield first, second


def asked(values: range) -> list[tuple[int, int]]:
    return [(value, 1) for value in values]


def answered(values: range, first: int = 2) -> list[tuple[int, int]]:
    return [(first + i, value + 1) for i, value in enumerate(values)]


def test_both_boards_serve_and_call(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, second):
        relay.seen.clear()
        call(first, second, range(10, 20))
        call(second, first, range(30, 40))
        assert (first.served, second.served) == (asked(range(30, 40)), asked(range(10, 20)))
        assert first.replies == answered(range(10, 20))
        assert second.replies == answered(range(30, 40))
    # What a sniffer sees: requests as to an agent, and replies with the identity of their request.
    writes = [(sender, sub) for sender, _, sub in relay.seen if isinstance(sub, WriteData)]
    requests = [sub for sender, sub in writes if sender == 1 and sub.object == ADD_REQUESTS]
    replies = [sub for sender, sub in writes if sender == 0 and sub.object == ADD_REPLIES]
    assert len(requests) == len(replies) == 10
    assert [len(bytes(sub.data)) for sub in requests] == [16] * 10
    for request, reply in zip(requests, replies, strict=True):
        identity = bytes(reply.data)[:24]
        assert identity[:8] == b"\xff" * 8
        assert int.from_bytes(identity[16:20], "little") == 0
        assert int.from_bytes(identity[20:], "little") == request.request


@pytest.mark.parametrize("clock", [0, SHORTLY_BEFORE_WRAP])
def test_a_bad_network_executes_each_request_once(
    programs: tuple[Path, Path], relay: Relay, clock: int
) -> None:
    """Loss, repetition and another order, while the clock and the numbers of messages and requests wrap."""
    with pair(programs, clock) as (first, second):
        settle(first, second)
        for board in (first, second):
            assert not board.tell(f"numbers {WRAPS} {WRAPS}")
        relay.fate = unreliable(7)
        for start in range(0, 24, SLOTS):
            some = range(start, start + SLOTS)
            ask(first, second, some)
            ask(second, first, some)
            until(lambda: len(first.replies) == len(second.replies) == start + SLOTS, first, second)  # noqa: B023
        for board in (first, second):
            assert board.served == asked(range(24))
            assert board.replies == answered(range(24))
            assert board.counts()[:2] == (0, 0)


def test_a_server_that_restarts(programs: tuple[Path, Path], relay: Relay) -> None:
    with service_board(programs[0]) as client:
        with service_board(programs[1]) as server:
            call(client, server, range(1))
            ask(client, server, range(5, 7), "ask_later")
            until(lambda: server.takes(2), client, server)
            server.kill()
        with service_board(programs[1]) as server:
            end = deadline(10)
            while not (error := client.tell("spin 5")):
                assert time.monotonic() < end
                server.tell("spin 2")
            assert "service /b/later: a session was lost with 2 requests under way" in error
            call(client, server, range(20, 22))
            assert client.replies[-2:] == [(2, 21), (3, 22)]
            assert not client.later
            assert client.counts()[1] == 2


@pytest.mark.system
def test_the_reply_to_a_client_that_has_restarted_is_dropped(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    """The new life asks with the same number and gets no answer of the former one."""
    with service_board(programs[1]) as server:
        for life in range(3):
            with service_board(programs[0]) as client:
                ask(client, server, range(life * 10, life * 10 + 1), "ask_later")
                until(lambda: server.takes(life + 1), client, server)  # noqa: B023
                if life < 2:
                    client.kill()
                    continue
                for i in range(2):
                    assert not server.tell(f"answer {i}")
                until(lambda: server.counts()[0] == 2, client, server)
                assert not client.later
                assert not server.tell("answer 2")
                until(lambda: client.later, client, server)
                assert client.later == [(1, 21)]
                assert not server.tell("answer 2")  # a second answer to one request
                until(lambda: client.counts()[0], client, server)
                assert client.later == [(1, 21)]
        numbers = {sub.request for _, _, sub in relay.seen if isinstance(sub, WriteData) and sub.request}
    assert numbers == {FIRST_REQUEST}


def test_a_request_without_room_is_refused(programs: tuple[Path, Path], relay: Relay) -> None:
    with service_board(programs[0]) as client:
        assert "service /b/add: the board b does not answer" in client.tell("ask 1 2")
        with service_board(programs[1]) as server:
            call(client, server, range(1))
            until(lambda: client.counts()[2] == 0, client, server)
            server.kill()
        ask(client, client, range(SLOTS), "ask_later")
        assert f"the board b has not acknowledged {SLOTS} messages" in client.tell("ask 1 2")


def test_a_callback_that_publishes_leaves_room_for_its_reply(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    with pair(programs) as (first, second):
        settle(first, second)
        assert not second.tell("greedy 1")
        call(first, second, range(3))
        assert first.replies == answered(range(3))
        assert 0 in first.received
        published = [line for line in second.words if line.startswith("published")]
        assert all(f"has not acknowledged {SLOTS - 1} messages" in line for line in published), published
        assert published


def test_a_callback_that_finalizes_its_service_keeps_no_room(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    with pair(programs) as (first, second):
        assert not second.tell("hasty 1")
        for _ in range(SLOTS + 1):
            ask(first, second, range(1))
            end = deadline(10)
            while not (error := second.tell("spin 2")):
                assert time.monotonic() < end
                first.tell("spin 2")
            assert "service" in error
            assert not second.tell("open")
        assert not second.tell("hasty 0")
        call(first, second, range(8, 9))
        assert first.replies[-1][1] == 9


def test_a_service_that_is_closed_takes_no_request(programs: tuple[Path, Path], relay: Relay) -> None:
    with pair(programs) as (first, second):
        assert not second.tell("close")
        ask(first, second, range(1))
        end = deadline(10)
        while not second.counts()[0]:
            assert time.monotonic() < end
            first.tell("spin 2")
            second.tell("spin 2")
        assert not second.tell("open")
        call(first, second, range(4, 5))
        assert second.served == asked(range(4, 5))
        assert first.replies == [(3, 5)]


def test_a_closed_client_ends_no_wait_for_a_subscription(
    programs: tuple[Path, Path], relay: Relay, tmp_path: Path
) -> None:
    """What arrives before the program has opened its subscription waits, whatever else the program closes."""
    own = free_ports(1)[0]
    ends = system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own}")
    late = service_board_program(tmp_path, "b", ends, flags=("-DLATE=true",))
    with pair((programs[0], late)) as (first, second):
        assert not first.tell("greedy 1")
        ask(second, first, range(1))
        until(lambda: any(word.startswith("published") for word in first.words), first, second)
        assert not second.tell("close_client")
        for _ in range(30):  # some HEARTBEATs
            for board in (first, second):
                assert not board.tell("spin 2")
        assert (second.received, second.counts()[0]) == ([], 0)
        assert not second.tell("open_sure")
        count = int(next(word for word in first.words if word.startswith("published")).split()[1])
        until(lambda: len(second.received) == count, first, second)
        assert second.received == [*range(count)]
        assert second.counts()[0] == 0
