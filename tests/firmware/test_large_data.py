# SPDX-License-Identifier: Apache-2.0
"""A board mirrors images of 60,000 bytes over its serial line: one copy is in memory, that in the queue."""

from __future__ import annotations

import time

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.running import BOARD, started
from tests.support.patience import deadline

LARGEST = 60_000
APPLICATION = f"""\
version: 1
profiles: [pure_sender, pure_reader]
components: [+continuous_serialization, +loaned_messages]
errors: code
transport: {{type: serial, send_buffer: 1200}}
session: {{connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}}
nodes:
  - name: mirror
    publishers:
      - topic: /large_out
        type: sensor_msgs/msg/Image
        limits: {{header: {{frame_id: 8}}, encoding: 8, data: 1}}
    subscriptions:
      - topic: /large_in
        type: sensor_msgs/msg/Image
        queue: 1
        qos: {{reliability: reliable}}
        limits: {{header: {{frame_id: 8}}, encoding: 8, data: {LARGEST}}}
"""
TAKEN, SENT, ERROR, REPORTS = range(4)


def image(size: int) -> dict[str, object]:
    return {
        "header": {"stamp": {"sec": 3, "nanosec": 4}, "frame_id": "eye"},
        "height": 1,
        "width": size,
        "encoding": "mono8",
        "is_bigendian": 0,
        "step": size,
        "data": [(i * 13 + i // 256) % 256 for i in range(size)],
    }


@pytest.mark.variant  # of tests/e2e/test_large.py, on a board
@pytest.mark.ros
def test_a_board_mirrors_images_larger_than_its_buffers(
    builds: Builds, observer: Observer, domain: int
) -> None:
    built = builds.merged(BOARD, APPLICATION)
    need(BOARD, emulator=True)
    program = builds.application(built, "large_data.c")
    sizes = built.symbol_sizes(program)
    ram = {name: size for name, size in sizes.items() if size > LARGEST // 4}
    assert len(ram) == 1, f"one of them has room for an image: {ram}"
    with (
        board(built, program) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        observer.subscribe("/large_out", "sensor_msgs/msg/Image")
        where = {"topic": "/large_in", "type": "sensor_msgs/msg/Image"}
        observer.ask(do="publish", values=[], **where)
        running.go_on()
        end = deadline(20)
        while not observer.ask(do="matched", topic="/large_in"):
            assert time.monotonic() < end, "no subscription"
            time.sleep(0.05)
        observer.named_endpoints("/large_out", 2)
        values = [image(size) for size in (LARGEST, 0, 700)]
        observer.ask(do="publish", values=values, **where)
        found = observer.got(3, timeout_s=30)
        assert [value for _, value in found] == values
        assert running.words("large_data_report", REPORTS) == [3, 3, 0]
