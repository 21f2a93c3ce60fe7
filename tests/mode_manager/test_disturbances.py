# SPDX-License-Identifier: Apache-2.0
"""Parts fail, answer late, refuse, leave and are changed by others, and managers are killed: where it ends."""

from __future__ import annotations

import random

import pytest

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import active
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text
from tests.support.slices import spread

ARM = model_text("arm")
ROBOT = model_text("robot")
QUICK, GENTLE = active("QUICK"), active("GENTLE")


def arm(**nodes: Node) -> World:
    return World(model_of(ARM), {"gripper": Node(), "joint": Node(), **nodes})


def activates(call: Call) -> bool:
    return call.transition == 3


def sets(call: Call) -> bool:
    return call.kind in (Kind.SET_PARAMETERS, Kind.CHANGE_MODE)


def test_a_part_that_cannot_be_activated_degrades_the_system() -> None:
    """Three attempts; then the rule applies to the inactive gripper, and the arm is in its default mode."""
    world = arm(gripper=Node(refuses=activates))
    world.request("arm", QUICK, 6)
    assert sum(activates(call) for _, call in world.sent if call.part == "gripper") == 3
    assert world.status("arm") == "active.__DEFAULT__"
    assert world.manager.rules == {"arm": "without_gripper_quick"}
    assert str(world.manager.targets["arm"]) == "active.__DEFAULT__"


def test_a_part_that_fails_while_it_is_activated_is_tried_three_times() -> None:
    """It falls back to unconfigured each time, from where no rule leads on: the arm stays activating."""
    world = arm(gripper=Node(refuses=activates, fails_to="unconfigured"))
    world.request("arm", QUICK, 12)
    assert sum(activates(call) for _, call in world.sent) == 3 + 1
    assert (world.status("gripper"), world.status("arm")) == ("unconfigured", "activating")
    assert world.manager.leaves["gripper"].failure == "it refuses change_state activate"


def test_a_part_that_ends_finalized_is_not_commanded_again() -> None:
    world = arm(gripper=Node(refuses=activates, fails_to="finalized"))
    world.request("arm", QUICK, 6)
    assert sum(activates(call) for _, call in world.sent if call.part == "gripper") == 1
    assert world.status("arm") == "activating"
    assert world.manager.leaves["gripper"].failure == "it is finalized"


@pytest.mark.parametrize("link", [Link.PARAMETERS, Link.MODES])
def test_a_part_that_refuses_a_mode(link: Link) -> None:
    """It stays in its former mode, without a rule for that; the other part has the new one."""
    world = arm(joint=Node(link))
    world.request("arm", GENTLE)
    world.nodes["joint"].refuses = sets
    world.request("arm", QUICK, 6)
    assert world.status("joint") == "active.CRAWL"
    assert world.status("gripper") == "active.FIRM"
    assert world.status("arm") == "activating"
    assert "it refuses" in world.manager.leaves["joint"].failure
    world.nodes["joint"].refuses = lambda _: False
    world.request("arm", QUICK, 6)
    assert world.status("arm") == "active.QUICK"


def test_a_late_response_changes_nothing_in_the_end() -> None:
    """The node does what it is told, and says so after the time-out: it is asked, and found in its target."""
    world = arm(joint=Node(state="inactive", delay_s=7.0))
    world.settings = Settings(call_s=5.0)
    world.nodes["joint"].delay_s = 0.01
    world.let(1)
    world.nodes["joint"].delay_s = 7.0
    world.manager.request("arm", QUICK)
    world.let(8)
    world.nodes["joint"].delay_s = 0.01
    world.let(12)
    assert world.status("arm") == "active.QUICK"
    assert world.manager.leaves["joint"].retries > 0


def test_a_part_that_never_answers_is_unknown_until_it_answers_again() -> None:
    world = arm(joint=Node(is_dead=True))
    world.manager.link("joint", Link.PARAMETERS)
    world.request("arm", QUICK, 25)
    assert world.manager.leaves["joint"].failure == "it does not answer"
    assert (world.status("joint"), world.status("arm")) == ("unknown", "activating")
    world.nodes["joint"].is_dead = False
    world.let(15)
    assert world.status("arm") == "active.QUICK"


def test_a_part_that_leaves_and_returns_gets_its_target_again() -> None:
    world = arm()
    world.request("arm", QUICK)
    world.leave("gripper")
    world.let(2)
    assert (world.status("gripper"), world.status("arm")) == ("unknown", "activating")
    world.join("gripper", Node())
    world.let(3)
    assert world.status("arm") == "active.QUICK"


def test_a_part_that_is_discovered_after_a_request_is_on_its_way() -> None:
    """The rule is for an inactive gripper of an active arm, and not for one that has not been commanded yet."""
    world = arm()
    world.leave("gripper")
    world.request("arm", QUICK, 1)
    world.join("gripper", Node(state="inactive"))
    world.let(4)
    assert world.manager.rules == {}
    assert world.status("arm") == "active.QUICK"


def test_a_part_that_leaves_during_a_transition() -> None:
    world = arm(gripper=Node(delay_s=1.0))
    world.manager.request("arm", QUICK)
    world.let(1.5)
    world.leave("gripper")
    world.let(10)
    assert (world.status("gripper"), world.status("joint")) == ("unknown", "active.RUSH")
    assert world.status("arm") == "activating"


def test_a_part_that_somebody_deactivates_follows_the_rule() -> None:
    world = arm()
    world.request("arm", QUICK)
    world.change("gripper", "inactive")
    world.let(3)
    assert world.status("arm") == "active.__DEFAULT__"
    assert "gripper: others changed it from active.FIRM to inactive" in world.log


def test_a_part_that_somebody_deactivates_slowly_follows_the_rule() -> None:
    """The rule is for an inactive gripper: while that is on its way there, it is not commanded."""
    world = arm()
    world.request("arm", QUICK)
    first = len(world.sent)
    world.change("gripper", "deactivating")
    world.let(2)
    assert (world.commands(first), world.status("gripper")) == ([], "deactivating")
    world.change("gripper", "inactive")
    world.let(3)
    assert world.manager.rules == {"arm": "without_gripper_quick"}
    assert world.status("arm") == "active.__DEFAULT__"


def test_a_part_that_somebody_deactivates_is_asked_when_an_event_is_lost() -> None:
    world = arm()
    world.request("arm", QUICK)
    world.change("gripper", "deactivating")
    world.nodes["gripper"].state = "inactive"
    world.let(3)
    assert world.status("arm") == "active.__DEFAULT__"


def test_a_part_that_somebody_reconfigures_is_brought_back() -> None:
    """No rule is about the mode of the joint; it is commanded again."""
    world = arm()
    world.request("arm", QUICK)
    world.let(2)
    world.nodes["joint"].values["speed"] = 0.2
    world.manager.hear_parameters("joint", {"speed": 0.2})
    assert world.status("joint") == "active"
    world.let(2)
    assert world.status("arm") == "active.QUICK"
    assert world.nodes["joint"].values["speed"] == 1.5


def test_a_lost_parameter_event_is_noticed_nevertheless() -> None:
    world = arm()
    world.request("arm", QUICK)
    world.nodes["joint"].values["speed"] = 0.2
    world.let(6)
    assert world.nodes["joint"].values["speed"] == 1.5


def test_two_that_change_a_part_against_each_other_end() -> None:
    """After three times in ten seconds the manager stops, and says so."""
    world = arm()
    world.request("arm", QUICK)
    for _ in range(6):
        world.let(1.5)
        world.nodes["joint"].values["speed"] = 0.3
        world.manager.hear_parameters("joint", {"speed": 0.3})
    world.let(2)
    assert world.manager.leaves["joint"].failure == "others change it again and again"
    assert world.nodes["joint"].values["speed"] == 0.3
    assert world.status("arm") == "activating"


def test_a_part_that_is_changed_by_hand_during_a_transition_of_its_system() -> None:
    """The joint has its mode and is stopped by hand while the gripper is on its way: the rule waits for that."""
    world = arm(gripper=Node(delay_s=1.0))
    world.manager.request("arm", QUICK)
    world.let(2.2)
    assert world.status("joint") == "active.RUSH"
    world.change("joint", "inactive")
    world.let(0.3)
    assert world.manager.rules == {}
    world.let(10)
    assert world.manager.rules == {"arm": "without_joint"}
    assert world.status("arm") == "inactive"


def test_a_reported_error_degrades_and_does_not_stop_commands() -> None:
    text = ARM.replace("[gripper, inactive]", "[gripper, errorprocessing]")
    world = World(model_of(text), {"gripper": Node(), "joint": Node()})
    world.request("arm", QUICK)
    world.manager.diagnosed.observe("gripper", "motor too hot")
    world.let(2)
    assert world.nodes["gripper"].state == "inactive"
    assert str(world.manager.targets["arm"]) == "active.__DEFAULT__"
    assert world.status("arm") == "errorprocessing"
    world.manager.diagnosed.observe("gripper", "")
    world.let(1)
    assert world.status("arm") == "active.__DEFAULT__"


def test_a_follower_of_a_failed_part_is_not_started() -> None:
    """The wheels start after the camera."""
    model = model_of(changed(ROBOT, "if_target: active.FAST", "if_target: active"))
    nodes = {node.name: Node() for node in model.nodes}
    nodes["camera"].refuses = activates
    world = World(model, nodes)
    world.request("robot", active("FAST"), 8)
    assert world.status("camera") == "inactive"
    assert [nodes[f"wheels/{side}"].state for side in ("left", "right")] == ["unconfigured"] * 2
    assert world.manager.progress.blocker("wheels/left") == "camera"


def test_rules_that_oscillate_end() -> None:
    text = ARM.replace("        new_target: inactive", "        new_target: active.GENTLE")
    text = text.replace(
        "      without_joint:",
        "      back:\n        if_target: active.GENTLE\n        if_part: [joint, inactive]\n"
        "        new_target: active.QUICK\n      without_joint:",
    )
    world = World(model_of(text), {"gripper": Node(), "joint": Node(refuses=activates)})
    world.request("arm", QUICK, 60)
    assert world.manager.oscillating == {"arm"}
    first = len(world.sent)
    world.let(10)
    assert len(world.sent) == first


def test_a_restarted_manager_takes_over_the_mode_that_a_system_is_in() -> None:
    world = arm()
    world.request("arm", QUICK)
    first = len(world.sent)
    world.start()
    assert world.status("arm") == "unknown"
    world.let(3)
    assert world.status("arm") == "active.QUICK"
    assert world.sent[first:] == []
    world.change("joint", "inactive")
    world.let(3)
    assert world.status("arm") == "inactive"


def test_a_restarted_manager_takes_over_values_of_parents() -> None:
    model = model_of(ROBOT)
    world = World(model, {node.name: Node() for node in model.nodes})
    world.request("robot", active("FAST"))
    world.start()
    world.let(3)
    assert world.status("robot") == "active.FAST"
    assert str(world.manager.targets["wheels/left"]) == "active.TURN"


def test_a_manager_that_is_killed_in_the_middle_commands_nothing_until_the_next_request() -> None:
    """The joint has its new mode and the gripper the old one: no mode fits, and the arm is active in none."""
    world = arm()
    world.request("arm", GENTLE)
    world.nodes["gripper"].delay_s = 1.0
    world.manager.request("arm", QUICK)
    world.let(0.5)
    world._due.clear()
    world.nodes["gripper"].delay_s = 0.01
    world.start()
    first = len(world.sent)
    world.let(10)
    assert (world.status("arm"), world.sent[first:]) == ("active", [])
    assert "arm" not in world.manager.targets
    world.request("arm", QUICK)
    assert world.status("arm") == "active.QUICK"


def test_a_fresh_system_is_not_commanded_to_anything() -> None:
    world = arm()
    world.let(10)
    assert (world.sent, world.manager.targets, world.status("arm")) == ([], {}, "unconfigured")


def test_a_subsystem_of_another_manager_that_degrades_by_itself() -> None:
    """The upper manager does not insist: its rule applies to the part that is what it is."""
    model = model_of(ROBOT)
    text = ROBOT.replace("if_part: [base, activating]", "if_part: [base, active]")
    model = model_of(text)
    world = World(model, {"camera": Node(), "base": Node(Link.SYSTEM, "inactive")}, without=("base",))
    world.request("robot", active("FAST"))
    assert world.status("robot") == "active.FAST"
    world.nodes["base"].mode = "__DEFAULT__"
    world.manager.hear_mode("base", "__DEFAULT__")
    world.let(5)
    assert world.manager.rules == {"robot": "stop"}
    assert world.status("robot") == "active.__DEFAULT__"


def test_a_subsystem_of_another_manager_that_never_arrives() -> None:
    model = model_of(ROBOT)
    nodes = {"camera": Node(), "base": Node(Link.SYSTEM, "inactive", settles=False)}
    world = World(model, nodes, without=("base",), settings=Settings(system_s=10.0))
    world.request("robot", active("FAST"), 30)
    assert world.manager.leaves["base"].failure == "it does not get its target in time"
    assert world.status("robot") == "activating"


@pytest.mark.parametrize("seed", spread(range(60), 3))
def test_whatever_happens_it_ends(seed: int) -> None:
    """Responses are late or lost, nodes leave and return, others interfere; then all is well, and one request is."""
    dice = random.Random(seed)
    model = model_of(ROBOT if seed % 2 else ARM)
    root = "robot" if seed % 2 else "arm"
    names = [node.name for node in model.nodes]
    links = (Link.PARAMETERS, Link.MODES)
    world = World(model, {name: Node(dice.choice(links)) for name in names})
    for _ in range(15):
        name = dice.choice(names)
        event = dice.randrange(7)
        if event == 0:
            target = dice.choice(model.targets(model.parts[root]))
            world.manager.request(root, target)
        elif event == 1 and not world.nodes[name].is_dead:
            world.change(name, dice.choice(["inactive", "active", "unconfigured", "finalized"]))
        elif event == 2:
            world.leave(name)
        elif event == 3 and world.nodes[name].is_dead:
            world.join(name, Node(dice.choice(links)))
        elif event == 4:
            world.nodes[name].delay_s = dice.choice([0.01, 1.0, 6.0])
        elif event == 5:
            world.nodes[name].refuses = dice.choice([activates, sets, lambda _: False])
        else:
            world.start()
        world.let(dice.choice([0.05, 0.5, 4.0]))
    for name in names:
        world.leave(name)
        world.let(0.1)
        world.join(name, Node(dice.choice(links)))
    world.let(1)
    target = dice.choice(model.targets(model.parts[root])[1:])
    world.request(root, target, 10)
    assert world.status(root) == str(target), world.log[-20:]
    first = len(world.sent)
    world.let(20)
    assert world.commands(first) == []
    assert not world.manager.progress.is_moving(root)


def test_parts_that_are_not_there_yet_are_waited_for_a_while() -> None:
    """In the first seconds nothing is known of the gripper: no rule for unknown parts applies so early."""
    text = changed(
        ARM,
        "[gripper, inactive]\n        new_target: active.__DEFAULT__\n      without_gripper_quick",
        "[gripper, unknown]\n        new_target: active.__DEFAULT__\n      without_gripper_quick",
    )
    world = World(model_of(text), {"joint": Node()})
    world.request("arm", GENTLE, 4)
    assert (world.manager.rules, world.status("joint")) == ({}, "active.CRAWL")
    world.let(3)
    assert world.manager.rules == {"arm": "without_gripper_gentle"}


def test_a_part_that_stops_and_is_not_there_holds_nothing_up() -> None:
    """The gripper should stop first; it has never been there, and the joint starts without it."""
    world = World(model_of(ARM), {"joint": Node()})
    world.request("arm", active(), 4)
    assert world.status("joint") == "unconfigured"
    world.let(3)
    assert world.status("joint") == "active.__DEFAULT__"


def test_a_mode_is_taken_over_when_the_nodes_are_discovered_late() -> None:
    world = arm()
    world.request("arm", QUICK)
    nodes, world.nodes = world.nodes, {}
    world.start()
    world.let(20)
    for name, node in nodes.items():
        world.join(name, node)
    world.let(3)
    assert world.status("arm") == "active.QUICK"
    assert str(world.manager.targets["arm"]) == "active.QUICK"


def test_a_part_that_appears_inactive_is_commanded_before_rules_are_looked_at() -> None:
    """A rule degrades an arm whose gripper is inactive; this one has just not been commanded yet."""
    world = World(model_of(ARM), {"joint": Node()})
    world.request("arm", QUICK, 1)
    world.join("gripper", Node(state="inactive"))
    world.let(3)
    assert (world.status("arm"), world.manager.rules) == ("active.QUICK", {})


def test_a_part_that_waits_for_a_failed_one_is_not_on_its_way() -> None:
    """Others deactivate it soon after a command of the manager: what is in doubt is asked, and rules go on."""
    model = model_of(changed(ROBOT, "if_target: active.FAST", "if_target: active"))
    nodes = {each.name: Node() for each in model.nodes}
    world = World(model, nodes)
    world.request("robot", active("FAST"), 0.5)
    assert world.status("robot") == "active.FAST"
    nodes["camera"].refuses = activates
    world.change("camera", "inactive")
    world.nodes["wheels/left"].state = "unconfigured"
    world.manager.hear_state("wheels/left", "unconfigured")
    world.let(15)
    assert world.status("camera") == "inactive"
    assert world.status("wheels/left") == "unconfigured"
    assert not world.manager.progress.is_moving("robot")
