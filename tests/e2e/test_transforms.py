# SPDX-License-Identifier: Apache-2.0
"""Transforms of a device on /tf and /tf_static: rclpy receives them with the QoS of tf2_ros, rosbags reads them."""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from rosbags.typesys import Stores, get_typestore

from microros_gen.interfaces.type_hashes import type_hashes
from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay, lossy
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+tf_broadcaster, +executor]
pools: {handles: 1}
session: {connect_timeout: 20 s, create_timeout: 10 s, liveliness_timeout: 1 s, liveliness_period: 500 ms}
nodes: [{name: robot}]
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
TYPE = "tf2_msgs/msg/TFMessage"
INVALID_ARGUMENT, BAD_ALLOC, PUBLISHER_INVALID = 11, 10, 300
Transform = tuple[str, str, float]
"""Parent, child and x."""


@cache
def _store() -> Any:
    return get_typestore(Stores.ROS2_JAZZY)


def read(sample: str) -> list[Transform]:
    """Return the transforms of a sample as rosbags reads it; stamp and rotation are what the program sets."""
    found = _store().deserialize_cdr(bytes.fromhex(sample), TYPE).transforms
    assert all(
        (t.header.stamp.sec, t.header.stamp.nanosec, t.transform.rotation.w) == (7, 500, 1) for t in found
    )
    return [(t.header.frame_id, t.child_frame_id, t.transform.translation.x) for t in found]


def listen(observer: Observer, topic: str) -> None:
    """Subscribe as a listener of tf2_ros does."""
    observer.ask(
        do="subscribe_raw",
        topic=topic,
        type=TYPE,
        hash=type_hashes()(TYPE),
        depth=100,
        transient_local=topic == "/tf_static",
    )


def received(observer: Observer, topic: str, wanted: list[Transform]) -> list[list[Transform]]:
    """Wait for a message with these transforms; return all messages of the topic until then."""
    end = deadline(10)
    found: list[list[Transform]] = []
    while wanted not in found:
        assert time.monotonic() < end, found
        found += [read(sample) for name, sample in observer.ask(do="samples") if name == topic]
        time.sleep(0.02)
    return found


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "transforms.c", tmp_path_factory.mktemp("tf") / "transforms", *STRICT)


@pytest.fixture
def device(program: Path, agent: object) -> Iterator[CommandedProgram]:
    with started(program) as process:
        yield CommandedProgram(process)
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_moving_frames(device: CommandedProgram, observer: Observer) -> None:
    """One or several in a message, on a publisher that listeners of tf2_ros match."""
    listen(observer, "/tf")
    found = observer.named_endpoints("/tf", 2)
    (publisher,) = [endpoint for endpoint in found if endpoint["kind"] == "PUBLISHER"]
    assert (publisher["node"], publisher["type"]) == ("/robot", TYPE)
    assert (publisher["reliability"], publisher["durability"]) == ("RELIABLE", "VOLATILE")
    assert {endpoint["hash"] for endpoint in found} == {type_hashes()(TYPE)}
    end = deadline(10)
    while not observer.ask(do="samples"):  # discovery in the other direction
        assert device.call("move first 1.0")[0] == 0
        assert time.monotonic() < end
    assert device.call("pair 2.5")[0] == 0
    received(observer, "/tf", [("odom", "base", 2.5), ("base", "arm", 3.5)])


def test_fixed_frames_reach_late_listeners(device: CommandedProgram, observer: Observer) -> None:
    """All that were ever sent, in one message, each child frame once."""
    assert device.call("fix laser 0.5")[0] == 0
    assert device.call("fixed camera laser")[0] == 0
    assert device.call("fix camera 1.5")[0] == 0
    listen(observer, "/tf_static")
    found = received(observer, "/tf_static", [("base", "laser", 0.5), ("base", "camera", 1.5)])
    assert found[-1] == [("base", "laser", 0.5), ("base", "camera", 1.5)]
    (publisher,) = [e for e in observer.named_endpoints("/tf_static", 2) if e["kind"] == "PUBLISHER"]
    assert (publisher["reliability"], publisher["durability"]) == ("RELIABLE", "TRANSIENT_LOCAL")


def test_fixed_frames_outlive_the_agent(
    device: CommandedProgram, observer: Observer, domain: int, image_port: Relay
) -> None:
    """The next agent gets them again, also those that were sent without any, over a network that loses messages."""
    assert device.call("fix laser 0.5")[0] == 0
    image_port.connect(0)
    time.sleep(1.2)
    assert device.call("fix camera 1.5")[0] == 0, "kept until there is a session"
    with running_agent(domain, "--domain", str(domain)) as agent:
        image_port.connect(agent.port)
        image_port.fault = lossy(17, 0.2)
        listen(observer, "/tf_static")
        received(observer, "/tf_static", [("base", "laser", 0.5), ("base", "camera", 1.5)])
        image_port.fault = lossy(0, 0.0)
        assert device.call("fix laser 0.75")[0] == 0
        received(observer, "/tf_static", [("base", "laser", 0.75), ("base", "camera", 1.5)])


def test_what_is_refused(device: CommandedProgram, observer: Observer) -> None:
    """With a text; what was sent before stays."""
    for name in ("a", "b"):
        assert device.call(f"fix {name} 1.0")[0] == 0
    text = "transform to frame d: set limits: {tf2_msgs/msg/TFMessage: {transforms: 4}} in microros.yaml"
    assert device.call("fixed c d")[:2] == (BAD_ALLOC, text)
    assert device.call("fixed c b")[0] == 0, "one of them has a place already"
    expected = {
        "fix - 1.0": (INVALID_ARGUMENT, "transform to frame : its name is empty or begins with '/'"),
        "move /wheel 1.0": (INVALID_ARGUMENT, "transform to frame : its name is empty or begins with '/'"),
        "fix base 1.0": (
            INVALID_ARGUMENT,
            "transform to frame base: the name of its parent is empty, begins with '/' or is its own",
        ),
        f"fix {'n' * 32} 1.0": (
            INVALID_ARGUMENT,
            f"frame {'n' * 32}: set limits: {{{TYPE}: "
            "{transforms: {header: {frame_id: 32}, child_frame_id: 32}}}",
        ),
        "none": (INVALID_ARGUMENT, "transforms or count"),
        "frames": (INVALID_ARGUMENT, "transform, frame_id or child_frame_id"),
        "null": (PUBLISHER_INVALID, "broadcaster"),
    }
    for line, (wanted, words) in expected.items():
        code, error, _ = device.call(line)
        assert (code, words in error) == (wanted, True), (line, error)
    code, error, _ = device.call("many")
    assert code == 1, error
    assert "transforms" in error
    listen(observer, "/tf_static")
    received(observer, "/tf_static", [("base", "a", 1.0), ("base", "b", 0.5), ("base", "c", 0.25)])
    assert device.call("again")[0] == 0
    assert device.call("fix e 2.0")[0] == 0
    received(observer, "/tf_static", [("base", "e", 2.0)])
