# SPDX-License-Identifier: Apache-2.0
"""Slow links: three seconds of round trip over UDP, and a line of 2,400 baud; image, agent and rclpy.

What runs here in real time, tests/runtime/test_times.py and test_slow_services.py have with a clock that is made.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, QUICK, Images, started
from tests.support.e2e.line_relay import LineRelay
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+subscribe, +services, +executor, +time_sync]
nodes:
  - name: slow
    publishers: [{{topic: slow_out, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: slow_in, type: std_msgs/msg/Int32}}]
    services: [{{name: slow_sum, type: example_interfaces/srv/AddTwoInts}}]
    clients: [{{name: slow_far, type: example_interfaces/srv/AddTwoInts}}]
pools: {{history: 8}}
{more}
"""
CREATE_CLIENT, CREATE = 0, 1
SAMPLES, SUMS = [3, 4, 5], [[1, 2], [30, 40]]


def exchange(observer: Observer, program: Path, timeout_s: float, how: str) -> dict[str, int]:
    """Let samples and calls go through the device, both ways; return what it counted.

    `how`: `spin` with the executor, or `poll` each entity.
    """
    if not any(end["kind"] == "SUBSCRIPTION" for end in observer.ask(do="endpoints", topic="/slow_out")):
        observer.subscribe("/slow_out", "std_msgs/msg/Int32")
        observer.ask(do="add", service="/slow_far")
    observer.ask(do="publish", topic="/slow_in", type="std_msgs/msg/Int32", values=[])
    began = time.monotonic()
    with started(program, str(len(SAMPLES) + len(SUMS)), str(int(timeout_s)), how) as process:
        print(await_line(process, "created"))
        reported_time = float(await_line(process, "time").split()[1]) / 1000
        print(await_line(process, "ready"), f"time is off by {time.time() - reported_time:.1f} s")
        assert abs(time.time() - reported_time) < 5
        values = [{"data": value} for value in SAMPLES]
        observer.ask(do="publish", topic="/slow_in", type="std_msgs/msg/Int32", values=values)
        observer.ask(do="ask_sums", service="/slow_sum", pairs=SUMS)
        out, errors = process.communicate(timeout=seconds(timeout_s))
    assert (process.returncode, errors) == (0, ""), out
    *replies, counted = out.splitlines()
    print(f"{time.monotonic() - began:.0f} s: {counted}")
    assert replies == ["sum 11", "sum 22"], "what rclpy answered"
    arrived: list[int] = []
    end = deadline(20)
    while len(arrived) < len(SAMPLES) or None in observer.ask(do="sums"):
        assert time.monotonic() < end, (arrived, observer.ask(do="sums"))
        arrived += [value["data"] for topic, value in observer.ask(do="samples") if topic == "/slow_out"]
        time.sleep(0.1)
    assert arrived == SAMPLES
    assert observer.ask(do="sums") == [sum(pair) for pair in SUMS]
    return {key: int(value) for key, value in (pair.split("=") for pair in counted.split())}


@pytest.mark.long
@pytest.mark.parametrize("how", ["spin", "poll"])
def test_three_seconds_of_round_trip(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay, how: str
) -> None:
    application = APPLICATION.format(more="session: {round_trip: 3500 ms}")
    image = images.build(relay.port, application, flags=QUICK)
    program = image.application(
        C_FILES / "slow.c", image.out.parent / "slow", "-std=gnu99", "-Wall", "-Werror"
    )
    relay.connect(agent.port)
    relay.fault = lambda: [1.5]
    relay.sent.clear()
    counted = exchange(observer, program, 120, how)
    assert counted["left"] == counted["reconnects"] == counted["resent"] == counted["dropped"] == 0
    assert relay.sent[CREATE_CLIENT] == 1
    assert relay.sent[CREATE] == 1 + 3 + 3 + 1 + 1, "none is asked for a second time"


@pytest.mark.system
def test_a_line_of_2400_baud(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    device = tmp_path / "line"
    transport = f'transport: {{type: serial, device: "{device}", baud: 2400}}'
    image = images.build(0, APPLICATION.format(more=transport), flags=QUICK)
    program = image.application(C_FILES / "slow.c", tmp_path / "slow", "-std=gnu99", "-Wall", "-Werror")
    with (
        LineRelay(device, 2400, 0.0, 1) as line,
        running_agent(
            domain, "--domain", str(domain), transport=("serial", "--device", line.agent, "--baud", "2400")
        ),
    ):
        counted = exchange(observer, program, 120, "spin")
    assert counted["left"] == counted["reconnects"] == counted["resent"] == counted["dropped"] == 0
