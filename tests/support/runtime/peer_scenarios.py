# SPDX-License-Identifier: Apache-2.0
"""What two boards do on a link of any kind: they meet, send, and lose one of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from tests.support.runtime.peers import Board, published, received, started, until

BEST, SURE = 0, 1
"""The topics."""


def meet(first: Board, second: Board) -> None:
    """Let both boards run until each has a session with the present life of the other one, and forget what that took.

    What is published in a session with a former life is lost.
    """
    ways = ((first, second), (second, first))
    for sender, receiver in ways:
        until(lambda s=sender, r=receiver: published(s, BEST, -1) and received(r, BEST, 1), first, second)  # type: ignore[misc]
    for sender, receiver in ways:
        assert published(sender, BEST, -2)
        until(lambda r=receiver: -2 in r.values[BEST], first, second)  # type: ignore[misc]
    for board in (first, second):
        board.values[BEST].clear()


def send(board: Board, others: Sequence[Board], topic: int, values: range) -> None:
    """Publish each value; repeat a call that finds no room."""
    for value in values:
        until(partial(published, board, topic, value), board, *others)


def restart_one(programs: tuple[Path, Path], lives: int = 3) -> None:
    """Let the first board lose its supply `lives` times: each life exchanges its own messages with the other board.

    Every reliable message arrives once and in order. One of the former life whose acknowledgement was lost may precede.
    """
    with started(programs[1]) as second:
        for life in range(lives):
            with started(programs[0]) as first:
                meet(first, second)
                values = range(10 * life, 10 * life + 7)
                for board, other in ((first, second), (second, first)):
                    send(board, [other], SURE, values)
                for board in (first, second):
                    until(lambda b=board, v=values: set(v) <= set(b.values[SURE]), first, second)  # type: ignore[misc]
                    assert [value for value in board.values[SURE] if value in values] == [*values], life
                first.kill()
