# SPDX-License-Identifier: Apache-2.0
"""A parameter server on a board: rclpy sets parameters over the serial line, and the firmware uses them."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.support.e2e.parameter_peer import ParameterPeer, parameter_peer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.parameters import ADDED, APPLICATION, cost, taken, work
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.slices import beyond, first, only

NAME = "qemu-mps2-an386"
DEVICE = "/arm/device"
SIZES = {
    "qemu-microbit": (24_168, 5_736, 960),
    NAME: (22_776, 5_736, 1_080),
    "qemu-mps2-an505": (22_936, 5_736, 1_092),
}
"""Flash, RAM without the stack, worst stack; the goals on the Cortex-M4 are 24,000, 6,000 and 1,200."""
COSTS = {"bool": (28, 16), "integer": (28, 16), "double": (28, 16), "string": (44, 40)}
"""Flash and RAM of one more declared parameter, a string of at most 16 bytes, its name of two characters."""
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


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.parametrize("flags", first([(), ADDED]), ids=["declared", "added"])
def test_rclpy_sets_what_the_firmware_uses(builds: Builds, domain: int, flags: tuple[str, ...]) -> None:
    built = builds.merged(NAME, APPLICATION)
    need(NAME, emulator=True)
    image = builds.application(built, "parameters.c", *flags)
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


@pytest.mark.system
@pytest.mark.parametrize("name", beyond(list(SIZES), {"qemu-mps2-an505"}, {"qemu-microbit"}))
def test_its_size(builds: Builds, name: str) -> None:
    """Four declared parameters, six services, executor, over a serial line."""
    need(name)
    found, (flash, ram, stack) = taken(builds, name), SIZES[name]
    assert found.flash <= flash
    assert found.size.ram <= ram
    assert found.stack <= stack


@pytest.mark.system
def test_its_size_where_the_program_adds_them(builds: Builds) -> None:
    """As sources for rclc do: their names and ranges are in RAM."""
    need(NAME)
    found = taken(builds, NAME, ADDED)
    assert found.flash <= 23_360
    assert found.size.ram <= 5_936
    assert found.stack <= 1_104


@pytest.mark.system
def test_its_instructions(builds: Builds) -> None:
    """Goals: 15,000, 4,000 and 6,000 for init, get and set."""
    need(NAME, emulator=True)
    found = work(builds, NAME)
    assert found.init <= 15_000
    assert found.get <= 3_273
    assert found.set <= 5_850
    assert found.get_call <= 256
    assert found.set_call <= 1_974


@pytest.mark.system
@pytest.mark.parametrize("kind", only({"string"}, COSTS))
def test_what_one_more_takes(builds: Builds, kind: str) -> None:
    """In the store: messages that have room for all parameters grow as well."""
    need(NAME)
    flash, ram = cost(builds, NAME, kind, messages=False)
    flash_most, ram_most = COSTS[kind]
    assert 0 < flash <= flash_most
    assert 0 < ram <= ram_most
