# SPDX-License-Identifier: Apache-2.0
"""Boards on a CAN FD bus that a thread plays: identifiers, a bad bus, restarts, boards that join late, wrap-around."""

from __future__ import annotations

import random
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import pytest

from microros_gen.agent.transport.canfd import decode as decode_frame
from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import decode
from tests.support.components.rendered import program_of, rendered
from tests.support.e2e.can_bus import CanBus, record
from tests.support.runtime.peer_scenarios import BEST, SURE, meet, restart_one, send
from tests.support.runtime.peers import (
    APPLICATION,
    PAIR,
    Board,
    board_program,
    published,
    received,
    started,
    system,
    unreliable,
    until,
)

CANFD = APPLICATION + "transport: {type: canfd}\n"
A_TO_B, B_TO_A = 0x10102, 0x10201
THREE = """\
version: 1
boards:
  a: {application: a/microros.yaml}
  b: {application: b/microros.yaml}
  c: {application: c/microros.yaml}
links:
  - {type: canfd, id: 0x1fff0000, history: 16, ends: {a: "DEVICE:0xff", b: "DEVICE", c: "DEVICE:9"}}
"""
"""Numbers that are given, and one that is the position."""


@pytest.fixture(scope="module")
def bus() -> Iterator[CanBus]:
    with CanBus() as running:
        yield running


@pytest.fixture(autouse=True)
def fresh(bus: CanBus) -> None:
    bus.lost = lambda frame: False
    bus.fate = lambda frame: (frame,)
    bus.frames.clear()


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, bus: CanBus) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("boards")
    ends = system(bus.device, bus.device, "canfd")
    first, second = (board_program(folder, own, ends, CANFD, CANFD) for own in PAIR)
    return first, second


@pytest.fixture(scope="module")
def three(tmp_path_factory: pytest.TempPathFactory, bus: CanBus) -> dict[str, Path]:
    """The programs of a board that the two others subscribe to, and of these."""
    folder = tmp_path_factory.mktemp("three")
    others = {"a": "b", "b": "a", "c": "a"}
    texts = {own: CANFD.replace("OWN", own).replace("OTHER", other) for own, other in others.items()}
    readers = "".join(
        f"{line.replace('/b/', '/c/')}\n" for line in texts["a"].splitlines() if "topic: /b/sure" in line
    )
    readers += (
        "      - {topic: /c/best, type: std_msgs/msg/Int32, peer: only, qos: {reliability: best_effort}}\n"
    )
    texts["a"] = texts["a"].replace("transport:", f"{readers}transport:")
    (folder / "system.yaml").write_text(THREE.replace("DEVICE", bus.device))
    for own, text in texts.items():
        (folder / own).mkdir()
        (folder / own / "microros.yaml").write_text(text)
    return {
        own: program_of(
            rendered(folder / own, text),
            "peer_board.c",
            ("port_posix_time.c",),
            (f'-DOWN="{own}"', f'-DOTHER="{others[own]}"'),
        )
        for own, text in texts.items()
    }


def in_order(values: list[int], wanted: range) -> bool:
    """Return whether all values came in order: one twice if its call failed for the other board and was repeated."""
    found = [value for value in values if value in wanted]
    return found == sorted(found) and set(found) == set(wanted)


@contextmanager
def pair(programs: tuple[Path, Path]) -> Iterator[tuple[Board, Board]]:
    with started(programs[0]) as first, started(programs[1]) as second:
        meet(first, second)
        yield first, second


def both_ways(first: Board, second: Board, values: range) -> None:
    for topic in (BEST, SURE):
        send(first, [second], topic, values)
        send(second, [first], topic, values)
    for board in (first, second):
        until(partial(received, board, SURE, len(values)), first, second)


def test_both_ways_on_both_streams_and_what_a_sniffer_sees(programs: tuple[Path, Path], bus: CanBus) -> None:
    with pair(programs) as (first, second):
        both_ways(first, second, range(10))
        until(partial(received, first, BEST, 10), first, second)
        until(partial(received, second, BEST, 10), first, second)
        assert first.values == second.values == ([*range(10)], [*range(10)])
        first.end()
        second.end()
    assert bus.identifiers() == {A_TO_B, B_TO_A}
    creates = set()
    for frame in bus.frames:
        found = decode_frame(frame)
        assert found is not None
        number, data = found
        for span in split(data, header_size(data)):
            submessage = decode(*span[:2], data, *span[2:])
            if isinstance(submessage, CreateClient):
                creates.add((number, submessage.session % 2))
    assert creates == {(A_TO_B, 1), (B_TO_A, 0)}


@pytest.mark.parametrize("seed", [1, 2])
def test_a_bus_that_loses_repeats_and_reorders(programs: tuple[Path, Path], bus: CanBus, seed: int) -> None:
    with pair(programs) as (first, second):
        bus.fate = unreliable(seed)
        for board, other in ((first, second), (second, first)):
            for topic in (BEST, SURE):
                send(board, [other], topic, range(40))
        for board in (first, second):
            until(partial(received, board, SURE, 40), first, second)
            assert board.values[SURE] == [*range(40)]
            best = board.values[BEST]
            assert best == sorted(set(best))
            assert 10 < len(best) < 40


def test_frames_of_others_change_nothing(programs: tuple[Path, Path], bus: CanBus) -> None:
    strange = [
        record(A_TO_B, b"\x05\x01\x02\x03"),  # too short for its length
        record(A_TO_B, b"\x00"),
        record(A_TO_B, bytes(64)),
        record(A_TO_B, b"\x18\x80\x00", flags=0),  # not an extended identifier
        record(0x10103, b"\x08\x81\x01\x00\x00\x0a\x01\x00\x00"),  # for a board that is not here
        record(A_TO_B, b"\x08\x81\x01\x00\x00\x07\x01\xff\x00"),  # its submessage ends beyond it
        bytes(16),
    ]
    with pair(programs) as (first, second):
        for i in range(5):
            for frame in strange:
                bus.put(frame)
            both_ways(first, second, range(4 * i, 4 * i + 4))
            first.values[SURE].clear()
            second.values[SURE].clear()


def test_a_board_restarts(programs: tuple[Path, Path]) -> None:
    restart_one(programs)


@pytest.mark.parametrize("loss", [0.0, 0.2])
def test_the_numbers_of_both_streams_wrap(programs: tuple[Path, Path], bus: CanBus, loss: float) -> None:
    chance = random.Random(3)
    with pair(programs) as (first, second):
        for board in (first, second):
            board.continue_with(0xFFF0)
        bus.lost = lambda frame: chance.random() < loss
        both_ways(first, second, range(40))
        for board in (first, second):
            assert board.values[SURE] == [*range(40)]
            assert loss or board.values[BEST] == [*range(40)]
            assert board.values[BEST] == sorted(set(board.values[BEST]))


def test_three_boards_of_which_one_joins_late_and_restarts(three: dict[str, Path], bus: CanBus) -> None:
    chance = random.Random(5)
    a_to_b, b_to_a, a_to_c, c_to_a = 0x1FFFFF02, 0x1FFF02FF, 0x1FFFFF09, 0x1FFF09FF
    with ExitStack() as stack:
        a, b = (stack.enter_context(started(three[name])) for name in ("a", "b"))
        until(lambda: published(b, BEST, 1), a, b)
        until(partial(received, a, BEST, 1), a, b)
        # b gets it all the same
        until(lambda: "the board c does not answer" in a.publish(SURE, 0) and b.values[SURE], a, b)
        assert bus.identifiers() == {a_to_b, b_to_a, a_to_c}
        with started(three["c"]) as c:
            until(partial(published, a, SURE, 1), a, b, c)
            send(a, (b, c), SURE, range(2, 10))
            send(c, (a, b), BEST, range(3))  # a does not open its subscription
            until(lambda: 9 in b.values[SURE] and 9 in c.values[SURE], a, b, c)
            for board in (b, c):
                assert in_order(board.values[SURE], range(1, 10))
            c.kill()
        send(a, (b,), SURE, range(10, 14))  # they wait for c
        with started(three["c"]) as c:
            until(lambda: 13 in b.values[SURE] and 13 in c.values[SURE], a, b, c)
            assert in_order(c.values[SURE], range(10, 14))
            bus.lost = lambda frame: chance.random() < 0.2
            send(a, (b, c), SURE, range(14, 40))
            until(lambda: 39 in b.values[SURE] and 39 in c.values[SURE], a, b, c)
            for board in (b, c):
                assert in_order(board.values[SURE], range(14, 40))
    assert bus.identifiers() == {a_to_b, b_to_a, a_to_c, c_to_a}


def test_a_bus_that_is_there_only_later(tmp_path: Path) -> None:
    """The programs start before the interface exists."""
    with tempfile.TemporaryDirectory() as short:  # a socket has a path of at most 107 bytes
        path = Path(short) / "bus"
        ends = system(f"unix:{path}", f"unix:{path}:0x20", "canfd")
        first, second = (board_program(tmp_path, own, ends, CANFD, CANFD) for own in PAIR)
        with started(first) as a, started(second) as b:
            for board in (a, b):
                board.spin()
                assert "does not answer" in board.publish(BEST, 1)
            with CanBus(path) as later:
                meet(a, b)
                both_ways(a, b, range(3))
                assert later.identifiers() == {0x10120, 0x12001}


def test_a_bus_that_is_removed_and_returns(tmp_path: Path) -> None:
    """As with a USB adapter: reliable messages wait, best-effort ones get an error, and each return is counted."""
    with tempfile.TemporaryDirectory() as short:
        path = Path(short) / "bus"
        ends = system(f"unix:{path}", f"unix:{path}", "canfd")
        first, second = (board_program(tmp_path, own, ends, CANFD, CANFD) for own in PAIR)
        with started(first) as a, started(second) as b:
            for life in range(3):
                with CanBus(path):
                    until(lambda: a.reconnects() == b.reconnects() == life, a, b)  # noqa: B023
                    meet(a, b)
                    both_ways(a, b, range(4 * life, 4 * life + 4))
                path.unlink()
                until(lambda: "the line to the board b is gone" in a.publish(BEST, 0), a, b)
                assert a.reconnects() == life
                a.begin("rest 700")
                assert a.heard() < 100, "each look at the time is one of the line: it ended the wait"
                until(lambda: "is gone" in b.publish(BEST, 0), a, b)
                for board in (a, b):
                    board.values[SURE].clear()
