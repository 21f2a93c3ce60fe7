# SPDX-License-Identifier: Apache-2.0
"""What a board logged before a fault reaches rclpy after the restart."""

from __future__ import annotations

import time

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.running import started
from tests.support.patience import deadline

NAME = "qemu-mps2-an386"
NO_MEMORY = "0xa0000000"
APPLICATION = """\
version: 1
profiles: [pure_sender]
logging: [{to: rosout, level: warn}, {to: ring, level: debug}]
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: device, namespace: /arm}]
"""


@pytest.mark.system
@pytest.mark.ros
def test_rclpy_receives_what_the_board_logged_before_a_fault(
    builds: Builds, domain: int, observer: Observer
) -> None:
    built = builds.merged(NAME, APPLICATION)
    need(NAME, emulator=True)
    image = builds.application(built, "log_ring.c", f"-DFAULT_ADDRESS={NO_MEMORY}u")
    observer.subscribe("/rosout", "rcl_interfaces/msg/Log", transient_local=True)
    with (
        board(built, image, restarts=True) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        running.wait_for(lambda: running.words("ring_report", 1) == [1], 60)
        end, found = deadline(60), list[tuple[int, str, str]]()
        while "before the fault 2" not in [text for _, _, text in found]:
            found += [
                (line["level"], line["name"], line["msg"])
                for topic, line in observer.ask(do="samples")
                if topic == "/rosout" and line["name"] in ("board", "microros")
            ]
            assert time.monotonic() < end, found
            time.sleep(0.02)
    assert found == [
        (30, "board", "after the fault 3"),
        (20, "microros", "lines from before the reset follow"),
        *((10, "board", f"before the fault {number}") for number in range(3)),
    ]
