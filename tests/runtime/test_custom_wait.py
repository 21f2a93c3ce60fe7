# SPDX-License-Identifier: Apache-2.0
"""An executor over a custom transport rests in the application's read function: not busy, and awake when data comes."""

from __future__ import annotations

import socket
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.patience import seconds
from tests.support.plans import EXECUTOR, changed
from tests.support.runtime.harness import build, components, render
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.slices import first

PLAN = changed(
    EXECUTOR,
    transport__kind="custom",
    timers__max=0,
    times__connect_timeout_ms=10_000,
    times__create_timeout_ms=10_000,
    times__liveliness_period_ms=5000,
)


@contextmanager
def serving(agent: ReadingAgent) -> Iterator[tuple[socket.socket, list[tuple[str, int]]]]:
    """Let `agent` answer at a socket; yield that, and who has sent something."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        peers: list[tuple[str, int]] = []

        def serve() -> None:
            while True:
                try:
                    datagram, peer = served.recvfrom(2048)
                except OSError:
                    return
                peers.append(peer)
                for answer in agent.receive(datagram):
                    served.sendto(answer, peer)

        threading.Thread(target=serve, daemon=True).start()
        yield served, peers


@pytest.mark.parametrize("framing", first(["off", "either"]))
@pytest.mark.parametrize("read_polls", [True, False])
def test_calls_without_a_time_out(read_polls: bool, framing: str, tmp_path: Path) -> None:
    """What is acknowledged is seen although no call waits, where the read function looks and returns."""
    plan = changed(PLAN, transport__framing=framing, transport__read_polls=read_polls)
    tree = render(tmp_path, plan, components(plan))
    program = build(tree, ["types_read.c", "custom_wait.c"], "custom_wait")
    with serving(ReadingAgent()) as (served, _):
        command = [str(program), str(served.getsockname()[1]), "polls"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=True)
    reads, longest_ms, acknowledged = map(int, done.stdout.split())
    assert acknowledged == 1
    assert longest_ms == (0 if read_polls else 1), "1: functions for micro-ROS may wait forever with 0"
    assert reads > 0


@pytest.mark.parametrize("framing", ["off", "either"])
def test_the_processor_rests(framing: str, tmp_path: Path) -> None:
    plan = changed(PLAN, transport__framing=framing)
    tree = render(tmp_path, plan, components(plan))
    program = build(tree, ["types_read.c", "custom_wait.c"], "custom_wait")
    agent = ReadingAgent()
    with (
        serving(agent) as (served, peers),
        subprocess.Popen(
            [program, str(served.getsockname()[1])], text=True, stdout=subprocess.PIPE
        ) as process,
    ):
        assert process.stdout is not None
        reads, busy_ms, took_ms = (int(word) for word in process.stdout.readline().split())
        time.sleep(0.2)
        sent = time.monotonic()
        for answer in agent.numbers(plan.entities.publisher_places, 7):
            served.sendto(answer, peers[-1])
        arrived = float(process.stdout.readline())
        assert process.wait(timeout=seconds(20)) == 0
    assert took_ms >= 999
    assert reads <= 250, "two for each rest of 10 ms"
    assert busy_ms < took_ms / 3
    assert arrived - sent < 2, "not at the end of the wait of five seconds"
