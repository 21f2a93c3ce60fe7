# SPDX-License-Identifier: Apache-2.0
"""What rclpy's parameter client sees of a device with the parameters of tests/e2e/c/parameters.c, and of the model."""

from __future__ import annotations

import time
from typing import Any

from tests.support.e2e.parameter_peer import MODEL, ParameterPeer
from tests.support.patience import deadline

DEVICE = "/arm/device"
NAMES = ["enabled", "motor.steps", "motor.limits.gain", "version"]
BOTH = (DEVICE, MODEL)


def same(peer: ParameterPeer, service: str, *arguments: Any) -> Any:
    """Call a service of both nodes; return what both answered."""
    found, wanted = (peer.call(node, service, *arguments) for node in BOTH)
    assert found == wanted
    return found


def results(peer: ParameterPeer, *values: tuple[str, Any]) -> list[str]:
    """Set parameters of both nodes; return the device's reasons where both agree in what was set."""
    found, wanted = (peer.call(node, "set_parameters", values)["results"] for node in BOTH)
    assert [r["successful"] for r in found] == [r["successful"] for r in wanted]
    assert all(r["successful"] == (r["reason"] == "") for r in found)
    return [r["reason"] for r in found]


def names_of(listed: dict[str, Any]) -> tuple[list[str], list[str]]:
    """Return the names and prefixes of a list; those of rclpy's own parameters are left out."""
    own = ("use_sim_time", "start_type_description_service")
    return (
        sorted(name for name in listed["result"]["names"] if name not in own),
        sorted(listed["result"]["prefixes"]),
    )


def reads(peer: ParameterPeer) -> None:
    """Get, types, describe; one unknown name makes the whole reply empty."""
    assert same(peer, "get_parameters", NAMES)["values"] == [[1, False], [2, 10], [3, 0.5], [3, 1.25]]
    assert same(peer, "get_parameters", ["version", "version"])["values"] == [[3, 1.25]] * 2
    assert same(peer, "get_parameters", ["enabled", "missing"])["values"] == []
    assert same(peer, "get_parameters", [])["values"] == []
    assert same(peer, "get_parameter_types", NAMES)["types"] == [1, 2, 3, 3]
    assert same(peer, "get_parameter_types", ["missing"])["types"] == []
    steps = same(peer, "describe_parameters", NAMES)["descriptors"][1]
    assert steps["integer_range"] == [{"from_value": -10, "to_value": 120, "step": 2}]
    assert steps["description"] == "Steps in a turn"
    assert same(peer, "describe_parameters", ["x" * 60])["descriptors"] == []


def lists(peer: ParameterPeer) -> None:
    cases: list[tuple[list[str], int]] = [([], 0), ([], 1), ([], 2), (["motor"], 0), (["motor"], 1)]
    cases += [
        (["motor"], 2),
        (["motor.limits", "enabled"], 0),
        (["mot"], 0),
        (["enabled"], 5),
        (["x" * 40], 0),
    ]
    for prefixes, depth in cases:
        found, wanted = (names_of(peer.call(node, "list_parameters", prefixes, depth)) for node in BOTH)
        assert found == wanted, (prefixes, depth)
    assert names_of(peer.call(DEVICE, "list_parameters", [], 0))[1] == ["motor", "motor.limits"]


def sets(peer: ParameterPeer) -> None:
    """The reasons are those of rclcpp (rclcpp/src/rclcpp/node_interfaces/node_parameters.cpp)."""
    assert results(peer, ("enabled", True), ("missing", 1), ("version", 2.0), ("motor.steps", 1.0)) == [
        "",
        "parameter 'missing' cannot be set because it was not declared",
        "parameter 'version' cannot be set because it is read-only",
        "Wrong parameter type, parameter {motor.steps} is of type {integer}, setting it to {double} is not allowed.",
    ]
    odd = "Parameter {motor.steps} doesn't comply with integer range."
    assert results(peer, ("motor.steps", 11), ("motor.steps", -12), ("motor.steps", 122)) == [odd] * 3
    gain = "Parameter {motor.limits.gain} doesn't comply with floating point range."
    assert results(peer, ("motor.limits.gain", 0.35), ("motor.limits.gain", 0.3)) == [gain, ""]
    assert results(peer, ("motor.steps", 66)) == ["rejected by the callback"]
    assert results(peer, ("enabled", None)) == ["cannot undeclare a statically typed parameter"]
    for value, kind in (
        ("text", "string"),
        ([1, 2], "integer_array"),
        ([True], "bool_array"),
        (["a", "b"], "string_array"),
    ):
        (reason,) = results(peer, ("enabled", value))
        assert reason.endswith(f"is of type {{bool}}, setting it to {{{kind}}} is not allowed.")
    assert same(peer, "get_parameters", NAMES)["values"] == [[1, True], [2, 10], [3, 0.3], [3, 1.25]]


def sets_atomically(peer: ParameterPeer) -> None:
    wrong = [("enabled", False), ("motor.steps", 20), ("version", 3.0)]
    found, wanted = (peer.call(node, "set_parameters_atomically", wrong)["result"] for node in BOTH)
    assert (found["successful"], wanted["successful"]) == (False, False)
    assert found["reason"] == "parameter 'version' cannot be set because it is read-only"
    vetoed = [("enabled", False), ("motor.steps", 66)]
    found, wanted = (peer.call(node, "set_parameters_atomically", vetoed)["result"] for node in BOTH)
    assert (found["successful"], wanted["successful"]) == (False, False)
    assert same(peer, "get_parameters", NAMES[:2])["values"] == [[1, True], [2, 10]]
    for node in BOTH:
        peer.events(node)
    same(peer, "set_parameters_atomically", [("enabled", False), ("motor.steps", 20)])
    assert same(peer, "get_parameters", NAMES[:2])["values"] == [[1, False], [2, 20]]


def events_of(peer: ParameterPeer, node: str, count: int) -> list[dict[str, Any]]:
    """Wait for events of a node; return them without their stamps, which must be those of today."""
    end = deadline(15)
    found: list[dict[str, Any]] = []
    while len(found) < count:
        found += peer.events(node)
        assert time.monotonic() < end, found
        time.sleep(0.02)
    for event in found:
        assert abs(event.pop("stamp")["sec"] - time.time()) < 600
        event.pop("node")
    return found


def _events_until(peer: ParameterPeer, node: str, names: list[str]) -> list[dict[str, Any]]:
    """Return the event that changes these parameters at once, and what follows it; earlier ones can be late."""
    while True:
        found = events_of(peer, node, 1)
        for index, event in enumerate(found):
            if [p["name"] for p in event["changed_parameters"]] == names:
                return found[index:]


def events(peer: ParameterPeer) -> None:
    """One event for each set of a parameter, one for an atomic set."""
    found, wanted = (_events_until(peer, node, ["enabled", "motor.steps"]) for node in BOTH)
    assert found == wanted
    assert results(peer, ("enabled", True), ("motor.steps", 20)) == ["", ""]
    found, wanted = (events_of(peer, node, 2) for node in BOTH)
    assert found == wanted
    assert found[1]["changed_parameters"] == [{"name": "motor.steps", "value": [2, 20]}]
