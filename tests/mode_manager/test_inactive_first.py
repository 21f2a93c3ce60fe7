# SPDX-License-Identifier: Apache-2.0
"""Nodes with mode services get their mode while they are inactive, as firmware accepts it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes import Status
from microros_gen.modes.model import active
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text

QUICK, GENTLE = active("QUICK"), active("GENTLE")
RECONFIGURED = Settings(reconfigured=frozenset({"joint"}))


@dataclass
class Watched(Node):
    """Notes each mode that it is active in."""

    def __post_init__(self) -> None:
        self.seen: list[str] = []

    def carry_out(self, call: Call) -> dict[str, Any]:
        response = super().carry_out(call)
        if self.state == "active" and self.seen[-1:] != [self.mode]:
            self.seen.append(self.mode)
        return response


class Forgetful(Watched):
    """Is in __DEFAULT__ after each activation."""

    def carry_out(self, call: Call) -> dict[str, Any]:
        if call.transition == 3:
            self.mode = "__DEFAULT__"
        return super().carry_out(call)


def arm(joint: Node, settings: Settings | None = None) -> World:
    world = World(
        model_of(model_text("arm")),
        {"gripper": Node(values={"force": 0.5}), "joint": joint},
        settings=settings,
    )
    world.let(3)
    return world


def commands(world: World, since: int = 0) -> list[str]:
    return [call.split(" ", 2)[2] for call in world.commands(since) if call.startswith("joint ")]


def changes_while_inactive(node: Node) -> Any:
    return lambda call: call.kind is Kind.CHANGE_MODE and node.state == "inactive"


@pytest.mark.parametrize("settings", [None, RECONFIGURED], ids=["as usual", "reconfigured"])
def test_a_node_is_never_active_in_a_former_mode(settings: Settings | None) -> None:
    """It keeps its mode while it is inactive."""
    joint = Watched(Link.MODES)
    world = arm(joint, settings)
    world.request("arm", QUICK)
    world.request("arm", Status("inactive"))
    first = len(world.sent)
    world.request("arm", GENTLE)
    assert commands(world, first) == ["CRAWL", "activate"]
    assert joint.seen == ["RUSH", "CRAWL"]
    assert world.status("arm") == "active.GENTLE"
    assert not any("others" in line for line in world.log)


def test_a_node_that_refuses_a_mode_while_it_is_inactive_gets_it_when_it_is_active() -> None:
    joint = Watched(Link.MODES)
    joint.refuses = changes_while_inactive(joint)
    world = arm(joint)
    world.request("arm", QUICK)
    assert commands(world) == ["configure", "RUSH", "activate", "RUSH"]
    assert world.status("arm") == "active.QUICK"
    assert world.manager.leaves["joint"].retries == 0


def test_a_node_that_forgets_its_mode_when_it_is_activated() -> None:
    joint = Forgetful(Link.MODES)
    world = arm(joint)
    world.request("arm", QUICK)
    assert joint.mode == "RUSH"
    assert world.status("arm") == "active.QUICK"


def test_a_reconfigured_node_is_inactive_while_it_gets_its_mode() -> None:
    joint = Watched(Link.MODES)
    world = arm(joint, RECONFIGURED)
    world.request("arm", QUICK)
    first = len(world.sent)
    world.request("arm", GENTLE)
    assert commands(world, first) == ["deactivate", "CRAWL", "activate"]
    assert joint.seen == ["RUSH", "CRAWL"]
    assert world.status("arm") == "active.GENTLE"


def test_a_reconfigured_node_that_refuses_is_active_as_before() -> None:
    joint = Watched(Link.MODES)
    world = arm(joint, RECONFIGURED)
    world.request("arm", QUICK)
    joint.refuses = lambda call: call.kind is Kind.CHANGE_MODE
    first = len(world.sent)
    world.request("arm", GENTLE, 20)
    assert commands(world, first) == ["deactivate", "CRAWL", "activate"]
    assert joint.seen == ["RUSH"]
    assert world.status("joint") == "active.RUSH"
    assert world.manager.leaves["joint"].failure == "it refuses the mode CRAWL, and is active as before"


def test_a_reconfigured_node_that_refuses_before_it_was_active_stays_inactive() -> None:
    joint = Watched(Link.MODES)
    joint.refuses = changes_while_inactive(joint)
    world = arm(joint, RECONFIGURED)
    world.request("arm", GENTLE, 20)
    assert commands(world) == ["configure", "CRAWL", "CRAWL", "CRAWL"]
    assert world.status("joint") == "inactive"
    assert world.manager.leaves["joint"].failure == "it refuses change_mode CRAWL"


def test_values_of_a_parent_that_are_not_sent_are_logged() -> None:
    text = changed(model_text("arm"), "speed: 0.2\n", "speed: $(parent limit)\n")
    text = changed(
        text,
        "      __DEFAULT__:\n        gripper: inactive\n",
        "      __DEFAULT__:\n        ros__parameters: {limit: 0.3}\n        gripper: inactive\n",
    )
    line = "joint: it serves no parameters, and does not get speed of its parent"
    for link, count in ((Link.MODES, 1), (Link.PARAMETERS, 0)):
        world = World(model_of(text), {"gripper": Node(), "joint": Node(link)})
        world.let(3)
        assert world.log.count(line) == count
