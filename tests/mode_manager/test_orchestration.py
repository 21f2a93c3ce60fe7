# SPDX-License-Identifier: Apache-2.0
"""Requests: the order of commands, their number, what is inferred and announced. With a made clock, without ROS."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.mode_manager.calls import Call, Kind, Link, Topic
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes import Status
from microros_gen.modes.model import active
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text

ARM = model_text("arm")
ROBOT = model_text("robot")
QUICK, GENTLE = active("QUICK"), active("GENTLE")


def arm(text: str = ARM, **nodes: Node) -> World:
    return World(model_of(text), {"gripper": Node(), "joint": Node(), **nodes})


def test_a_system_gets_its_mode_from_unconfigured_nodes() -> None:
    world = arm()
    world.request("arm", QUICK)
    assert world.status("arm") == "active.QUICK"
    assert [c for c in world.commands() if "joint" in c] == [
        "joint change_state configure",
        "joint set_parameters_atomically",
        "joint change_state activate",
    ]
    assert world.nodes["joint"].values == {"speed": 1.5, "law": "SPEED"}
    assert world.topics("arm") == [
        (Topic.TRANSITION_REQUEST, "active.QUICK"),
        (Topic.MODE_REQUEST, "active.QUICK"),
        (Topic.TRANSITION_EVENT, "activating"),
        (Topic.TRANSITION_EVENT, "active.QUICK"),
        (Topic.MODE_EVENT, "active.QUICK"),
    ]


def test_an_active_system_changes_its_mode_with_one_call_per_node() -> None:
    world = arm()
    world.request("arm", QUICK)
    first = len(world.sent)
    world.request("arm", GENTLE)
    assert world.status("arm") == "active.GENTLE"
    assert world.commands(first) == [
        "gripper set_parameters_atomically",
        "joint set_parameters_atomically",
    ]


def test_nodes_with_mode_services_get_their_mode_from_these() -> None:
    world = arm(joint=Node(Link.MODES))
    world.request("arm", QUICK)
    assert world.status("arm") == "active.QUICK"
    assert [c for c in world.commands() if "joint" in c] == [
        "joint change_state configure",
        "joint change_mode RUSH",
        "joint change_state activate",
    ]
    assert world.nodes["joint"].mode == "RUSH"


def six(order: str = "") -> str:
    names = [f"n{i}" for i in range(6)]
    parts = "\n".join(f"      {name}" for name in names)
    commands = "\n".join(f"        {name}: active.GO" for name in names)
    nodes = "\n".join(
        f"{name}:\n  ros__parameters:\n    type: node\n    modes:\n"
        f"      __DEFAULT__: {{ros__parameters: {{rate: 1}}}}\n      GO: {{ros__parameters: {{rate: 2}}}}"
        for name in names
    )
    return (
        f"s:\n  ros__parameters:\n    type: system\n    parts:\n{parts}\n{order}    modes:\n"
        f"      __DEFAULT__:\n{commands.replace('active.GO', 'inactive')}\n      GO:\n{commands}\n{nodes}\n"
    )


@pytest.mark.parametrize("link", [Link.PARAMETERS, Link.MODES])
def test_six_parts_take_three_round_trips(link: Link) -> None:
    """Each response takes a second; that of the last of three calls arrives in the fourth."""
    nodes = {f"n{i}": Node(link, delay_s=1.0, values={"rate": 1}) for i in range(6)}
    world = World(model_of(six()), nodes)
    world.let(3)
    begin = world.now
    world.request("s", active("GO"), 4)
    assert world.status("s") == "active.GO"
    assert len(world.sent) == 18
    assert {round((time - begin), 1) for time, _ in world.sent} == {0.0, 1.0, 2.0}


def test_levels_of_a_start_order_follow_each_other() -> None:
    nodes = {f"n{i}": Node(values={"rate": 1}) for i in range(6)}
    world = World(model_of(six("    start_after: {n0: [n4, n5], n1: n0}\n")), nodes)
    world.request("s", active("GO"))
    activated = [call.part for _, call in world.sent if call.transition == 3]
    assert activated.index("n0") > max(activated.index("n4"), activated.index("n5"))
    assert activated.index("n1") > activated.index("n0")
    first = len(world.sent)
    world.request("s", Status("inactive"))
    stopped = [call.part for _, call in world.sent[first:]]
    assert stopped.index("n1") < stopped.index("n0") < min(stopped.index("n4"), stopped.index("n5"))


def test_parts_stop_before_others_start() -> None:
    text = changed(
        ARM,
        "      QUICK:\n        gripper: active.FIRM\n        joint: active.RUSH",
        "      QUICK:\n        gripper: active.FIRM\n        joint: inactive",
    )
    world = arm(text)
    world.request("arm", active())
    first = len(world.sent)
    world.request("arm", QUICK)
    assert world.commands(first)[0] == "joint change_state deactivate"
    assert world.status("arm") == "active.QUICK"


def reconfigured(refuses: Callable[[Call], bool]) -> World:
    """Return the arm after a change of mode, for which its joint was inactive meanwhile, as its convention says."""
    world = arm(gripper=Node(values={"force": 0.5}), joint=Node(values={"speed": 0.1, "law": "TORQUE"}))
    world.settings = Settings(reconfigured=frozenset({"joint"}))
    world.start()
    world.request("arm", QUICK)
    world.nodes["joint"].refuses = refuses
    first = len(world.sent)
    world.request("arm", GENTLE)
    assert [c for c in world.commands(first) if "joint" in c] == [
        "joint change_state deactivate",
        "joint set_parameters_atomically",
        "joint change_state activate",
    ]
    return world


def test_a_node_that_is_reconfigured_by_convention() -> None:
    """Inactive, the parameters, active again."""
    assert reconfigured(lambda _: False).status("joint") == "active.CRAWL"


def test_a_refused_reconfiguration_ends_in_the_former_mode() -> None:
    world = reconfigured(lambda call: call.kind is Kind.SET_PARAMETERS)
    assert world.status("joint") == "active.RUSH"
    assert "refuses the parameters" in world.manager.leaves["joint"].failure
    assert world.status("arm") == "activating"


def test_a_node_without_a_life_cycle_is_always_active() -> None:
    world = arm(joint=Node(Link.PLAIN, state="active"))
    world.request("arm", QUICK)
    assert world.status("arm") == "active.QUICK"
    world.request("arm", Status("inactive"))
    assert world.status("joint") == "active.RUSH"
    assert "always active" in world.manager.leaves["joint"].failure
    assert world.status("gripper") == "inactive"


def test_configuring_and_cleaning_up_a_system() -> None:
    world = arm()
    world.manager.request("arm", Status("inactive"), must_configure=True)
    world.let(2)
    assert [node.state for node in world.nodes.values()] == ["inactive"] * 2
    world.manager.clean_up("arm")
    world.let(2)
    assert [node.state for node in world.nodes.values()] == ["unconfigured"] * 2
    assert world.status("arm") == "inactive"


def test_values_of_a_parent_follow_its_mode() -> None:
    model = model_of(ROBOT)
    world = World(model, {node.name: Node() for node in model.nodes})
    world.request("robot", active("FAST"))
    assert world.status("robot") == "active.FAST"
    assert world.nodes["wheels/left"].values["speed"] == 1.2
    assert world.nodes["camera"].values == {"rate": 10, "topics": ("front", "rear")}
    activated = [call.part for _, call in world.sent if call.transition == 3]
    assert activated[0] == "camera"


def test_an_upper_manager_leaves_what_another_one_manages_alone() -> None:
    model = model_of(ROBOT)
    world = World(model, {"camera": Node(), "base": Node(Link.SYSTEM, "inactive")}, without=("base",))
    world.request("robot", active("FAST"))
    assert [c for c in world.commands() if "camera" not in c] == ["base change_mode DRIVE"]
    assert world.status("robot") == "active.FAST"
    assert {each.part for each in world.announced} == {"robot", "camera"}
    world.request("robot", Status("inactive"))
    assert world.commands()[-2:] == ["base change_state deactivate", "camera change_state deactivate"]


def test_a_lower_manager_takes_its_subsystem_alone() -> None:
    model = model_of(ROBOT)
    world = World(model, {n: Node() for n in ("wheels/left", "wheels/right")}, roots=("/base",))
    world.request("base", active("DRIVE"))
    assert world.status("base") == "active.DRIVE"
    assert set(world.manager.statuses()) == {"base", "wheels/left", "wheels/right"}


@pytest.mark.parametrize(
    ("roots", "without", "id"),
    [
        (("bse",), (), "MG-8870"),
        (("robot", "base"), (), "MG-8871"),
        ((), ("camera",), "MG-8872"),
        (("base",), ("robot",), "MG-8872"),
    ],
)
def test_a_scope_with_a_mistake(roots: tuple[str, ...], without: tuple[str, ...], id: str) -> None:
    with pytest.raises(UserError) as raised:
        select_scope(model_of(ROBOT), roots, without)
    assert [d.id for d in raised.value.diagnostics] == [id]


def test_a_call_says_what_it_is() -> None:
    assert str(Call(1, "a", Kind.CHANGE_STATE, transition=4)) == "change_state deactivate"
