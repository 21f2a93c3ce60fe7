# SPDX-License-Identifier: Apache-2.0
"""A device that gives each sample back, and what is sent through it: all must come back, once and in order."""

from __future__ import annotations

import time
from pathlib import Path

from tests.support.agent.observer import Observer
from tests.support.e2e.images import started
from tests.support.patience import deadline, seconds

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
