# SPDX-License-Identifier: Apache-2.0
"""A rolling restart: each of two agents is stopped in order and started again while samples flow in both directions.

rclpy counts what a device publishes, and the device what rclpy publishes; both are `transient_local`.
"""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.agent_list import listed
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.free_ports import free_ports
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]

UP, DOWN = "/rolling_up", "/rolling_down"
INT32 = "std_msgs/msg/Int32"
TIMES = (
    "round_trip: 50 ms, liveliness_period: 300 ms, liveliness_timeout: 1500 ms, retry_max: 500 ms,"
    " connect_timeout: 20 s, create_timeout: 20 s"
)
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+subscribe, +executor]
nodes:
  - name: device
    publishers:
      - {topic: rolling_up, type: std_msgs/msg/Int32, qos: {depth: 1000, durability: transient_local}}
    subscriptions:
      - {topic: rolling_down, type: std_msgs/msg/Int32, queue: 8, qos: {depth: 1000, durability: transient_local}}
"""


class Flow:
    """Samples in both directions, and who received them."""

    def __init__(self, observer: Observer, device: subprocess.Popen[str]) -> None:
        self.sent = 0
        self.up: Counter[int] = Counter()
        self.down: Counter[int] = Counter()
        self.published: int | None = None
        self._observer = observer
        self._reader = threading.Thread(target=self._read, args=(device.stdout,), daemon=True)
        self._reader.start()

    def _read(self, lines: Iterable[str]) -> None:
        for line in lines:
            word, number = line.split()
            if word == "taken":
                self.down[int(number)] += 1
            else:
                self.published = int(number)

    def go_on(self, reached: Callable[[], object], timeout_s: float = 30.0) -> None:
        """Let samples flow until `reached`."""
        end = deadline(timeout_s)
        while not reached():
            assert time.monotonic() < end, (
                f"sent {self.sent}; received {max(self.up, default=-1)}, {max(self.down, default=-1)}"
            )
            self._send(self.sent)
            self.sent += 1
            self._take()
            time.sleep(0.01)

    def go_on_for(self, count: int) -> None:
        """Let samples flow until each side has received `count` samples more than it has, or was sent, now."""
        sent, received = self.sent, max(self.up, default=0)
        self.go_on(
            lambda: max(self.down, default=0) >= sent + count and max(self.up, default=0) >= received + count
        )

    def finish(self) -> None:
        """Send the last number, which ends the device; wait until everything that it published has arrived."""
        self._send(-1)
        self._reader.join(seconds(30))
        assert self.published is not None, "the device does not end"
        end = deadline(10)
        while self.up[self.published - 1] == 0:
            assert time.monotonic() < end, f"{self.published} published, received {max(self.up)}"
            self._take()
        time.sleep(0.3)
        self._take()

    def _send(self, value: int) -> None:
        self._observer.ask(
            do="publish", topic=DOWN, type=INT32, values=[{"data": value}], transient_local=True
        )

    def _take(self) -> None:
        self.up.update(value["data"] for name, value in self._observer.ask(do="samples") if name == UP)


def lost_and_doubled(what: str, sent: int, received: Counter[int]) -> tuple[list[int], list[int]]:
    """Print and return the numbers below `sent` that did not arrive, and those that arrived more than once."""
    assert set(received) <= set(range(sent))
    lost = [value for value in range(sent) if received[value] == 0]
    doubled = [value for value in range(sent) if received[value] > 1]
    print(f"{what}: {sent} sent, {len(lost)} lost, {len(doubled)} received more than once")
    return lost, doubled


def restart_in_turn(
    flow: Flow, agents: Sequence[AgentProcess], start: Callable[[int], AgentProcess]
) -> list[AgentProcess]:
    """Stop each agent while samples flow, and start it again; the device is with the first one before."""
    restarted = []
    for index, agent in enumerate(agents):
        flow.go_on_for(20)
        agent.process.send_signal(signal.SIGTERM)
        flow.go_on(lambda agent=agent: agent.process.poll() is not None)  # type: ignore[misc]
        assert agent.process.returncode == 0
        flow.go_on_for(20)
        restarted.append(start(index))
    return restarted


@pytest.mark.parametrize("workers", [1, 2])
def test_a_rolling_restart_loses_nothing(
    images: Images, observer: Observer, domain: int, tmp_path: Path, workers: int
) -> None:
    ports = free_ports(2)
    image = images.build(0, listed(ports, TIMES, APPLICATION))
    program = image.application(
        C_FILES / "rolling.c", tmp_path / "rolling", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    observer.subscribe(UP, INT32, transient_local=True)
    with ExitStack() as stack:

        def start(index: int) -> AgentProcess:
            options = ("--domain", str(domain), "--workers", str(workers))
            return stack.enter_context(
                running_agent(domain, *options, transport=("udp4", "--port", str(ports[index])))
            )

        agents = [start(0), start(1)]
        flow = Flow(observer, stack.enter_context(started(program)))
        restarted = restart_in_turn(flow, agents, start)
        flow.go_on_for(20)
        flow.finish()
        assert flow.published is not None
        up = lost_and_doubled("device to rclpy", flow.published, flow.up)
        del flow.down[-1]
        down = lost_and_doubled("rclpy to device", flow.sent, flow.down)
        assert up == ([], []), "a stop loses and doubles nothing that a device publishes"
        assert down[0] == [], "each sample of a transient_local topic reaches the device"
        for agent in restarted:
            assert agent.process.poll() is None
