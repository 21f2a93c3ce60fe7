# SPDX-License-Identifier: Apache-2.0
"""Samples that flow between rclpy and a device (rolling.c) while its agent is stopped, killed and started again."""

from __future__ import annotations

import subprocess
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable

from tests.support.agent.observer import Observer
from tests.support.patience import deadline, seconds

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
