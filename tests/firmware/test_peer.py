# SPDX-License-Identifier: Apache-2.0
"""Two emulated boards whose serial lines are joined: no agent, a bad line, and a board that restarts."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.firmware.board import (
    C_FILES,
    Board,
    Built,
    board,
    compile_merged_image,
    generate,
    need,
    target,
)
from tests.support.firmware.line import Relay, noisy
from tests.support.runtime.peers import APPLICATION, PAIR, application, system, written

NAME = "qemu-mps2-an386"
LAST = 40
HEAD = ("ready", "published", "refused", "malformed", "fault")
HEARD = ("count", "first", "last", "lives", "misses")
WORDS = (*HEAD, *(f"{topic} {word}" for topic in ("best", "sure") for word in HEARD))

Image = tuple[Built, Path]


@pytest.fixture(scope="module")
def images(tmp_path_factory: pytest.TempPathFactory) -> tuple[Image, Image]:
    """The image of each board; the other end of its link is the line of the other one."""
    need(NAME, emulator=True)
    text = APPLICATION + "transport: {type: serial}\n"
    folder = written(tmp_path_factory.mktemp("boards"), system("uart", "uart", "serial"), text)
    first, second = (image(folder / own, own, text) for own in PAIR)
    return first, second


def image(home: Path, own: str, text: str) -> Image:
    """Build the image of a board in the folder of its application."""
    generate(home, NAME, application(own, text))
    built = Built(home / "out", target(NAME))
    compile_merged_image(built)
    names = (f'-DOWN="{own}"', f'-DOTHER="{PAIR[1 - PAIR.index(own)]}"')
    return built, built.link(C_FILES / "peer.c", home / "peer.elf", *names, f"-DPEER_LAST={LAST}u")


def report(running: Board) -> dict[str, int]:
    """Return what a board says of itself."""
    return dict(zip(WORDS, running.words("peer_report", len(WORDS)), strict=True))


def has_all(running: Board) -> bool:
    """Return whether a board has published everything and received the last message of the other one."""
    seen = report(running)
    return seen["published"] == seen["sure last"] == LAST


@pytest.mark.variant  # of tests/runtime/test_peer.py and test_peer_lines.py, on two boards
@pytest.mark.system
def test_over_a_bad_line_and_after_a_restart(images: tuple[Image, Image]) -> None:
    with (
        board(*images[0], restarts=True) as first,
        board(*images[1], restarts=True) as second,
        Relay(first.device, second.device) as line,
    ):
        line.fault = noisy(5, 400)
        first.go_on()
        first.wait_for(lambda: report(first)["refused"] > 3)  # the other board is not there
        assert report(first)["ready"]
        second.go_on()
        for running in (first, second):
            running.wait_for(lambda running=running: has_all(running))  # type: ignore[misc]
        of_first, of_second = report(first), report(second)
        for seen in (of_first, of_second):
            assert (seen["sure count"], seen["sure first"], seen["sure lives"]) == (LAST, 1, 1), seen
            assert seen["best count"], seen
            assert seen["best misses"] == seen["sure misses"] == seen["fault"] == 0, seen
        assert of_first["best count"] + of_second["best count"] < 2 * LAST
        assert of_first["malformed"] + of_second["malformed"]
        assert line.lost
        assert line.spoiled
        second.restart()
        first.wait_for(lambda: report(first)["sure lives"] == 2)
        first.wait_for(lambda: report(first)["sure last"] == LAST)
        seen = report(first)
    assert seen["sure count"] == 2 * LAST, seen
    assert seen["sure misses"] == seen["fault"] == 0, seen
