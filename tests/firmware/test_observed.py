# SPDX-License-Identifier: Apache-2.0
"""A board over its serial line: events of what matches and what does not, and transforms with the agent's time."""

from __future__ import annotations

import time
from typing import Any

import pytest
from rosbags.typesys import Stores, get_typestore

from microros_gen.interfaces.type_hashes import type_hashes
from tests.support.agent.observer import Observer
from tests.support.e2e.event_peer import event_peer
from tests.support.firmware.board import Board, Builds, board, need
from tests.support.firmware.observed import APPLICATION
from tests.support.firmware.running import BOARD, started
from tests.support.patience import deadline

TRANSFORMS = "tf2_msgs/msg/TFMessage"
NONE, RELIABILITY = 1, 16
"""Policies of rmw/qos_policy_kind.h."""
SLACK_S = 5.0
"""How far the agent's time on the board may be off, which is on the machine of the test."""


def wait_for(running: Board, *expected: int) -> None:
    """Wait until the report begins with these numbers."""
    end = deadline(40)
    while (report := running.words("observed_report", 5))[: len(expected)] != list(expected):
        assert time.monotonic() < end, (report, expected)
        time.sleep(0.1)


@pytest.mark.variant  # of tests/e2e/test_qos_events.py and test_transforms.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_events_and_transforms_of_a_board(builds: Builds, observer: Observer, domain: int) -> None:
    """The subscriptions are those of rclpy, and so is the receiver of /tf, with the QoS of tf2_ros."""
    built = builds.merged(BOARD, APPLICATION)
    need(BOARD, emulator=True)
    image = builds.application(built, "observed.c")
    arguments = ("--domain", str(domain), "--graph-server")
    with (
        event_peer(domain) as peer,
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, *arguments, domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        observer.ask(
            do="subscribe_raw", topic="/tf", type=TRANSFORMS, hash=type_hashes()(TRANSFORMS), depth=100
        )
        began_s = time.time()
        running.go_on()
        wait_for(running, 0, 0, 0)
        fitting = peer.ask(do="add", topic="/arm/count", kind="subscription", reliable=False)
        wait_for(running, 1, 1, 0)
        peer.ask(do="add", topic="/arm/count", kind="subscription", reliable=True)
        wait_for(running, 1, 1, 1, RELIABILITY)
        peer.ask(do="remove", number=fitting)
        wait_for(running, 1, 0, 1, RELIABILITY)
        (_, sample), *_ = observer.got(1, timeout_s=30, topic="/tf")
        received_s = time.time()
    store: Any = get_typestore(Stores.ROS2_JAZZY)
    (transform,) = store.deserialize_cdr(bytes.fromhex(sample), TRANSFORMS).transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_link")
    assert (transform.transform.translation.x, transform.transform.rotation.w) == (0.25, 1)
    assert began_s - SLACK_S < transform.header.stamp.sec < received_s + SLACK_S
