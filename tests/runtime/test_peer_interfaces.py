# SPDX-License-Identifier: Apache-2.0
"""Two boards on a link over UDP whose network interface is removed, returns, or appears after the programs started."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from tests.support.runtime.peers import (
    PAIR,
    Board,
    board_program,
    published,
    received,
    started,
    system,
    until,
)

BEST, SURE = 0, 1
ADDRESSES = ("10.77.0.1", "10.77.0.2")
PORT = 7500


def ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True, capture_output=True)


class Networks:
    """A network namespace for each board, and a cable between them that can be removed."""

    def __init__(self) -> None:
        self.names = tuple(f"mg-{os.getpid()}-{own}" for own in PAIR)

    def add(self) -> None:
        """Add the namespaces."""
        for name in self.names:
            ip("netns", "add", name)

    def delete(self) -> None:
        """Delete them with all interfaces."""
        for name in self.names:
            subprocess.run(["ip", "netns", "delete", name], check=False, capture_output=True)

    def connect(self) -> None:
        """Plug the cable in: both interfaces appear, with their addresses."""
        first, second = self.names
        ip("-n", first, "link", "add", "cable", "type", "veth", "peer", "name", "cable", "netns", second)
        for name, address in zip(self.names, ADDRESSES, strict=True):
            ip("-n", name, "address", "add", f"{address}/24", "dev", "cable")
            ip("-n", name, "link", "set", "cable", "up")

    def disconnect(self) -> None:
        """Remove the interfaces."""
        ip("-n", self.names[0], "link", "delete", "cable")

    def add_other(self) -> None:
        """Give board a another interface, over which everything goes until the cable is there."""
        own = self.names[0]
        ip("-n", own, "link", "add", "other", "type", "veth", "peer", "name", "nobody")
        for end in ("other", "nobody"):
            ip("-n", own, "link", "set", end, "up")
        ip("-n", own, "address", "add", "10.88.0.1/24", "dev", "other")
        ip("-n", own, "route", "add", "default", "via", "10.88.0.2")


@pytest.fixture
def networks() -> Iterator[Networks]:
    if os.getuid() != 0 or shutil.which("ip") is None:
        pytest.skip("network namespaces need root and iproute2")
    networks = Networks()
    try:
        networks.add()
        yield networks
    finally:
        networks.delete()


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("boards")
    ends = system(*(f"{address}:{PORT}" for address in ADDRESSES))
    first, second = (board_program(folder, own, ends) for own in PAIR)
    return first, second


def inside(folder: Path, networks: Networks, programs: tuple[Path, Path]) -> tuple[Path, Path]:
    """Return programs that run those of the boards in their networks."""
    found = []
    for name, program in zip(networks.names, programs, strict=True):
        script = folder / name
        script.write_text(f'#!/bin/sh\nexec ip netns exec {name} {program} "$@"\n')
        script.chmod(0o755)
        found.append(script)
    return found[0], found[1]


def exchange(a: Board, b: Board, values: range) -> None:
    """Send each value both ways, reliable, and wait until it has arrived; the streams have nothing else."""
    for value in values:
        for sender in (a, b):
            until(partial(published, sender, SURE, value), a, b)
    for board in (a, b):
        until(partial(received, board, SURE, values.stop), a, b)
        assert board.values[SURE] == [*range(values.stop)]


def test_an_interface_that_is_removed_and_returns(
    networks: Networks, programs: tuple[Path, Path], tmp_path: Path
) -> None:
    networks.connect()
    first, second = inside(tmp_path, networks, programs)
    with started(first) as a, started(second) as b:
        exchange(a, b, range(3))
        for life in range(1, 3):
            networks.disconnect()
            until(lambda: "the line to the board b is gone" in a.publish(BEST, 0), a, b)
            until(lambda: "the line to the board a is gone" in b.publish(BEST, 0), a, b)
            assert not a.publish(SURE, 4 * life - 1)
            assert not b.publish(SURE, 4 * life - 1)
            a.begin("rest 700")
            assert a.heard() < 100, "each look at the time is one of the line: it ended the wait"
            assert a.reconnects() == life - 1
            networks.connect()
            until(lambda: a.reconnects() == b.reconnects() == life, a, b)  # noqa: B023
            exchange(a, b, range(4 * life, 4 * life + 3))


def test_an_interface_that_appears_after_the_start(
    networks: Networks, programs: tuple[Path, Path], tmp_path: Path
) -> None:
    """Until then the system selects an address of another interface, from which the other board takes nothing."""
    networks.add_other()
    first, second = inside(tmp_path, networks, programs)
    with started(first) as a, started(second) as b:
        for board in (a, b):
            board.spin(300)
            assert "does not answer" in board.publish(SURE, 0)
        networks.connect()
        exchange(a, b, range(3))
        assert a.reconnects() == b.reconnects() == 0
