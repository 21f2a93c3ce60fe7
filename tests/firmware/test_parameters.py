# SPDX-License-Identifier: Apache-2.0
"""A parameter server on a board: rclpy sets parameters over the serial line, and the firmware uses them."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.support.e2e.parameter_peer import ParameterPeer, parameter_peer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.running import started
from tests.support.patience import deadline

NAME = "qemu-mps2-an386"
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: enabled, type: bool}
      - {name: motor.steps, type: integer}
      - {name: motor.gain, type: double}
      - {name: version, type: integer}
"""
DEVICE = "/arm/device"
NAMES = ["enabled", "motor.steps", "motor.gain", "version"]


def reasons(peer: ParameterPeer, *values: tuple[str, Any]) -> list[str]:
    """Set parameters; return why not, in the order of the values."""
    found = peer.call(DEVICE, "set_parameters", list(values))["results"]
    assert all(result["successful"] == (result["reason"] == "") for result in found)
    return [result["reason"] for result in found]


def changed(peer: ParameterPeer, count: int) -> list[Any]:
    """Wait for events of changes; return what changed."""
    end, found = deadline(30), list[Any]()
    while len(found) < count:
        found += [p for event in peer.events(DEVICE) for p in event["changed_parameters"]]
        assert time.monotonic() < end, found
        time.sleep(0.02)
    return found


@pytest.mark.ros
def test_rclpy_sets_what_the_firmware_uses(builds: Builds, domain: int) -> None:
    built = builds.build(NAME, APPLICATION)
    need(NAME, emulator=True)
    image = builds.application(built, "parameters.c")
    with (
        parameter_peer(domain) as peer,
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        peer.wait(DEVICE)
        assert sorted(peer.call(DEVICE, "list_parameters", [], 0)["result"]["names"]) == sorted(NAMES)
        peer.events(DEVICE)
        assert reasons(
            peer, ("enabled", True), ("motor.steps", 42), ("motor.gain", -2.5), ("version", 2)
        ) == ["", "", "", "parameter 'version' cannot be set because it is read-only"]
        assert changed(peer, 3) == [
            {"name": "enabled", "value": [1, True]},
            {"name": "motor.steps", "value": [2, 42]},
            {"name": "motor.gain", "value": [3, -2.5]},
        ]
        outside = "Parameter {motor.steps} doesn't comply with integer range."
        assert reasons(peer, ("motor.steps", 43), ("motor.steps", 66)) == [
            outside,
            "rejected by the callback",
        ]
        large = "the request is too large, none of it was set"
        assert reasons(peer, *[("motor.steps", 44)] * 9)[:1] == [large]
        assert peer.call(DEVICE, "get_parameters", NAMES)["values"] == [[1, True], [2, 42], [3, -2.5], [2, 0]]
        steps, changes = running.words("parameters_report", 2)
    assert steps == 2 * 42
    assert changes == 1


def test_its_size(builds: Builds) -> None:
    """Four parameters, six services, executor, over a serial line (goals: 24,000 and 6,000, stack 1,200; not met)."""
    need(NAME)
    built = builds.build(NAME, APPLICATION)
    image = builds.application(built, "parameters.c")
    size = image_sections(built, image)
    assert size.text + size.data <= 25_520
    assert size.ram <= 6_032
    assert bounded_stack(built, image) <= 1312
