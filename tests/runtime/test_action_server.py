# SPDX-License-Identifier: Apache-2.0
"""Action servers with a scripted agent: loss, lost sessions, clock wrap, requests above the limits, wrong calls."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import Tree, build
from tests.support.runtime.serving_agent import ServingAgent, identity
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
components: [+action_server]
memory: {arena: 1024}
nodes:
  - name: device
    actions:
      - {name: walk, type: example_interfaces/action/Fibonacci, goals: 2, result_timeout: 1 s}
      - {name: find, type: tf2_msgs/action/LookupTransform}
limits: {"*": {string: 8, sequence: 4}}
"""
WALK, FIND = "example_interfaces/action/Fibonacci", "tf2_msgs/action/LookupTransform"
PUBLISHERS, STEP_MS, SPINS = 4, 20, 12
STATUS = 1
PLACES = {"send_goal": 0, "cancel_goal": 1, "get_result": 2}
ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(1, 7)
NEARLY_WRAPPED = 2**32 - 700


class Device:
    """The program and its agent; a goal's id is its number."""

    def __init__(self, client: Client, agent: ServingAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec, self._requests = client, agent, codec, 0

    def start(self) -> None:
        for call in ("init", "make"):
            self.client.ok(call)

    def spin(self, times: int = SPINS) -> list[int]:
        """Return the codes other than 0."""
        codes = []
        for _ in range(times):
            self.client.wait(STEP_MS)
            codes.append(self.client.call("spin").code)
        return [code for code in codes if code]

    def request(self, service: str, kind: str, members: dict[str, Any], server: int = 0) -> int:
        body = self._codec.encode(f"{kind}_Request", members)[ENCAPSULATION_BYTES:]
        self._requests += 1
        target = ((PUBLISHERS + 3 * server + PLACES[service]) << 4 | 8).to_bytes(2, "big")
        self.client.queued += self.agent.give(target, identity(self._requests) + body)
        return self._requests

    def answer(self, kind: str, number: int) -> Any:
        """Return the response; None without one."""
        found = [b[24:] for b in self.agent.answered if b[:24] == identity(number)]
        assert len(found) < 2
        return self._codec.decode(f"{kind}_Response", b"\0\1\0\0" + found[0]) if found else None

    def ask(self, service: str, kind: str, members: dict[str, Any], server: int = 0) -> Any:
        number = self.request(service, kind, members, server)
        self.spin()
        return self.answer(kind, number)

    def send(self, goal: int) -> bool:
        answer = self.ask("send_goal", f"{WALK}_SendGoal", {"goal_id": uuid(goal), "goal": {"order": goal}})
        return bool(answer["accepted"])

    def find(self, frame: str) -> bool:
        members = {
            "goal_id": uuid(99),
            "goal": {"target_frame": frame, "source_frame": "b", "fixed_frame": "c"},
        }
        return bool(self.ask("send_goal", f"{FIND}_SendGoal", members, server=1)["accepted"])

    def ask_result(self, goal: int) -> int:
        return self.request("get_result", f"{WALK}_GetResult", {"goal_id": uuid(goal)})

    def result(self, number: int) -> tuple[int, list[int]] | None:
        answer = self.answer(f"{WALK}_GetResult", number)
        return None if answer is None else (answer["status"], list(answer["result"]["sequence"]))

    def result_of(self, goal: int) -> tuple[int, list[int]] | None:
        number = self.ask_result(goal)
        self.spin()
        return self.result(number)

    def statuses(self) -> list[list[tuple[int, int]]]:
        """Return for each message the goals and their states."""
        found = []
        for target, body in self.agent.written:
            if target == ((STATUS << 4) | 5).to_bytes(2, "big"):
                message = self._codec.decode("action_msgs/msg/GoalStatusArray", b"\0\1\0\0" + body)
                found.append(
                    [(s["goal_info"]["goal_id"]["uuid"][0], s["status"]) for s in message["status_list"]]
                )
        return found

    def refused(self) -> list[int]:
        (line,) = self.client.ok("refused").lines
        return [int(word) for word in line.split()[1:]]


def uuid(goal: int) -> dict[str, Any]:
    return {"uuid": [goal, *range(15)]}


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    return write_application(tmp_path_factory.mktemp("actions") / "tree", APPLICATION)


@pytest.fixture(scope="module")
def program(tree: Tree) -> Path:
    return build(tree.without_port(), ["port_fake.c", "client_actions.c"], "actions")


@pytest.fixture(scope="module")
def codec() -> Codec:
    names = (WALK, FIND, "action_msgs/srv/CancelGoal", "action_msgs/msg/GoalStatusArray")
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces(tuple(Named(name, None) for name in names), finder, Diagnostics()))


@pytest.fixture
def device(program: Path, tree: Tree, codec: Codec) -> Iterator[Device]:
    config = (tree.folder / "include/microros_config.h").read_text(encoding="utf-8")
    (size,) = re.findall(r"MICROROS_INPUT_SIZE (\d+)u", config)
    agent = ServingAgent(mtu=int(size))
    with Client(program, agent) as client:
        yield Device(client, agent, codec)


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_a_result_is_there_before_and_after_the_end_until_it_expires(device: Device, start_ms: int) -> None:
    device.client.wait(start_ms)
    device.start()
    assert device.send(3)
    waiting = device.ask_result(3)
    device.spin()
    assert device.result(waiting) is None
    device.client.ok(f"end 0 {SUCCEEDED}")
    device.spin()
    assert device.result(waiting) == (SUCCEEDED, [5])
    assert device.result_of(3) == (SUCCEEDED, [5])
    device.spin(60)
    assert device.result_of(3) == (0, [])
    states = [message[0][1] for message in device.statuses() if message]
    assert states == [ACCEPTED, EXECUTING, SUCCEEDED]
    assert device.client.call(f"end 0 {SUCCEEDED}").code == 11


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_places_of_goals_without_a_request_are_free_after_the_time_out(device: Device, start_ms: int) -> None:
    device.client.wait(start_ms)
    device.start()
    for goal in (1, 2):
        assert device.send(goal)
        device.client.ok(f"end {goal - 1} {ABORTED}")
    assert not device.send(3)
    assert device.refused() == [1, 0]
    device.spin(60)
    assert device.send(4)


def test_every_third_datagram_is_lost(device: Device) -> None:
    device.start()
    seen = 0

    def is_lost(datagram: bytes) -> bool:
        nonlocal seen
        seen += 1
        return seen % 3 == 0

    device.agent.drop = is_lost
    number = device.request("send_goal", f"{WALK}_SendGoal", {"goal_id": uuid(7), "goal": {"order": 7}})
    device.spin(200)
    assert device.answer(f"{WALK}_SendGoal", number)["accepted"]
    waiting = device.ask_result(7)
    device.spin(100)
    assert device.result(waiting) is None
    device.client.ok(f"end 0 {SUCCEEDED}")
    device.spin(100)
    assert device.result(waiting) == (SUCCEEDED, [5])


def test_states_are_published_again_in_a_new_session(device: Device) -> None:
    device.start()
    assert device.send(1)
    assert device.send(2)
    device.agent.silent = True
    device.spin(400)  # the session is lost
    device.client.ok(f"end 1 {SUCCEEDED}")
    device.agent.silent = False
    device.agent.restart()
    before = len(device.statuses())
    device.spin(600)
    assert device.statuses()[before:] == [[(1, EXECUTING)]]  # the result of goal 2 expired meanwhile
    device.client.ok(f"end 0 {SUCCEEDED}")
    assert device.result_of(1) == (SUCCEEDED, [5])


def test_requests_above_the_limits_are_refused_and_answered(device: Device) -> None:
    """By a little, so that they arrive; by so much that only their beginning does."""
    device.start()
    for size in (20, 60, 400):
        number = device.request(
            "send_goal",
            f"{FIND}_SendGoal",
            {"goal_id": uuid(9), "goal": {"target_frame": "x" * size, "source_frame": "", "fixed_frame": ""}},
            server=1,
        )
        assert set(device.spin(30)) == {1}
        assert not device.answer(f"{FIND}_SendGoal", number)["accepted"]
    assert device.refused() == [0, 3]
    assert device.find("12345678")
    assert device.client.ok("frame").lines == ("frame 12345678",)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        ("name", "action not declared: add to its node's actions"),
        ("type", "action not declared: add to its node's actions"),
        ("twice", "open already"),
        ("goals", "3 goals at once, 2 are declared"),
        ("size", "its goal requests have"),
    ],
)
def test_wrong_calls_say_what_to_do(device: Device, call: str, text: str) -> None:
    device.start()
    refused = device.client.call(f"refuse {call}")
    assert refused.code == 1
    assert text in refused.error
    assert device.send(5)  # the open one is as it was


def test_the_functions_of_rcl_action_know_servers_and_goals(device: Device) -> None:
    """A goal exists until its result expires, as in rcl_action; that of another server does not."""
    device.client.ok("init")
    assert device.client.ok("valid").lines == ("valid 0 0 0 0",)
    device.client.ok("make")
    assert device.client.ok("valid").lines == ("valid 1 0 0 0",)
    assert device.client.ok("known 3").lines == ("known 0 0",)
    assert device.send(3)
    assert device.client.ok("known 3").lines == ("known 1 0",)
    device.client.ok(f"end 0 {SUCCEEDED}")
    assert device.result_of(3) == (SUCCEEDED, [5])
    assert device.client.ok("known 3").lines == ("known 1 0",)
    device.spin(60)
    assert device.client.ok("known 3").lines == ("known 0 0",)


def test_goals_are_listed_with_their_states(device: Device) -> None:
    """None of a closed server; ended goals until their results expire; not those of another server."""
    device.client.ok("init")
    assert device.client.call("goals walk").code == 2200
    device.client.ok("make")
    assert device.client.ok("name").lines == ("name /walk /find",)
    assert device.client.ok("goals walk").lines == ()
    for goal in (3, 4):
        assert device.send(goal)
    assert device.find("a")
    assert device.client.ok("goals walk").lines == ("goal 3 2 1 1", "goal 4 2 1 1")
    assert device.client.ok("goals find").lines == ("goal 99 2 1 1",)
    device.ask("cancel_goal", "action_msgs/srv/CancelGoal", {"goal_info": {"goal_id": uuid(4)}})
    device.client.ok(f"end 0 {SUCCEEDED}")
    assert device.client.ok("goals walk").lines == ("goal 3 4 0 0", "goal 4 3 1 0")
    device.spin(60)
    assert device.client.ok("goals walk").lines == ("goal 4 3 1 0",)


def test_goals_expire_where_the_program_asks(device: Device) -> None:
    """Not before their time, not while their results are awaited, and no more than the list has room for."""
    device.start()
    for goal in (3, 4):
        assert device.send(goal)
        device.client.ok(f"end {goal - 3} {SUCCEEDED}")
    assert device.client.ok("expire 2").lines == ()
    device.client.wait(1000)
    assert device.client.ok("expire 1").lines == ("expired 3",)
    assert device.client.ok("goals walk").lines == ("goal 4 4 0 0",)
    assert device.client.ok("expire 0").lines == ()
    assert device.client.ok("goals walk").lines == ()
    assert device.send(5)


def test_a_program_publishes_feedback_and_states_itself(device: Device) -> None:
    device.start()
    device.spin()
    before = len(device.statuses())
    device.client.ok("say 9")
    device.spin()
    assert device.statuses()[before:] == [[(9, EXECUTING)]]
    assert any(body[:1] == b"\x09" for target, body in device.agent.written if target == b"\0\x05")


def test_a_server_is_added_again_with_fewer_goals_than_are_active(device: Device) -> None:
    """Those that are active end; then there is one place."""
    device.start()
    assert device.send(3)
    assert device.send(4)
    device.client.ok("remove")
    device.client.ok("add 1")
    waiting = [device.ask_result(3), device.ask_result(4)]
    for goal in range(2):
        device.client.ok(f"end {goal} {SUCCEEDED}")
    device.spin()
    assert [device.result(number) for number in waiting] == [(SUCCEEDED, [5])] * 2
    assert device.send(5)
    assert not device.send(6)


def test_a_callback_closes_its_server(device: Device) -> None:
    device.start()
    device.client.ok("close")
    number = device.request("send_goal", f"{WALK}_SendGoal", {"goal_id": uuid(7), "goal": {"order": 7}})
    device.client.wait(STEP_MS)
    device.spin(3)
    assert device.answer(f"{WALK}_SendGoal", number) is None
    device.client.ok("remove")
    assert device.find("a")
