# SPDX-License-Identifier: Apache-2.0
"""Loaned messages: an image of 60,000 bytes from rclpy, which the device has once, in the queue."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Image, Images, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

LARGEST = 60_000
APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+loaned_messages]
session: {{connect_timeout: 20 s, create_timeout: 20 s}}
nodes:
  - name: screen
    subscriptions:
      - {{topic: loan_number, type: std_msgs/msg/Int32}}
      - {{topic: loan_image, type: sensor_msgs/msg/Image, {queue}}}
limits:
  sensor_msgs/msg/Image: {{header: {{frame_id: 8}}, encoding: 8, data: {size}}}
"""
SECTIONS = ("-O0", "-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections")
"""As in an image of a user: the linker leaves out what nobody calls, so the memory for a copy."""
OK, UNSUPPORTED, INVALID, TAKE_FAILED = 0, 3, 11, 401


def image(size: int, seed: int = 0) -> dict[str, object]:
    return {
        "header": {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "eye"},
        "height": 1,
        "width": size + seed,
        "encoding": "mono8",
        "is_bigendian": 0,
        "step": size,
        "data": [(i * 7 + seed) % 251 for i in range(size)],
    }


def shown(size: int, seed: int = 0) -> str:
    """Return what the device prints of it."""
    total = 0
    for i in range(size):
        total = (total * 31 + (i * 7 + seed) % 251) & 0xFFFFFFFF
    return f"{size} {size + seed} mono8 eye {total} 0"


class Screen:
    """A running loan.c."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def run(self, what: str, value: int = 0) -> str:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{what} {value}\n")
        self._process.stdin.flush()
        return self._process.stdout.readline().rstrip("\n")

    def take(self) -> str:
        """Wait for a sample."""
        end = deadline(20)
        while (line := self.run("take")) == str(TAKE_FAILED):
            assert time.monotonic() < end, "no sample"
            time.sleep(0.01)
        return line


@contextmanager
def screen(program: Path, relay: Relay, observer: Observer) -> Iterator[Screen]:
    """Start it, and wait until the observer's publisher has found it; end it without an error."""
    with started(program, str(relay.port)) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n", process.communicate()
        publish(observer)
        end = deadline(20)
        while not observer.ask(do="matched", topic="/loan_image"):
            assert time.monotonic() < end, "the device has not come"
            time.sleep(0.05)
        yield Screen(process)
        _, errors = process.communicate("", timeout=seconds(20))
        assert (process.returncode, errors) == (0, "")


def publish(observer: Observer, *values: dict[str, object]) -> None:
    observer.ask(do="publish", topic="/loan_image", type="sensor_msgs/msg/Image", values=list(values))


@pytest.fixture(scope="module")
def large(images: Images) -> Image:
    return images.build(1, APPLICATION.format(queue="queue: 1", size=LARGEST), "gcc", SECTIONS)


@pytest.fixture(scope="module")
def program(large: Image) -> Path:
    return large.application(C_FILES / "loan.c", large.out.parent / "loan", "-std=c99")


def test_an_image_is_in_memory_once(
    program: Path, relay: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """It comes in fragments to the queue, is read there, and the next one comes when it is returned."""
    with screen(program, relay, observer) as device:
        assert device.run("other") == f"1 0 {UNSUPPORTED}"
        assert device.run("take") == str(TAKE_FAILED)
        publish(observer, image(LARGEST), image(100, 1), image(7, 2))
        assert device.take() == shown(LARGEST)
        assert device.run("spin", 100) == str(OK)
        assert device.run("look") == shown(LARGEST)
        assert device.run("again") == str(TAKE_FAILED)
        assert device.run("copy") == str(TAKE_FAILED)
        assert device.run("take") == str(INVALID), "*loaned_message is not NULL"
        assert device.run("return") == str(OK)
        assert device.run("return") == str(INVALID)
        assert device.take() == shown(100, 1)
        assert device.run("close") == str(OK)
        assert device.run("return") == "400"
        assert device.run("open") == str(OK)
        assert device.run("take") == str(TAKE_FAILED)
    done = subprocess.run(["size", program], capture_output=True, text=True, check=True)
    _, data, bss = map(int, done.stdout.splitlines()[1].split()[:3])
    assert LARGEST < data + bss < LARGEST + 20_000


def test_a_newer_sample_does_not_overwrite_the_one_in_use(
    images: Images, relay: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """Best effort, two slots: while the older one is in use, the newest replaces the other one."""
    queue = "queue: 2, qos: {reliability: best_effort}"
    built = images.build(1, APPLICATION.format(queue=queue, size=400))
    program = built.application(
        C_FILES / "loan.c", built.out.parent / "loan", "-std=c99", "-DLOAN_BEST_EFFORT"
    )
    with screen(program, relay, observer) as device:
        publish(observer, image(300))
        assert device.take() == shown(300)
        for seed in (1, 2, 3):
            publish(observer, image(200, seed))
            device.run("spin", 100)
        assert device.run("look") == shown(300)
        assert device.run("return") == str(OK)
        assert device.take() == shown(200, 3)
