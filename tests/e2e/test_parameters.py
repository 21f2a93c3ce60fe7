# SPDX-License-Identifier: Apache-2.0
"""Parameters of a device: rclpy's parameter client sees what it sees of an rclpy node that declares the same."""

from __future__ import annotations

import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, SANITIZE, Images, ends_well, started
from tests.support.e2e.parameter_calls import (
    BOTH,
    DEVICE,
    NAMES,
    events,
    events_of,
    lists,
    names_of,
    reads,
    results,
    same,
    sets,
    sets_atomically,
)
from tests.support.e2e.parameter_peer import MODEL, ParameterPeer, parameter_peer
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes: [{name: device, namespace: /arm}]
"""
WITH_ARRAYS = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
pools: {parameters: 12}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: bytes, type: "byte[]", size: 4}
      - {name: bools, type: "bool[]", size: 4}
      - {name: integers, type: "integer[]", size: 4}
      - {name: doubles, type: "double[]", size: 2}
      - {name: strings, type: "string[]", size: 3}
      - {name: mode, type: integer, one_of: [0, 5]}
      - {name: rate, type: double, one_of: [0, 0.1]}
      - {name: side, type: string, size: 5, one_of: ["", left]}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")


def program_of(images: Images, port: int, folder: Path, *flags: str, application: str = APPLICATION) -> Path:
    image = images.build(port, application, flags=(*SANITIZE, *flags) if flags else ())
    return image.application(C_FILES / "parameters.c", folder / "parameters", *STRICT)


LARGE = "the request is too large, none of it was set"


def large_requests(peer: ParameterPeer) -> None:
    """Above the limits of the device: each is answered, each is reported there, and nothing of it is lost or set."""
    many = [("enabled", False)] * 12
    found = peer.call(DEVICE, "set_parameters", [*many, ("motor.steps", 30)])["results"]
    assert [(r["successful"], r["reason"] in ("", LARGE)) for r in found] == [(False, True)] * 13
    assert found[0]["reason"] == LARGE
    for value in (["x" * 50] * 60, "x" * 1000):
        found = peer.call(DEVICE, "set_parameters", [("motor.steps", value), ("enabled", True)])["results"]
        assert [(r["successful"], r["reason"]) for r in found] == [(False, LARGE)] * 2
        whole = peer.call(DEVICE, "set_parameters_atomically", [("motor.steps", value)])["result"]
        assert (whole["successful"], whole["reason"]) == (False, LARGE)
    assert peer.call(DEVICE, "set_parameters", [("enabled", True)] * 200)["results"] == []
    assert peer.call(DEVICE, "get_parameters", NAMES * 10)["values"] == []
    assert peer.call(DEVICE, "get_parameter_types", NAMES * 10)["types"] == []
    assert peer.call(DEVICE, "describe_parameters", ["x" * 900])["descriptors"] == []
    assert names_of(peer.call(DEVICE, "list_parameters", ["motor"] * 60, 0)) == ([], [])
    assert peer.call(DEVICE, "get_parameters", NAMES[:2])["values"] == [[1, True], [2, 20]]


@pytest.mark.parametrize("flags", [(), pytest.param(("-m32",), marks=pytest.mark.variant)], ids=["64", "32"])
def test_as_an_rclpy_node(
    images: Images,
    image_port: Relay,
    agent: AgentProcess,
    domain: int,
    tmp_path: Path,
    flags: tuple[str, ...],
) -> None:
    program = program_of(images, image_port.port, tmp_path, *flags)
    with parameter_peer(domain) as peer, started(program) as process:
        await_line(process, "ready")
        for node in BOTH:
            peer.wait(node)
        reads(peer)
        lists(peer)
        sets(peer)
        sets_atomically(peer)
        events(peer)
        large_requests(peer)
        peer.call(DEVICE, "set_parameters", [("motor.steps", 120)])
        ends_well(process)


ARRAYS: dict[str, tuple[str, list[Any], list[Any]]] = {
    "bytes": ("BYTE_ARRAY", [0, 255], [1, 2, 3, 128]),
    "bools": ("BOOL_ARRAY", [True, False, True], [False]),
    "integers": ("INTEGER_ARRAY", [-(2**63), -1, 2**63 - 1], [7, -8]),
    "doubles": ("DOUBLE_ARRAY", [0.5], [-0.25, 5e-324]),
    "strings": ("STRING_ARRAY", ["left", "", "right"], ["größer", "x" * 49]),
}
"""Name → type, value at the start, another value."""


def typed(kind: str, value: list[Any]) -> dict[str, Any]:
    return {"type": kind, "value": value}


@pytest.mark.system
def test_arrays_as_of_an_rclpy_node(
    images: Images, image_port: Relay, agent: AgentProcess, domain: int, tmp_path: Path
) -> None:
    """Each type: its value at the start, another one, an empty one, too many elements, another type."""
    program = program_of(images, image_port.port, tmp_path, application=WITH_ARRAYS)
    names = list(ARRAYS)
    with parameter_peer(domain) as peer, started(program) as process:
        await_line(process, "ready")
        for node in BOTH:
            peer.wait(node)
        for name, (kind, value, _) in ARRAYS.items():
            assert peer.ask(declare=name, value=typed(kind, value))
        assert [v for _, v in same(peer, "get_parameters", names)["values"]] == [
            v[1] for v in ARRAYS.values()
        ]
        assert same(peer, "get_parameter_types", names)["types"] == [5, 6, 7, 8, 9]
        same(peer, "describe_parameters", names)
        events_of(peer, MODEL, len(names))
        for node in BOTH:
            peer.events(node)
        values = [(name, typed(kind, value)) for name, (kind, _, value) in ARRAYS.items()]
        assert same(peer, "set_parameters_atomically", values)["result"]["successful"]
        assert [v for _, v in same(peer, "get_parameters", names)["values"]] == [
            v[2] for v in ARRAYS.values()
        ]
        found, wanted = (events_of(peer, node, 1) for node in BOTH)
        assert found == wanted
        for name, (kind, value, _) in ARRAYS.items():
            many = peer.call(
                DEVICE, "set_parameters", [(name, typed(kind, value * 5)), (name, typed(kind, []))]
            )
            assert [r["reason"] for r in many["results"]] == [
                f"the array for parameter '{name}' is too long",
                "",
            ]
            peer.call(MODEL, "set_parameters", [(name, typed(kind, []))])
        empty = same(peer, "get_parameters", names)["values"]
        assert [v for _, v in empty] == [[]] * 5
        long = [("strings", ["x" * 50]), ("doubles", [1.0, 2.0, 3.0])]
        reasons = [r["reason"] for r in peer.call(DEVICE, "set_parameters", long)["results"]]
        assert reasons == [f"the array for parameter '{name}' is too long" for name, _ in long]
        whole = peer.call(DEVICE, "set_parameters_atomically", [("bools", [True]), long[0]])["result"]
        assert whole["reason"] == "the array for parameter 'strings' is too long"
        wrong = (
            "Wrong parameter type, parameter {bools} is of type {bool_array}, setting it to {integer_array}"
        )
        assert results(peer, ("bools", [1]))[0].startswith(wrong)
        assert same(peer, "get_parameters", names)["values"] == empty
        peer.call(DEVICE, "set_parameters", [("motor.steps", 120)])
        ends_well(process)


@pytest.mark.system
def test_values_that_are_not_listed(
    images: Images, image_port: Relay, agent: AgentProcess, domain: int, tmp_path: Path
) -> None:
    program = program_of(images, image_port.port, tmp_path, application=WITH_ARRAYS)
    with parameter_peer(domain) as peer, started(program) as process:
        await_line(process, "ready")
        peer.wait(DEVICE)
        sets = [("mode", 5), ("rate", 0.1), ("side", "left"), ("side", ""), ("side", "left")]
        found = peer.call(DEVICE, "set_parameters", sets)["results"]
        assert [r["reason"] for r in found] == [""] * 5
        wrong = [("mode", 1), ("rate", 0.2), ("side", "lef"), ("side", "lefty"), ("side", "l\0")]
        found = peer.call(DEVICE, "set_parameters", wrong)["results"]
        assert [r["reason"] for r in found] == [
            f"Parameter {{{name}}} doesn't comply with its list of values." for name, _ in wrong
        ]
        values = peer.call(DEVICE, "get_parameters", ["mode", "rate", "side"])["values"]
        assert [v for _, v in values] == [5, 0.1, "left"]
        peer.call(DEVICE, "set_parameters", [("motor.steps", 120)])
        ends_well(process)


@pytest.mark.system
def test_after_a_restart_of_the_agent(images: Images, relay: Relay, domain: int, tmp_path: Path) -> None:
    """The device keeps its values; the new agent has its services, and events go on."""
    program = program_of(images, relay.port, tmp_path)
    options = ("--domain", str(domain))
    with parameter_peer(domain) as peer, ExitStack() as stack:
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            process = stack.enter_context(started(program, "undeclared"))
            await_line(process, "ready")
            peer.wait(DEVICE)
            peer.call(DEVICE, "set_parameters", [("enabled", True), ("motor.steps", 42)])
            relay.connect(0)
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            end = deadline(60)
            question = {"node": DEVICE, "service": "get_parameters", "arguments": [NAMES[:2]]}
            while peer.ask(**question, timeout=2) is None:
                assert time.monotonic() < end
            assert peer.call(DEVICE, "get_parameters", NAMES[:2])["values"] == [[1, True], [2, 42]]
            peer.events(DEVICE)
            peer.call(DEVICE, "set_parameters", [("motor.steps", 120)])
            (event,) = events_of(peer, DEVICE, 1)
            assert event["changed_parameters"] == [{"name": "motor.steps", "value": [2, 120]}]
            ends_well(process, 60)


@pytest.mark.system
def test_the_example_of_the_profile_with_diagnostics(
    images: Images, image_port: Relay, agent: AgentProcess, domain: int, observer: Observer
) -> None:
    """The profile alone: a parameter that ROS sets, log messages, and reports on /diagnostics."""
    text = "version: 1\nprofiles: [configurable_sender_with_diagnostics]\n"
    (example,) = (images.build(image_port.port, text).out / "bin").iterdir()
    observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", reliable=True)
    with parameter_peer(domain) as peer, started(example) as process:
        await_line(process, "[INFO] [example]: all entities are open")
        await_line(process, "parameters of /device are up to date")
        peer.wait("/device")
        assert peer.call("/device", "get_parameters", ["gain"])["values"] == [[3, 1.0]]
        for value, reason in (
            (2.5, ""),
            (11.0, "Parameter {gain} doesn't comply with floating point range."),
        ):
            (result,) = peer.call("/device", "set_parameters", [("gain", value)])["results"]
            assert result["reason"] == reason
        await_line(process, "parameter gain changes")
        end = deadline(30)
        while not (found := [m for topic, m in observer.ask(do="samples") if topic == "/diagnostics"]):
            assert time.monotonic() < end
            time.sleep(0.1)
    (status,) = found[0]["status"]
    assert (status["name"], status["hardware_id"], found[0]["header"]["frame_id"]) == ("device",) * 3
    assert status["level"] in ([0], "\0", 0)
