# SPDX-License-Identifier: Apache-2.0
"""An action server on a board: rclpy sends it goals over the serial line. Its size, with the whole stack."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.support.e2e.action_peer import DEVICE, action_peer
from tests.support.firmware.actions import SERVER
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.running import started
from tests.support.patience import deadline, seconds

NAME = "qemu-mps2-an386"
SUCCEEDED, CANCELED = 4, 5
WRAPPED_BELOW = 2**31
"""Milliseconds of c/late_clock.h, which starts just below 2**32."""
SIZE = (22_200, 3_048, 1_264)
"""Flash, RAM without the stack, worst stack, on the Cortex-M4."""


@pytest.mark.variant  # of tests/e2e/test_action_server.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_rclpy_sends_goals(builds: Builds, domain: int) -> None:
    """Two goals at once with feedback, one of which is canceled, and a third one that has no place.

    The clock of the board wraps meanwhile.
    """
    need(NAME, emulator=True)
    built = builds.build(NAME, SERVER)
    image = builds.application(built, "actions.c", "-DLATE_CLOCK")
    with (
        action_peer(domain) as peer,
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        assert peer.ask(do="wait", action=DEVICE, timeout=seconds(60))
        assert peer.send(0)["accepted"]
        assert peer.send(6)["accepted"]
        assert peer.result(1) == [SUCCEEDED, [0, 1, 1, 2, 3, 5]]
        feedback: list[Any] = []
        end = deadline(20)
        while len(feedback) < 6:
            assert time.monotonic() < end, feedback
            feedback += peer.ask(do="feedback")
        assert [goal for goal, _ in feedback] == [1] * 6
        assert feedback[-1] == [1, [0, 1, 1, 2, 3, 5]]
        assert peer.send(0)["accepted"]  # in the place of the goal that has ended
        assert peer.send(1)["accepted"] is False
        running.wait_for(lambda: running.words("late_now_ms")[0] < WRAPPED_BELOW)
        peer.ask(do="ask", goal=0)
        assert peer.cancel(0) == [0, [0]]
        assert peer.result(0) == [CANCELED, []]
        report = running.words("actions_report", 3)
    assert report == [3, 2, 1]


@pytest.mark.system
def test_its_size(builds: Builds) -> None:
    """Three services, two publishers, executor, two goals, over a serial line."""
    need(NAME)
    built = builds.build(NAME, SERVER)
    image = builds.application(built, "actions.c")
    size = image_sections(built, image)
    found = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(value <= limit for value, limit in zip(found, SIZE, strict=True)), found
