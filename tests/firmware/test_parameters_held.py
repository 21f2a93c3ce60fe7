# SPDX-License-Identifier: Apache-2.0
"""Parameters of a board that the agent holds: over the serial line, while board and agent restart, and their size."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.process import AgentProcess
from tests.support.e2e.parameter_peer import ParameterPeer, parameter_peer
from tests.support.firmware.board import Board, Builds, board, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.running import started
from tests.support.patience import deadline, seconds

NAME = "qemu-mps2-an386"
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      at: agent
      declare:
        - {name: enabled, type: bool}
        - {name: motor.steps, type: integer, default: 10, range: {min: 0, max: 120, step: 2}}
        - {name: motor.gain, type: double}
        - {name: version, type: integer, read_only: true}
"""
DEVICE = "/arm/device"
NAMES = ["enabled", "motor.steps", "motor.gain", "version"]
HELD = "held until the node is back"


def until(answer: Callable[[], Any], wanted: Any) -> None:
    """Ask until that is the answer."""
    end = deadline(60)
    while (found := answer()) != wanted:
        assert time.monotonic() < end, found
        time.sleep(0.1)


def values(peer: ParameterPeer) -> Any:
    """Return what a server says, if one answers."""
    response = peer.ask(node=DEVICE, service="get_parameters", arguments=[NAMES], timeout=seconds(3))
    return response and [value for _, value in response["values"]]


def set_steps(peer: ParameterPeer, value: int) -> Any:
    """Set a parameter; return the reason of the result, if one comes."""
    arguments = [[("motor.steps", value)]]
    response = peer.ask(node=DEVICE, service="set_parameters", arguments=arguments, timeout=seconds(5))
    return response and response["results"][0]["reason"]


def steps_of(running: Board) -> int:
    """Return twice the steps that the firmware uses."""
    return running.words("parameters_report")[0]


@pytest.mark.variant  # of tests/e2e/test_parameters_held.py, on a board
@pytest.mark.system
@pytest.mark.ros
def test_board_and_agent_restart(builds: Builds, domain: int, tmp_path: Path) -> None:
    need(NAME, emulator=True)
    built = builds.merged(NAME, APPLICATION)
    image = builds.application(built, "parameters.c")
    with parameter_peer(domain) as peer, board(built, image, restarts=True) as running:

        def agent() -> AbstractContextManager[AgentProcess]:
            options = ("--domain", str(domain), "--parameter-file", str(tmp_path / "p.json"))
            return started("agent", "serial", "--dev", running.device, *options, domain=domain)

        with agent() as first:
            first.wait_for("agent ready")
            running.go_on()
            until(lambda: values(peer), [False, 10, 0.0, 0])
            until(lambda: set_steps(peer, 42), "")
            running.wait_for(lambda: steps_of(running) == 84, 30)
            assert set_steps(peer, 43) == "Parameter {motor.steps} doesn't comply with integer range."
            assert set_steps(peer, 66) == "rejected by the callback"
            running.restart()  # its values are the declared ones, until the server has set what it holds
            running.wait_for(lambda: steps_of(running) == 84, 60)
            until(lambda: values(peer), [False, 42, 0.0, 0])
            until(lambda: set_steps(peer, 44), "")
        running.wait_for(lambda: steps_of(running) == 88, 30)
        with agent() as second:  # the file has the values, and the board gets the next one
            second.wait_for("agent ready")
            until(lambda: values(peer), [False, 44, 0.0, 0])
            until(lambda: set_steps(peer, 46), "")
            running.wait_for(lambda: steps_of(running) == 92, 30)


@pytest.mark.system
@pytest.mark.parametrize(
    ("name", "flash", "ram", "stack"),
    [
        pytest.param("qemu-microbit", 24_148, 3_592, 1_028, marks=pytest.mark.variant),
        (NAME, 22_348, 3_592, 1_172),
        pytest.param("qemu-mps2-an505", 22_396, 3_592, 1_176, marks=pytest.mark.long),
    ],
    ids=["m0", "m4", "m33"],
)
def test_its_size(builds: Builds, name: str, flash: int, ram: int, stack: int) -> None:
    """One node with four parameters that a server holds, executor, over a serial line."""
    need(name)
    built = builds.build(name, APPLICATION)
    image = builds.application(built, "parameters.c")
    size = image_sections(built, image)
    measured = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(found <= most for found, most in zip(measured, (flash, ram, stack), strict=True)), measured
