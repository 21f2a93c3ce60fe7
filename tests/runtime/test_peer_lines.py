# SPDX-License-Identifier: Apache-2.0
"""Two boards on a serial line whose device disappears and returns, as that of a USB converter does."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from tests.support.runtime import peers
from tests.support.runtime.peers import APPLICATION, PAIR, Board, board_program, started, system
from tests.support.runtime.plugs import Plugs

BEST, SURE = 0, 1
SERIAL = APPLICATION + "transport: {type: serial}\n"


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("devices")
    return folder / "tty_a", folder / "tty_b"


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory, names: tuple[Path, Path]) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("boards")
    ends = system(str(names[0]), str(names[1]), "serial")
    first, second = (board_program(folder, own, ends, SERIAL, SERIAL) for own in PAIR)
    return first, second


until = partial(peers.until, at_most_s=20)


def send(board: Board, other: Board, values: range) -> None:
    """Publish each value, and wait until the other board has all."""
    for value in values:
        until(lambda value=value: not board.publish(SURE, value), board, other)  # type: ignore[misc]
    until(lambda: set(values) <= set(other.values[SURE]), board, other)


@pytest.mark.parametrize("unplugged", [0, 1])
def test_a_device_that_is_unplugged_and_returns(
    programs: tuple[Path, Path], names: tuple[Path, Path], unplugged: int
) -> None:
    with Plugs(names) as plugs, started(programs[0]) as a, started(programs[1]) as b:
        send(a, b, range(3))
        send(b, a, range(3))
        boards = (a, b) if unplugged == 0 else (b, a)

        plugs.unplug(unplugged)
        until(lambda: "gone" in boards[0].publish(BEST, 0), boards[0])
        assert not boards[0].publish(SURE, 3)
        boards[0].begin("rest 700")
        assert (
            boards[0].heard() < 100
        )  # each look at the time is one of the line: thousands if it ended the wait
        assert "the line to the board" in boards[0].publish(BEST, 0)
        assert boards[0].reconnects() == 0

        plugs.plug(unplugged)
        until(partial(_has, boards[1], 3), *boards)
        for value in range(4, 8):
            send(boards[0], boards[1], range(value, value + 1))
            send(boards[1], boards[0], range(value, value + 1))
        assert boards[0].reconnects() == 1
        assert boards[1].values[SURE] == [*range(8)]


def _has(board: Board, value: int) -> bool:
    return value in board.values[SURE]
