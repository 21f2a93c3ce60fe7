# SPDX-License-Identifier: Apache-2.0
"""The applications of examples/, built and run as their page says: several at once under one agent, and rclpy."""

from __future__ import annotations

import time
from collections.abc import Mapping
from datetime import datetime, timezone
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess, running_agent
from tests.support.e2e.examples import NAMES, PAGE, Example, Examples, commands
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]

INT32, HEADER, JOINTS = "std_msgs/msg/Int32", "std_msgs/msg/Header", "sensor_msgs/msg/JointState"
SLACK_S = 1.0
"""How far the agent's time on the device may be off: half of the time-out of the question, and rounding."""

Samples = dict[str, list[Any]]


@pytest.fixture(scope="module")
def examples(tmp_path_factory: pytest.TempPathFactory, image_port: Relay) -> Examples:
    return Examples(tmp_path_factory.mktemp("examples"), image_port.port)


def collect(observer: Observer, found: Samples, wanted: Mapping[str, int]) -> None:
    """Add samples to `found` until each topic of `wanted` has as many."""
    end = deadline(30)
    while any(len(found.setdefault(topic, [])) < count for topic, count in wanted.items()):
        assert time.monotonic() < end, f"of {wanted}: { {t: len(v) for t, v in found.items()} }"
        for topic, value in observer.ask(do="samples"):
            found.setdefault(topic, []).append(value)
        time.sleep(0.02)


def listen(observer: Observer, topics: Mapping[str, str]) -> None:
    for topic, type_name in topics.items():
        observer.subscribe(topic, type_name, reliable=topic != "/stamps")


def speak(observer: Observer, topics: Mapping[str, str]) -> None:
    """Make the publishers, which say nothing yet."""
    for topic, type_name in topics.items():
        observer.ask(do="publish", topic=topic, type=type_name, values=[])


def say(observer: Observer, topic: str, type_name: str, *values: Mapping[str, Any]) -> None:
    observer.ask(do="publish", topic=topic, type=type_name, values=list(values))


def _publishes(node: str, topic: str, graph: dict[str, Any]) -> bool:
    return any(name == node for name, *_ in graph["publishers"].get(topic, []))


def meet(observer: Observer, matched: Mapping[str, int], node: str, *topics: str) -> None:
    """Wait until as many subscriptions as in `matched` exist, and the publishers of `node` on `topics`."""
    end = deadline(30)
    while any(observer.ask(do="matched", topic=topic) < count for topic, count in matched.items()):
        assert time.monotonic() < end, f"nobody subscribes to one of {list(matched)}"
        time.sleep(0.05)
    for topic in topics:
        observer.see(partial(_publishes, node, topic), 30)


def numbers(*values: int) -> list[dict[str, int]]:
    return [{"data": value} for value in values]


def test_topics(examples: Examples, agent: AgentProcess, observer: Observer) -> None:
    """A publisher, a subscriber, ping-pong and the executor with a trigger, at the same time."""
    listen(observer, {"/count": INT32, "/difference": INT32, "/ping": HEADER, "/pong": HEADER})
    speak(observer, {"/numbers": INT32, "/left": INT32, "/right": INT32, "/ping": HEADER, "/pong": HEADER})
    found: Samples = {}
    with examples.running("publisher", "subscriber", "ping_pong", "executor_trigger") as running:
        publisher, subscriber, ping_pong, _ = running
        check_publisher(publisher, observer, found)
        check_subscriber(subscriber, observer)
        check_trigger(observer, found)
        check_ping_pong(ping_pong, observer, found)


def check_publisher(publisher: Example, observer: Observer, found: Samples) -> None:
    publisher.wait_for("published 3")
    collect(observer, found, {"/count": 10})
    values = [sample["data"] for sample in found["/count"]]
    assert values == list(range(values[0], values[0] + len(values)))


def check_subscriber(subscriber: Example, observer: Observer) -> None:
    values = [3, -1, 2**31 - 1, -(2**31), 0, 4]
    meet(observer, {"/numbers": 1}, "/listener")
    say(observer, "/numbers", INT32, *numbers(*values))
    subscriber.wait_for("received 4")
    assert subscriber.log == [f"received {value}" for value in values]


def check_trigger(observer: Observer, found: Samples) -> None:
    """Two values of one sensor wait for the other's, and each finds its own."""
    meet(observer, {"/left": 1, "/right": 1}, "/pairing", "/difference")
    say(observer, "/left", INT32, *numbers(10, 20, 30))
    say(observer, "/right", INT32, *numbers(1, 2))
    collect(observer, found, {"/difference": 2})
    say(observer, "/right", INT32, *numbers(-3))
    collect(observer, found, {"/difference": 3})
    assert found["/difference"] == numbers(9, 18, 33)


def check_ping_pong(ping_pong: Example, observer: Observer, found: Samples) -> None:
    meet(observer, {"/ping": 2, "/pong": 2}, "/ping_pong", "/ping", "/pong")
    own = [ping for ping in found["/ping"] if ping["frame_id"] != "7_somebody"]
    collect(observer, found, {"/ping": len(own) + 1})
    first, second = found["/ping"][0]["frame_id"], found["/ping"][-1]["frame_id"]
    device = first.partition("_")[2]
    assert device == second.partition("_")[2]
    assert int(first.partition("_")[0]) < int(second.partition("_")[0])
    for number, ping in enumerate((first, second), 1):
        say(observer, "/pong", HEADER, {"frame_id": ping})
        assert ping_pong.wait_for("pong") == f"pong {number} answers {ping}"
    say(observer, "/pong", HEADER, {"frame_id": "1_somebody"})  # an answer to somebody else
    say(observer, "/ping", HEADER, {"frame_id": "7_somebody"})
    collect(observer, found, {"/pong": 4})
    assert sorted(pong["frame_id"] for pong in found["/pong"]) == sorted(
        [first, second, "1_somebody", "7_somebody"]
    )
    assert len(ping_pong.log) == 2


def test_devices(examples: Examples, agent: AgentProcess, observer: Observer) -> None:
    """Timers, memory of messages, time of the agent, at the same time."""
    begin = time.time()
    listen(observer, {"/blinks": INT32, "/joint_states": JOINTS, "/stamps": HEADER})
    speak(observer, {"/joint_commands": JOINTS})
    found: Samples = {}
    with examples.running("timers", "static_types", "time_sync", "epoch") as running:
        timers, static_types, _, epoch = running
        collect(observer, found, {"/blinks": 12})
        assert timers.wait_for("pauses") == "pauses: 100 ms, were 250 ms"
        blinks = [sample["data"] for sample in found["/blinks"]]
        assert blinks == [1 + (blinks[0] - 1 + i) % 3 for i in range(len(blinks))]
        check_static_types(static_types, observer, found)
        collect(observer, found, {"/stamps": 3})
        check_stamps(found["/stamps"], begin)
        check_epoch(epoch, begin)


def check_static_types(static_types: Example, observer: Observer, found: Samples) -> None:
    """What fits comes back; what is larger than the capacities is refused in words, what follows is not."""
    full = {"name": [f"a_joint_of_16_b{i}" for i in range(6)], "position": [i / 8 for i in range(6)]}
    large = {"name": ["one"] * 7}
    small = {"name": ["elbow"], "position": [-0.5]}
    meet(observer, {"/joint_commands": 1}, "/arm", "/joint_states")
    say(observer, "/joint_commands", JOINTS, full, large, small)
    collect(observer, found, {"/joint_states": 2})
    states = [{key: state[key] for key in ("name", "position")} for state in found["/joint_states"]]
    assert states == [full, small]
    assert [found["/joint_states"][0][key] for key in ("velocity", "effort")] == [[], []]
    assert static_types.log == []
    static_types.wait_for(
        "capacity for 6: set limits: {sensor_msgs/msg/JointState: {name: 7}} in microros.yaml"
    )
    static_types.complaints = ("spin: error ",)


def check_stamps(headers: list[Any], begin: float) -> None:
    stamps = [header["stamp"]["sec"] + header["stamp"]["nanosec"] * 1e-9 for header in headers]
    assert all(header["frame_id"] == "board" for header in headers)
    assert stamps == sorted(set(stamps))
    assert begin - SLACK_S < stamps[0]
    assert stamps[-1] < time.time() + SLACK_S


def check_epoch(epoch: Example, begin: float) -> None:
    times = [
        datetime.strptime(epoch.wait_for("UTC"), "%Y-%m-%d %H:%M:%S.%f UTC").replace(tzinfo=timezone.utc)
        for _ in range(2)
    ]
    assert begin - SLACK_S < times[0].timestamp() < times[1].timestamp() < time.time() + SLACK_S


def test_services(examples: Examples, agent: AgentProcess, observer: Observer) -> None:
    """rclpy asks the server; then the client asks rclpy, gets its three sums, and ends by itself."""
    examples.build_all(["add_two_ints_server", "add_two_ints_client"])
    pairs = [(2, 3), (-7, 7), (2**62, 2**62 - 1), (-(2**63), 1)]
    with examples.running("add_two_ints_server") as (server,):
        observer.ask(do="ask_sums", service="/add_two_ints", pairs=pairs)
        for _ in pairs:
            server.wait_for("=")
        end = deadline(30)
        while None in (sums := observer.ask(do="sums")):
            assert time.monotonic() < end, sums
            time.sleep(0.02)
    assert sums == [a + b for a, b in pairs]
    assert server.log == [f"{a} + {b} = {a + b}" for a, b in pairs]
    observer.ask(do="add", service="/add_two_ints")
    with examples.running("add_two_ints_client") as (client,):
        client.process.wait(timeout=seconds(30))
    observer.ask(do="add", service="/add_two_ints", ends=True)
    assert sorted(client.log) == ["1 + 10 = 11", "2 + 20 = 22", "3 + 30 = 33"]


def test_actions(examples: Examples, agent: AgentProcess) -> None:
    """The client begins before there is a server, gets all of its feedback in order, and ends by itself."""
    examples.build_all(["fibonacci_server", "fibonacci_client"])
    found = [0, 1, 1, 2, 3, 5, 8, 13]
    with examples.running("fibonacci_server") as (server,), examples.running("fibonacci_client") as (client,):
        client.process.wait(timeout=seconds(30))
        server.wait_for("ended with 8 numbers")
    lines = [" ".join(map(str, found[: i + 1])) for i in range(len(found))]
    first = client.log.index("accepted")
    reported = client.log[first + 1 :]
    assert reported[-1] == f"succeeded: {lines[-1]}"
    assert set(reported[:-1]) <= {f"feedback: {line}" for line in lines}
    assert reported[:-1] == sorted(reported[:-1], key=len)


def test_reconnection(
    tmp_path: Path, shared_agent: AgentProcess, observer: Observer, examples: Examples
) -> None:
    """The agent cannot be reached for a while; numbers and orders go on without a line of the application."""
    listen(observer, {"/alive": INT32})
    speak(observer, {"/orders": INT32})
    found: Samples = {}
    with Relay() as relay:
        relay.connect(shared_agent.port)
        with Examples(tmp_path, relay.port).running("reconnection") as (survivor,):
            meet(observer, {"/orders": 1}, "/survivor", "/alive")
            collect(observer, found, {"/alive": 2})
            relay.connect(0)
            survivor.wait_for("the agent is gone")
            relay.connect(shared_agent.port)
            assert survivor.wait_for("again") == "connected, 1 times again"
            before = len(found["/alive"])
            collect(observer, found, {"/alive": before + 5})
            meet(observer, {"/orders": 1}, "/survivor")
            say(observer, "/orders", INT32, *numbers(42))
            survivor.wait_for("order 42")
    values = [sample["data"] for sample in found["/alive"]]
    assert values == sorted(set(values))


def test_custom_transport(examples: Examples, domain: int, observer: Observer) -> None:
    """The agent has a pseudo-terminal, the example its device."""
    listen(observer, {"/over_own_line": INT32})
    found: Samples = {}
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty",)) as line,
        examples.running("custom_transport", argument=line.device),
    ):
        collect(observer, found, {"/over_own_line": 10})
    values = [sample["data"] for sample in found["/over_own_line"]]
    assert values == list(range(values[0], values[0] + len(values)))


def test_parameters(examples: Examples, agent: AgentProcess, observer: Observer) -> None:
    """`make demo` sets them; here the example runs with sanitizers."""
    wanted = {"/brightness": "std_msgs/msg/Float64", "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray"}
    listen(observer, wanted)
    found: Samples = {}
    with examples.running("parameters"):
        collect(observer, found, {"/brightness": 20, "/diagnostics": 1})
    assert {sample["data"] for sample in found["/brightness"]} == {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}
    (status,) = found["/diagnostics"][0]["status"]
    assert (status["name"], status["message"]) == ("dimmer", "the lamp is on")
    assert status["values"] == [{"key": "changes", "value": "0"}]


def test_the_page_has_every_example() -> None:
    """A row each, and the commands that this file runs: build, compile, an agent, the program."""
    for name in NAMES:
        assert f"| [{name}]({name}/main.c) | " in PAGE
    assert [command[0] for command in commands("epoch")] == [
        "microros-gen",
        "cc",
        "microros-gen",
        "build/epoch_main",
    ]
    assert commands("epoch")[2][1:3] == ["agent", "udp4"]
