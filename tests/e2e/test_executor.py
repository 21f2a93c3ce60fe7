# SPDX-License-Identifier: Apache-2.0
"""An application of rclc with a timer and an executor on this machine: it publishes in time, and rests between."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.udp_agent import serving
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import first

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


@pytest.mark.parametrize("kind", first(["", ", kind: rtos"]), ids=["clock", "rtos"])
def test_a_timer_publishes_under_the_executor(images: Images, kind: str, tmp_path: Path) -> None:
    agent = FakeAgent()
    with serving(agent) as port:
        image = images.build(port, APPLICATION % kind)
        program = image.application(TICKER, tmp_path / "ticker", "-DTICKER_PERIOD_MS=20")
        start = time.monotonic()
        with subprocess.Popen([program]) as process:
            while len(agent.values()) < SAMPLES and time.monotonic() - start < 20:
                time.sleep(0.01)
            elapsed = time.monotonic() - start
            process.send_signal(signal.SIGKILL)
            _, _, used = os.wait4(process.pid, 0)
            process.returncode = -signal.SIGKILL
    assert agent.values()[:SAMPLES] == list(range(SAMPLES))
    assert elapsed > 0.02 * (SAMPLES - 1)
    assert used.ru_utime + used.ru_stime < elapsed / 3, "it rests between the ticks"


PARROT = """\
version: 1
profiles: [pure_sender, pure_reader]
nodes:
  - name: parrot
    domain_id: DOMAIN
    publishers: [{topic: words, type: std_msgs/msg/String}]
    subscriptions: [{topic: words, type: std_msgs/msg/String}]
limits: {"*": {string: 8}}
"""


@pytest.mark.ros
def test_a_message_that_was_only_initialized_gets_storage(
    images: Images, shared_agent: AgentProcess, domain: int, tmp_path: Path
) -> None:
    """`__init` gives a string a shared NUL and no buffer: what its declaration has is bound to it all the same."""
    image = images.build(shared_agent.port, PARROT.replace("DOMAIN", str(domain)))
    program = image.application(
        C_FILES / "initialized.c", tmp_path / "parrot", "-std=c99", "-Wall", "-Werror"
    )
    with started(program) as process:
        ends_well(process, 30)
