# SPDX-License-Identifier: Apache-2.0
"""Continuous serialization: messages of 60,000 bytes from a device that has room for one fragment, read by rclpy."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.e2e.line_relay import LineRelay
from tests.support.e2e.relay import Relay, lossy
from tests.support.patience import seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+continuous_serialization]
{transport}pools: {{history: 2}}
session: {{connect_timeout: 20 s, create_timeout: 20 s}}
nodes:
  - name: camera
    publishers:
      - {{topic: continuous_text, type: std_msgs/msg/String, qos: {{durability: transient_local}}}}
      - {{topic: continuous_image, type: sensor_msgs/msg/Image, qos: {{durability: transient_local}}}}
      - {{topic: continuous_fast, type: std_msgs/msg/String, qos: {{reliability: best_effort}}}}
      - {{topic: continuous_number, type: std_msgs/msg/Int32, qos: {{durability: transient_local}}}}
limits:
  std_msgs/msg/String: {{data: 8}}
  sensor_msgs/msg/Image: {{header: {{frame_id: 8}}, encoding: 8, data: 1}}
"""
TEXT, IMAGE, NUMBER = "/continuous_text", "/continuous_image", "/continuous_number"
LARGEST = 65_527 - 4 - 1
"""Characters of the largest String: its number and its NUL are counted, too."""


def text(size: int) -> str:
    """Return what `text SIZE` of continuous.c publishes."""
    return "".join(chr(ord("a") + (i + i // 97) % 26) for i in range(size))


def image(size: int) -> dict[str, object]:
    """Return what `image SIZE` publishes."""
    return {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "eye"},
        "height": 1,
        "width": size,
        "encoding": "mono8",
        "is_bigendian": 0,
        "step": size,
        "data": [(i + i // 97) % 256 for i in range(size)],
    }


class Camera:
    """A running continuous.c."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def send(self, line: str) -> None:
        """Write a command."""
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def line(self) -> str:
        """Return the next line, without its end."""
        assert self._process.stdout is not None
        return self._process.stdout.readline().rstrip("\n")

    def run(self, command: str) -> tuple[int, int, str]:
        """Return the result, the dropped messages so far and the error text of a command."""
        self.send(command)
        return self.result()

    def result(self) -> tuple[int, int, str]:
        """Return those of the command that runs."""
        code, dropped, error = self.line().split(" ", 2)
        return int(code), int(dropped), error


@contextmanager
def camera(program: Path, *arguments: str) -> Iterator[Camera]:
    """Start it, and end it without an error."""
    with started(program, *arguments) as process:
        device = Camera(process)
        ready = device.line()
        assert ready == "ready", process.communicate()
        yield device
        _, errors = process.communicate("", timeout=seconds(20))
        assert (process.returncode, errors) == (0, "")


@pytest.fixture(scope="module")
def program(images: Images) -> Path:
    built = images.build(1, APPLICATION.format(transport=""))
    return built.application(C_FILES / "continuous.c", built.out.parent / "continuous", "-std=c99")


def subscribe(observer: Observer) -> None:
    """Receive all that is published reliably."""
    observer.subscribe(TEXT, "std_msgs/msg/String", transient_local=True)
    observer.subscribe(IMAGE, "sensor_msgs/msg/Image", transient_local=True)
    observer.subscribe(NUMBER, "std_msgs/msg/Int32", transient_local=True)


def test_the_whole_arrives_byte_for_byte(
    program: Path, relay: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """Sizes around the bounds of fragments, 60,000 and the largest; other messages before, within and after."""
    subscribe(observer)
    edge = 1472 - 8 - 8 - 5
    sizes = [0, 1, 8, edge - 1, edge, edge + 1, edge + 1464, edge + 1465, LARGEST]
    with camera(program, str(relay.port)) as device:
        assert device.run("plain 1") == (0, 0, "")
        for size in sizes:
            assert device.run(f"text {size}") == (0, 0, ""), size
        assert device.run("nested 3000") == (0, 0, "")
        assert device.run("image 60000") == (0, 0, "")
        assert device.run("plain 2") == (0, 0, "")
        found = observer.got(len(sizes) + 5, timeout_s=30)
    assert [value["data"] for topic, value in found if topic == TEXT] == [
        text(size) for size in [*sizes, 3000]
    ]
    assert [value for topic, value in found if topic == IMAGE] == [image(60_000)]
    assert [value["data"] for topic, value in found if topic == NUMBER] == [1, 3000, 2]


def test_what_is_refused_is_not_sent(
    program: Path, relay: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """Each with its text and counted; the next message arrives whole, and nothing of those before."""
    subscribe(observer)
    with camera(program, str(relay.port)) as device:
        assert device.run(f"text {LARGEST + 1}") == (
            1,
            1,
            "publisher /continuous_text: a message of 65528 bytes, and XRCE carries 65527",
        )
        for dropped, command in enumerate(("few 5000", "many 5000", "few 10", "many 10"), start=2):
            code, count, error = device.run(command)
            size = int(command.split()[1]) + 5
            assert (code, count) == (1, dropped)
            written = size - 1 if command.startswith("few") else size
            assert error == (
                f"publisher /continuous_text: {written} bytes written and {size} promised by the callbacks"
            )
        code, count, error = device.run("fast 10")
        assert (code, count) == (1, 6)
        assert "publisher /continuous_fast is best effort" in error
        assert device.run("text 4000") == (0, 6, "")
        assert device.run("plain 5") == (0, 6, "")
        found = observer.got(2)
    assert found == [(TEXT, {"data": text(4000)}), (NUMBER, {"data": 5})]


def test_a_network_that_loses_and_doubles(
    program: Path, relay: Relay, agent: AgentProcess, observer: Observer
) -> None:
    subscribe(observer)
    with camera(program, str(relay.port)) as device:
        relay.fault = lossy(5, 0.1)
        assert device.run("text 60000") == (0, 0, "")
        assert device.run("image 9000") == (0, 0, "")
        found = observer.got(2, timeout_s=30)
    assert found == [(TEXT, {"data": text(60_000)}), (IMAGE, image(9000))]


def test_an_agent_restarts_in_the_middle(
    program: Path, relay: Relay, domain: int, observer: Observer
) -> None:
    """The message is refused and nothing of it arrives; the next one in the new session does."""
    subscribe(observer)
    options = ("--domain", str(domain))
    with running_agent(domain, *options) as first:
        relay.connect(first.port)
        with camera(program, str(relay.port)) as device:
            assert device.run("text 3000") == (0, 0, "")
            assert observer.got(1) == [(TEXT, {"data": text(3000)})]
            device.send("pause 100")
            device.send("text 60000")
            assert device.line() == "half"
            first.stop(signal.SIGKILL)
            with running_agent(domain, *options) as second:
                relay.connect(second.port)
                code, dropped, error = device.result()
                assert (code, dropped) == (1, 1)
                assert "of 60005 bytes and acknowledges no more: publish it again" in error
                assert device.run("spin 1500")[0] == 0
                assert device.run("text 50000") == (0, 1, "")
                assert observer.got(1) == [(TEXT, {"data": text(50_000)})]
    assert observer.ask(do="samples") == []


@pytest.mark.system
def test_over_a_bad_line(images: Images, observer: Observer, domain: int, tmp_path: Path) -> None:
    """A line of a megabaud that changes and loses bytes; fragments are as large as its send buffer allows."""
    device_path = tmp_path / "line"
    transport = f'transport: {{type: serial, device: "{device_path}", baud: 1000000, send_buffer: 1100}}\n'
    built = images.build(0, APPLICATION.format(transport=transport))
    program = built.application(
        C_FILES / "continuous.c", tmp_path / "continuous", "-std=c99", "-DCONTINUOUS_LINE"
    )
    subscribe(observer)
    agent = ("serial", "--device", "", "--baud", "1000000")
    with LineRelay(device_path, 1_000_000, 0.01, 3) as line:
        transport_options = (*agent[:2], str(line.agent), *agent[3:])
        with (
            running_agent(domain, "--domain", str(domain), transport=transport_options),
            camera(program) as device,
        ):
            assert device.run("text 20000") == (0, 0, "")
            assert observer.got(1, timeout_s=30) == [(TEXT, {"data": text(20_000)})]
