# SPDX-License-Identifier: Apache-2.0
"""Action clients with a scripted agent: no answers, late ones, loss, lost sessions, clock wrap, wrong calls."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.runtime.driver import Client
from tests.support.runtime.harness import Tree, build
from tests.support.runtime.serving_agent import ServingAgent
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
components: [+action_client, +executor_nodes]
nodes:
  - name: device
    action_clients:
      - {name: walk, type: example_interfaces/action/Fibonacci, goals: 2, response_timeout: 500 ms, result_timeout: 3 s}
      - {name: find, type: tf2_msgs/action/LookupTransform}
limits: {"*": {string: 8, sequence: 4}}
"""
DROPS = APPLICATION.replace("components:", "on_full: drop_oldest\ncomponents:")
OWN_LIMITS = APPLICATION.replace(
    "{name: find, type: tf2_msgs/action/LookupTransform}",
    "{name: find, type: tf2_msgs/action/LookupTransform, limits: {string: 5}}\n"
    "      - {name: far, type: tf2_msgs/action/LookupTransform, limits: {string: 7}}",
)
STEP_MS, SPINS = 20, 12
ACCEPTED, SUCCEEDED, CANCELED = 1, 4, 5
SIZES = {"goal": 20, "cancel": 24, "result": 16}
"""Bytes of the bodies of requests: an id and an order, an id and a time, an id."""
FEEDBACK = (0 << 4 | 6).to_bytes(2, "big")
NEARLY_WRAPPED = 2**32 - 700


class Device:
    """The program, and the agent in the place of the server."""

    def __init__(self, client: Client, agent: ServingAgent) -> None:
        self.client, self.agent = client, agent

    def start(self) -> None:
        for call in ("init", "make"):
            self.client.ok(call)

    def spin(self, times: int = SPINS) -> list[str]:
        """Return what callbacks printed, and the texts of rounds that failed."""
        lines: list[str] = []
        for _ in range(times):
            self.client.wait(STEP_MS)
            result = self.client.call("spin")
            lines += [*result.lines, *([result.error] if result.code else [])]
        return lines

    def asked(self, what: str) -> list[int]:
        """Return the numbers of the requests of a sort among all."""
        return [i for i, (_, _, body) in enumerate(self.agent.calls) if len(body) == SIZES[what]]

    def identifier(self, goal: int) -> bytes:
        """Return the id of the goal that was sent as the `goal`-th."""
        return self.agent.calls[self.asked("goal")[goal]][2][:16]

    def answer(self, number: int, body: bytes) -> None:
        target, request, _ = self.agent.calls[number]
        self.client.queued += self.agent.give(target, request + target + body)

    def accept(self, number: int, accepted: bool = True) -> None:
        self.answer(number, bytes([accepted, 0, 0, 0]) + struct.pack("<II", 7, 8))

    def end(self, number: int, status: int, *sequence: int) -> None:
        self.answer(number, struct.pack(f"<bxxxI{len(sequence)}i", status, len(sequence), *sequence))

    def confirm(self, number: int, *identifiers: bytes) -> None:
        body = struct.pack("<bxxxI", 0, len(identifiers))
        self.answer(number, body + b"".join(i + bytes(8) for i in identifiers))

    def feed(self, identifier: bytes, *sequence: int) -> None:
        body = identifier + struct.pack(f"<I{len(sequence)}i", len(sequence), *sequence)
        self.client.queued += self.agent.give(FEEDBACK, body)

    def active(self, order: int = 3) -> int:
        """Send a goal and accept it; return its number."""
        self.client.ok(f"send {order}")
        goals = self.asked("goal")
        self.accept(goals[-1])
        assert self.spin() == [f"goal {len(goals) - 1} 1"]
        return len(goals) - 1


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    return write_application(tmp_path_factory.mktemp("action_client") / "tree", APPLICATION)


@pytest.fixture(scope="module")
def program(tree: Tree) -> Path:
    return build(tree.without_port(), ["port_fake.c", "client_action_client.c"], "action_client")


@pytest.fixture
def device(program: Path, tree: Tree) -> Iterator[Device]:
    yield from started(program, tree)


@pytest.fixture
def dropping(tmp_path: Path) -> Iterator[Device]:
    """The same device with `on_full: drop_oldest`."""
    tree = write_application(tmp_path / "tree", DROPS)
    yield from started(build(tree.without_port(), ["port_fake.c", "client_action_client.c"], "drops"), tree)


def started(program: Path, tree: Tree) -> Iterator[Device]:
    config = (tree.folder / "include/microros_config.h").read_text(encoding="utf-8")
    (size,) = re.findall(r"MICROROS_INPUT_SIZE (\d+)u", config)
    agent = ServingAgent(mtu=int(size))
    with Client(program, agent) as client:
        yield Device(client, agent)


def test_each_client_has_its_name(device: Device) -> None:
    device.start()
    assert device.client.ok("names").lines == ("names /walk /find 1",)


def test_each_client_has_its_limits(tmp_path: Path) -> None:
    """Another client of the same type has larger ones."""
    tree = write_application(tmp_path / "tree", OWN_LIMITS)
    program = build(tree.without_port(), ["port_fake.c", "client_action_client.c"], "own_limits")
    for device in started(program, tree):
        device.start()
        refused = device.client.call("look frame1")
        assert refused.code == 1
        assert "limit 5" in refused.error
        assert device.agent.calls == []
        device.client.ok("look frame")
        device.spin()
        ((_, _, body),) = device.agent.calls
        assert b"frame\0" in body


def test_callbacks_run_in_the_order_of_rclc(device: Device) -> None:
    """Everything arrives before one round: goal, feedback, cancel, result, one message of each."""
    device.start()
    first = device.active()
    device.client.ok(f"cancel {first}")
    device.client.ok("send 5")
    goals = device.asked("goal")
    device.spin(2)
    device.end(device.asked("result")[0], SUCCEEDED, 1, 2)
    device.confirm(device.asked("cancel")[0], device.identifier(first))
    device.feed(device.identifier(first), 1)
    device.accept(goals[1])
    assert sorted(found := device.spin(), key=lambda line: "gfcr".index(line[0])) == found
    assert found == ["goal 1 1", "feedback 0 1", "cancel 0 1", f"result 0 {SUCCEEDED} 1 2"]


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_a_goal_without_an_answer_is_not_accepted(device: Device, start_ms: int) -> None:
    """A late acceptance is dropped, and the place is free before."""
    device.client.wait(start_ms)
    device.start()
    for order in (1, 2):
        device.client.ok(f"send {order}")
    refused = device.client.call("send 3")
    assert refused.code == 1
    assert "more than 2 goals at once" in refused.error
    found = device.spin(40)
    assert found[:2] == ["goal 0 0", "goal 1 0"]
    assert "no response to a goal or a cancel request within 500 ms" in found[2]
    for number in device.asked("goal"):
        device.accept(number)
    assert device.spin() == []
    assert device.active() == 2


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_a_result_that_does_not_arrive_is_unknown(device: Device, start_ms: int) -> None:
    """The other goal keeps its request, although it is older."""
    device.client.wait(start_ms)
    device.start()
    first = device.active()
    device.spin(40)
    second = device.active()
    found = device.spin(110)
    assert found[0] == f"result {first} 0"
    assert "no result within 3000 ms: raise the result_timeout of its action_clients" in found[1]
    assert found[2:] == []
    third = device.active()
    late, alive, last = device.asked("result")
    device.end(late, SUCCEEDED, 1)
    device.end(alive, SUCCEEDED, 2)
    device.end(last, SUCCEEDED, 3)
    assert device.spin() == [f"result {second} {SUCCEEDED} 2", f"result {third} {SUCCEEDED} 3"]


def test_goals_are_canceled_in_every_state(device: Device) -> None:
    device.start()
    device.client.ok("send 1")
    device.client.ok("cancel 0")  # before its acceptance: the server says that it does not know it
    device.spin(2)
    device.confirm(device.asked("cancel")[0])
    assert device.spin(4) == ["cancel 0 0"]
    device.accept(device.asked("goal")[0])
    assert device.spin(4) == ["goal 0 1"]
    for _ in range(2):  # the answer to the second request alone is reported
        device.client.ok("cancel 0")
    device.spin(2)
    _, second, third = device.asked("cancel")
    device.confirm(second)
    device.confirm(third, device.identifier(0))
    assert device.spin(4) == ["cancel 0 1"]
    device.client.ok("cancel 0")  # no answer: it is canceling already
    found = device.spin(40)
    assert found[0] == "cancel 0 0"
    assert "within 500 ms" in found[1]
    device.end(device.asked("result")[0], CANCELED)
    assert device.spin(4) == [f"result 0 {CANCELED}"]
    assert device.client.call("cancel 0").code == 11
    assert device.client.call("ask 0").code == 11


def test_a_goal_that_is_canceled_without_an_answer_is_still_reported(device: Device) -> None:
    """Both requests are silent: two callbacks, the goal's first."""
    device.start()
    device.client.ok("send 1")
    device.client.ok("cancel 0")
    assert [line for line in device.spin(40) if "walk" not in line] == ["goal 0 0"]


def test_results_are_asked_for_again_in_a_new_session(device: Device) -> None:
    device.start()
    goal = device.active()
    device.agent.silent = True
    device.spin(60)
    device.agent.silent = False
    device.agent.restart()
    before = len(device.asked("result"))
    assert [line for line in device.spin(60) if line.startswith("goal")] == []
    assert len(device.asked("result")) == before + 1
    device.end(device.asked("result")[-1], SUCCEEDED, 4)
    assert device.spin() == [f"result {goal} {SUCCEEDED} 4"]


def test_a_request_for_a_result_that_the_stream_dropped_is_sent_again(dropping: Device) -> None:
    """Other requests took its place while the agent took nothing; without a result_timeout the goal would not end."""
    dropping.start()
    dropping.client.ok("send 3")
    dropping.accept(dropping.asked("goal")[0])
    dropping.agent.drop = lambda _: True
    assert dropping.spin(2) == ["goal 0 1"]
    for _ in range(8):
        dropping.client.ok("cancel 0")
    dropping.agent.drop = lambda _: False
    dropping.spin(40)
    (number,) = dropping.asked("result")
    dropping.end(number, SUCCEEDED, 5)
    assert dropping.spin() == [f"result 0 {SUCCEEDED} 5"]


def test_every_third_datagram_is_lost(device: Device) -> None:
    device.start()
    seen = 0

    def is_lost(datagram: bytes) -> bool:
        nonlocal seen
        seen += 1
        return seen % 3 == 0

    device.agent.drop = is_lost
    device.client.ok("send 7")
    device.spin(8)
    device.accept(device.asked("goal")[0])
    assert device.spin(14) == ["goal 0 1"]
    device.spin(20)
    device.end(device.asked("result")[0], SUCCEEDED, 9)
    assert device.spin(60) == [f"result 0 {SUCCEEDED} 9"]


def test_feedback_that_cannot_be_read(device: Device) -> None:
    """That of others is not decoded, whatever it is; of an own goal it is a fault of the round."""
    device.start()
    goal = device.active()
    damaged = struct.pack("<Ii", 9, 1)
    device.client.queued += device.agent.give(FEEDBACK, bytes(16) + damaged)
    device.feed(device.identifier(goal), 1, 2)
    assert device.spin() == [f"feedback {goal} 2"]
    for body in (device.identifier(goal) + damaged, device.identifier(goal)[:9]):
        device.client.queued += device.agent.give(FEEDBACK, body)
        (fault,) = device.spin()
        assert "Fibonacci_FeedbackMessage." in fault


@pytest.mark.parametrize(
    ("call", "code", "text"),
    [
        ("name", 1, "action client not declared: add to its node's action_clients"),
        ("type", 1, "action client not declared: add to its node's action_clients"),
        ("twice", 1, "open already"),
        ("goals", 1, "more than 2 goals at once: set the goals of its action_clients: 3"),
        ("closed", 1, "action client not open: open it, and add it to an executor"),
        ("no_feedback", 11, "callbacks"),
    ],
)
def test_wrong_calls_say_what_to_do(device: Device, call: str, code: int, text: str) -> None:
    device.start()
    refused = device.client.call(f"refuse {call}")
    assert refused.code == code
    assert text in refused.error
    device.active()  # the open one is as it was


@pytest.mark.parametrize("sort", ["goal", "feedback", "cancel", "result"])
def test_a_callback_closes_its_client(device: Device, sort: str) -> None:
    device.start()
    device.client.ok("send 1")
    device.client.ok(f"close_in {sort}")
    device.accept(device.asked("goal")[0])
    device.client.wait(STEP_MS)
    found = list(device.client.call("spin").lines)
    if sort != "goal":
        device.client.ok("cancel 0")
        device.spin(2)
        device.feed(device.identifier(0), 1)
        device.confirm(device.asked("cancel")[0], device.identifier(0))
        device.end(device.asked("result")[0], SUCCEEDED)
        device.client.wait(STEP_MS)
        found += device.client.call("spin").lines
    assert found[-1].startswith(sort)
    device.client.ok("remove")
    assert device.spin(2) == []


def test_a_client_is_removed_and_added_while_a_goal_is_active(device: Device) -> None:
    """What arrives meanwhile waits; with the semantics of rclc's LET, too."""
    device.start()
    device.client.ok("let")
    goal = device.active()
    device.client.ok("remove")
    device.end(device.asked("result")[0], SUCCEEDED, 1)
    assert device.spin() == []
    device.client.ok("add")
    assert device.spin() == [f"result {goal} {SUCCEEDED} 1"]


def test_a_client_is_added_again_with_fewer_goals_than_are_active(device: Device) -> None:
    """Those that are active end; then there is one place."""
    device.start()
    first, second = device.active(), device.active()
    device.client.ok("remove")
    device.client.ok("add 1")
    for number in device.asked("result"):
        device.end(number, SUCCEEDED, 1)
    assert sorted(device.spin()) == [f"result {goal} {SUCCEEDED} 1" for goal in (first, second)]
    device.active()
    refused = device.client.call("send 3")
    assert refused.code == 1
    assert "more than 1 goals at once" in refused.error


def test_a_client_leaves_an_executor_with_its_node_and_returns(device: Device) -> None:
    device.start()
    goal = device.active()
    assert device.client.ok("query").lines == ("nodes 2 0",)
    device.client.ok("leave")
    assert device.client.ok("query").lines == ("nodes 0 2",)
    device.end(device.asked("result")[0], SUCCEEDED, 1)
    assert device.spin() == []
    device.client.ok("return")
    assert device.client.ok("query").lines == ("nodes 2 0",)
    assert device.spin() == [f"result {goal} {SUCCEEDED} 1"]


def test_a_goal_that_is_rejected_has_no_other_callbacks(device: Device) -> None:
    """Although the response to its cancel request comes in the same round."""
    device.start()
    device.client.ok("send 1")
    device.client.ok("cancel 0")
    device.spin(2)
    device.confirm(device.asked("cancel")[0])
    device.accept(device.asked("goal")[0], accepted=False)
    assert device.spin() == ["goal 0 0"]
