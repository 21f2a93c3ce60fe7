# SPDX-License-Identifier: Apache-2.0
"""An application of rclc with a timer and an executor on this machine: it publishes in time, and rests between."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from runtime.fake_agent import FakeAgent

from e2e.images import Images
from e2e.udp_agent import serving

TICKER = Path(__file__).parents[1] / "firmware" / "c" / "ticker.c"
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+timers]
nodes:
  - name: ticker
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    timers: [{name: tick, period: 20 ms%s}]
"""
SAMPLES = 50


@pytest.mark.parametrize("kind", ["", ", kind: rtos"], ids=["clock", "rtos"])
def test_a_timer_publishes_under_the_executor(images: Images, kind: str, tmp_path: Path) -> None:
    agent = FakeAgent()
    with serving(agent) as port:
        image = images.build(port, APPLICATION % kind)
        program = image.application(TICKER, tmp_path / "ticker", "-DTICKER_PERIOD_MS=20")
        start = time.monotonic()
        with subprocess.Popen([program]) as process:
            while len(agent.values()) < SAMPLES and time.monotonic() - start < 20:
                time.sleep(0.01)
            took = time.monotonic() - start
            process.send_signal(signal.SIGKILL)
            _, _, used = os.wait4(process.pid, 0)
            process.returncode = -signal.SIGKILL
    assert agent.values()[:SAMPLES] == list(range(SAMPLES))
    assert took > 0.02 * (SAMPLES - 1)
    assert used.ru_utime + used.ru_stime < took / 3, "it rests between the ticks"
