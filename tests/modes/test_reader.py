# SPDX-License-Identifier: Apache-2.0
"""Model files are read as the package system_modes reads them, and with what is added to its format."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.modes import Model, Rule, Status, read_model
from tests.support.modes.models import MODELS, changed, model_of, model_text


@pytest.fixture(scope="module")
def arm() -> Model:
    return read_model(MODELS / "arm.yaml")


@pytest.fixture(scope="module")
def robot() -> Model:
    return read_model(MODELS / "robot.yaml")


def test_parts_of_a_text_over_several_lines_have_their_places(arm: Model) -> None:
    places = [(p.name, p.span.line, p.span.column) for p in arm.parts["arm"].parts if p.span]
    assert places == [("gripper", 9, 7), ("joint", 10, 7)]


@pytest.mark.parametrize(
    ("written", "places"),
    [
        ('"gripper  joint"', [(8, 13), (8, 22)]),
        ('"grip\\x70er joint"', [(8, 12), (8, 12)]),
        ("gripper\n\n\n      joint", [(8, 12), (11, 7)]),
        (">\n      gripper\n      joint", [(9, 7), (10, 7)]),
    ],
)
def test_places_of_parts_in_other_kinds_of_texts(written: str, places: list[tuple[int, int]]) -> None:
    listed = "    parts:\n      gripper\n      joint\n"
    parts = model_of(changed(model_text("arm"), listed, f"    parts: {written}\n")).parts["arm"].parts
    assert [part.name for part in parts] == ["gripper", "joint"]
    assert [(part.span.line, part.span.column) for part in parts if part.span] == places


def test_modes_are_in_the_order_of_the_file(arm: Model) -> None:
    assert {name: list(part.modes) for name, part in arm.parts.items()} == {
        "arm": ["__DEFAULT__", "GENTLE", "QUICK"],
        "gripper": ["__DEFAULT__", "SOFT", "FIRM"],
        "joint": ["__DEFAULT__", "CRAWL", "RUSH"],
    }


def test_a_command_without_a_mode_means_the_default(arm: Model) -> None:
    commands = arm.parts["arm"].modes["__DEFAULT__"].commands
    assert {name: str(command.target) for name, command in commands.items()} == {
        "gripper": "inactive",
        "joint": "active.__DEFAULT__",
    }


def test_a_mode_inherits_from_the_default(arm: Model, robot: Model) -> None:
    crawl = arm.parts["joint"].modes["CRAWL"].parameters
    assert {name: value.value for name, value in crawl.items()} == {"speed": 0.2, "law": "TORQUE"}
    fast = robot.parts["robot"].modes["FAST"].commands
    assert str(fast["camera"].target) == "active.__DEFAULT__"


def test_rules_are_sorted_by_name(arm: Model) -> None:
    rules = arm.parts["arm"].rules
    assert [rule.name for rule in rules] == [
        "without_gripper_gentle",
        "without_gripper_quick",
        "without_joint",
    ]
    last = rules[-1]
    assert last == Rule(
        "without_joint", Status("active", "QUICK"), "joint", Status("inactive"), Status("inactive"), last.span
    )


def test_namespaces_lists_groups_and_slashes(robot: Model) -> None:
    assert list(robot.parts) == ["robot", "base", "wheels/left", "wheels/right", "camera"]
    assert robot.parts["robot"].part_names == ("base", "camera")
    left = robot.parts["wheels/left"].modes["__DEFAULT__"].parameters
    assert {name: (v.value, v.type) for name, v in left.items()} == {
        "speed": (0.0, "double"),
        "pid.p": (1.0, "double"),
        "pid.i": (0.1, "double"),
    }
    camera = robot.parts["camera"].modes["__DEFAULT__"].parameters
    assert [(v.value, v.type) for v in camera.values()] == [(10, "integer"), (("front", "rear"), "string[]")]


def test_parents_and_order(robot: Model) -> None:
    assert robot.parents == {
        "base": "robot",
        "camera": "robot",
        "wheels/left": "base",
        "wheels/right": "base",
    }
    assert [system.name for system in robot.systems] == ["base", "robot"]
    assert [root.name for root in robot.roots] == ["robot"]
    assert [leaf.name for leaf in robot.leaves("base")] == ["wheels/left", "wheels/right"]
    assert [name.name for name in robot.parts["robot"].start_after["base"]] == ["camera"]


def test_the_default_may_follow_other_modes() -> None:
    text = model_text("arm")
    default = "      __DEFAULT__:\n        ros__parameters:\n          force: 0.5\n"
    later = "      FIRM:\n        ros__parameters:\n          force: 2.0\n"
    model = model_of(changed(changed(text, default, ""), later, later + default))
    assert list(model.parts["gripper"].modes) == ["SOFT", "FIRM", "__DEFAULT__"]


def test_a_file_that_does_not_exist(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"cannot read '.*none.yaml': No such file.*MG-8801"):
        read_model(tmp_path / "none.yaml")


def test_the_misspelled_part_has_its_line_and_a_hint() -> None:
    with pytest.raises(UserError) as raised:
        read_model(MODELS / "two_arms.yaml")
    (found,) = raised.value.diagnostics
    assert found.render().splitlines() == [
        f"{MODELS / 'two_arms.yaml'}:15:9: error: unknown part 'right/arn' in the mode 'BOTH'. "
        "Did you mean 'right/arm'? [MG-8813]",
        "          right/arn: active.SLOW",
        "          ^~~~~~~~~",
    ]
