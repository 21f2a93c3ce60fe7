# SPDX-License-Identifier: Apache-2.0
"""Services between two boards on one link: requests and replies over a bad network, restarts, and numbers that wrap."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.agent.wire.data_messages import WriteData
from tests.support.components.rendered import program_of, rendered
from tests.support.e2e.commanded import CommandedProgram
from tests.support.patience import deadline
from tests.support.runtime.peers import HOST, PAIR, Relay, application, system, unreliable, written

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services]
system: {file: ../system.yaml, board: OWN}
session: {round_trip: 20 ms, heartbeat: 10 ms}
nodes:
  - name: board
    publishers:
      - {topic: /OWN/sure, type: std_msgs/msg/Int32, peer: only}
    subscriptions:
      - {topic: /OTHER/sure, type: std_msgs/msg/Int32, peer: only}
    services:
      - {name: /OWN/add, type: example_interfaces/srv/AddTwoInts, peer: only}
      - {name: /OWN/later, type: example_interfaces/srv/AddTwoInts, peer: only}
    clients:
      - {name: /OTHER/add, type: example_interfaces/srv/AddTwoInts, peer: only}
      - {name: /OTHER/later, type: example_interfaces/srv/AddTwoInts, peer: only}
"""
SLOTS = 4
ADD_REQUESTS, ADD_REPLIES, LATER_REPLIES = 0x0007, 0x0008, 0x0018
"""Objects of /a/add and /a/later, the first two of four services: requester and repliers."""
FIRST_REQUEST = 0x000B
WRAPS = 0xFFFF - 5
SHORTLY_BEFORE_WRAP = 0xFFFFFFFF - 300


class ServiceBoard(CommandedProgram):
    """A process that is a board; what it printed is in `served`, `replies`, `later`, `got` and `words`."""

    def __init__(self, program: Path, clock: int) -> None:
        self.process = subprocess.Popen(
            [str(program), str(clock)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        super().__init__(self.process)
        self.served: list[tuple[int, int]] = []
        self.replies: list[tuple[int, int]] = []
        self.later: list[tuple[int, int]] = []
        self.got: list[int] = []
        self.words: list[str] = []

    def tell(self, command: str) -> str:
        """Return the error of a command, empty for none."""
        code, error, lines = self.call(command)
        assert bool(code) == bool(error), (code, error)
        for line in lines:
            word, *rest = line.split()
            kept = {"served": self.served, "reply": self.replies, "later": self.later}.get(word)
            if kept is not None:
                kept.append((int(rest[0]), int(rest[1])))
            elif word == "got":
                self.got.append(int(rest[0]))
            else:
                self.words.append(line)
        return error

    def takes(self, count: int) -> bool:
        """Take a request of /OWN/later if there is one; return whether so many were taken since the start."""
        assert not self.tell("take")
        return sum(line.startswith("taken") for line in self.words) >= count

    def counts(self) -> tuple[int, int]:
        """Return how many messages were dropped, and how many requests of /OTHER/later were interrupted."""
        assert not self.tell("counts")
        _, dropped, interrupted = self.words[-1].split()
        return int(dropped), int(interrupted)

    def kill(self) -> None:
        """End it as if it lost its supply."""
        self.process.kill()
        self.process.communicate()


@pytest.fixture(scope="module")
def relay() -> Iterator[Relay]:
    with Relay() as running:
        yield running


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, relay: Relay) -> tuple[Path, Path]:
    """The programs of both boards, each of which sees the relay as the other one."""
    folder = tmp_path_factory.mktemp("boards")
    with Relay() as unused:
        own = unused.ports
    ends = {
        "a": system(f"{HOST}:{own[0]}", f"{HOST}:{relay.ports[0]}"),
        "b": system(f"{HOST}:{relay.ports[1]}", f"{HOST}:{own[1]}"),
    }
    return _program(folder, "a", ends["a"]), _program(folder, "b", ends["b"])


def _program(folder: Path, own: str, system_text: str) -> Path:
    home = written(folder / f"of_{own}", system_text, APPLICATION)
    out = rendered(home / own, application(own, APPLICATION))
    flags = (f'-DOWN="{own}"', f'-DOTHER="{PAIR[1 - PAIR.index(own)]}"')
    return program_of(out, "peer_service_board.c", ("port_posix_time.c",), flags)


@pytest.fixture(autouse=True)
def fresh(relay: Relay) -> Iterator[None]:
    relay.fate = lambda data: (data,)
    relay.seen.clear()
    yield
    assert not relay.faults


@contextmanager
def started(program: Path, clock: int = 0) -> Iterator[ServiceBoard]:
    board = ServiceBoard(program, clock)
    try:
        yield board
    finally:
        if board.process.poll() is None:
            board.kill()


def until(seen: Callable[[], object], *boards: ServiceBoard) -> None:
    """Let boards run until something is true."""
    end = deadline(10)
    while not seen():
        assert time.monotonic() < end, [(b.served, b.replies, b.later, b.words) for b in boards]
        for board in boards:
            assert not board.tell("spin 2")


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


@contextmanager
def pair(programs: tuple[Path, Path], clock: int = 0) -> Iterator[tuple[ServiceBoard, ServiceBoard]]:
    with started(programs[0], clock) as first, started(programs[1], clock) as second:
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
        for board in (first, second):
            assert not board.tell("spin 30")  # the acknowledgements are there
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
            assert board.counts() == (0, 0)


def test_a_server_that_restarts(programs: tuple[Path, Path], relay: Relay) -> None:
    with started(programs[0]) as client:
        with started(programs[1]) as server:
            call(client, server, range(1))
            ask(client, server, range(5, 7), "ask_later")
            until(lambda: server.takes(2), client, server)
            server.kill()
        with started(programs[1]) as server:
            end = deadline(10)
            while not (error := client.tell("spin 5")):
                assert time.monotonic() < end
                server.tell("spin 2")
            assert "service /b/later: a session was lost with 2 requests under way" in error
            call(client, server, range(20, 22))
            assert client.replies[-2:] == [(2, 21), (3, 22)]
            assert not client.later
            assert client.counts()[1] == 2


def test_the_reply_to_a_client_that_has_restarted_is_dropped(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    """The new life asks with the same number and gets no answer of the former one."""
    with started(programs[1]) as server:
        for life in range(3):
            with started(programs[0]) as client:
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
    with started(programs[0]) as client:
        assert "service /b/add: the board b does not answer" in client.tell("ask 1 2")
        with started(programs[1]) as server:
            call(client, server, range(1))
            assert not client.tell("spin 30")
            server.kill()
        ask(client, client, range(SLOTS), "ask_later")
        assert f"the board b has not acknowledged {SLOTS} messages" in client.tell("ask 1 2")


def test_a_callback_that_publishes_leaves_room_for_its_reply(
    programs: tuple[Path, Path], relay: Relay
) -> None:
    with pair(programs) as (first, second):
        assert not second.tell("spin 30")
        assert not second.tell("greedy 1")
        call(first, second, range(3))
        assert first.replies == answered(range(3))
        assert first.got
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
