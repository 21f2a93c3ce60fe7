# SPDX-License-Identifier: Apache-2.0
"""An action client on the device, served by rclpy's action server."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.agent.process import running_agent
from tests.support.e2e.action_server_peer import (
    ABORTED,
    ENDLESS,
    REJECTED,
    STUBBORN,
    ActionServerPeer,
    action_server_peer,
    fibonacci,
)
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.graph_server import graph_server
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
components: [+action_client, +graph]
session: {connect_timeout: 20 s, create_timeout: 10 s}
nodes:
  - name: device
    namespace: /arm
    action_clients:
      - {name: fibonacci, type: test_msgs/action/Fibonacci, goals: 2, response_timeout: 1500 ms}
limits: {"*": {sequence: 16}}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
ACCEPTED, SUCCEEDED, CANCELED, ABORTED_STATE = 1, 4, 5, 6
INVALID_ARGUMENT = 11


class Device:
    """The device and the server."""

    def __init__(self, program: CommandedProgram, peer: ActionServerPeer) -> None:
        self.program, self.peer = program, peer

    def ok(self, command: str) -> list[str]:
        code, error, lines = self.program.call(command)
        assert code == 0, (command, code, error)
        return lines

    def until(self, event: str, within: float = 20) -> list[str]:
        """Return what callbacks got until `event`."""
        end = deadline(within)
        while event not in (found := self.ok("events")):
            assert time.monotonic() < end, (found, self.ok("faults"))
            time.sleep(0.02)
        return found

    def accepted(self, order: int) -> int:
        """Send a goal, again until the server is known to the agent; return its number."""
        end = deadline(30)
        while True:
            number = sum(line.startswith("goal ") for line in self.ok("events"))
            self.ok(f"send {order}")
            while not (found := [e for e in self.ok("events") if e.startswith(f"goal {number} ")]):
                assert time.monotonic() < end
                time.sleep(0.02)
            if found == [f"goal {number} 1"]:
                return number


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    folder = tmp_path_factory.mktemp("action_client")
    return image.application(C_FILES / "action_client.c", folder / "action_client", *STRICT)


@pytest.fixture(scope="module")
def server(domain: int) -> Iterator[ActionServerPeer]:
    with action_server_peer(domain) as peer:
        peer.ask(do="serve")
        yield peer


@pytest.fixture
def device(program: Path, agent: object, server: ActionServerPeer) -> Iterator[Device]:
    server.ask(do="forget")
    with started(program) as process:
        yield Device(CommandedProgram(process), server)
        server.ask(do="release")
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_a_goal_with_feedback_and_result(device: Device) -> None:
    number = device.accepted(5)
    assert device.until(f"result {number} {SUCCEEDED} 0 1 1 2 3")[-7:] == [
        f"goal {number} 1",
        *(
            f"feedback {number} {ACCEPTED} " + " ".join(str(n) for n in fibonacci(count))
            for count in range(1, 6)
        ),
        f"result {number} {SUCCEEDED} 0 1 1 2 3",
    ]
    order, identifier, state = device.peer.goals()[-1]
    assert [order, state] == [5, SUCCEEDED]
    assert device.ok(f"id {number}") == [identifier]
    # The goal has ended, and its handle is not valid any more.
    code, error, _ = device.program.call(f"cancel {number}")
    assert (code, "goal_handle" in error) == (INVALID_ARGUMENT, True)


def test_two_goals_at_once_and_one_too_many(device: Device) -> None:
    first = device.accepted(ENDLESS)
    second = device.accepted(3)
    code, error, _ = device.program.call("send 4")
    assert code == 1
    assert "more than 2 goals at once: set the goals of its action_clients: 3" in error
    device.until(f"result {second} {SUCCEEDED} 0 1 1")
    assert f"result {first}" not in " ".join(device.ok("events"))
    # The place of the goal that has ended is used again.
    third = device.accepted(2)
    device.until(f"result {third} {SUCCEEDED} 0 1")
    identifiers = [identifier for _, identifier, _ in device.peer.goals()]
    assert len(set(identifiers)) == len(identifiers) >= 3


def test_goals_that_are_rejected_or_aborted(device: Device) -> None:
    aborted = device.accepted(ABORTED)
    device.until(f"result {aborted} {ABORTED_STATE}")
    for _ in range(3):  # a rejected goal keeps no place
        device.ok(f"send {REJECTED}")
        device.until(f"goal {aborted + 1} 0")
        aborted += 1


@pytest.mark.parametrize(("order", "accepts"), [(ENDLESS, True), (STUBBORN, False)])
def test_a_goal_is_canceled(device: Device, order: int, accepts: bool) -> None:
    number = device.accepted(order)
    device.ok(f"cancel {number}")
    device.until(f"cancel {number} {int(accepts)}")
    if accepts:
        device.until(f"result {number} {CANCELED}")
    else:
        assert "result" not in " ".join(device.ok("events"))
        device.peer.ask(do="release")
        device.until(f"result {number} {SUCCEEDED}")


def test_feedback_of_other_clients_is_not_reported(device: Device) -> None:
    number = device.accepted(ENDLESS)
    assert device.peer.ask(do="send", order=4)
    device.ok(f"cancel {number}")
    device.until(f"result {number} {CANCELED}")
    assert not [event for event in device.ok("events") if event.startswith("feedback")]
    assert device.ok("faults")[0].startswith("0 ")


def test_without_a_server_a_goal_is_not_accepted(device: Device) -> None:
    """Its place is free afterwards, and the text says what is missing."""
    device.peer.ask(do="close")
    for number in range(3):
        device.ok("send 3")
        device.until(f"goal {number} 0")
    assert "no response to a goal or a cancel request within 1500 ms" in device.ok("faults")[0]
    device.peer.ask(do="serve")
    number = device.accepted(1)
    device.until(f"result {number} {SUCCEEDED} 0")


def test_whether_the_server_is_available(device: Device, domain: int) -> None:
    def until(expected: str) -> None:
        end = deadline(20)
        while device.program.call("available")[::2] != (0, [expected]):
            assert time.monotonic() < end

    with graph_server(domain):
        until("1")
        device.peer.ask(do="close")
        until("0")
        device.peer.ask(do="serve")
        until("1")


def test_the_agent_restarts_in_the_middle_of_a_goal(
    program: Path, image_port: Relay, domain: int, server: ActionServerPeer
) -> None:
    """The result is asked for again, from the next agent."""
    server.ask(do="forget")
    options = (domain, "--domain", str(domain), "--client-timeout", "3")
    with running_agent(*options) as first:
        image_port.connect(first.port)
        process = started(program)
        running = process.__enter__()
        device = Device(CommandedProgram(running), server)
        waiting, ending = device.accepted(ENDLESS), device.accepted(STUBBORN)
    server.ask(do="release")  # without an agent
    with running_agent(*options) as second:
        image_port.connect(second.port)
        for number in (waiting, ending):
            device.until(f"result {number} {SUCCEEDED}", 60)
        number = device.accepted(2)
        device.until(f"result {number} {SUCCEEDED} 0 1")
        assert running.stdin is not None
        running.stdin.write("end\n")
        ends_well(running)
        process.__exit__(None, None, None)
