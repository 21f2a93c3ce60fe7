# SPDX-License-Identifier: Apache-2.0
"""ROS time: rclpy publishes /clock, this project's agent carries it, and an application's timer follows."""

from __future__ import annotations

import queue
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.e2e.simulated import APPLICATION, END_S
from tests.support.patience import deadline

pytestmark = pytest.mark.ros


class Simulation:
    """Says what time it is, and waits until the application says so too; so nothing here depends on how fast it is."""

    def __init__(self, observer: Observer, process: subprocess.Popen[str]) -> None:
        self._observer = observer
        self._output: queue.Queue[str] = queue.Queue()
        assert process.stdout is not None
        threading.Thread(target=self._listen, args=(process.stdout,), daemon=True).start()

    def _listen(self, lines: Iterator[str]) -> None:
        for line in lines:
            self._output.put(line.rstrip("\n"))

    def publish(self, now_ms: int) -> None:
        time_of_day = {"sec": now_ms // 1000, "nanosec": now_ms % 1000 * 1_000_000}
        self._observer.ask(
            do="publish", topic="/clock", type="rosgraph_msgs/msg/Clock", values=[{"clock": time_of_day}]
        )

    def heard(self, until: str, again_ms: int | None = None) -> list[str]:
        """Return what the application said before `until`; a best-effort sample may be lost: then it is sent again."""
        found: list[str] = []
        for _ in range(30):
            try:
                while (line := self._output.get(timeout=0.5)) != until:
                    found.append(line)
                return found
            except queue.Empty:
                if again_ms is not None:
                    self.publish(again_ms)
        raise AssertionError(f"'{until}' was not said, but {found}")

    def at(self, now_ms: int) -> list[str]:
        """Let it be `now_ms`; return ticks and jumps, in milliseconds: `tick 100`."""
        self.publish(now_ms)
        lines = self.heard(f"now {now_ms * 1_000_000}", now_ms)
        return [f"{word} {int(value) // 1_000_000}" for word, value in map(str.split, lines)]

    def quiet(self, duration_s: float) -> bool:
        """Whether the application says nothing for a while."""
        time.sleep(duration_s)
        return self._output.empty()


@contextmanager
def simulation(observer: Observer, program: Path) -> Iterator[tuple[Simulation, subprocess.Popen[str]]]:
    observer.ask(do="publish", topic="/clock", type="rosgraph_msgs/msg/Clock", values=[])
    with started(program, str(END_S)) as process:
        simulated = Simulation(observer, process)
        simulated.heard("now 0")
        end = deadline(15)
        while not observer.ask(do="matched", topic="/clock"):
            assert time.monotonic() < end, "nobody subscribes to /clock"
            time.sleep(0.05)
        yield simulated, process


def test_timers_follow_the_clock(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, tmp_path: Path
) -> None:
    """It stops, jumps forward and back, runs four times as fast and four times as slow as the clock on the wall."""
    image = images.build(image_port.port, APPLICATION)
    program = image.application(
        C_FILES / "simulation.c", tmp_path / "simulation", "-std=c99", "-Wall", "-Werror"
    )
    observer.subscribe("/ticks", "std_msgs/msg/Int32")
    with simulation(observer, program) as (simulated, process):
        assert simulated.quiet(0.3), "time has not begun: no tick"
        assert simulated.at(50_000) == ["jump 50000", "tick 50000"]
        assert simulated.quiet(0.5), "it stands still"
        seen = []
        for step in range(1, 41):  # 40 ms each 10 ms
            time.sleep(0.01)
            seen += simulated.at(50_000 + 40 * step)
        assert seen == [f"tick {-(-t // 40) * 40}" for t in range(50_100, 51_700, 100)]
        seen = []
        for step in range(1, 41):  # 5 ms each 20 ms
            time.sleep(0.02)
            seen += simulated.at(51_600 + 5 * step)
        assert seen == ["tick 51700", "tick 51800"]
        assert simulated.at(90_030) == ["jump 38230", "tick 90030"]  # what was missed is left out
        assert simulated.at(90_100) == ["tick 90100"]
        # Back, but not to before the last call: as it was.
        assert [simulated.at(ms) for ms in (90_150, 90_120, 90_199)] == [[], ["jump -30"], []]
        assert simulated.at(90_200) == ["tick 90200"]
        # Further back: the period begins again.
        assert [simulated.at(ms) for ms in (20_000, 20_099)] == [["jump -70200"], []]
        assert simulated.at(20_100) == ["tick 20100"]
        assert _ticks(observer, 23) == [{"data": i} for i in range(1, 24)]
        simulated.publish(1000 * END_S)
        ends_well(process)


def _ticks(observer: Observer, count: int) -> list[dict[str, int]]:
    """Return `count` samples of /ticks; what tests before have left on other topics does not count."""
    found: list[dict[str, int]] = []
    while len(found) < count:
        found += [value for topic, value in observer.got(1) if topic == "/ticks"]
    return found
