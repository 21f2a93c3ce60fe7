# SPDX-License-Identifier: Apache-2.0
"""`microros-gen time-server` against the ROS clock of rclpy."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.support.agent.process import environment, own_domain
from tests.support.e2e.server_process import server_process
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros
READY = "time server ready: /microros_time\n"
COMMAND = ("-m", "microros_gen", "time-server")


class Node:
    """The node of rclpy."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def ask(self, **order: Any) -> dict[str, Any]:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(order) + "\n")
        self._process.stdin.flush()
        answer: dict[str, Any] = json.loads(self._process.stdout.readline())
        return answer

    def set(self, **values: Any) -> str:
        return str(self.ask(set=values)["reason"])

    def wait(self, holds: Callable[[float], bool]) -> float:
        """Wait until the node's time is as wanted; return it."""
        end = deadline(20)
        while not holds(now := self.ask()["now"]):
            assert time.monotonic() < end, now
            time.sleep(0.02)
        return float(now)


@pytest.fixture(scope="module")
def node() -> Iterator[Node]:
    domain = own_domain()
    with (
        server_process(domain, READY, (*COMMAND, "--start", "100", "--paused")) as server,
        subprocess.Popen(
            [sys.executable, "-m", "tests.support.time_server.simulated"],
            env=environment(domain),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as process,
    ):
        try:
            yield Node(process)
        finally:
            process.kill()
            server.terminate()
            assert server.wait(seconds(15)) == 0


def test_pause_speed_and_jumps(node: Node) -> None:
    assert node.wait(lambda now: now > 0) == 100.0, "a node that starts later gets the time that stands still"
    time.sleep(0.2)
    assert node.ask()["now"] == 100.0
    assert node.set(speed=0.001, paused=False) == ""
    node.wait(lambda now: now > 100.0)
    began, wall = node.ask()["now"], time.monotonic()
    time.sleep(0.5)
    passed, wall_passed = node.ask()["now"] - began, time.monotonic() - wall
    assert 0 < passed <= wall_passed / 100, "a thousandth, measured generously"
    assert node.set(speed=500.0) == ""
    fast = node.wait(lambda now: now > 150.0)
    assert node.set(paused=True) == ""
    stopped = node.wait(lambda now: now >= fast)
    before = node.ask()["jumps"]
    assert node.set(time=5000.5) == ""
    assert node.wait(lambda now: now > stopped + 1000) == 5000.5
    assert node.set(time=7) == ""
    assert node.wait(lambda now: now < 5000) == 7.0
    jumps = node.ask()["jumps"][len(before) :]
    assert jumps[-1] == pytest.approx(7 - 5000.5)
    assert jumps[-2] > 1000
    assert node.set(speed=-1.0) == "'speed' must be 0.001 to 1000"
    assert node.ask()["now"] == 7.0
