# SPDX-License-Identifier: Apache-2.0
"""Parameters that the agent holds: rclpy's parameter client sees what it sees of an rclpy node, board or no board."""

from __future__ import annotations

import json
import os
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.parameter_calls import (
    BOTH,
    DEVICE,
    NAMES,
    events,
    lists,
    reads,
    sets,
    sets_atomically,
)
from tests.support.e2e.parameter_peer import ParameterPeer, parameter_peer
from tests.support.e2e.relay import Relay
from tests.support.parameter_server.process import parameter_server
from tests.support.paths import ROOT
from tests.support.patience import deadline
from tests.support.ros.python_messages import python_messages

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes: [{name: device, namespace: /arm, parameters: {at: agent}}]
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
HELD = "held until the node is back"
SHORT_SERVER = ("-m", "tests.support.parameter_server.short_server")
LAST_NOTICE_S, NEXT_NOTICE_S = 14, 30
"""After the first notice: the one that the tests wait for, and the next one (0, 2, 6, 14, 30, 62)."""


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    folder = tmp_path_factory.mktemp("held")
    return image.application(C_FILES / "parameters.c", folder / "parameters", *STRICT)


def until(answer: Callable[[], Any], wanted: Any) -> None:
    """Ask until that is the answer."""
    end = deadline(30)
    while (found := answer()) != wanted:
        assert time.monotonic() < end, found
        time.sleep(0.1)


def await_line(process: subprocess.Popen[str], beginning: str) -> None:
    """Read until a line begins so."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith(beginning):
            return
    raise AssertionError(f"the program ended without '{beginning}'")


def values(peer: ParameterPeer, *names: str) -> Any:
    """Return values of the device, None without a response."""
    response = peer.attempt(DEVICE, "get_parameters", names)
    return response and [value for _, value in response["values"]]


def set_steps(peer: ParameterPeer, value: int) -> Any:
    """Return whether it was set and the reason, None without a response."""
    response = peer.attempt(DEVICE, "set_parameters", [("motor.steps", value)])
    return response and [(result["successful"], result["reason"]) for result in response["results"]]


def wait_for_server(agent: AgentProcess) -> None:
    ready = "parameter server ready: /microros_parameters"
    if not any(ready in line for line in agent.log):
        agent.wait_for(ready)


def test_as_an_rclpy_node_and_without_the_board(
    program: Path, relay: Relay, domain: int, tmp_path: Path
) -> None:
    file = tmp_path / "p.json"
    options = ("--domain", str(domain), "--parameter-file", str(file))
    with parameter_peer(domain) as peer:
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            with started(program) as process:
                await_line(process, "ready")
                wait_for_server(agent)
                for node in BOTH:
                    peer.wait(node)
                until(lambda: values(peer, *NAMES), [False, 10, 0.5, 1.25])
                for node in BOTH:
                    peer.events(node)
                reads(peer)
                lists(peer)
                sets(peer)
                sets_atomically(peer)
                events(peer)
            until(lambda: set_steps(peer, 40), [(True, HELD)])
            odd = "Parameter {motor.steps} doesn't comply with integer range."
            assert set_steps(peer, 41) == [(False, odd)]
            assert values(peer, *NAMES[:2]) == [True, 40]
            with started(program) as process:
                await_line(process, "changed motor.steps 40")
                until(lambda: set_steps(peer, 42), [(True, "")])
                await_line(process, "changed motor.steps 42")
            until(lambda: set_steps(peer, 66), [(True, HELD)])
            assert agent.stop() == 0
        assert json.loads(file.read_text())["nodes"][DEVICE]["parameters"]["motor.steps"]["value"] == 66
        with running_agent(domain, *options) as agent:  # another agent, the same file; the board refuses 66
            relay.connect(agent.port)
            with started(program) as process:
                await_line(process, "ready")
                wait_for_server(agent)
                peer.wait(DEVICE)
                agent.wait_for(
                    "/arm/device: motor.steps: the node refuses 66 (rejected by the callback) and keeps 10"
                )
                until(lambda: values(peer, *NAMES[:2]), [True, 10])
                set_steps(peer, 120)
                ends_well(process)


@pytest.mark.system
def test_a_server_of_its_own_that_restarts(program: Path, relay: Relay, domain: int, tmp_path: Path) -> None:
    """The agent leaves it the parameters; while it is away nothing is lost."""
    file = tmp_path / "own.json"
    options = ("--domain", str(domain), "--parameter-file", str(tmp_path / "agent.json"))
    with parameter_peer(domain) as peer, running_agent(domain, *options) as agent:
        relay.connect(agent.port)
        with parameter_server(domain, file), started(program) as process:
            await_line(process, "ready")
            agent.wait_for("parameters are held by another /microros_parameters")
            peer.wait(DEVICE)
            until(lambda: set_steps(peer, 30), [(True, "")])
            await_line(process, "changed motor.steps 30")
        with parameter_server(domain, file), started(program) as process:
            await_line(process, "changed motor.steps 30")
            # A repeated request comes after the program has ended, which the value tells it to do.
            until(lambda: set_steps(peer, 120) in ([(True, "")], [(True, HELD)]), True)
            ends_well(process)
    assert not (tmp_path / "agent.json").exists()


def wait_for_the_last_notice(process: subprocess.Popen[str]) -> float:
    """Wait until the next notice of a program that has just started is 15 s away; return when it is due."""
    await_line(process, "ready")
    begin = time.monotonic()
    time.sleep(LAST_NOTICE_S + 1)
    return begin + NEXT_NOTICE_S


@pytest.mark.system
def test_a_server_that_starts_late_has_the_last_notice(
    program: Path, relay: Relay, domain: int, tmp_path: Path
) -> None:
    """It does not wait for the next one: the agent still has the last one."""
    options = ("--domain", str(domain), "--no-parameter-server")
    with parameter_peer(domain) as peer, running_agent(domain, *options) as agent:
        relay.connect(agent.port)
        with started(program) as process:
            due = wait_for_the_last_notice(process)
            with parameter_server(domain, tmp_path / "late.json"):
                peer.wait(DEVICE)
                assert time.monotonic() < due
                until(lambda: set_steps(peer, 30), [(True, "")])
                await_line(process, "changed motor.steps 30")


@pytest.mark.system
def test_a_late_server_without_the_last_notice_gets_the_next_one(
    program: Path, relay: Relay, domain: int, tmp_path: Path
) -> None:
    """It is published when it is due, within 16 s."""
    options = ("--domain", str(domain), "--no-parameter-server")
    with running_agent(domain, *options) as agent:
        relay.connect(agent.port)
        with started(program) as process:
            due = wait_for_the_last_notice(process)
            with parameter_server(domain, tmp_path / "none.json", (*SHORT_SERVER, "--volatile")) as server:
                ready = time.monotonic()
                await_line(server, f"follows {DEVICE}")
                found = time.monotonic()
                assert found - ready < NEXT_NOTICE_S - LAST_NOTICE_S
                assert found > due - 1, "not by the last notice, which it did not get"


def replaced(program: Path, relay: Relay, domain: int, folder: Path, *script: str) -> None:
    """Hold values by a script, which has the contract of the page and nothing else of this tool's server."""
    with (
        parameter_peer(domain) as peer,
        running_agent(domain, "--domain", str(domain), "--no-parameter-server") as agent,
        parameter_server(domain, folder / "none.json", script),
    ):
        relay.connect(agent.port)
        with started(program) as process:
            await_line(process, "ready")
            until(lambda: values(peer, "motor.steps"), [10])
            until(lambda: set_steps(peer, 66), [(False, "rejected by the callback")])
            until(lambda: set_steps(peer, 30), [(True, "")])
            await_line(process, "changed motor.steps 30")
        with started(program) as process:  # it has lost its values
            await_line(process, "changed motor.steps 30")
            until(lambda: values(peer, "motor.steps"), [30])


@pytest.mark.variant
@pytest.mark.system
def test_a_short_script_instead_of_the_server(
    program: Path, relay: Relay, domain: int, tmp_path: Path
) -> None:
    replaced(program, relay, domain, tmp_path, *SHORT_SERVER)


@pytest.mark.system
def test_an_rclpy_script_instead_of_the_server(
    program: Path, relay: Relay, domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its classes of microros_parameter_msgs are what the generators of ROS 2 make of the shipped definitions."""
    script = ROOT / "examples" / "parameter_server.py"
    packages = ("rcl_interfaces", "service_msgs", "builtin_interfaces")
    python_messages("microros_parameter_msgs", packages, tmp_path / "messages")
    for path in ("PYTHONPATH", "LD_LIBRARY_PATH"):
        monkeypatch.setenv(path, str(tmp_path / "messages"), prepend=os.pathsep)
    replaced(program, relay, domain, tmp_path, str(script))
