# SPDX-License-Identifier: Apache-2.0
"""An action client on a board: it sends goals to rclpy over the serial line. Its size, with the whole stack."""

from __future__ import annotations

import time

import pytest

from tests.support.e2e.action_server_peer import action_server_peer
from tests.support.firmware.actions import CLIENT
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.running import started
from tests.support.patience import deadline

NAME = "qemu-mps2-an386"
CANCELED = 5
SIZE = (20_960, 3_120, 1_360)
"""Flash, RAM without the stack, worst stack, on the Cortex-M4."""


@pytest.mark.variant  # of tests/e2e/test_action_client.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_goals_are_sent_to_rclpy(builds: Builds, domain: int) -> None:
    """A goal with feedback and result, and another one that is canceled."""
    need(NAME, emulator=True)
    built = builds.build(NAME, CLIENT)
    image = builds.application(built, "action_client.c")
    with (
        action_server_peer(domain) as peer,
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        peer.ask(do="serve")
        agent.wait_for("agent ready")
        running.go_on()
        end = deadline(40)
        while (report := running.words("client_report", 4))[3] == 0:
            assert time.monotonic() < end, report
            time.sleep(0.2)
    assert report[0] >= 2
    assert report[1] >= 6
    assert report[2:] == [5, CANCELED]


@pytest.mark.system
def test_its_size(builds: Builds) -> None:
    """Three clients, a subscription, executor, two goals, over a serial line."""
    need(NAME)
    built = builds.build(NAME, CLIENT)
    image = builds.application(built, "action_client.c")
    size = image_sections(built, image)
    found = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(value <= limit for value, limit in zip(found, SIZE, strict=True)), found
