# SPDX-License-Identifier: Apache-2.0
"""Values of a parent that another manager manages: it sets them at the system, whose manager passes them on."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

import pytest

from microros_gen.mode_manager.calls import Kind, Link
from microros_gen.modes.model import active
from microros_gen.ros.peer import Peer
from tests.support.mode_manager.processes import Asking, manager, node
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import model_of

ROBOT = """\
robot:
  ros__parameters:
    type: system
    parts: [base]
    modes:
      __DEFAULT__: {base: active.GO, ros__parameters: {limit: 0.3, slow: 0.1}}
      FAST: {base: active.GO, ros__parameters: {limit: 0.9}}
base:
  ros__parameters:
    type: system
    parts: [wheel]
    modes:
      __DEFAULT__: {wheel: inactive, ros__parameters: {speed: $(parent limit)}}
      GO: {wheel: active}
      CREEP: {wheel: active, ros__parameters: {speed: $(parent slow)}}
wheel:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {speed: $(parent speed)}}
"""


def upper(base: Node) -> World:
    world = World(model_of(ROBOT), {"base": base}, without=("base",))
    world.let(3)
    return world


def lower() -> World:
    world = World(model_of(ROBOT), {"wheel": Node(values={"speed": 0.0})}, roots=("base",))
    world.let(3)
    return world


def test_the_upper_manager_sets_all_values_of_its_mode_before_the_mode() -> None:
    base = Node(Link.SYSTEM, serves_parameters=True)
    world = upper(base)
    world.request("robot", active("FAST"))
    assert world.commands() == ["base set_parameters_atomically", "base change_mode GO"]
    assert (base.values, world.status("robot")) == ({"limit": 0.9, "slow": 0.1}, "active.FAST")
    first = len(world.sent)
    world.request("robot", active())
    assert world.commands(first) == ["base set_parameters_atomically"]
    assert base.values == {"limit": 0.3, "slow": 0.1}


def test_values_that_differ_are_set_again() -> None:
    """The lower manager was killed and started again before this one noticed."""
    base = Node(Link.SYSTEM, serves_parameters=True)
    world = upper(base)
    world.request("robot", active("FAST"))
    base.values.update(limit=0.0, slow=0.0)
    world.let(8)
    assert base.values == {"limit": 0.9, "slow": 0.1}
    assert world.status("robot") == "active.FAST"


def test_values_that_are_refused_and_a_manager_that_takes_none() -> None:
    base = Node(Link.SYSTEM, serves_parameters=True)
    base.refuses, base.reason = (lambda call: call.kind is Kind.SET_PARAMETERS), "it takes none"
    world = upper(base)
    world.request("robot", active("FAST"), 10)
    assert world.manager.leaves["base"].failure == "it refuses set_parameters_atomically: it takes none"
    world = upper(Node(Link.SYSTEM))
    assert "base: it serves no parameters, and does not get speed of its parent" in world.log
    world.request("robot", active("FAST"))
    assert world.commands() == ["base change_mode GO"]


def test_the_lower_manager_passes_values_on() -> None:
    world = lower()
    wheel = world.nodes["wheel"]
    world.request("base", active("GO"))
    assert wheel.values["speed"] == 0.3, "__DEFAULT__ of the parent"
    assert world.manager.set_parent_values("base", {"limit": 0.9}) == ""
    world.let(3)
    assert (wheel.values["speed"], world.status("base")) == (0.9, "active.GO")
    assert world.manager.set_parent_values("base", {"slow": 0.2}) == ""
    world.request("base", active("CREEP"))
    assert wheel.values["speed"] == 0.2
    assert world.manager.parent_values("base") == {"limit": 0.9, "slow": 0.2}
    assert not any("others" in line for line in world.log)


def test_values_that_the_lower_manager_refuses() -> None:
    world = lower()
    both = {"limit": 0.9, "speed": 0.5}
    assert world.manager.set_parent_values("base", both) == (
        "speed: no mode of base has a value $(parent speed)"
    )
    assert world.manager.set_parent_values("base", {"limit": 1}) == "limit: it takes a value of type double"
    assert world.manager.parent_values("base") == {}


def test_a_restarted_lower_manager_takes_over_the_mode_when_it_has_the_values() -> None:
    world = lower()
    world.manager.set_parent_values("base", {"limit": 0.9})
    world.request("base", active("GO"))
    world.start()
    world.let(5)
    assert "base" not in world.manager.targets, "0.9 is no value of a mode yet"
    world.manager.set_parent_values("base", {"limit": 0.9})
    world.let(2)
    assert str(world.manager.targets["base"]) == "active.GO"


@pytest.mark.ros
@pytest.mark.system
def test_two_managers_and_a_restart_of_the_lower_one(stack: ExitStack, domain: int, tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT, encoding="utf-8")
    stack.enter_context(node(domain, "wheel", speed=0.0))
    first = stack.enter_context(manager(domain, str(path), "--scope", "base"))
    first.wait_for("mode manager ready: base")
    above = stack.enter_context(manager(domain, str(path), "--without", "base"))
    above.wait_for("mode manager ready: robot")
    asking = Asking(stack.enter_context(Peer("asking")))
    asking.until(lambda: "wheel" in asking.rows and asking.rows["wheel"].actual != "unknown")

    def speed() -> float:
        kind = "rcl_interfaces/srv/GetParameters"
        return float(asking.call("/wheel/get_parameters", kind, names=["speed"])["values"][0]["double_value"])

    for mode, value in (("FAST", 0.9), ("__DEFAULT__", 0.3), ("FAST", 0.9)):
        assert asking.change_mode("robot", mode)
        asking.until(lambda value=value: speed() == value)  # type: ignore[misc]
        asking.until_row("robot", f"active.{mode}", 60)
    first.process.kill()
    first.process.wait()
    second = stack.enter_context(manager(domain, str(path), "--scope", "base"))
    second.wait_for("mode manager ready: base", 60)
    asking.rows.clear()
    asking.until(lambda: asking.rows.get("wheel") is not None and asking.rows["wheel"].target != "", 60)
    asking.until(lambda: asking.rows["base"].actual == "active.GO", 60)
    assert speed() == 0.9
    assert not above.says("serves no parameters")
