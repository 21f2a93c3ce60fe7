# SPDX-License-Identifier: Apache-2.0
"""States and modes are inferred as the package system_modes documents and implements it."""

from __future__ import annotations

import pytest

from microros_gen.modes import Inference, Status
from tests.support.modes.models import model_of, model_text

MODEL = model_of(model_text("arm"))
ROBOT = model_of(model_text("robot"))


def status(text: str) -> Status:
    state, _, mode = text.partition(".")
    return Status(state, mode)


@pytest.mark.parametrize(
    ("target", "gripper", "joint", "expected"),
    [
        ("active.GENTLE", "active.SOFT", "active.CRAWL", "active.GENTLE"),
        ("active.__DEFAULT__", "inactive", "active.__DEFAULT__", "active.__DEFAULT__"),
        ("active.__DEFAULT__", "unconfigured", "active.__DEFAULT__", "active.__DEFAULT__"),
        ("active.GENTLE", "inactive", "active.__DEFAULT__", "activating.__DEFAULT__"),
        ("active.GENTLE", "unconfigured", "active.__DEFAULT__", "activating"),
        ("active.GENTLE", "active.FIRM", "active.RUSH", "activating.QUICK"),
        ("active.GENTLE", "active.SOFT", "active.RUSH", "activating"),
        ("active.GENTLE", "active.SOFT", "active", "activating"),
        ("active.GENTLE", "errorprocessing", "active.CRAWL", "errorprocessing"),
        ("inactive", "inactive", "unconfigured", "inactive"),
        ("inactive", "active.SOFT", "inactive", "deactivating"),
        ("inactive", "active.SOFT", "errorprocessing", "errorprocessing"),
        ("", "inactive", "inactive", "inactive"),
        ("", "active.SOFT", "active.CRAWL", "active"),
        ("", "inactive", "active.CRAWL", "unknown"),
        ("", "errorprocessing", "active.CRAWL", "errorprocessing"),
    ],
)
def test_a_system_from_its_parts(target: str, gripper: str, joint: str, expected: str) -> None:
    actual = {"gripper": status(gripper), "joint": status(joint)}
    wanted = status(target) if target else None
    found = Inference(MODEL).infer_system(MODEL.parts["arm"], wanted, actual)
    assert str(found) == expected


@pytest.mark.parametrize(
    ("target", "force", "expected"),
    [
        ("active.SOFT", 0.5, "active.SOFT"),
        ("active.FIRM", 0.5, "active.__DEFAULT__"),
        ("", 0.5, "active.__DEFAULT__"),
        ("", 2.0, "active.FIRM"),
        ("active.SOFT", 2.0, "active.FIRM"),
        ("inactive", 2.0, "active.FIRM"),
        ("active.FIRM", 3.0, "active"),
        ("active.FIRM", 2, "active"),
    ],
)
def test_a_node_from_its_parameters(target: str, force: float, expected: str) -> None:
    targets = {"gripper": status(target)} if target else {}
    found = Inference(MODEL).infer_node(MODEL.parts["gripper"], {"force": force}, targets)
    assert str(found) == expected


def test_a_parameter_that_is_not_known_matches_no_mode() -> None:
    assert str(Inference(MODEL).infer_node(MODEL.parts["joint"], {"speed": 0.1}, {})) == "active"


@pytest.mark.parametrize(("mode", "speed"), [("__DEFAULT__", 0.3), ("FAST", 1.2)])
def test_a_template_value_follows_the_mode_of_the_system_above(mode: str, speed: float) -> None:
    targets = {"robot": Status("active", mode), "base": Status("active", "DRIVE")}
    inference, node = Inference(ROBOT), ROBOT.parts["wheels/right"]
    assert str(inference.infer_node(node, {"speed": speed}, targets)) == "active.TURN"
    assert str(inference.infer_node(node, {"speed": speed + 1}, targets)) == "active"


def test_all_parts_bottom_up() -> None:
    nodes = {
        "wheels/left": status("active.TURN"),
        "wheels/right": status("active.TURN"),
        "camera": status("active.__DEFAULT__"),
    }
    targets = {"robot": status("active.FAST"), "base": status("active.DRIVE")}
    found = Inference(ROBOT).infer_all(targets, nodes)
    assert (str(found["base"]), str(found["robot"])) == ("active.DRIVE", "active.FAST")
