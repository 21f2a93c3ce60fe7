# SPDX-License-Identifier: Apache-2.0
"""Parameters of the application file, whose names and constraints are constants, next to those that a program adds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.runtime.driver import Client
from tests.support.runtime.parameter_device import INTEGER, Device, parameter_codec
from tests.support.runtime.parameter_program import Program, program_of
from tests.support.runtime.serving_agent import ServingAgent

DECLARED = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameters:
      - {name: steps, type: integer, default: 3, description: Way, unit: mm, range: {min: -9, max: 9, step: 3}}
      - {name: gain, type: double, default: 0.5, read_only: true, range: {min: 0, max: 1}}
      - {name: side, type: string, default: left, one_of: [left, right], size: 8}
      - {name: names, type: "string[]", size: 3, default: [a, "1b"]}
      - {name: on, type: bool}
      - {name: table, type: "integer[]", size: 2, default: [-1, 5]}
pools: {parameters: 8, history: 8}
"""
NAMES = ["steps", "gain", "side", "names", "on", "table"]


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Program:
    return program_of(tmp_path_factory.mktemp("declared") / "a", DECLARED, "client_declared.c")


@pytest.fixture
def device(program: Program) -> Iterator[Device]:
    agent = ServingAgent(mtu=200)
    with Client(program.path, agent) as client:
        client.ok("init")
        found = Device(client, agent, parameter_codec())
        found.open()
        client.ok("Declare")
        found.spin(30)
        yield found


def described(device: Device, name: str) -> dict[str, Any]:
    (found,) = device.call("describe_parameters", names=[name])["descriptors"]
    assert isinstance(found, dict)
    return found


def reasons(device: Device, *pairs: tuple[str, int]) -> list[str]:
    number = device.set(*pairs)
    device.spin(12)
    return [result["reason"] for result in device.reply("set_parameters", number)["results"]]


def test_each_is_there_with_its_value(device: Device) -> None:
    """As an rclpy node does it, one event has a new parameter with its value."""
    events = device.events()
    assert [name for event in events for name in event["new"]] == NAMES
    assert not any("cha" in event for event in events)
    values = device.call("get_parameters", names=NAMES)["values"]
    assert values[0]["integer_value"] == 3
    assert values[1]["double_value"] == 0.5
    assert values[2]["string_value"] == "left"
    assert values[3]["string_array_value"] == ["a", "1b"]
    assert values[4]["bool_value"] is False
    assert values[5]["integer_array_value"] == [-1, 5]


def test_what_is_declared_is_shown_and_checked(device: Device) -> None:
    steps = described(device, "steps")
    assert (steps["description"], steps["additional_constraints"]) == ("Way [mm]", "")
    assert steps["integer_range"] == [{"from_value": -9, "to_value": 9, "step": 3}]
    side = described(device, "side")
    assert (side["description"], side["additional_constraints"]) == ("", "one of: left, right")
    gain = described(device, "gain")
    assert gain["floating_point_range"] == [{"from_value": 0.0, "to_value": 1.0, "step": 0.0}]
    assert gain["read_only"]
    assert reasons(device, ("steps", 6), ("steps", 5), ("gain", 1)) == [
        "",
        "Parameter {steps} doesn't comply with integer range.",
        "parameter 'gain' cannot be set because it is read-only",
    ]
    assert device.client.ok("Update").lines == ("changed 1 steps 6",)
    assert device.client.ok("Update").lines == ("changed 0 steps 6",)
    device.client.ok("text side right")
    assert device.client.ok("Update").lines == ("changed 1 steps 6",)


def test_a_program_can_say_something_else(device: Device) -> None:
    """The constants stay: declared again in a new server, they are as they were."""
    device.client.ok("Override steps")
    steps = described(device, "steps")
    assert (steps["name"], steps["description"], steps["additional_constraints"]) == (
        "steps",
        "other",
        "words",
    )
    assert steps["integer_range"] == [{"from_value": 0, "to_value": 5, "step": 0}]
    assert reasons(device, ("steps", 5), ("steps", 6)) == [
        "",
        "Parameter {steps} doesn't comply with integer range.",
    ]
    device.client.ok("text side <4")
    assert device.client.call("text side right").code != 0
    assert described(device, "side")["additional_constraints"] == "one of: left, right"
    device.client.ok("close")
    device.open()
    device.client.ok("Declare")
    device.spin(30)
    assert described(device, "steps")["description"] == "Way [mm]"
    device.client.ok("text side right")


def test_added_and_declared_ones_share_the_places(device: Device) -> None:
    for name in ("x", "y"):
        device.client.ok(f"add {name}")
    assert device.client.call("add z").code != 0
    device.client.ok("Override y")
    assert reasons(device, ("x", 77), ("y", 4), ("y", 6), ("steps", 6)) == [
        "",
        "",
        "Parameter {y} doesn't comply with integer range.",
        "",
    ]
    device.client.ok("delete steps")
    device.client.ok("delete x")
    device.spin(30)
    for name in ("z", "steps"):
        device.client.ok(f"add {name}")
    device.spin(30)
    listed = device.call("list_parameters", prefixes=[], depth=0)["result"]["names"]
    assert listed == [*NAMES[1:], "y", "z", "steps"]
    assert described(device, "steps")["description"] == "", "not the declared one"
    assert described(device, "y")["description"] == "other"
    assert reasons(device, ("steps", 5), ("z", 6)) == ["", ""]
    for name, value in (("y", 4), ("z", 6), ("steps", 5)):
        assert device.client.ok(f"get {name}").lines == (f"value {value}",)


def test_again_and_too_many(device: Device) -> None:
    """The first that fails ends the call."""
    assert device.client.call("Declare").code != 0
    assert device.client.call("add on").code != 0
    types = device.call("get_parameter_types", names=["on", "steps"])["types"]
    assert list(types) == [1, INTEGER]
