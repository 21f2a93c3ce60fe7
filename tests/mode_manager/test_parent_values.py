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
from tests.support.mode_manager.two_managers import LowerManager, TwoManagers
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


WITH_RULE = ROBOT.replace(
    "base:\n  ros",
    "    rules:\n      slow: {if_target: active.FAST, if_part: [base, unknown], new_target: active}\nbase:\n  ros",
)


def two_managers(text: str = ROBOT) -> TwoManagers:
    """Return both, with the robot in the mode FAST."""
    below = World(model_of(text), {"wheel": Node(values={"speed": 0.0})}, roots=("base",))
    base = LowerManager(Link.SYSTEM, serves_parameters=True, world=below, system="base")
    both = TwoManagers(World(model_of(text), {"base": base}, without=("base",)), below, base)
    both.let(2)
    both.upper.manager.request("robot", active("FAST"))
    both.let(3)
    assert (both.upper.status("robot"), both.lower.status("base")) == ("active.FAST", "active.GO")
    return both


def test_a_system_that_gets_other_values_in_its_mode_does_not_leave_it() -> None:
    """Its manager reports that it is on its way meanwhile, for some seconds."""
    both = two_managers(WITH_RULE.replace("[base, unknown]", "[base, activating]"))
    both.lower.nodes["wheel"].delay_s = 0.4
    for mode, speed in (("__DEFAULT__", 0.3), ("FAST", 0.9)):
        both.upper.manager.request("robot", active(mode))
        both.let(6)
        assert both.lower.nodes["wheel"].values["speed"] == speed
        assert (both.upper.status("robot"), both.upper.manager.rules) == (f"active.{mode}", {})
    assert not any("by itself" in line or "others" in line for line in both.upper.log)


def test_events_that_arrive_before_the_response() -> None:
    base = Node(Link.SYSTEM, serves_parameters=True)
    world = upper(base)
    world.request("robot", active("FAST"))
    base.delay_s = 1.0
    world.request("robot", active(), 0.5)
    call = world.manager.leaves["base"].call
    assert call is not None
    assert call.kind is Kind.SET_PARAMETERS
    world.manager.hear_state("base", "activating")
    assert (world.manager.leaves["base"].failure, world.log) == ("", [])
    world.let(15)
    assert world.status("robot") == "active.__DEFAULT__"


@pytest.mark.parametrize("delay_s", [0.4, 0.6, 1.2, 3.0])
def test_a_system_whose_manager_responds_slowly_is_asked_everything(delay_s: float) -> None:
    """A response takes longer than the pause between two rounds of queries."""
    world = upper(Node(Link.SYSTEM, serves_parameters=True, delay_s=delay_s))
    world.request("robot", active("FAST"), 12 * delay_s)
    assert world.status("robot") == "active.FAST"


@pytest.mark.parametrize("late_s", [0.0, 1.0])
def test_a_lower_manager_that_was_away_for_long_gets_the_values_before_the_mode(late_s: float) -> None:
    """The upper manager has noticed that it does not answer."""
    both = two_managers()
    wheel = both.lower.nodes["wheel"]
    both.kill()
    both.let(30)
    assert both.upper.status("base") == "unknown"
    both.restart("wheel")
    both.let(late_s)
    both.discover("wheel")
    for _ in range(150):
        both.let(0.1)
        assert wheel.values["speed"] == 0.9
    assert (both.upper.status("robot"), both.lower.status("base")) == ("active.FAST", "active.GO")


@pytest.mark.parametrize("text", [ROBOT, WITH_RULE], ids=["plain", "rule"])
@pytest.mark.parametrize("late_s", [0.0, 0.2, 1.0, 7.0])
@pytest.mark.parametrize("dead_s", [0.0, 0.3, 2.0, 8.0])
def test_a_restarted_lower_manager_soon_has_mode_and_values(text: str, late_s: float, dead_s: float) -> None:
    """Also when it discovers its node late, and is unknown until then: its parts never have other values."""
    both = two_managers(text)
    wheel = both.lower.nodes["wheel"]
    both.kill()
    both.let(dead_s)
    both.restart("wheel")
    both.let(late_s)
    both.discover("wheel")
    for _ in range(120):
        both.let(0.1)
        assert wheel.values["speed"] == 0.9
    assert (both.upper.status("robot"), both.lower.status("base")) == ("active.FAST", "active.GO")
    assert both.lower.manager.parent_values("base") == {"limit": 0.9, "slow": 0.1}
    assert both.upper.manager.rules == {}, "a restart is no error"


@pytest.mark.parametrize("after_s", [0.1, 0.2, 0.4, 0.7])
def test_a_lower_manager_that_is_restarted_on_its_way_is_commanded_again(after_s: float) -> None:
    """It accepted a mode, and was killed before it was in it: nobody waits until the mode is late."""
    both = two_managers()
    both.lower.nodes["wheel"].delay_s = 0.5
    both.upper.manager.request("robot", active())
    both.let(after_s)
    both.kill()
    both.restart()
    both.let(15)
    assert (both.upper.status("robot"), both.lower.status("base")) == (
        "active.__DEFAULT__",
        "active.GO",
    )
    assert both.lower.nodes["wheel"].values["speed"] == 0.3


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
        asking.until_row("robot", f"active.{mode}", 15)
    first.process.kill()
    first.process.wait()
    second = stack.enter_context(manager(domain, str(path), "--scope", "base"))
    second.wait_for("mode manager ready: base", 15)
    asking.rows.clear()
    asking.until(lambda: asking.rows.get("wheel") is not None and asking.rows["wheel"].target != "", 15)
    asking.until(lambda: asking.rows["base"].actual == "active.GO", 15)
    assert speed() == 0.9
    assert not above.says("serves no parameters")
    assert not above.says("by itself"), above.lines
