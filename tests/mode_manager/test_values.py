# SPDX-License-Identifier: Apache-2.0
"""Values of nodes that have mode services and serve parameters: those of a parent, and those that others change."""

from __future__ import annotations

from contextlib import ExitStack

import pytest

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.messages import facts_of, parameters_of, request_of
from microros_gen.modes import Status
from microros_gen.modes.model import active
from tests.support.mode_manager.arm import start
from tests.support.mode_manager.device import Device, alive
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import model_of

CELL = """\
cell:
  ros__parameters:
    type: system
    parts: [device]
    modes:
      __DEFAULT__: {device: active.SLOW, ros__parameters: {limit: 0.3}}
      HIGH: {device: active.SLOW, ros__parameters: {limit: 0.9}}
      FAST: {device: active.FAST, ros__parameters: {limit: 0.9}}
device:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {speed: 0.5, limit: $(parent limit)}}
      SLOW: {ros__parameters: {speed: 0.2}}
      FAST: {ros__parameters: {speed: 2.0}}
"""
SPEEDS = {"__DEFAULT__": {"speed": 0.5}, "SLOW": {"speed": 0.2}, "FAST": {"speed": 2.0}}


def firmware() -> Node:
    values: dict[str, float] = {"speed": 0.5, "limit": 1.0}
    return Node(Link.MODES, values=dict(values), serves_parameters=True, mode_values=SPEEDS)


def cell(device: Node) -> World:
    world = World(model_of(CELL), {"device": device})
    world.let(3)
    return world


def test_values_of_the_parent_are_set_before_the_mode() -> None:
    device = firmware()
    world = cell(device)
    world.request("cell", active())
    assert world.commands() == [
        "device change_state configure",
        "device set_parameters_atomically",
        "device change_mode SLOW",
        "device change_state activate",
    ]
    assert world.sent[1][1].values == {"limit": 0.3}
    assert (device.values, world.status("cell")) == ({"speed": 0.2, "limit": 0.3}, "active.__DEFAULT__")
    first = len(world.sent)
    world.request("cell", active("HIGH"))
    assert world.commands(first) == ["device set_parameters_atomically"]
    assert (device.values["limit"], world.status("cell")) == (0.9, "active.HIGH")
    first = len(world.sent)
    world.request("cell", active("FAST"))
    assert world.commands(first) == ["device change_mode FAST"]
    assert world.status("cell") == "active.FAST"
    assert not any("others" in line for line in world.log)


def test_parameters_that_others_change_are_set_again() -> None:
    for name in ("speed", "limit"):
        device = firmware()
        world = cell(device)
        world.request("cell", active("FAST"))
        first = len(world.sent)
        device.values[name] = 1.5
        world.manager.hear_parameters("device", {name: 1.5})
        world.let(2)
        assert world.log[-1] == "device: others changed it from active.FAST to active"
        assert world.commands(first) == ["device set_parameters_atomically"]
        assert (device.values, world.status("cell")) == ({"speed": 2.0, "limit": 0.9}, "active.FAST")


def test_a_change_whose_event_is_lost_is_found() -> None:
    device = firmware()
    world = cell(device)
    world.request("cell", active("FAST"))
    device.values["speed"] = 1.5
    world.let(8)
    assert (device.values["speed"], world.status("cell")) == (2.0, "active.FAST")


def test_others_that_change_it_again_and_again_win() -> None:
    device = firmware()
    world = cell(device)
    world.request("cell", active("FAST"))
    for i in range(6):
        device.values["speed"] = 1.5 + i / 100
        world.manager.hear_parameters("device", {"speed": device.values["speed"]})
        world.let(1.5)
    assert world.log.count("device: others change it again and again") >= 1
    assert world.status("cell") == "activating"
    assert world.manager.leaves["device"].failure == "others change it again and again"


def test_a_device_that_was_changed_while_it_was_away() -> None:
    """Its values are asked when it is back, also those of the parent."""
    device = firmware()
    world = cell(device)
    world.request("cell", active("FAST"))
    world.leave("device")
    world.let(2)
    device.is_dead = False
    device.values.update(speed=1.5, limit=0.0)
    world.join("device", device)
    world.let(3)
    assert (device.values, world.status("cell")) == ({"speed": 2.0, "limit": 0.9}, "active.FAST")


def test_a_manager_that_is_restarted_takes_over_the_mode_with_its_values() -> None:
    """SLOW with 0.9 is HIGH, with 0.3 __DEFAULT__, and with something else neither."""
    for limit, target in ((0.3, "active.__DEFAULT__"), (0.9, "active.HIGH"), (0.5, "None")):
        device = firmware()
        world = cell(device)
        world.request("cell", active())
        device.values["limit"] = limit
        world.start()
        world.let(3)
        assert str(world.manager.targets.get("cell")) == target


def test_a_device_that_refuses_the_value_of_its_parent() -> None:
    device = firmware()
    device.refuses, device.reason = (lambda call: call.kind is Kind.SET_PARAMETERS), "out of range"
    world = cell(device)
    world.request("cell", active(), 10)
    assert world.manager.leaves["device"].failure == "it refuses set_parameters_atomically: out of range"
    assert world.status("device") == "inactive"
    assert "device change_mode SLOW" not in world.commands()


def test_a_device_whose_values_differ_from_the_model() -> None:
    """The mode has another value on the device than in the model file: this one is set."""
    device = firmware()
    device.mode_values = {**SPEEDS, "FAST": {"speed": 1.0}}
    world = cell(device)
    world.request("cell", active("FAST"), 6)
    assert (device.values["speed"], world.status("cell")) == (2.0, "active.FAST")


def test_a_list_of_bytes_keeps_its_type() -> None:
    query = Call(1, "device", Kind.GET_PARAMETERS)
    response = {"values": [{"type": 5, "byte_array_value": b"\x01\xff"}]}
    facts = facts_of(query, response, ("key",))
    assert (facts["values"], facts["byte_arrays"]) == ({"key": (1, 255)}, ["key"])
    command = Call(2, "device", Kind.SET_PARAMETERS, values={"key": (7, 0)})
    (sent,) = request_of(command, (), facts["byte_arrays"])["parameters"]
    assert sent["value"]["type"] == 5
    assert parameters_of({"key": (7, 0)})[0]["value"]["type"] == 7


@pytest.mark.ros
def test_a_device_with_parameters_on_ros(stack: ExitStack, domain: int, tmp_path: object) -> None:
    """Values of the parent are set before the mode; one that another node sets is noticed and set again."""
    path = tmp_path / "cell.yaml"  # type: ignore[operator]
    path.write_text(CELL, encoding="utf-8")
    device = Device("device", tuple(SPEEDS), {"speed": 0.5, "limit": 1.0}, SPEEDS)
    stack.enter_context(alive(device))
    asking, managing = start(stack, domain, str(path))
    asking.until(lambda: "device" in asking.rows and asking.rows["device"].actual == "unconfigured")
    assert asking.change_mode("cell", "FAST")
    asking.until_row("cell", "active.FAST")
    assert device.requests == ["configure", {"limit": 0.9}, "FAST", "activate"]
    asking.set("device", speed=1.5)
    managing.wait_for("device: others changed it from active.FAST to active")
    asking.until(lambda: device.values["speed"] == 2.0)
    asking.until_row("cell", "active.FAST")
    assert asking.change_state("cell", 4)
    asking.until_row("cell", "inactive")
    assert Status(device.state) == Status("inactive")
