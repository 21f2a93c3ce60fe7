# SPDX-License-Identifier: Apache-2.0
"""Reliable streams over bad networks: rclpy publishes, a device gives each sample back, rclpy gets all, once, in order.

Both directions at once: what is lost, doubled or out of order on either way shows in what comes back.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, QUICK, Images, started
from tests.support.e2e.line_relay import LineRelay
from tests.support.e2e.relay import Relay, cutting, lossy
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+subscribe, +executor]
{transport}
nodes:
  - name: echo
    publishers: [{{topic: echo_out, type: std_msgs/msg/Int32, qos: {{depth: 1000}}}}]
    subscriptions: [{{topic: echo_in, type: std_msgs/msg/Int32, queue: 64, qos: {{depth: 1000}}}}]
pools: {{history: 16, input_history: 16}}
session: {{liveliness_timeout: 30 s}}
on_full: block 60 s
"""
"""The time-out is for a busy test machine: an agent that does not run for seconds is not what these tests are about."""
AHEAD = 500
"""Samples that are published and have not come back: less than the depth of each reader in DDS."""


def begin(observer: Observer) -> None:
    """Subscribe once for all tests, and wait until the device of another one is gone."""
    if not any(end["kind"] == "SUBSCRIPTION" for end in observer.ask(do="endpoints", topic="/echo_out")):
        observer.subscribe("/echo_out", "std_msgs/msg/Int32")
    observer.ask(do="publish", topic="/echo_in", type="std_msgs/msg/Int32", values=[])
    end = deadline(30)
    while observer.ask(do="matched", topic="/echo_in"):
        assert time.monotonic() < end, "another device is still there"
        time.sleep(0.1)
    observer.ask(do="samples")


def echo(observer: Observer, program: Path, count: int, timeout_s: float) -> dict[str, int]:
    """Send `count` samples through the device; return what it counted. AssertionError unless all come back in order."""
    begin(observer)
    arrived: list[int] = []
    sent, end, began = 0, deadline(timeout_s), time.monotonic()
    with started(program, str(count - 1)) as process:
        while not observer.ask(do="matched", topic="/echo_in"):
            assert time.monotonic() < end, "the device has not come"
            assert process.poll() is None, process.communicate()
            time.sleep(0.05)
        time.sleep(0.5)  # and the other way
        while len(arrived) < count:
            assert process.poll() is None or sent == count, process.communicate()
            more = min(count, len(arrived) + AHEAD) - sent
            if more >= min(50, count - sent) and more:
                values = [{"data": value} for value in range(sent, sent + more)]
                observer.ask(do="publish", topic="/echo_in", type="std_msgs/msg/Int32", values=values)
                sent += more
            time.sleep(0.02)
            arrived += [value["data"] for topic, value in observer.ask(do="samples") if topic == "/echo_out"]
            assert arrived == list(range(len(arrived))), (
                f"after {time.monotonic() - began:.0f} s: {arrived[-20:]}"
            )
            assert time.monotonic() < end, f"{len(arrived)} of {count} after {timeout_s} s"
        out, errors = process.communicate(timeout=seconds(60))
    assert (process.returncode, errors) == (0, "")
    counted = {key: int(value) for key, value in (pair.split("=") for pair in out.split())}
    print(f"{count} samples in {time.monotonic() - began:.0f} s: {counted}")
    assert counted["reconnects"] == counted["dropped"] == 0
    return counted


def over_udp(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay, count: int, timeout_s: float
) -> None:
    image = images.build(relay.port, APPLICATION.format(transport=""), flags=QUICK)
    program = image.application(C_FILES / "echo.c", image.out.parent / "echo", "-std=c99", "-Wall", "-Werror")
    relay.connect(agent.port)
    relay.fault, relay.cut = lossy(count), cutting(count)
    before = relay.shortened
    counted = echo(observer, program, count, timeout_s)
    print(f"datagrams that came cut: {relay.shortened - before}")
    assert counted["resent"] > count // 8
    assert relay.shortened - before > count // 50


def over_a_line(
    images: Images, observer: Observer, domain: int, folder: Path, count: int, timeout_s: float
) -> None:
    """A line of 115200 baud, a part of whose frames is cut or changed."""
    device = folder / "line"
    text = APPLICATION.format(transport=f'transport: {{type: serial, device: "{device}"}}')
    image = images.build(0, text, flags=QUICK)
    program = image.application(C_FILES / "echo.c", folder / "echo", "-std=c99", "-Wall", "-Werror")
    with (
        LineRelay(device, 115_200, 0.01, count) as line,
        running_agent(
            domain, "--domain", str(domain), transport=("serial", "--device", line.agent, "--baud", "115200")
        ),
    ):
        counted = echo(observer, program, count, timeout_s)
        print(f"bytes changed in {line.changed} pieces, missing in {line.missing}")
    assert counted["resent"]
    assert line.changed
    assert line.missing


@pytest.mark.system
def test_nothing_is_lost_over_a_bad_network(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay
) -> None:
    over_udp(images, observer, agent, relay, 400, 60)


@pytest.mark.system
def test_nothing_is_lost_over_a_bad_line(
    images: Images, observer: Observer, domain: int, tmp_path: Path
) -> None:
    over_a_line(images, observer, domain, tmp_path, 300, 60)


@pytest.mark.long
def test_a_hundred_thousand_over_a_bad_network(
    images: Images, observer: Observer, agent: AgentProcess, relay: Relay
) -> None:
    over_udp(images, observer, agent, relay, 100_000, 7200)


@pytest.mark.long
def test_many_over_a_bad_line(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    over_a_line(images, observer, domain, tmp_path, 20_000, 3600)
