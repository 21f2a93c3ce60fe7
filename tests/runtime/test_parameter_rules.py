# SPDX-License-Identifier: Apache-2.0
"""Rules of generate_parameter_library on the device: what it refuses, with the reasons that RSL has for them.

The texts are those that https://github.com/PickNikRobotics/RSL gives in C++: numbers as printf shows them for %g.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.runtime.driver import Client
from tests.support.runtime.parameter_device import Device, parameter_codec
from tests.support.runtime.parameter_program import Program, program_of
from tests.support.runtime.serving_agent import ServingAgent

FILE = """\
arm:
  label: {type: string_fixed_8, default_value: left, validation: {not_empty<>: []}}
  code: {type: string, default_value: abc, validation: {fixed_size<>: [3]}}
  mode: {type: string, default_value: slow, validation: {one_of<>: [["slow", "fast"]]}}
  speed: {type: double, default_value: 16.0, validation: {gt<>: [15.0], lt<>: [2000000.0]}}
  level: {type: double, default_value: 1.5, validation: {one_of<>: [[1.5, 2]]}}
  limits:
    type: double_array
    default_value: [0.0, 0.5, 1]
    validation: {fixed_size<>: 3, lower_element_bounds<>: -10.0, upper_element_bounds<>: 10}
  ports:
    type: int_array_fixed_4
    default_value: [1, 2]
    validation: {size_gt<>: [1], size_lt<>: [4], unique<>: null, element_bounds<>: [-5, 1000]}
  flags: {type: bool_array_fixed_3, default_value: [true], validation: {subset_of<>: [[true]]}}
  joints:
    type: string_array_fixed_3
    default_value: ["a", "b"]
    validation: {unique<>: [], subset_of<>: [["a", "b", "50% c"]]}
  free: {type: double_array_fixed_3, default_value: [], validation: {subset_of<>: [[0.5]]}}
  steps: {type: int, default_value: 3, validation: {gt<>: [0], lt<>: [9]}}
  __map_axes:
    gain: {type: double, default_value: 0.5, validation: {gt_eq<>: [0.0]}}
  axes: {type: string_array, default_value: ["x", "y"]}
"""
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameters: {file: %s}
pools: {history: 8}
"""
KINDS = {
    "double": (3, "double_value"),
    "string": (4, "string_value"),
    "bools": (6, "bool_array_value"),
    "integers": (7, "integer_array_value"),
    "doubles": (8, "double_array_value"),
    "strings": (9, "string_array_value"),
}
CASES: list[tuple[str, str, Any, str]] = [
    ("label", "string", "", "Parameter 'label' cannot be empty"),
    ("label", "string", "12345678", ""),
    ("label", "string", "123456789", "the string for parameter 'label' is too long"),
    ("code", "string", "ab", "Length of parameter 'code' is '2' but must be equal to '3'"),
    ("code", "string", "abcdefghijkl", "Length of parameter 'code' is '12' but must be equal to '3'"),
    ("code", "string", "xyz", ""),
    ("mode", "string", "off", "Parameter 'mode' with the value 'off' is not in the set '{slow, fast}'"),
    ("mode", "string", "fast", ""),
    ("speed", "double", 14.0, "Parameter {speed} doesn't comply with floating point range."),
    ("speed", "double", 15.0, "Parameter 'speed' with the value '15' must be greater than '15'"),
    ("speed", "double", 2e6, "Parameter 'speed' with the value '2e+06' must be less than '2e+06'"),
    ("speed", "double", 15.00001, ""),
    ("level", "double", 2.5, "Parameter 'level' with the value '2.5' is not in the set '{1.5, 2}'"),
    ("level", "double", 2.0, ""),
    ("limits", "doubles", [1.0], "Length of parameter 'limits' is '1' but must be equal to '3'"),
    ("limits", "doubles", [1.0] * 5, "Length of parameter 'limits' is '5' but must be equal to '3'"),
    (
        *("limits", "doubles", [0.0, -10.5, 0.0]),
        "Value '-10.5' in parameter 'limits' must be above lower bound of '-10'",
    ),
    (
        *("limits", "doubles", [0.0, 0.0, 10.25]),
        "Value '10.25' in parameter 'limits' must be below upper bound of '10'",
    ),
    ("limits", "doubles", [-10.0, 10.0, 0.1], ""),
    ("ports", "integers", [1], "Length of parameter 'ports' is '1' but must be greater than '1'"),
    ("ports", "integers", [1, 2, 3, 4], "Length of parameter 'ports' is '4' but must be less than '4'"),
    ("ports", "integers", [1, 2, 1], "Parameter 'ports' must only contain unique values"),
    ("ports", "integers", [1, -6], "Value '-6' in parameter 'ports' must be within bounds '[-5, 1000]'"),
    (
        *("ports", "integers", [-(2**63), 2**63 - 1]),
        f"Value '{-(2**63)}' in parameter 'ports' must be within bounds '[-5, 1000]'",
    ),
    ("ports", "integers", [-5, 1000, 7], ""),
    ("flags", "bools", [True, False], "Entry 'false' in parameter 'flags' is not in the set '{true}'"),
    ("flags", "bools", [True, True, True], ""),
    ("joints", "strings", ["a", "d"], "Entry 'd' in parameter 'joints' is not in the set '{a, b, 50% c}'"),
    ("joints", "strings", ["a", "b", "a"], "Parameter 'joints' must only contain unique values"),
    ("joints", "strings", ["50% c", "a"], ""),
    ("joints", "strings", [], ""),
    ("free", "doubles", [0.5, 0.25], "Entry '0.25' in parameter 'free' is not in the set '{0.5}'"),
    ("axes", "strings", ["x", "z"], "parameter 'axes' cannot be set because it is read-only"),
    ("x.gain", "double", -1.0, "Parameter {x.gain} doesn't comply with floating point range."),
    ("y.gain", "double", 0.25, ""),
]


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Program:
    folder = tmp_path_factory.mktemp("rules")
    (folder / "arm.yaml").write_text(FILE)
    return program_of(folder / "a", APPLICATION % (folder / "arm.yaml"), "client_declared.c")


@pytest.fixture(scope="module")
def device(program: Program) -> Iterator[Device]:
    agent = ServingAgent(mtu=200)
    with Client(program.path, agent) as client:
        client.ok("init")
        found = Device(client, agent, parameter_codec())
        found.open()
        client.ok("Declare")
        found.spin(30)
        yield found


def value(kind: str, content: Any) -> dict[str, Any]:
    number, member = KINDS[kind]
    return {"type": number, member: content}


def refusal(device: Device, service: str, name: str, kind: str, content: Any) -> str:
    """Return the reason of a set request; empty: the parameter has the value."""
    result = device.call(service, parameters=[{"name": name, "value": value(kind, content)}])
    result = result["results"][0] if service == "set_parameters" else result["result"]
    assert result["successful"] == (result["reason"] == "")
    assert isinstance(result["reason"], str)
    return result["reason"]


@pytest.mark.parametrize(("name", "kind", "content", "reason"), CASES)
def test_each_rule_is_checked_with_its_reason(
    device: Device, name: str, kind: str, content: Any, reason: str
) -> None:
    member = KINDS[kind][1]
    (before,) = device.call("get_parameters", names=[name])["values"]
    assert refusal(device, "set_parameters", name, kind, content) == reason
    (after,) = device.call("get_parameters", names=[name])["values"]
    assert after[member] == (before[member] if reason else content)
    assert refusal(device, "set_parameters_atomically", name, kind, content) == reason


def test_a_long_text_in_a_reason_is_cut_between_characters(device: Device) -> None:
    """At the largest text of such a value; a request may have a longer one."""
    reason = refusal(device, "set_parameters", "joints", "strings", ["a", "\u00e9" * 30])
    assert reason == f"Entry '{'é' * 24}' in parameter 'joints' is not in the set '{{a, b, 50% c}}'"


def test_numbers_are_shown_as_by_printf(device: Device) -> None:
    """The oracle is Python's %g."""
    chooser = random.Random(5)
    numbers = [1e-4, 1e-5, 999999.0, 999999.5, 999998.5, 0.0009765625, 123456.7, 1e6, 0.1, 100.0, -2.5, 1e22]
    numbers += [1e300, 1.7976931348623157e308, 2.2250738585072014e-308, 5e-324]
    numbers += [chooser.uniform(-1, 1) * 10.0 ** chooser.randint(-12, 12) for _ in range(100)]
    numbers += [float("inf"), float("-inf"), float("nan"), 0.0]
    for number in numbers:
        reason = refusal(device, "set_parameters", "free", "doubles", [number])
        assert reason == f"Entry '{number:g}' in parameter 'free' is not in the set '{{0.5}}'"


def test_names_of_a_map_are_those_of_its_list(device: Device) -> None:
    listed = device.call("list_parameters", prefixes=[], depth=0)["result"]["names"]
    assert listed[-3:] == ["x.gain", "y.gain", "axes"]
    (axes,) = device.call("describe_parameters", names=["axes"])["descriptors"]
    assert axes["read_only"]


def test_the_program_may_set_what_it_wants(device: Device, tmp_path: Path) -> None:
    """As with ranges: rules are for other nodes."""
    device.client.ok("text mode other")
    (mode,) = device.call("get_parameters", names=["mode"])["values"]
    assert mode["string_value"] == "other"
