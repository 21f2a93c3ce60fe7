# SPDX-License-Identifier: Apache-2.0
"""Two emulated boards that call each other over a serial line, without ROS: requests in fragments, and a bad line."""

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
from tests.support.runtime.peers import PAIR, application, system, written

NAME = "qemu-mps2-an386"
LAST = 20
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services]
system: {file: ../system.yaml, board: OWN}
session: {round_trip: 20 ms, heartbeat: 10 ms}
transport: {type: serial}
limits: {"*": {string: 200}}
nodes:
  - name: board
    services:
      - {name: /OWN/check, type: diagnostic_msgs/srv/AddDiagnostics, peer: only, limits: {load_namespace: 100}}
    clients:
      - {name: /OTHER/check, type: diagnostic_msgs/srv/AddDiagnostics, peer: only, limits: {load_namespace: 100}}
"""
WORDS = ("ready", "served", "replies", "refused", "wrong", "errors", "malformed", "fault")

Image = tuple[Built, Path]


@pytest.fixture(scope="module")
def images(tmp_path_factory: pytest.TempPathFactory) -> tuple[Image, Image]:
    """The image of each board; the other end of its link is the line of the other one."""
    need(NAME, emulator=True)
    link = system("uart", "uart", "serial").replace("type: serial", "type: serial, mtu: 64")
    folder = written(tmp_path_factory.mktemp("boards"), link, APPLICATION)
    first, second = (image(folder / own, own) for own in PAIR)
    return first, second


def image(home: Path, own: str) -> Image:
    """Build the image of a board in the folder of its application."""
    generate(home, NAME, application(own, APPLICATION))
    built = Built(home / "out", target(NAME))
    joins = built.out / "src" / "peer" / "xrce_peer_fragments.c"
    assert joins.is_file(), "requests and replies are larger than the MTU"
    compile_merged_image(built)
    names = (f'-DOWN="{own}"', f'-DOTHER="{PAIR[1 - PAIR.index(own)]}"')
    return built, built.link(C_FILES / "peer_service.c", home / "peer.elf", *names, f"-DPEER_LAST={LAST}u")


def report(running: Board) -> dict[str, int]:
    """Return what a board says of itself."""
    return dict(zip(WORDS, running.words("peer_report", len(WORDS)), strict=True))


@pytest.mark.variant  # of tests/runtime/test_peer_services.py, on two boards
@pytest.mark.system
def test_each_request_is_executed_once_on_a_bad_line(images: tuple[Image, Image]) -> None:
    with (
        board(*images[0], restarts=True) as first,
        board(*images[1], restarts=True) as second,
        Relay(first.device, second.device) as line,
    ):
        line.fault = noisy(6, 600)
        first.go_on()
        second.go_on()
        for running in (first, second):
            running.wait_for(lambda running=running: report(running)["replies"] == LAST)  # type: ignore[misc]
        for running in (first, second):
            seen = report(running)
            assert seen["served"] == LAST, seen
            assert seen["wrong"] == seen["errors"] == seen["fault"] == 0, seen
        assert line.lost
        assert line.spoiled
        second.restart()
        second.wait_for(lambda: report(second)["replies"] == LAST)
        seen = report(first)
        assert seen["served"] == 2 * LAST, seen
        assert seen["wrong"] == seen["fault"] == 0, seen
