# SPDX-License-Identifier: Apache-2.0
"""An action server on the device, driven by rclpy's action client, next to a server of rclpy."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.process import running_agent
from tests.support.e2e.action_peer import DEVICE, MODEL, ActionPeer, action_peer
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, QUICK, Images, ends_well, kill, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
components: [+action_server]
session: {connect_timeout: 20 s, create_timeout: 10 s}
nodes:
  - name: device
    namespace: /arm
    actions:
      - {name: fibonacci, type: test_msgs/action/Fibonacci, goals: 2, result_timeout: 3 s, waiting: 2}
limits: {"*": {sequence: 16}}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(1, 7)
NONE, REJECTED, UNKNOWN_GOAL, TERMINATED = range(4)
FIBONACCI = [0, 1, 1, 2, 3, 5, 8, 13]


class Server:
    """The device and the client."""

    def __init__(self, program: CommandedProgram, peer: ActionPeer) -> None:
        self.program, self.peer = program, peer

    def ok(self, command: str) -> list[str]:
        code, error, lines = self.program.call(command)
        assert code == 0, (command, code, error)
        return lines

    def refused(self) -> tuple[int, str]:
        number, _, text = self.ok("refused")[0].partition(" ")
        return int(number), text

    def goal(self, index: int) -> list[int]:
        """Return order, state and whether it was canceled."""
        return [int(word) for word in self.ok(f"goal {index}")[0].split()]

    def until(self, holds: Callable[[], bool], within: float = 20) -> None:
        end = deadline(within)
        while not holds():
            assert time.monotonic() < end
            time.sleep(0.02)


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "actions.c", tmp_path_factory.mktemp("actions") / "actions", *STRICT)


@pytest.fixture
def server(program: Path, agent: object, domain: int) -> Iterator[Server]:
    with action_peer(domain) as peer, started(program) as process:
        found = Server(CommandedProgram(process), peer)
        assert peer.ask(do="wait", action=DEVICE, timeout=seconds(30))
        yield found
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_names_types_hashes_and_qos_are_those_of_rclpy(server: Server) -> None:
    assert server.peer.ask(do="wait", action=MODEL, timeout=seconds(30))
    device, model = (server.peer.ask(do="endpoints", action=name) for name in (DEVICE, MODEL))
    assert len(model) == 5
    assert device == model
    hidden = server.peer.ask(do="hidden", action=DEVICE)
    assert [name.removeprefix(DEVICE) for name in hidden] == [
        name.removeprefix(MODEL) for name in server.peer.ask(do="hidden", action=MODEL)
    ]


def test_a_goal_with_feedback_and_result(server: Server) -> None:
    server.peer.ask(do="watch", action=DEVICE)
    answer = server.peer.send(7)
    assert answer["accepted"]
    assert abs(answer["stamp"][0] - time.time()) < 60
    server.peer.ask(do="ask", goal=0)
    assert server.goal(0) == [7, EXECUTING, 0]
    for numbers in (1, 3):
        server.ok(f"feedback 0 {numbers}")
    feedback: list[Any] = []

    def two_came() -> bool:
        feedback.extend(server.peer.ask(do="feedback"))
        return len(feedback) == 2

    server.until(two_came)
    assert feedback == [[0, [0]], [0, [0, 1, 2]]]
    server.until(
        lambda: server.peer.ask(do="statuses")[-1:] == [[[0, EXECUTING]]]
    )  # DDS connects topics one by one
    server.ok(f"end 0 {SUCCEEDED} 8")
    assert server.peer.result(0) == [SUCCEEDED, FIBONACCI]
    # The history has the last status alone, so an agent may overtake the first one.
    server.until(lambda: server.peer.ask(do="statuses")[-1:] == [[[0, SUCCEEDED]]])
    seen = server.peer.ask(do="statuses")
    states = list(dict.fromkeys(message[0][1] for message in seen if message))
    assert states in ([ACCEPTED, EXECUTING, SUCCEEDED], [EXECUTING, SUCCEEDED])


def test_the_result_is_asked_for_after_the_end_and_until_it_expires(server: Server) -> None:
    server.peer.send(2)
    server.ok(f"end 0 {ABORTED} 3")
    assert server.peer.result(0) == [ABORTED, FIBONACCI[:3]]
    assert server.peer.result(0) == [ABORTED, FIBONACCI[:3]]
    time.sleep(3.5)
    assert server.peer.result(0) == [0, []]


def test_two_goals_at_once_and_one_too_many(server: Server) -> None:
    goals = [server.peer.send(order) for order in (3, 4)]
    assert [answer["accepted"] for answer in goals] == [True, True]
    assert server.peer.send(5)["accepted"] is False
    number, text = server.refused()
    assert number == 1
    assert "goal refused: all its goals are in use" in text
    for goal in (0, 1):
        server.peer.ask(do="ask", goal=goal)
    server.ok(f"end 1 {SUCCEEDED} 1")
    assert server.peer.result(1) == [SUCCEEDED, [0]]
    # Its result was sent: its place is used again.
    assert server.peer.send(6)["accepted"]
    server.ok(f"end 0 {SUCCEEDED} 2")
    server.ok(f"end 2 {ABORTED} 0")
    assert server.peer.result(0) == [SUCCEEDED, [0, 1]]
    assert server.peer.result(3) == [ABORTED, []]


def test_an_ended_goal_keeps_its_place_until_its_result_was_sent_or_expires(server: Server) -> None:
    for order in (3, 4):
        server.peer.send(order)
        server.ok(f"end {order - 3} {SUCCEEDED} 1")
    assert server.peer.send(5)["accepted"] is False
    server.until(lambda: bool(server.peer.send(5)["accepted"]))
    assert server.refused()[0] >= 1


def test_goals_that_are_rejected(server: Server) -> None:
    server.ok("reject 1")
    assert server.peer.send(1)["accepted"] is False
    assert server.refused()[0] == 0  # the application knows
    server.ok("reject 0")
    assert server.peer.send(2)["accepted"]
    assert server.peer.send(3, same_id_as=1)["accepted"] is False
    assert server.refused() == (1, server.refused()[1])
    assert "a goal with this id exists" in server.refused()[1]
    assert server.goal(0) == [2, EXECUTING, 0]


@pytest.mark.parametrize("ends_at_once", [False, True])
def test_a_goal_is_canceled(server: Server, ends_at_once: bool) -> None:
    server.ok(f"end_at_cancel {int(ends_at_once)}")
    server.peer.send(9)
    server.peer.ask(do="ask", goal=0)
    assert server.peer.cancel(0) == [NONE, [0]]
    if not ends_at_once:
        assert server.goal(0) == [9, CANCELING, 1]
        assert server.peer.cancel(0) == [TERMINATED, []]
        server.ok(f"end 0 {CANCELED} 1")
    assert server.peer.result(0) == [CANCELED, [0]]
    assert server.peer.cancel(0) == [TERMINATED, []]
    assert server.ok("cancels") == ["1"]


def test_a_cancel_request_is_rejected(server: Server) -> None:
    server.ok("keep 1")
    server.peer.send(9)
    assert server.peer.cancel(0) == [REJECTED, []]
    assert server.goal(0) == [9, EXECUTING, 0]
    code, error, _ = server.program.call(f"end 0 {CANCELED} 0")
    assert code == 2301
    assert "no such transition" in error
    server.ok(f"end 0 {SUCCEEDED} 0")
    assert server.peer.result(0) == [SUCCEEDED, []]


def test_goals_are_canceled_by_time_and_all_together(server: Server) -> None:
    first, second = (server.peer.send(order)["stamp"] for order in (1, 2))
    assert first < second
    assert server.peer.cancel(None, (first[0], first[1])) == [NONE, [0]]
    assert server.peer.cancel(5) == [UNKNOWN_GOAL, []]
    assert server.peer.cancel(5, (second[0], second[1])) == [NONE, [1]]
    assert server.peer.cancel(None) == [NONE, []]
    for goal in (0, 1):
        server.ok(f"end {goal} {CANCELED} 0")
        assert server.peer.result(goal) == [CANCELED, []]
    for order in (3, 4):
        assert server.peer.send(order)["accepted"]
    assert server.peer.cancel(None) == [NONE, [2, 3]]


def test_codes_of_cancel_requests_are_those_of_rclpy(server: Server) -> None:
    """Unknown, ended and active goals, the same for both servers."""
    assert server.peer.ask(do="wait", action=MODEL, timeout=seconds(30))
    found = []
    for action in (DEVICE, MODEL):
        ended = server.peer.send(0, action=action)["goal"]
        if action == DEVICE:
            server.ok(f"end 0 {SUCCEEDED} 0")
        server.peer.result(ended)
        active = server.peer.send(1, action=action)["goal"]
        codes = [server.peer.cancel(goal, action=action) for goal in (999, ended, active)]
        found.append([[code, len(goals)] for code, goals in codes])
    assert found[0] == found[1]


def test_several_clients_wait_for_one_result(server: Server) -> None:
    """Two requests wait; a third one replaces the oldest."""
    server.peer.send(3)
    server.peer.ask(do="ask_often", goal=0, times=3)
    server.until(lambda: "more than 2 requests wait for one result" in server.refused()[1])
    server.ok(f"end 0 {SUCCEEDED} 1")
    server.until(lambda: len(server.peer.ask(do="answered")) == 2)
    assert server.peer.ask(do="answered") == [1, 2]
    assert server.refused()[0] == 0


def test_a_late_subscriber_gets_the_states(server: Server) -> None:
    server.peer.send(3)
    server.ok(f"end 0 {SUCCEEDED} 1")
    server.peer.ask(do="watch", action=DEVICE)
    server.until(lambda: server.peer.ask(do="statuses")[-1:] == [[[0, SUCCEEDED]]])


def test_a_result_above_its_limit_leaves_the_goal_active(server: Server) -> None:
    server.peer.send(3)
    code, error, _ = server.program.call(f"end 0 {SUCCEEDED} 20")
    assert code == 1
    assert "sequence" in error
    assert server.goal(0)[1] == EXECUTING
    server.ok(f"end 0 {SUCCEEDED} 1")
    code, _, _ = server.program.call(f"end 0 {SUCCEEDED} 1")
    assert code == 11  # RCL_RET_INVALID_ARGUMENT: it has ended
    assert server.program.call("feedback 0 1")[0] == 11


def test_the_agent_restarts_in_the_middle_of_a_goal(program: Path, image_port: Relay, domain: int) -> None:
    """The goal goes on without an agent; its states are published again, and its result is there for who asks."""
    with action_peer(domain) as peer:
        options = (domain, "--domain", str(domain), "--client-timeout", "3")
        with running_agent(*options) as first:
            image_port.connect(first.port)
            process = started(program)
            running = process.__enter__()
            server = Server(CommandedProgram(running), peer)
            assert peer.ask(do="wait", action=DEVICE, timeout=seconds(30))
            assert peer.send(3)["accepted"]
            assert peer.send(4)["accepted"]
            peer.ask(do="ask", goal=0)
        server.ok(f"end 0 {SUCCEEDED} 2")
        with running_agent(*options) as second:
            image_port.connect(second.port)
            peer.ask(do="watch", action=DEVICE)
            server.until(lambda: [1, EXECUTING] in (peer.ask(do="statuses") or [[]])[-1], 60)
            assert peer.ask(do="wait", action=DEVICE, timeout=seconds(30))
            assert server.goal(1) == [4, EXECUTING, 0]
            server.ok(f"end 1 {SUCCEEDED} 3")
            assert peer.result(1) == [SUCCEEDED, [0, 1, 1]]
            assert peer.send(5)["accepted"]
            assert running.stdin is not None
            running.stdin.write("end\n")
            ends_well(running)
            process.__exit__(None, None, None)


def assert_succeeds(peer: ActionPeer, order: int, numbers: list[int]) -> None:
    answer = peer.send(order)
    assert answer["accepted"]
    assert peer.result(answer["goal"]) == [SUCCEEDED, numbers]


def test_the_example_of_the_profile(images: Images, image_port: Relay, agent: object, domain: int) -> None:
    """It computes Fibonacci numbers; the type is that which rclpy has here."""
    text = (
        "version: 1\nprofiles: [pure_action_server]\nsession: {connect_timeout: 20 s, create_timeout: 20 s}\n"
        "nodes:\n  - name: device\n    namespace: /arm\n    actions:\n"
        "      - {name: fibonacci, type: test_msgs/action/Fibonacci, goals: 2, limits: {sequence: 16}}\n"
    )
    image = images.build(image_port.port, text, flags=(*QUICK, "-DEXAMPLE_PERIOD_MS=20"))
    program = image.out / "bin" / "pure_action_server"
    with action_peer(domain) as peer, started(program) as process:
        assert peer.ask(do="wait", action=DEVICE, timeout=seconds(30))
        received: list[list[int]] = []
        end = deadline(20)
        while not received:  # DDS connects the topic of feedback later than the services
            assert time.monotonic() < end
            assert_succeeds(peer, 8, FIBONACCI)
            received = [numbers for _, numbers in peer.ask(do="feedback")]
        assert_succeeds(peer, 0, [])
        assert peer.send(17)["accepted"] is False
        assert all(numbers == FIBONACCI[: len(numbers)] for numbers in received)
        kill(process)
