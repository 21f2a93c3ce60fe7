# SPDX-License-Identifier: Apache-2.0
"""Modes that devices change to by themselves, for an error: the manager does not work against them."""

from __future__ import annotations

from contextlib import ExitStack
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.diagnosis import FAILED, TOPIC, TYPE, rows_of
from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import Event, Manager, Status
from microros_gen.modes.model import active
from tests.support.mode_manager.arm import start
from tests.support.mode_manager.device import Device, alive
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of
from tests.support.slices import first

CELL = """\
cell:
  ros__parameters:
    type: system
    parts: [device, lamp]
    modes:
      __DEFAULT__: {device: inactive, lamp: inactive}
      RUN: {device: active.FAST}
      CAREFUL: {device: active.SAFE, lamp: active}
      WARNED: {device: active.FAST, lamp: active}
device:
  ros__parameters:
    type: node
    contingencies: [SAFE]
    modes:
      __DEFAULT__: {ros__parameters: {speed: 0.5}}
      FAST: {ros__parameters: {speed: 2.0}}
      SAFE: {ros__parameters: {speed: 0.1}}
lamp: {ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {on: true}}}}}
"""
SPEEDS = {"__DEFAULT__": {"speed": 0.5}, "FAST": {"speed": 2.0}, "SAFE": {"speed": 0.1}}
RUN = active("RUN")


def rule(status: str, goal: str) -> str:
    """Return the model with a rule of RUN."""
    text = f"if_target: active.RUN, if_part: [device, {status}], new_target: active.{goal}"
    return changed(CELL, "device:\n  ros", f"    rules: {{degrade: {{{text}}}}}\ndevice:\n  ros")


def cell(text: str = CELL) -> World:
    device = Node(Link.MODES, serves_parameters=True, mode_values=SPEEDS, values={"speed": 0.5})
    world = World(model_of(text), {"device": device, "lamp": Node(values={"on": True})})
    world.let(3)
    world.request("cell", RUN)
    assert world.status("cell") == "active.RUN"
    return world


def react(world: World, order: str = "states first") -> None:
    """Let the device reconfigure itself; its events are published in one of several orders."""
    device = world.nodes["device"]
    device.mode, device.state = "SAFE", "active"
    device.values.update(SPEEDS["SAFE"])
    reported: list[tuple[Kind, Any]] = [(Kind.GET_MODE, "SAFE")]
    passed = ("deactivating", "inactive", "activating", "active")
    states: list[tuple[Kind, Any]] = [(Kind.GET_STATE, state) for state in passed]
    values: list[tuple[Kind, Any]] = [(Kind.GET_PARAMETERS, SPEEDS["SAFE"])]
    for kind, what in {
        "states first": [*states, *values, *reported],
        "mode first": [*reported, *states, *values],
        "values first": [*values, *states, *reported],
        "no states": [*values, *reported],
        "one state": states[:2],
        "nothing": [],
    }[order]:
        world.publish("device", kind, what)


@pytest.mark.parametrize(
    "order", ["states first", "mode first", "values first", "no states", "one state", "nothing"]
)
def test_a_declared_mode_is_left_alone(order: str) -> None:
    """Without a rule nothing is commanded, and the deviation is shown; lost events change nothing."""
    world = cell()
    first = len(world.sent)
    react(world, order)
    world.let(60)
    assert world.commands(first) == []
    assert (world.status("device"), world.status("cell")) == ("active.SAFE", "activating")
    row = next(row for row in rows_of(world.manager) if row.part == "device")
    assert (row.level, row.message) == (FAILED, "it went to active.SAFE by itself")
    assert world.log.count("device: it went to active.SAFE by itself") == 1


@pytest.mark.parametrize("between", [Kind.GET_STATE, Kind.GET_MODE, Kind.GET_PARAMETERS])
def test_a_reaction_right_after_a_command(between: Kind) -> None:
    """Its events may be those of the command: the device is asked, and reacts between two of the questions."""
    world = cell()
    world.request("cell", Status("inactive"))
    device = world.nodes["device"]
    carry_out, reacted = device.carry_out, list[Call]()

    def reacting(call: Call) -> dict[str, Any]:
        response = carry_out(call)
        if call.kind is between and device.state == "active" and not reacted:
            reacted.append(call)
            react(world)
        return response

    vars(device)["carry_out"] = reacting
    world.request("cell", RUN, 0.1)
    first = len(world.sent)
    world.let(30)
    assert reacted
    assert world.commands(first) == []
    assert world.status("device") == "active.SAFE"
    assert world.manager.leaves["device"].failure == "it went to active.SAFE by itself"


def test_states_that_arrive_one_after_another() -> None:
    """A slow device: the manager waits for it between two states."""
    world = cell()
    first, device = len(world.sent), world.nodes["device"]
    for state in ("deactivating", "inactive"):
        world.change("device", state)
        world.let(0.1)
    world.let(0.6)
    react(world, "mode first")
    world.let(20)
    assert world.commands(first) == []
    assert device.mode == "SAFE"


def test_a_rule_decides_on_the_mode_and_on_the_error() -> None:
    world = cell(rule("active.SAFE", "CAREFUL"))
    react(world)
    world.let(3)
    assert (world.manager.rules, world.status("cell")) == ({"cell": "degrade"}, "active.CAREFUL")
    assert not [c for c in world.commands() if c == "device change_mode SAFE"]
    world = cell(rule("errorprocessing", "CAREFUL"))
    world.manager.diagnosed.observe("device", "battery: low")
    react(world)
    world.let(3)
    assert str(world.manager.targets["cell"]) == "active.CAREFUL"
    assert world.status("lamp") == "active.__DEFAULT__"
    assert world.nodes["device"].mode == "SAFE"
    world.manager.diagnosed.observe("device", "")
    world.let(1)
    assert world.status("cell") == "active.CAREFUL"


@pytest.mark.parametrize("error_first", [True, False])
def test_a_rule_for_other_parts_does_not_command_the_device_again(error_first: bool) -> None:
    """WARNED commands the device to be what RUN does."""
    world = cell(rule("errorprocessing", "WARNED"))
    first = len(world.sent)
    for step in ("error", "reaction") if error_first else ("reaction", "error"):
        if step == "error":
            world.manager.diagnosed.observe("device", "battery: low")
        else:
            react(world)
        world.let(0.3)
    world.let(10)
    assert all(command.startswith("lamp") for command in world.commands(first))
    assert world.status("lamp") == "active.__DEFAULT__"
    row = next(row for row in rows_of(world.manager) if row.part == "device")
    assert row.message == "it went to active.SAFE by itself: battery: low"


def test_a_request_commands_the_device_again() -> None:
    world = cell()
    react(world)
    world.let(10)
    world.request("cell", RUN)
    assert (world.nodes["device"].mode, world.status("cell")) == ("FAST", "active.RUN")
    react(world)
    world.let(10)
    assert world.status("device") == "active.SAFE"


def test_a_device_that_returns_by_itself() -> None:
    world = cell()
    react(world)
    world.let(10)
    world.nodes["device"].mode = "FAST"
    world.nodes["device"].values.update(SPEEDS["FAST"])
    world.manager.hear_mode("device", "FAST")
    world.let(2)
    assert world.status("cell") == "active.RUN"
    assert world.manager.leaves["device"].failure == ""


def test_a_reaction_while_the_session_is_lost() -> None:
    world = cell()
    first = len(world.sent)
    world.leave("device")
    world.let(5)
    world.nodes["device"].is_dead = False
    react(world, "nothing")
    world.join("device", world.nodes["device"])
    world.let(20)
    assert world.commands(first) == []
    assert world.status("device") == "active.SAFE"
    world.leave("device")
    world.let(5)
    world.nodes["device"].is_dead = False
    world.nodes["device"].state = "unconfigured"
    world.join("device", world.nodes["device"])
    world.let(5)
    assert world.status("cell") == "active.RUN", "it was reset, and got its target"


def test_a_silent_device_and_a_manager_that_is_restarted() -> None:
    world = cell()
    first = len(world.sent)
    react(world)
    world.let(2)
    world.nodes["device"].is_dead = True
    world.let(40)
    assert world.manager.leaves["device"].failure == "it does not answer"
    world.nodes["device"].is_dead = False
    world.let(20)
    assert world.manager.leaves["device"].failure == "it went to active.SAFE by itself"
    world.start()
    world.let(20)
    assert world.commands(first) == []


def test_an_undeclared_mode_counts_only_with_an_error() -> None:
    text = changed(CELL, "    contingencies: [SAFE]\n", "")
    world = cell(text)
    react(world)
    world.let(5)
    assert world.nodes["device"].mode == "FAST", "others changed it"
    assert "device: it went to active.SAFE by itself" not in world.log
    first = len(world.sent)
    world.manager.diagnosed.observe("device", "battery: low")
    react(world)
    world.let(20)
    assert world.commands(first) == []
    assert world.nodes["device"].mode == "SAFE"


def test_the_proof_and_the_simulation_leave_it_alone() -> None:
    model = model_of(CELL)
    manager = Manager(model)
    list(manager.request("cell", RUN))
    list(manager.change("device", active("SAFE")))
    assert manager.nodes["device"] == active("SAFE")
    list(manager.change("device", active()))
    assert manager.nodes["device"] == active("SAFE") or manager.nodes["device"] == active()
    list(manager.request("cell", RUN))
    assert manager.nodes["device"] == active("FAST")
    events = [Event(0, "request", "cell", RUN), Event(2_000_000, "change", "device", active("SAFE"))]
    played = simulate(model, events, with_services=["device"])
    assert {end.part: end.status for end in played.ends}["device"] == active("SAFE")
    assert played.is_stable
    assert "device: it went to active.SAFE by itself" in played.text()
    late = Event(9_000_000, "request", "cell", RUN)
    played = simulate(model, [*events, late], with_services=["device"])
    assert {end.part: end.status for end in played.ends}["cell"] == RUN
    assert Status("active", "SAFE") == active("SAFE")


@pytest.mark.parametrize("changed_to", first(["active.SAFE", "active.FAST", "inactive", "unconfigured"]))
def test_the_proof_and_the_simulation_end_alike(changed_to: str) -> None:
    """After every sequence of three changes by others: a reaction is over in the target, and after a reset."""
    model, found = model_of(CELL), dict[str, str]()
    statuses = [active("SAFE"), active("FAST"), Status("inactive"), Status("unconfigured")]
    for changes in product([s for s in statuses if str(s) == changed_to], statuses, statuses):
        manager = Manager(model)
        list(manager.request("cell", RUN))
        for status in changes:
            list(manager.change("device", status))
        events = [Event((i + 1) * 60_000_000, "change", "device", s) for i, s in enumerate(changes)]
        played = simulate(model, [Event(0, "request", "cell", RUN), *events], with_services=["device"])
        assert {end.part: end.status for end in played.ends}["device"] == manager.nodes["device"], changes
        found[" ".join(map(str, changes[1:]))] = str(manager.nodes["device"])
    assert found["active.FAST inactive"] == "active.FAST"
    assert found["active.SAFE inactive"] == "inactive"
    assert found["active.SAFE unconfigured"] == "active.FAST"


@pytest.mark.ros
def test_a_device_that_reacts_on_ros(stack: ExitStack, domain: int, tmp_path: Path) -> None:
    """Its error and its mode are seen on /diagnostics; it is not commanded until somebody requests something."""
    path = tmp_path / "cell.yaml"
    path.write_text(CELL, encoding="utf-8")
    device = Device("device", tuple(SPEEDS), {"speed": 0.5}, SPEEDS)
    stack.enter_context(alive(device))
    asking, managing = start(stack, domain, str(path), lamp={"on": True})
    asking.until(lambda: "device" in asking.rows and asking.rows["device"].actual == "unconfigured")
    publisher = asking.peer.publisher(TOPIC, TYPE)
    assert asking.change_mode("cell", "RUN")
    asking.until_row("cell", "active.RUN")
    device.requests.clear()
    asking.until(lambda: publisher.subscriptions() == 2)
    status = {"name": "device: battery", "level": 2, "message": "low"}
    publisher.publish({"status": [status]})
    device.reacts.append("SAFE")
    managing.wait_for("device: it went to active.SAFE by itself")
    asking.until_row("cell", "errorprocessing")
    message = "it went to active.SAFE by itself: device: battery: low"
    asking.until(lambda: asking.rows["device"].message == message)
    publisher.publish({"status": [{**status, "level": 0}]})
    asking.until_row("device", "active.SAFE")
    asking.peer.spin(lambda: False, 6.0)
    assert (device.requests, device.mode) == ([], "SAFE")
    assert asking.change_mode("cell", "RUN")
    asking.until_row("cell", "active.RUN")
    assert device.requests == ["FAST"]
