# SPDX-License-Identifier: Apache-2.0
"""Events about matched endpoints and incompatible QoS: a device has the counts of rclpy's events of like endpoints."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.agent.line_process import LineProcess
from tests.support.agent.process import running_agent
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.event_peer import event_peer
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay, lossy
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+graph_events]
session: {connect_timeout: 20 s, create_timeout: 10 s, liveliness_timeout: 1 s, liveliness_period: 500 ms}
nodes:
  - name: device
    namespace: /arm
    publishers:
      - {topic: count, type: std_msgs/msg/Int32}
      - {topic: fast, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}
    subscriptions: [{topic: order, type: std_msgs/msg/Int32}]
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
DURABILITY, RELIABILITY = 2, 16
OBSERVED = (
    ("/arm/count", "publisher", True),
    ("/arm/fast", "publisher", False),
    ("/arm/order", "subscription", True),
)
COMPARED = (
    "/arm/count matched",
    "/arm/order matched",
    "/arm/count incompatible",
    "/arm/fast incompatible",
    "/arm/order incompatible",
)


class Board:
    """The program: what its events say now, and the sums of all changes that they told."""

    def __init__(self, program: CommandedProgram) -> None:
        self._program = program
        self.changes: Counter[str] = Counter()
        self.callbacks = 0

    def statuses(self) -> dict[str, list[int]]:
        """Return what rclpy's events have as well: total and current, or total and policy."""
        code, error, lines = self._program.call("take")
        assert (code, error) == (0, "")
        self.callbacks += int(lines.pop().partition(" ")[2])
        found = {}
        for line in lines:
            topic, event, *numbers = line.split()
            total, change, last, *current_change = map(int, numbers)
            name = f"/arm/{topic} {event}"
            self.changes[name] += change
            self.changes[f"{name} now"] += sum(current_change)
            found[name] = [total, last]
        return found


def alike(board: Board, peer: LineProcess | None, **wanted: list[int]) -> None:
    """Wait until both say the same, and of some events what is wanted; None: those of rclpy have other totals."""
    expected = {f"/arm/{name.replace('_', ' ')}": status for name, status in wanted.items()}
    end = deadline(15)
    while True:
        reference = peer.ask(do="statuses") if peer is not None else {}
        found, other = board.statuses(), {name: reference[name] for name in COMPARED if reference}
        if {**found, **other, **expected} == found:
            return
        assert time.monotonic() < end, (found, other, wanted)
        time.sleep(0.1)


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "qos_events.c", tmp_path_factory.mktemp("events") / "events", *STRICT)


@pytest.fixture
def peer(domain: int) -> Iterator[LineProcess]:
    with event_peer(domain) as process:
        for topic, kind, reliable in OBSERVED:
            process.ask(do="observe", topic=topic, kind=kind, reliable=reliable)
        yield process


@pytest.fixture
def board(program: Path, relay: Relay) -> Iterator[Board]:
    with started(program) as process:
        yield Board(CommandedProgram(process))
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_counts_are_those_of_rclpy(domain: int, image_port: Relay, peer: LineProcess, board: Board) -> None:
    """Endpoints come and go; the agent with its graph server is followed by another one, over a network with losses."""
    with running_agent(domain, "--domain", str(domain), "--graph-server") as agent:
        image_port.connect(agent.port)
        first = peer.ask(do="add", topic="/arm/count", kind="subscription")
        peer.ask(do="add", topic="/arm/count", kind="subscription", reliable=False)
        peer.ask(do="add", topic="/arm/count", kind="subscription", lasting=True)
        alike(board, peer, count_matched=[2, 2], count_incompatible=[1, DURABILITY])
        peer.ask(do="add", topic="/arm/fast", kind="subscription", lasting=True)  # two policies
        peer.ask(do="add", topic="/arm/order", kind="publisher", lasting=True)
        peer.ask(do="add", topic="/arm/order", kind="publisher", reliable=False)
        alike(board, peer, order_matched=[1, 1], order_incompatible=[1, RELIABILITY])
        before = board.callbacks
        peer.ask(do="remove", number=first)
        alike(board, peer, count_matched=[2, 1])
        assert board.callbacks == before + 1, "one that leaves is an event as well"
        peer.ask(do="add", topic="/arm/count", kind="subscription")
        alike(board, peer, count_matched=[3, 2])
        changes = dict(board.changes)
        assert changes["/arm/count matched"] == 3
        assert changes["/arm/count matched now"] == 2
        assert board.callbacks == sum(board.changes[name] for name in COMPARED) + 1
    image_port.connect(0)
    peer.ask(do="add", topic="/arm/count", kind="subscription")
    with running_agent(domain, "--domain", str(domain), "--graph-server") as agent:
        image_port.connect(agent.port)
        image_port.fault = lossy(3, 0.2)
        # For DDS, the writer of the second agent is another one: it matches all of them again.
        alike(board, None, count_matched=[3 + 3, 3], count_incompatible=[1 + 1, DURABILITY])
        peer.ask(do="add", topic="/arm/count", kind="subscription", lasting=True)
        alike(board, None, count_matched=[6, 3], count_incompatible=[3, DURABILITY])
        image_port.fault = lossy(0, 0.0)
