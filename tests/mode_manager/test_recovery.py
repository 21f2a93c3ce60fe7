# SPDX-License-Identifier: Apache-2.0
"""Rules with `recover_if`: a degraded system gets the target of before when the failed part is well again."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from microros_gen.mode_manager.calls import Kind, Link
from microros_gen.mode_manager.diagnosis import TOPIC, TYPE
from microros_gen.mode_manager.simulation import Played
from microros_gen.modes import Manager, Status, check
from microros_gen.modes.model import active
from tests.support.mode_manager.arm import start
from tests.support.mode_manager.played import CELL_NODES, play
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of

ARM = (
    """\
arm:
  ros__parameters:
    type: system
    parts: [p, q]
    modes:
      __DEFAULT__: {p: active, q: active}
      LIMP: {p: inactive, q: active.SLOW}
      STOP: {p: inactive, q: inactive}
    rules:
      degrade:
        if_target: active
        if_part: [p, errorprocessing]
        new_target: active.LIMP
        recover_if: [p, inactive, unconfigured]
      stop:
        if_target: active.LIMP
        if_part: [q, errorprocessing]
        new_target: active.STOP
        recover_if: [q, inactive, unconfigured]
"""
    + CELL_NODES
)


def world() -> World:
    arm = World(model_of(ARM), {"p": Node(values={"v": 1}), "q": Node(values={"w": 1})})
    arm.let(3)
    arm.request("arm", active())
    assert arm.status("arm") == "active.__DEFAULT__"
    return arm


def played(script: str, text: str = ARM) -> Played:
    return play(script, text)


def targets(world: World) -> str:
    return str(world.manager.targets["arm"])


def test_the_system_returns_when_the_failed_part_is_well() -> None:
    """Its error is over, and the manager commands it again; simulation and proof end in the same."""
    arm = world()
    arm.manager.diagnosed.observe("p", "motor: hot")
    arm.let(5)
    assert (targets(arm), arm.manager.rules) == ("active.LIMP", {"arm": "degrade"})
    assert (arm.nodes["p"].state, arm.nodes["q"].values) == ("inactive", {"w": 0})
    arm.manager.diagnosed.observe("p", "")
    arm.let(5)
    assert (arm.status("arm"), dict(arm.manager.rules)) == ("active.__DEFAULT__", {})
    assert (arm.nodes["p"].state, arm.nodes["q"].values) == ("active", {"w": 1})
    assert "arm: rule degrade is over: active.__DEFAULT__" in arm.log
    trace = played(
        "- {at: 0 s, request: arm, target: active}\n- {at: 2 s, fail: p}\n- {at: 20 s, repair: p}\n"
    )
    assert {end.part: str(end.status) for end in trace.ends}["arm"] == "active.__DEFAULT__"
    assert "arm: rule degrade: active.LIMP" in trace.text()
    manager = Manager(model_of(ARM))
    list(manager.request("arm", active()))
    list(manager.fail("p", Status("errorprocessing")))
    assert manager.targets["arm"] == active("LIMP")
    manager = Manager(model_of(ARM))
    list(manager.request("arm", active()))
    steps = list(manager.change("p", Status("errorprocessing")))
    assert [str(step) for step in steps if step.kind == "recovery"] == [
        "rule degrade: arm active.__DEFAULT__ again"
    ]
    assert manager.statuses()["arm"] == active()


def test_two_failures_recover_one_after_another() -> None:
    arm = world()
    arm.manager.diagnosed.observe("p", "motor: hot")
    arm.let(3)
    arm.manager.diagnosed.observe("q", "motor: hot")
    arm.let(3)
    assert targets(arm) == "active.STOP"
    arm.manager.diagnosed.observe("p", "")
    arm.let(3)
    assert targets(arm) == "active.STOP", "only the last rule can be over"
    arm.manager.diagnosed.observe("q", "")
    arm.let(5)
    assert arm.status("arm") == "active.__DEFAULT__"


def test_a_requested_mode_is_not_left() -> None:
    """LIMP was requested: the part is well, and nothing returns. The same after a manager that was restarted."""
    arm = world()
    arm.request("arm", active("LIMP"))
    arm.let(10)
    assert arm.status("arm") == "active.LIMP"
    arm.request("arm", active())
    arm.manager.diagnosed.observe("p", "motor: hot")
    arm.let(5)
    arm.request("arm", active("LIMP"))
    arm.manager.diagnosed.observe("p", "")
    arm.let(5)
    assert arm.status("arm") == "active.LIMP"
    arm.start()
    arm.let(10)
    assert (arm.status("arm"), targets(arm)) == ("active.LIMP", "active.LIMP")


def test_a_part_that_is_on_its_way_is_waited_for() -> None:
    """It answers slowly: the system returns when all parts have arrived."""
    arm = world()
    arm.nodes["q"].delay_s = 3.0
    arm.manager.diagnosed.observe("p", "motor: hot")
    arm.let(1)
    arm.manager.diagnosed.observe("p", "")
    arm.let(1)
    assert targets(arm) == "active.LIMP"
    arm.let(15)
    assert arm.status("arm") == "active.__DEFAULT__"


def test_a_part_that_fails_again_and_again_ends_degraded() -> None:
    """It has an error whenever it is active: three times in a minute the system returns, then it stays."""
    arm = world()
    for _ in range(12):
        arm.manager.diagnosed.observe("p", "motor: hot" if arm.nodes["p"].state == "active" else "")
        arm.let(3)
    assert targets(arm) == "active.LIMP"
    assert "arm: it recovered again and again, and stays so until the next request" in arm.log
    assert arm.log.count("arm: rule degrade is over: active.__DEFAULT__") == 3
    arm.request("arm", active())
    assert arm.status("arm") == "active.__DEFAULT__"


def test_failures_on_many_days_do_not_count_as_an_oscillation() -> None:
    arm = world()
    for _ in range(12):
        arm.manager.diagnosed.observe("p", "motor: hot")
        arm.let(40)
        assert targets(arm) == "active.LIMP"
        arm.manager.diagnosed.observe("p", "")
        arm.let(40)
        assert arm.status("arm") == "active.__DEFAULT__"
    assert not arm.manager.oscillating


def test_a_session_that_was_lost() -> None:
    text = changed(ARM, "[p, errorprocessing]", "[p, unknown]")
    arm = World(model_of(text), {"p": Node(values={"v": 1}), "q": Node(values={"w": 1})})
    arm.let(3)
    arm.request("arm", active())
    arm.leave("p")
    arm.let(5)
    assert targets(arm) == "active.LIMP"
    arm.nodes["p"].is_dead, arm.nodes["p"].state = False, "unconfigured"
    arm.join("p", arm.nodes["p"])
    arm.let(5)
    assert arm.status("arm") == "active.__DEFAULT__"


def test_a_device_that_reacts_to_its_error_is_commanded_when_that_is_over() -> None:
    """In LIMP it is commanded to be what it was: nothing is sent until the error has ended."""
    text = changed(ARM, "LIMP: {p: inactive,", "LIMP: {p: active,")
    text = changed(text, "recover_if: [p, inactive, unconfigured]", "recover_if: [p, active.SAFE]")
    text = changed(
        text,
        "p: {ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}}}}",
        "p:\n  ros__parameters:\n    type: node\n    contingencies: [SAFE]\n    modes:\n"
        "      __DEFAULT__: {ros__parameters: {v: 1}}\n      SAFE: {ros__parameters: {v: 0}}",
    )
    device = Node(Link.MODES)
    arm = World(model_of(text), {"p": device, "q": Node(values={"w": 1})})
    arm.let(3)
    arm.request("arm", active())
    first = len(arm.sent)
    arm.manager.diagnosed.observe("p", "battery: low")
    device.mode = "SAFE"
    arm.manager.hear_mode("p", "SAFE")
    arm.let(10)
    assert targets(arm) == "active.LIMP"
    assert not [call for _, call in arm.sent[first:] if call.part == "p"]
    arm.manager.diagnosed.observe("p", "")
    arm.let(5)
    assert (device.mode, arm.status("arm")) == ("__DEFAULT__", "active.__DEFAULT__")
    assert [call.kind for _, call in arm.sent[first:] if call.part == "p"] == [Kind.CHANGE_MODE]


def test_rules_that_lead_back_to_the_failure_are_refuted(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    assert check(path).exit_status == 0
    path.write_text(changed(ARM, "[p, errorprocessing]", "[p, inactive]"), encoding="utf-8")
    report = check(path)
    (found,) = [d for d in report.diagnostics if d.id == "MG-8844"]
    assert report.exit_status == 2
    assert "the rules of 'arm' oscillate: 'degrade'" in found.message
    assert "  rule degrade: arm active.__DEFAULT__ again" in found.block


@pytest.mark.ros
@pytest.mark.system
def test_an_arm_of_rclpy_recovers(stack: ExitStack, domain: int, tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    values: dict[str, dict[str, Any]] = {"p": {"v": 1}, "q": {"w": 1}}
    asking, managing = start(stack, domain, str(path), **values)
    publisher = asking.peer.publisher(TOPIC, TYPE)
    assert asking.change_mode("arm", "__DEFAULT__")
    asking.until_row("arm", "active.__DEFAULT__")
    asking.until(lambda: publisher.subscriptions() == 2)
    status = {"name": "p: motor", "level": 2, "message": "hot"}
    publisher.publish({"status": [status]})
    managing.wait_for("arm: rule degrade: active.LIMP")
    asking.until(lambda: asking.rows["arm"].rule == "degrade")
    asking.until_row("q", "active.SLOW")
    assert asking.state("p") == "inactive"
    publisher.publish({"status": [{**status, "level": 0}]})
    managing.wait_for("arm: rule degrade is over: active.__DEFAULT__")
    asking.until(lambda: asking.rows["arm"].actual == "active.__DEFAULT__" and not asking.rows["arm"].rule)
    assert asking.state("p") == "active"
