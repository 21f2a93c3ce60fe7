# SPDX-License-Identifier: Apache-2.0
"""float64 on a processor whose double is a float: the conversion in a simulator, and messages to and from rclpy."""

from __future__ import annotations

import math
import os
import struct
import time

import pytest

from tests.support.agent.observer import Observer
from tests.support.examples import some
from tests.support.firmware.avr import MEGA, UNO, flash_and_ram, linked, read_line, simulated
from tests.support.firmware.board import Builds
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.typesupport.float64 import edge_patterns, expected, random_patterns

DEFAULTS = """\
float64 TENTH=0.1
float64 LARGE=-1e300
float64 SMALL=1e-50
float64 HALFWAY=1.000000178813934326171875
float64 number 0.1
float64[2] numbers [1e39, -2.5]
float64[] several [3.4028235e38, 1e-45, 1e308]
"""
CONVERTS = """\
version: 1
profiles: [pure_sender, pure_reader]
session: {key: 3}
interface_paths: [test_msgs]
interfaces: [test_msgs/msg/Defaults]
limits: {test_msgs/msg/Defaults: {several: 3}}
"""
EXCHANGES = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
# a busy test machine
session: {key: 4, connect_timeout: 20 s, create_timeout: 20 s}
limits: {sensor_msgs/msg/Temperature: {header: {frame_id: 4}}}
nodes:
  - name: uno
    publishers: [{topic: temperature, type: sensor_msgs/msg/Temperature, qos: {reliability: best_effort}}]
    subscriptions: [{topic: cmd_vel, type: geometry_msgs/msg/Twist, qos: {reliability: best_effort}}]
"""
SAMPLES = [(0.1, -2.5), (1e300, 1e-300), (1e-45, 16777217.0), (-math.inf, 3.4028235677973366e38)]


@pytest.mark.system
@pytest.mark.examples
def test_every_kind_of_number(builds: Builds) -> None:
    """Constants, default values, and the conversions of the same patterns as on a computer."""
    built = builds.build(MEGA, CONVERTS, more_files=(("test_msgs/msg/Defaults.msg", DEFAULTS),))
    image = linked(builds, built, "float64.c")
    patterns = some([*edge_patterns(), *random_patterns(300, seed=8)], every=5)  # both signs: 5 is odd
    with simulated(builds, built, image) as board:
        line = os.open(board.device, os.O_RDWR | os.O_NOCTTY)
        try:
            started_with = struct.unpack("<10f", read_line(line, 40))
            answers = [_asked(line, pattern) for pattern in patterns]
        finally:
            os.close(line)
    tenth = struct.unpack("<f", struct.pack("<f", 0.1))[0]
    constants = (tenth, -math.inf, 0.0, 1.0000002384185791015625)
    several = (3.4028234663852886e38, 1.401298464324817e-45, math.inf)
    assert started_with == (*constants, tenth, math.inf, -2.5, *several)
    assert answers == [expected(pattern) for pattern in patterns]


@pytest.mark.variant  # of tests/package/test_arduino.py: the same type on a Mega
@pytest.mark.ros
def test_messages_of_both_directions(builds: Builds, observer: Observer, domain: int) -> None:
    """An Uno receives geometry_msgs/Twist and sends sensor_msgs/Temperature."""
    built = builds.build(UNO, EXCHANGES)
    image = linked(builds, built, "twist.c")
    observer.subscribe("/temperature", "sensor_msgs/msg/Temperature", reliable=False)
    with simulated(builds, built, image) as board:
        with started(
            "agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain
        ) as agent:
            agent.wait_for("agent ready")
            for speed, turn in SAMPLES:
                _echoed(observer, speed, turn)
        assert flash_and_ram(built, image)[1] + board.touched_stack() < 2048


def _echoed(observer: Observer, speed: float, turn: float) -> None:
    """Publish a Twist until its numbers return, each as the nearest binary32."""
    end = deadline(60)
    zeros = {"x": 0.0, "y": 0.0, "z": 0.0}
    velocity = {"linear": {**zeros, "x": speed}, "angular": {**zeros, "z": turn}}
    wanted = tuple(_nearest(value) for value in (speed, turn))
    while True:
        echoed = [sample for topic, sample in observer.ask(do="samples") if topic == "/temperature"]
        if any((sample["temperature"], sample["variance"]) == wanted for sample in echoed):
            return
        assert time.monotonic() < end, f"not heard: {wanted}, but {echoed}"
        observer.ask(do="publish", topic="/cmd_vel", type="geometry_msgs/msg/Twist", values=[velocity])
        time.sleep(0.1)


def _nearest(value: float) -> float:
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


def _asked(line: int, pattern: int) -> tuple[int, int]:
    """Send a float64; return what it becomes, and what that becomes again."""
    os.write(line, struct.pack("<Q", pattern))
    narrow, wide = struct.unpack("<IQ", read_line(line, 12))
    return narrow, wide
