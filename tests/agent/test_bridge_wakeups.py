# SPDX-License-Identifier: Apache-2.0
"""A sample to ROS 2 does not wake further threads of the agent: that took a third of its processor time."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from microros_gen.agent.representation import Qos, Topic
from tests.support.agent.bridging import Bridged
from tests.support.agent.observer import Observer

pytestmark = pytest.mark.ros

SAMPLES = 400
SUPPRESSION_S = 0.004
"""Seconds between two times at which the timer of a reader ends, however many samples are sent."""


def waits_of_timers() -> int:
    """Return how often the threads of this process that run the timers of Fast DDS have gone to sleep."""
    found = 0
    for task in Path("/proc/self/task").iterdir():
        if (task / "comm").read_text().startswith("dds.ev"):
            _, _, after = (task / "status").read_text().partition("\nvoluntary_ctxt_switches:")
            found += int(after.split()[0])
    return found


def test_a_reliable_sample_does_not_wake_the_thread_of_timers(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    node = bridged.bridge.create_node("quiet", bridged.domain)
    writer = node.create_writer(Topic("rt/quiet", "std_msgs::msg::dds_::Int32_"), Qos(depth=SAMPLES))
    bridge_observer.subscribe("/quiet", "std_msgs/msg/Int32")
    bridged.wait(lambda: len(bridge_observer.ask(do="endpoints", topic="/quiet")) >= 1)
    bridged.wait_for(0.5)
    before, began = waits_of_timers(), time.monotonic()
    assert before > 0
    for value in range(SAMPLES):
        writer.publish(b"\0\1\0\0" + value.to_bytes(4, "little"))
        time.sleep(0.0001)  # a thread that the sample wakes sleeps again before the next one
    woken, elapsed = waits_of_timers() - before, time.monotonic() - began
    values = [value["data"] for _, value in bridge_observer.got(SAMPLES)]
    node.destroy()
    assert values == list(range(SAMPLES))
    assert woken < SAMPLES / 4 + 3 * elapsed / SUPPRESSION_S, (
        f"{woken} times for {SAMPLES} samples in {elapsed} s"
    )


def test_samples_that_were_left_are_there_and_the_next_one_after_them_wakes(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    node = bridged.bridge.create_node("patient", bridged.domain)
    reader = node.create_reader(Topic("rt/patient", "std_msgs::msg::dds_::Int32_"), Qos(depth=SAMPLES))
    bridged.wait(lambda: len(bridge_observer.ask(do="endpoints", topic="/patient")) >= 1)

    def publish(values: range) -> None:
        ask = {"topic": "/patient", "type": "std_msgs/msg/Int32"}
        bridge_observer.ask(do="publish", values=[{"data": value} for value in values], **ask)

    def take() -> int:
        taken = reader.take()
        assert taken is not None
        return int.from_bytes(taken[4:8], "little")

    for round_ in range(3):
        first = 10 * round_
        publish(range(first, first + 4))
        bridged.wait(lambda: reader.unread() >= 4)
        assert take() == first
        publish(range(first + 4, first + 6))
        bridged.wait(lambda: reader.unread() >= 6)
        assert [take() for _ in range(5)] == list(range(first + 1, first + 6))
        assert reader.take() is None
        publish(range(first + 6, first + 8))
        received = bridged.take(reader, 2)
        assert [int.from_bytes(each[4:8], "little") for each in received] == [first + 6, first + 7]
        reader.unread()
        assert reader.take() is None  # now it counts from 0
    node.destroy()
