# SPDX-License-Identifier: Apache-2.0
"""A manager with `--reconfigure` and nodes of rclpy: one takes parameters only while it is inactive."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import pytest

from microros_gen.ros.endpoints import SETTLE_S
from microros_gen.ros.peer import Peer
from tests.support.mode_manager.arm import ARM, GRIPPER, JOINT, start
from tests.support.mode_manager.device import Device, alive
from tests.support.patience import seconds

pytestmark = pytest.mark.ros


def goals_of(peer: Peer, name: str) -> list[str]:
    """Return a list that gets the goal of each transition event of a node, which is connected already."""
    goals: list[str] = []

    def note(event: dict[str, Any]) -> None:
        goals.append(event["goal_state"]["label"])

    topic = f"/{name}/transition_event"
    subscription = peer.subscribe(topic, "lifecycle_msgs/msg/TransitionEvent", note)
    assert peer.spin(lambda: subscription.publishers() > 0, seconds(30)), topic
    peer.spin(lambda: False, SETTLE_S)  # the publisher may discover the subscription a little later
    return goals


def test_a_node_that_is_reconfigured_while_it_is_inactive(stack: ExitStack, domain: int) -> None:
    """The joint refuses parameters while it is active; the gripper takes them then, and stays active."""
    strict = {**JOINT, "only_inactive": True}
    asking, _ = start(stack, domain, ARM, "--reconfigure", "joint", gripper=GRIPPER, joint=strict)
    states = {name: goals_of(asking.peer, name) for name in ("gripper", "joint")}
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    asking.until(lambda: all(seen[-1:] == ["active"] for seen in states.values()))
    for seen in states.values():
        seen.clear()
    assert asking.change_mode("arm", "GENTLE")
    asking.until_row("arm", "active.GENTLE")
    asking.until(lambda: states["joint"] == ["deactivating", "inactive", "activating", "active"])
    assert states["gripper"] == []
    assert asking.mode("joint") == "CRAWL"
    assert asking.rows["joint"].retries == 0


def test_a_node_that_refuses_parameters_while_it_is_active_needs_the_option(
    stack: ExitStack, domain: int
) -> None:
    strict = {**JOINT, "only_inactive": True}
    asking, managing = start(stack, domain, ARM, gripper=GRIPPER, joint=strict)
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    assert asking.change_mode("arm", "GENTLE")
    managing.wait_for("joint: it refuses set_parameters_atomically: only while inactive")
    assert asking.mode("joint") == "RUSH"


def test_a_device_that_is_reconfigured_while_it_is_inactive(stack: ExitStack, domain: int) -> None:
    """One with mode services is never active in a mode that was not requested."""
    device = Device("joint", ("__DEFAULT__", "CRAWL", "RUSH"))
    stack.enter_context(alive(device))
    asking, _ = start(stack, domain, ARM, "--reconfigure", "joint", gripper=GRIPPER)
    asking.until(lambda: asking.rows["joint"].actual == "unconfigured")
    assert asking.change_mode("arm", "QUICK")
    asking.until_row("arm", "active.QUICK")
    assert asking.change_mode("arm", "GENTLE")
    asking.until_row("arm", "active.GENTLE")
    first, second = ["configure", "RUSH", "activate"], ["deactivate", "CRAWL", "activate"]
    assert device.requests == [*first, *second]
    assert (device.state, device.mode) == ("active", "CRAWL")
