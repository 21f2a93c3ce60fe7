# SPDX-License-Identifier: Apache-2.0
"""A client of parameters whose agent and time are in the hands of the test: results, limits, and nodes that fail.

tests/e2e/test_parameter_client.py has rclpy.
"""

from __future__ import annotations

import random
import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.runtime.driver import Client, Result
from tests.support.runtime.harness import build
from tests.support.runtime.parameter_agent import ParameterAgent
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameter_client, +subscribe]
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameter_clients:
      - node: /motor
        operations: [get, set, set_atomically, list, describe, get_types, watch]
        string: 12
        elements: 3
"""
OK, ERROR, TIMEOUT, INVALID = 0, 1, 2, 11
REJECTED, MISMATCH, UNKNOWN, BUSY, IN_CALLBACK, LIMIT = 4001, 4002, 4011, 4012, 4013, 4014
BOOL, INT, DOUBLE, STRING, BYTES, BOOLS, INTS, DOUBLES, STRINGS = range(1, 10)
TIMEOUT_MS = 500
WRAP_MS = 256
"""port_fake.c begins so long before the milliseconds wrap."""
VALUES: dict[int, tuple[Any, str]] = {
    BOOL: (True, "1"),
    INT: (-(2**40), str(-(2**40))),
    DOUBLE: (0.25, "0.25"),
    STRING: ("twelve_bytes", "'twelve_bytes'"),
    BYTES: (bytes([0, 255, 7]), "0 255 7"),
    BOOLS: ([True, False, True], "1 0 1"),
    INTS: ([1, -(2**62), 3], f"1 {-(2**62)} 3"),
    DOUBLES: ([0.5, -2.0, 1e300], "0.5 -2 1e+300"),
    STRINGS: (["a", "", "twelve_bytes"], "'a' '' 'twelve_bytes'"),
}
"""By type: a value, and as the program prints it."""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("parameter_client") / "tree", APPLICATION)
    return build(tree.without_port(), ["port_fake.c", "client_parameter_client.c"], "parameter_client")


class Device:
    """The program, its agent and the other node."""

    def __init__(self, client: Client, agent: ParameterAgent) -> None:
        self.client, self.agent = client, agent
        self.client.ok("init")

    def lines(self, command: str) -> list[str]:
        return list(self.client.ok(command).lines)

    def fails(self, command: str, code: int) -> str:
        result: Result = self.client.call(command)
        assert result.code == code, result
        return result.error

    def spin(self, milliseconds: int = 0) -> list[str]:
        return self.lines(f"spin {milliseconds}")

    def result(self) -> list[str]:
        """Spin until the callback was called."""
        for _ in range(200):
            lines = self.spin(10)
            if any(line.startswith("done") for line in lines):
                return lines
        raise AssertionError("no result")

    def events(self, datagrams: list[bytes]) -> list[str]:
        self.client.queued += datagrams
        return [line for _ in range(12) for line in self.spin(5)]


@pytest.fixture
def device(program: Path) -> Iterator[Device]:
    # One publisher; then the subscription of events, and the clients.
    agent = ParameterAgent(mtu=256, reader=1, first_client=2)
    with Client(program, agent) as client:
        yield Device(client, agent)


@pytest.mark.parametrize("kind", VALUES)
def test_every_type_is_set_and_got(device: Device, kind: int) -> None:
    content, shown = VALUES[kind]
    words = shown.replace("'", "") if kind != STRINGS else "a twelve_bytes"
    device.client.ok(f"set {kind} name {words}")
    expected = content if kind != STRINGS else ["a", "twelve_bytes"]
    assert device.agent.parameters["name"] == (kind, expected)
    device.agent.parameters["name"] = (kind, content)
    assert device.lines(f"get {kind} name") == [f"value {kind} {shown}"]
    assert device.agent.seen[-1] == ("GetParameters", {"names": ["name"]})


def big_endian(kind: int, content: Any) -> bytes:
    """Return a response with one value, as a node with the other byte order writes it."""
    body = bytearray()

    def put(layout: str, *numbers: Any) -> None:
        width = struct.calcsize(f">{layout[-1]}")
        body.extend(bytes(-len(body) % width))
        body.extend(struct.pack(f">{layout}", *numbers))

    def put_text(text: str) -> None:
        put("I", len(text) + 1)
        body.extend(text.encode() + b"\0")

    scalars = {k: content if k == kind else 0 for k in (BOOL, INT, DOUBLE)}
    put("I", 1)
    put("BB", kind, scalars[BOOL])
    put("q", scalars[INT])
    put("d", scalars[DOUBLE])
    put_text(content if kind == STRING else "")
    for array, layout in ((BYTES, "B"), (BOOLS, "B"), (INTS, "q"), (DOUBLES, "d")):
        put("I", len(content) if array == kind else 0)
        for element in content if array == kind else ():
            put(layout, element)
    put("I", len(content) if kind == STRINGS else 0)
    for text in content if kind == STRINGS else ():
        put_text(text)
    return bytes(body)


@pytest.mark.parametrize("kind", VALUES)
def test_values_in_the_other_byte_order(device: Device, kind: int) -> None:
    content, shown = VALUES[kind]
    device.agent.parameters["name"] = (kind, content)
    device.agent.flags = 0
    device.agent.damage = lambda body: big_endian(kind, content)
    assert device.lines(f"get {kind} name") == [f"value {kind} {shown}"]


def test_empty_arrays_and_strings(device: Device) -> None:
    for kind in (STRING, BYTES, BOOLS, INTS, DOUBLES, STRINGS):
        device.client.ok(f"set {kind} empty")
        empty: Any = {STRING: "", BYTES: b""}.get(kind, [])
        assert device.agent.parameters["empty"] == (kind, empty)
        assert device.lines(f"get {kind} empty") == [f"value {kind}" + (" ''" if kind == STRING else "")]


def test_unknown_names_and_other_types(device: Device) -> None:
    device.agent.parameters |= {"gain": (INT, 3), "label": (STRING, "left")}
    assert "parameters of /motor: unknown name" in device.fails("get 2 nothing", UNKNOWN)
    assert "another type" in device.fails("get 3 gain", MISMATCH)
    assert "unknown name" in device.fails("names gain nothing", UNKNOWN)
    device.agent.known_alone = False
    assert device.lines("names gain nothing label") == ["value 2 3", "no value 4011", "value 4 'left'"]
    assert "unknown name" in device.fails("get 2 nothing", UNKNOWN)


def test_several_are_set_each_by_itself_or_all_or_none(device: Device) -> None:
    device.agent.rejects["b"] = "out of range"
    result = device.client.call("several each a=1 b=2 c")
    assert (result.code, result.error) == (REJECTED, "parameter not set: out of range")
    assert list(result.lines) == ["outcome 0 ''", "outcome 4001 'out of range'", "outcome 0 ''"]
    assert device.agent.parameters == {"a": (INT, 1), "c": (0, None)}
    result = device.client.call("several atomically a=5 b=2")
    assert (result.code, list(result.lines)) == (REJECTED, ["outcome 4001 'out of range'"])
    assert device.agent.parameters["a"] == (INT, 1)
    assert device.lines("several atomically a=5 d=6") == ["outcome 0 ''"]
    assert device.agent.parameters["d"] == (INT, 6)


def test_parameters_are_described(device: Device) -> None:
    device.agent.parameters |= {"gain": (INT, 3), "rate": (DOUBLE, 0.5), "label": (STRING, "left")}
    device.agent.descriptors |= {
        "gain": {
            "description": "Gain of the loop",
            "read_only": True,
            "integer_range": [{"from_value": -5, "to_value": 2**40, "step": 3}],
        },
        "rate": {
            "additional_constraints": "positive",
            "dynamic_typing": True,
            "floating_point_range": [{"from_value": -0.5, "to_value": 1e10, "step": 0.25}],
        },
    }
    gain = f"descriptor 'gain' 2 'Gain of the loop' '' 1 0 -5..{2**40} by 3"
    rate = "descriptor 'rate' 3 '' 'positive' 0 1 -0.5..1e+10 by 0.25"
    label = "descriptor 'label' 4 '' '' 0 0"
    assert device.lines("describe gain rate label") == [gain, rate, label]
    assert device.agent.seen[-1] == ("DescribeParameters", {"names": ["gain", "rate", "label"]})
    assert device.lines("get_descriptor rate") == [rate]
    device.client.ok("async_describe label gain")
    assert device.result() == ["done 0 ''", label, gain]
    assert "unknown name" in device.fails("get_descriptor nothing", UNKNOWN)
    assert "unknown name" in device.fails("describe gain nothing", UNKNOWN)
    device.agent.damage = lambda body: body[:-3]
    device.fails("describe gain", ERROR)
    device.agent.damage = lambda body: body
    device.agent.running = False
    assert "no response" in device.fails("describe gain", TIMEOUT)


def test_types_are_got(device: Device) -> None:
    device.agent.parameters |= {f"p{kind}": (kind, content) for kind, (content, _) in VALUES.items()}
    for kind in VALUES:
        assert device.lines(f"get_type p{kind}") == [f"type {kind}"]
    assert device.lines("types p9 p1 p4") == ["type 9", "type 1", "type 4"]
    device.client.ok("async_types p2 p8")
    assert device.result() == ["done 0 ''", "type 2", "type 8"]
    assert "unknown name" in device.fails("types p1 nothing", UNKNOWN)
    device.agent.known_alone = False
    assert device.lines("types p1 nothing") == ["type 1", "no type 4011"]
    assert "unknown name" in device.fails("get_type nothing", UNKNOWN)
    device.agent.change = lambda response: {"types": bytes([10])}
    device.fails("types p1", ERROR)
    device.agent.running = False
    assert "no response" in device.fails("get_type p1", TIMEOUT)


def test_names_are_listed(device: Device) -> None:
    device.agent.parameters |= {"motor.gain": (INT, 1), "label": (STRING, "x")}
    assert device.lines("list") == ["name 'motor.gain'", "name 'label'"]
    assert device.lines("list motor") == ["name 'motor.gain'"]
    assert device.lines("list none") == []


def test_asynchronous_calls(device: Device) -> None:
    device.agent.parameters["gain"] = (INT, 3)
    assert device.lines("async_names gain") == []
    assert device.result() == ["done 0 ''", "value 2 3"]
    device.client.ok("async_several each gain=9")
    assert device.result() == ["done 0 ''", "outcome 0 ''"]
    device.client.ok("async_several atomically gain=10")
    assert device.result() == ["done 0 ''", "outcome 0 ''"]
    device.client.ok("async_list")
    assert device.result() == ["done 0 ''", "name 'gain'"]
    device.client.ok("async_names unknown")
    assert device.result() == ["done 4011 'parameters of /motor: unknown name'"]
    assert device.spin(50) == []


def test_one_call_at_a_time(device: Device) -> None:
    device.agent.parameters["gain"] = (INT, 3)
    device.client.ok("async_names gain")
    assert "the last call has no result yet" in device.fails("get 2 gain", BUSY)
    assert "the last call has no result yet" in device.fails("async_names gain", BUSY)
    assert device.result() == ["done 0 ''", "value 2 3"]


def test_a_callback_does_not_wait(device: Device) -> None:
    device.agent.parameters["gain"] = (INT, 3)
    device.client.ok("inside")
    device.client.ok("async_names gain")
    assert device.result() == [
        "done 0 ''",
        "value 2 3",
        f"inside {IN_CALLBACK} 'parameters of /motor: a callback of its executor must not wait: "
        "make the call with _async'",
    ]
    assert device.lines("get 2 gain") == ["value 2 3"], "outside it does"
    device.client.ok("watch")
    lines = device.events(device.agent.event("/motor", changed=[("gain", INT, 4)]))
    assert lines == ["event changed gain 2 4", f"inside {IN_CALLBACK}"]


def test_a_node_that_does_not_run(device: Device) -> None:
    device.agent.running = False
    result = device.client.call("get 2 gain")
    assert (result.code, result.error) == (
        TIMEOUT,
        "parameters of /motor: no response within 500 ms: start the node",
    )
    assert TIMEOUT_MS <= result.slept < TIMEOUT_MS + 20
    device.client.ok("async_names gain")
    assert device.spin(TIMEOUT_MS - 100) == []
    assert device.spin(200) == ["done 2 'parameters of /motor: no response within 500 ms: start the node'"]


def test_a_late_response_is_not_taken_for_another(device: Device) -> None:
    device.agent.parameters["gain"] = (INT, 1)
    device.agent.running = False
    device.fails("get 2 gain", TIMEOUT)
    device.agent.running, device.agent.parameters["gain"] = True, (INT, 2)
    device.client.queued += device.agent.answer_late()
    assert device.lines("get 2 gain") == ["value 2 2"]
    device.agent.running = False
    device.client.ok("async_names gain")
    device.spin(TIMEOUT_MS + 100)
    device.agent.parameters["gain"] = (INT, 3)
    device.client.ok("async_names gain")
    late = device.agent.late.pop(0)
    device.client.queued += device.agent.give(*late)
    assert device.spin(100) == []
    device.client.queued += device.agent.answer_late()
    assert device.result() == ["done 0 ''", "value 2 3"]


@pytest.mark.parametrize("before_ms", range(0, WRAP_MS + 40, 60))
def test_the_clock_wraps_during_a_call(device: Device, before_ms: int) -> None:
    device.client.wait(before_ms)
    device.spin()
    device.agent.running = False
    result = device.client.call("get 2 gain")
    assert result.code == TIMEOUT
    assert TIMEOUT_MS <= result.slept < TIMEOUT_MS + 20
    device.client.ok("async_names gain")
    assert device.spin(TIMEOUT_MS - 50) == []
    assert len(device.spin(100)) == 1


def test_a_session_that_is_lost_during_a_call(device: Device) -> None:
    """The agent restarts: the call ends with its reason, and the next one works."""
    device.agent.parameters["gain"] = (INT, 1)
    device.agent.running = False
    device.client.ok("timeout 60000")
    device.client.ok("async_names gain")
    device.spin(50)
    device.agent.restart()
    lines = [line for _ in range(100) for line in device.spin(100) if line.startswith("done")]
    lost = "service /motor/get_parameters: a session was lost with 1 requests under way"
    assert lines == [f"done 1 '{lost}'"]
    device.agent.running = True
    assert device.lines("get 2 gain") == ["value 2 1"]


def test_a_silent_agent_during_a_call_that_waits(device: Device) -> None:
    device.agent.silent = True
    assert device.client.call("get 2 gain").code in (ERROR, TIMEOUT)
    device.agent.silent = False
    device.agent.parameters["gain"] = (INT, 1)
    for _ in range(100):
        if device.client.call("get 2 gain").code == OK:
            break
        device.spin(100)
    assert device.lines("get 2 gain") == ["value 2 1"]


def test_requests_above_the_limits(device: Device) -> None:
    fails = device.fails
    advice = "set parameter_clients: [{node: /motor"
    assert f"above 4: {advice}, parameters: 5}}]" in fails("names a b c d e", LIMIT)
    assert "too long a name" in fails(f"get 2 {'n' * 50}", LIMIT)
    assert f"above 12: {advice}, string: 13}}]" in fails(f"set 4 label {'x' * 13}", LIMIT)
    assert f"above 3: {advice}, elements: 4}}]" in fails("set 7 list 1 2 3 4", LIMIT)
    assert f"above 12: {advice}, string: 13}}]" in fails(f"set 9 list a {'x' * 13}", LIMIT)
    assert "too long a name" in fails(f"async_names {'n' * 50}", LIMIT)
    assert device.agent.seen == []
    device.agent.parameters["texts"] = (STRINGS, ["a", "b"])
    device.client.ok("capacity 1")
    assert "an array above your capacity" in fails("get 9 texts", LIMIT)
    device.agent.parameters["n" * 49] = (INT, 1)
    assert device.lines(f"names {' '.join(['n' * 49] * 4)}") == ["value 2 1"] * 4


def test_time_outs_that_are_none(device: Device) -> None:
    for timeout in (0, 2**31, 2**32 - 1):
        device.client.ok(f"timeout {timeout}")
        assert "timeout_ms" in device.fails("get 2 gain", INVALID)


def test_responses_above_the_limits(device: Device) -> None:
    """What has no room ends the call with its size; what has is given, whatever its limit."""
    large = re.compile(r"parameters of /motor: a response has \d+ bytes, \d+ fit: raise elements")
    device.agent.parameters["label"] = (STRING, "x" * 4000)
    assert large.match(device.fails("get 4 label", LIMIT))
    device.agent.parameters["label"] = (STRINGS, ["", "", "", ""])
    assert "above 3: set parameter_clients: [{node: /motor, elements: 4}]" in device.fails(
        "get 9 label", LIMIT
    )
    device.agent.rejects["label"] = "y" * 4000
    assert large.match(device.fails("set 2 label 1", LIMIT))
    device.agent.rejects.clear()
    device.agent.parameters = {f"{'n' * 300}{n}": (INT, n) for n in range(20)}
    assert large.match(device.fails("list", LIMIT))
    device.agent.parameters = {"gain": (INT, 1)}
    device.agent.descriptors["gain"] = {"description": "d" * 4000}
    assert large.match(device.fails("describe gain", LIMIT))
    device.client.ok("async_describe gain")
    assert device.result()[0].startswith(f"done {LIMIT} 'parameters of /motor: a response has ")
    device.agent.parameters = {"gain": (INT, 1)}
    assert device.lines("get 2 gain") == ["value 2 1"]


def test_responses_with_another_number_of_results(device: Device) -> None:
    device.agent.change = lambda response: {"results": response["results"] * 2}
    assert "another number of results" in device.fails("set 2 gain 1", ERROR)
    device.agent.change = lambda response: {"results": []}
    assert "another number of results" in device.fails("set 2 gain 1", ERROR)


def test_damaged_responses(device: Device) -> None:
    """Any change of bytes, or end, gives a result; sanitizers watch."""
    dice = random.Random(7)
    device.agent.parameters |= {str(kind): (kind, content) for kind, (content, _) in VALUES.items()}

    def damage(body: bytes) -> bytes:
        changed = bytearray(body)
        for _ in range(dice.randrange(1, 4)):
            changed[dice.randrange(len(changed))] = dice.choice((0, 1, 4, 127, 128, 255))
        return bytes(changed[: dice.randrange(len(changed)) if dice.random() < 0.3 else None])

    for kind in (INT, DOUBLE):
        name = f"{'integer' if kind == INT else 'floating_point'}_range"
        device.agent.descriptors[str(kind)] = {name: [{"from_value": 0, "to_value": 1, "step": 1}]}
    device.agent.damage = damage
    codes = set()
    for _ in range(60):
        for command in (
            *("names 4 7 9 5", "several each a=1 b=2", "list", "names 6 8 1 3"),
            *("describe 2 3 4", "types 1 2 3 4"),
        ):
            codes.add(device.client.call(command).code)
    assert OK in codes
    assert ERROR in codes
    device.agent.damage = lambda body: body
    assert device.lines("get 1 1") == ["value 1 1"]


def test_changes_are_watched(device: Device) -> None:
    device.client.ok("watch")
    event = device.agent.event
    assert device.events(event("/motor", new=[("a", INT, 1)])) == ["event new a 2 1"]
    changed = [("a", INT, 2), ("label", STRING, "left"), ("list", DOUBLES, [0.5, 1.5])]
    assert device.events(event("/motor", changed=changed, deleted=[("b", 0, None)])) == [
        "event changed a 2 2",
        "event changed label 4 'left'",
        "event changed list 8 0.5 1.5",
        "event deleted b 0",
    ]
    assert device.events(event("/other", new=[("a", INT, 1)])) == []
    assert device.events(event("/motors", new=[("a", INT, 1)])) == []
    device.client.ok("unwatch")
    assert device.events(event("/motor", new=[("a", INT, 1)])) == []


def test_a_restart_of_the_other_node_is_watched_and_called(device: Device) -> None:
    """Its parameters come as new ones; a call that it did not answer has timed out."""
    device.client.ok("watch")
    device.agent.running = False
    device.fails("get 2 gain", TIMEOUT)
    device.agent.running = True
    device.agent.parameters = {"gain": (INT, 7)}
    assert device.events(device.agent.event("/motor", new=[("gain", INT, 7)])) == ["event new gain 2 7"]
    assert device.lines("get 2 gain") == ["value 2 7"]


def test_events_that_are_too_large(device: Device) -> None:
    device.client.ok("watch")
    many = [(f"{'n' * 40}{n}", STRING, "x" * 60) for n in range(30)]
    assert device.events(device.agent.event("/motor", changed=many)) == ["event missed "]
    assert device.events(device.agent.event("/other", changed=many)) == []
    assert device.events(device.agent.event("/a" * 400, changed=many)) == []
    assert device.events(device.agent.event("/motor", new=[("a", INT, 1)])) == ["event new a 2 1"]


def test_an_event_that_is_damaged(device: Device) -> None:
    device.client.ok("watch")
    body = device.agent.encoded("rcl_interfaces/msg/ParameterEvent", {"node": "/motor"})
    assert device.events(device.agent.offer(1, body[:-4])) == ["event missed "]
    assert device.events(device.agent.offer(1, body)) == []


def test_events_and_calls_share_the_client(device: Device) -> None:
    device.client.ok("watch")
    device.agent.parameters["gain"] = (INT, 3)
    device.agent.running = False
    device.client.ok("async_names gain")
    assert device.events(device.agent.event("/motor", changed=[("a", INT, 2)])) == ["event changed a 2 2"]
    device.agent.running = True
    device.client.queued += device.agent.answer_late()
    assert device.result() == ["done 0 ''", "value 2 3"]


def test_a_client_is_closed_and_opened_again(device: Device) -> None:
    device.agent.parameters["gain"] = (INT, 3)
    device.client.ok("watch")
    device.client.ok("async_names gain")
    device.client.ok("close")
    assert "not open, or the operation is not declared" in device.fails("get 2 gain", ERROR)
    device.client.ok("open")
    assert device.lines("get 2 gain") == ["value 2 3"]
    assert device.spin(50) == []
    device.client.ok("watch")
    assert device.events(device.agent.event("/motor", new=[("a", INT, 1)])) == ["event new a 2 1"]


def test_a_node_that_is_not_declared(device: Device) -> None:
    error = device.fails("stranger", ERROR)
    assert "parameters of /stranger: the client is not declared" in error
    assert "parameter_clients: [{node: /stranger}]" in error
