# SPDX-License-Identifier: Apache-2.0
"""Strings and sequences filled as sources for micro-ROS fill them: what rclpy gets, with sanitizers and on 32 bit."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+micro_ros_utilities]
nodes:
  - name: filler
    publishers:
      - {topic: memory/initialized, type: std_msgs/msg/String, limits: {data: 40}}
      - {topic: memory/set, type: std_msgs/msg/String, limits: {data: 24}}
      - {topic: memory/header, type: std_msgs/msg/Header}
      - {topic: memory/numbers, type: std_msgs/msg/Int32MultiArray}
      - {topic: memory/joints, type: sensor_msgs/msg/JointState}
      - {topic: memory/arm, type: sensor_msgs/msg/JointState}
limits: {"*": {string: 15, sequence: 6}}
"""
TYPES = {
    "initialized": "std_msgs/msg/String",
    "set": "std_msgs/msg/String",
    "header": "std_msgs/msg/Header",
    "numbers": "std_msgs/msg/Int32MultiArray",
    "joints": "sensor_msgs/msg/JointState",
    "arm": "sensor_msgs/msg/JointState",
}
NAMES = ["base", "shoulder", "elbow", "wrist 1", "wrist 2", "a joint of 16 b"]
EXPECTED: dict[str, dict[str, Any]] = {
    "initialized": {"data": "a text of up to forty bytes: 29 and more"},
    "set": {"data": "set by the utilities"},
    "header": {"frame_id": "map"},
    "numbers": {"data": [1, 2, 3, -4]},
    "joints": {"name": NAMES, "position": [0.0, 0.5, 1.0, 1.5, 2.0, 2.5], "velocity": [], "effort": []},
    "arm": {"name": ["one"], "position": [], "velocity": [], "effort": [0.0, -1.5]},
}
FRAMES = {"joints": "base_link", "arm": "arm"}


@pytest.mark.parametrize(
    "flags", [(), pytest.param(("-m32", "-O1"), marks=pytest.mark.variant)], ids=["64", "32"]
)
def test_rclpy_gets_what_sources_write(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, flags: tuple[str, ...]
) -> None:
    image = images.build(image_port.port, APPLICATION, flags=flags)
    program = image.application(
        C_FILES / "messages.c", image.out.parent / "messages", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    for name, kind in TYPES.items():
        observer.subscribe(f"/memory/{name}", kind)
    observer.ask(do="samples")
    image_port.connect(agent.port)
    with started(program) as process:
        ends_well(process)
    found = {topic.removeprefix("/memory/"): value for topic, value in observer.ask(do="samples")}
    assert {
        name: {key: found[name][key] for key in expected} for name, expected in EXPECTED.items()
    } == EXPECTED
    assert {name: found[name]["header"]["frame_id"] for name in FRAMES} == FRAMES


SERVICES = """\
version: 1
profiles: [pure_sender]
components: [-publish, +services, +executor]
nodes:
  - name: names
    services: [{name: names, type: rcl_interfaces/srv/ListParameters}]
    clients: [{name: /peer/names, type: rcl_interfaces/srv/ListParameters}]
limits: {"*": {string: 17, sequence: 4}}
"""


@pytest.mark.parametrize(
    "flags", [(), pytest.param(("-m32", "-O1"), marks=pytest.mark.variant)], ids=["64", "32"]
)
def test_strings_of_services_are_exchanged_with_rclpy(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, flags: tuple[str, ...]
) -> None:
    image = images.build(image_port.port, SERVICES, flags=flags)
    program = image.application(
        C_FILES / "names.c", image.out.parent / "names", "-std=c99", "-Wall", "-Wextra", "-Werror"
    )
    observer.ask(do="serve_names", service="/peer/names")
    image_port.connect(agent.port)
    with started(program) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "reply: ONE  A NAME OF 17 BYTE\n", process.communicate()
        observer.ask(do="call_names", service="/names", prefixes=["x", "", "seventeen letters", "last"])
        ends_well(process)
    end = deadline(15)
    while (found := observer.ask(do="names")) is None:
        assert time.monotonic() < end, "no reply"
        time.sleep(0.02)
    assert found == [["last", "seventeen letters", "", "x"], ["of the device"]]
