# SPDX-License-Identifier: Apache-2.0
"""An application of rclc with a timer and an executor on a board: it publishes in time, and rests between."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.firmware.board import Builds, Built, board, need
from tests.support.firmware.footprint import SERVES, bounded_stack, image_sections, touched_stack
from tests.support.firmware.instructions import run_to_end
from tests.support.firmware.line import scripted_agent
from tests.support.firmware.ticker import APPLICATION, LISTENS
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import first

NAME = "qemu-mps2-an386"
SAMPLES = 12
CHANGES = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers, +services]
errors: code
pools: {executors: 2, handles: 8, timers: 2, guard_conditions: 2}
nodes:
  - name: device
    publishers:
      - {topic: first, type: std_msgs/msg/Int32, local: only}
      - {topic: second, type: std_msgs/msg/Int32, local: only}
    subscriptions:
      - {topic: first, type: std_msgs/msg/Int32, local: only, queue: 4}
      - {topic: second, type: std_msgs/msg/Int32, local: only, queue: 4}
    services: [{name: sum, type: example_interfaces/srv/AddTwoInts, local: only}]
    clients: [{name: sum, type: example_interfaces/srv/AddTwoInts, local: only}]
"""


@pytest.mark.system
@pytest.mark.parametrize("kind", first(["", ", kind: rtos"]), ids=["clock", "rtos"])
def test_a_timer_publishes_under_the_executor(builds: Builds, kind: str) -> None:
    built = builds.build(NAME, APPLICATION % kind)
    image = builds.application(built, "ticker.c")
    with board(built, image) as running, scripted_agent(running.device, FakeAgent()) as agent:
        running.go_on()
        running.wait_for(agent.values)
        start = time.monotonic()
        running.wait_for(lambda: len(agent.values()) > SAMPLES)
        elapsed = time.monotonic() - start
        touched = touched_stack(running, built, image)
    assert agent.values()[:SAMPLES] == list(range(SAMPLES))
    assert elapsed > 0.1 * SAMPLES * 0.8
    proven = bounded_stack(built, image)  # callbacks of the application included
    assert proven // 4 < touched <= proven


@pytest.mark.variant  # of tests/runtime/test_executor.py (unit_executor_changes.c), on a board
@pytest.mark.system
def test_handles_of_every_kind_are_added_and_removed(builds: Builds) -> None:
    """Two executors, local topics and a local service, without an agent; the clock wraps meanwhile."""
    need(NAME, emulator=True)
    built = builds.build(NAME, CHANGES)
    image = builds.application(built, "executor_changes.c")
    assert run_to_end(built.target, image) == (0, b"")


@pytest.mark.system
@pytest.mark.parametrize(
    ("listens", "text", "ram"),
    [(False, 11250, 1000), (True, 15500, 1220)],
    ids=["talks", "talks-and-listens"],
)
def test_its_size(builds: Builds, listens: bool, text: int, ram: int) -> None:
    """Publisher, timer, executor, and a subscription (goals of image 2: 15,000, not met, and 3,000)."""
    need(NAME)
    application = APPLICATION % "" + (LISTENS if listens else "")
    built = builds.build(NAME, application.replace("[pure_sender]", "[pure_sender, pure_reader]", listens))
    image = builds.application(built, "ticker.c", *(["-DTICKER_LISTENS"] if listens else []))
    assert within(built, image, text, ram)


@pytest.mark.system
def test_the_size_of_a_server(builds: Builds) -> None:
    """A server of SetBool and executor (the goal of image 3: 15,000 and 3,000); `errors: code`."""
    need(NAME)
    built = builds.build(NAME, SERVES)
    image = builds.application(built, "setbool.c")
    assert within(built, image, 14300, 1840)
    assert bounded_stack(built, image) <= 1320, "every interrupt on top of it"


def within(built: Built, image: Path, text: int, ram: int) -> bool:
    """Whether an image has no more code and constants, and no more static memory, the stack left out."""
    size = image_sections(built, image)
    print(size)
    return size.text + size.data <= text and size.ram <= ram
