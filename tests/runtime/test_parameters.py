# SPDX-License-Identifier: Apache-2.0
"""A parameter server whose agent and time are in the hands of the test: full streams, lost sessions, large requests.

tests/e2e/test_parameters.py has rclpy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from typing import Any

import pytest

from microros_gen.ros.codec import Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.parameter_device import INTEGER, Device, parameter_codec
from tests.support.runtime.parameter_program import (
    WRAP_MS,
    Program,
    is_acknowledgement,
    program_of,
)
from tests.support.runtime.serving_agent import ServingAgent

MANY = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
pools: {history: 2}
"""
FEW = MANY.replace("publishers:", "parameters: [{name: a, type: integer}]\n    publishers:")
TEXTS = MANY.replace(
    "publishers:",
    "parameters: [{name: label, type: string, size: 8}, {name: n, type: integer}]\n    publishers:",
)
LISTED = TEXTS.replace("{name: n,", "{name: mode, type: integer, one_of: [0, 5]}, {name: n,")
LARGE = "the request is too large, none of it was set"
COUNT_WRITER = 1
MOST = 65535
Programs = Callable[[str], Program]


@pytest.fixture(scope="module")
def codec() -> Codec:
    return parameter_codec()


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Programs:
    """Return a function that builds the program of an application when a test first needs it."""

    @cache
    def built(text: str) -> Program:
        return program_of(tmp_path_factory.mktemp("parameters") / "a", text)

    return built


@pytest.fixture
def stack() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


def started(programs: Programs, stack: ExitStack, codec: Codec, text: str = MANY) -> Device:
    agent = ServingAgent(mtu=200)
    client = stack.enter_context(Client(programs(text).path, agent))
    client.ok("init")
    return Device(client, agent, codec)


@pytest.fixture
def device(programs: Programs, stack: ExitStack, codec: Codec) -> Device:
    return started(programs, stack, codec)


def test_two_sets_of_a_request_where_the_stream_has_two_slots(device: Device) -> None:
    """One slot is the reply's: the second event waits, and comes when the first is acknowledged."""
    device.open("a", "b")
    device.spin(12)
    assert device.events() == [{"new": ["a"]}, {"new": ["b"]}]
    device.agent.written.clear()
    device.agent.drop_answer = is_acknowledgement
    number = device.set(("a", 1), ("b", 2))
    assert device.spin(12) == []
    assert device.reply("set_parameters", number)["results"] == [{"successful": True, "reason": ""}] * 2
    assert device.events() == [{"cha": ["a"]}]
    device.agent.drop_answer = lambda datagram: False
    device.spin(40)
    assert device.events() == [{"cha": ["a"]}, {"cha": ["b"]}]
    assert device.client.statistics()["dropped"] == 0


def test_changes_while_an_event_waits_are_one_event(device: Device) -> None:
    """Deleted and added meanwhile: a place is free only when its event was sent."""
    device.open("a", "b")
    device.spin(12)
    device.agent.written.clear()
    device.agent.drop_answer = is_acknowledgement
    for _ in range(2):
        device.client.ok("publish")
    for call in ("delete a", "add c", "add d"):
        device.client.ok(call)
    assert device.client.call("add e").code != 0, "four places, one of them waits for its event"
    device.spin(12)
    assert device.events() == []
    device.agent.drop_answer = lambda datagram: False
    device.spin(40)
    assert device.events() == [{"new": ["c", "d"], "del": ["a"]}]
    device.client.ok("add e")


def test_a_server_opened_while_the_stream_is_full(device: Device) -> None:
    device.agent.drop_answer = is_acknowledgement
    while device.client.call("publish").code == 0:
        pass
    device.open("a", "b")
    number = device.set(("a", 5))
    device.spin(12)
    assert (device.agent.answered, device.events()) == ([], [])
    device.agent.drop_answer = lambda datagram: False
    device.spin(60)
    assert device.reply("set_parameters", number)["results"] == [{"successful": True, "reason": ""}]
    assert device.client.ok("get a").lines == ("value 5",)
    assert device.events()[0] in ({"new": ["a", "b"]}, {"new": ["b"], "cha": ["a"]})


def test_a_lost_session_and_the_wrap_of_the_clock(device: Device) -> None:
    """A request that waits when the agent is replaced is answered by way of the new one, which gets every entity."""
    device.open("a")
    device.spin(12)
    objects = set(device.agent.objects)
    device.agent.drop_answer = is_acknowledgement
    while device.client.call("publish").code == 0:
        pass
    number = device.set(("a", 7))
    device.spin(3)
    device.agent.restart()
    device.agent.drop_answer = lambda datagram: False
    for _ in range(100):
        device.spin(40)
        if device.agent.answered:
            break
    assert device.client.now_ms > WRAP_MS
    assert device.client.statistics()["reconnects"] == 1
    assert set(device.agent.objects) == objects
    assert device.reply("set_parameters", number)["results"] == [{"successful": True, "reason": ""}]
    device.spin(12)
    assert device.events()[-1] == {"cha": ["a"]}
    values = device.call("get_parameters", names=["a"])["values"]
    assert [value["integer_value"] for value in values] == [7]


def test_closed_and_opened_again(device: Device) -> None:
    """The parameters of before are gone; services and events are there."""
    device.open("a", "b")
    device.spin(12)
    device.client.ok("close")
    repliers = [o for o in device.agent.objects if o[1] & 15 == 8]
    assert repliers == []
    device.agent.written.clear()
    device.open("c")
    device.spin(12)
    assert device.call("list_parameters", prefixes=[], depth=0)["result"]["names"] == ["c"]
    assert device.events() == [{"new": ["c"]}]
    number = device.set(("c", 3))
    device.spin(12)
    assert device.reply("set_parameters", number)["results"][0]["successful"]
    assert device.call("describe_parameters", names=["c"] * 90)["descriptors"] == []


@pytest.mark.parametrize(
    ("text", "mtu", "count"),
    [
        (MANY, 64, 60),
        (MANY, MOST, 60),
        pytest.param(FEW, MOST, 60, marks=pytest.mark.variant),
        pytest.param(FEW, MOST, 7, marks=pytest.mark.variant),
    ],
    ids=["small fragments", "fragments", "only large ones in fragments", "whole"],
)
def test_large_requests(
    programs: Programs, stack: ExitStack, codec: Codec, text: str, mtu: int, count: int
) -> None:
    """Each is answered in its turn, counted and reported once; the next one is as any other."""
    device = started(programs, stack, codec, text)
    device.open("a")
    device.spin(12)
    device.agent.mtu = min(mtu, programs(text).input_size)
    before = device.client.statistics()
    names = ["a"] * count
    numbers = [
        device.ask("get_parameters", names=names),
        device.ask("get_parameters", names=["a"]),
        device.ask("get_parameters", names=names),
    ]
    failed = device.spin(60)
    numbers += [device.set(*[("a", 5)] * 15), device.set(("a", 6))]
    failed += device.spin(60)
    assert [device.reply("get_parameters", n)["values"] != [] for n in numbers[:3]] == [False, True, False]
    results = device.reply("set_parameters", numbers[3])["results"]
    assert not any(result["successful"] for result in results)
    assert [result["reason"] for result in results[:1]] == ([LARGE] if results else [])
    assert text == FEW or len(results) == 15
    assert device.reply("set_parameters", numbers[4])["results"] == [{"successful": True, "reason": ""}]
    assert device.client.ok("get a").lines == ("value 6",)
    assert len(failed) == 3
    assert all("fit: raise limits" in result.error for result in failed)
    after = device.client.statistics()
    assert (after["dropped"] - before["dropped"], after["malformed"]) == (3, before["malformed"])


def test_a_large_request_after_one_that_ended_early(device: Device) -> None:
    """A new session begins in the middle of fragments: those of the new one are not taken for the rest."""
    device.open("a")
    device.spin(12)
    device.agent.mtu = 64
    device.ask("get_parameters", names=["a"] * 60)
    del device.client.queued[3:]
    device.agent.drop_answer = lambda datagram: datagram[4] != 0x04
    device.spin(2)
    device.agent.restart()
    device.agent.drop_answer = lambda datagram: False
    device.agent.history.clear()
    device.spin(1500)
    device.agent.answered.clear()
    assert device.client.statistics()["reconnects"] == 1
    assert device.call("get_parameters", names=["a"] * 60)["values"] == []


def test_a_value_that_is_set_before_the_parameter_was_announced(device: Device) -> None:
    """Its first event says that it is new, however often it changes before there is room for that event."""
    device.agent.drop_answer = is_acknowledgement
    while device.client.call("publish").code == 0:
        pass
    device.open("a", "b")
    for value in (1, 2):
        device.client.ok(f"write a {value}")
    device.agent.drop_answer = lambda datagram: False
    device.spin(60)
    assert device.events() == [{"new": ["a", "b"]}]
    device.client.ok("write a 3")
    device.spin(12)
    assert device.events()[1:] == [{"cha": ["a"]}]


STRING, DOUBLE = 4, 3


def text_of(name: str, value: str) -> dict[str, Any]:
    return {"name": name, "value": {"type": STRING, "string_value": value}}


def reasons(device: Device, *values: dict[str, Any]) -> list[str]:
    return [r["reason"] for r in device.call("set_parameters", parameters=list(values))["results"]]


def test_strings(programs: Programs, stack: ExitStack, codec: Codec) -> None:
    device = started(programs, stack, codec, TEXTS)
    device.open()
    client = device.client
    client.ok("text label +")
    client.ok("text label <6")
    client.ok("text label left")
    assert client.ok("text label").lines == ("text left",)
    assert (
        client.call("text label sixsix+").error == "parameter label: the string is too long: raise its size"
    )
    assert client.call("text label <3").error == "parameter label: its string is longer"
    assert client.call("text label <9").code == client.call("text label <800").code != 0
    values = device.call("get_parameters", names=["label"])["values"]
    assert [(v["type"], v["string_value"]) for v in values] == [(STRING, "left")]
    assert device.call("get_parameter_types", names=["label"])["types"] in ([STRING], bytes([STRING]))
    assert reasons(device, text_of("label", "right"), text_of("label", "longest")) == [
        "",
        "the string for parameter 'label' is too long",
    ]
    assert client.ok("text label").lines == ("text right",)
    assert reasons(device, text_of("label", "")) == [""]
    assert client.ok("text label").lines == ("text ",)
    assert reasons(device, text_of("label", "größe")) == ["the string for parameter 'label' is too long"]
    assert reasons(device, text_of("label", "größ")) == [""]
    assert client.ok("text label").lines == ("text größ",)
    wrong = {"name": "label", "value": {"type": INTEGER, "integer_value": 1}}
    assert reasons(device, wrong) == [
        "Wrong parameter type, parameter {label} is of type {string}, setting it to {integer} is not allowed."
    ]
    both = [text_of("label", "atomic"), text_of("other", "b")]
    result = device.call("set_parameters_atomically", parameters=both)["result"]
    assert not result["successful"]
    assert client.ok("text label").lines == ("text größ",)
    assert client.ok("add n").code == 0
    assert client.call("text n").error == "parameter n: it has another type"
    assert client.call("text n a").error == "parameter n: it has another type"


@pytest.mark.parametrize("constraint", ["bound x", "enumerate x"])
def test_another_type_ends_the_constraints(
    programs: Programs, stack: ExitStack, codec: Codec, constraint: str
) -> None:
    """A parameter that a request created may get another type: its range or list does not apply to that."""
    device = started(programs, stack, codec, LISTED)
    device.client.ok("free")
    number = device.set(("x", 5))
    device.spin(12)
    assert device.reply("set_parameters", number)["results"][0]["successful"]
    device.client.ok(constraint)
    number = device.set(("x", 6))
    device.spin(12)
    assert "comply" in device.reply("set_parameters", number)["results"][0]["reason"]
    doubles = [{"name": "x", "value": {"type": DOUBLE, "double_value": value}} for value in (2.5, 1e300)]
    assert reasons(device, *doubles) == ["", ""]
    (described,) = device.call("describe_parameters", names=["x"])["descriptors"]
    assert (described["type"], described["dynamic_typing"]) == (DOUBLE, True)
    assert described["floating_point_range"] == described["integer_range"] == []
    assert reasons(device, text_of("x", "first"), text_of("x", "second")) == ["", ""]
    assert reasons(device, text_of("x", "longer than 8")) == ["the string for parameter 'x' is too long"]
    number = device.set(("x", 6))
    device.spin(12)
    assert device.reply("set_parameters", number)["results"][0]["successful"]


def test_three_strings_for_two_places(programs: Programs, stack: ExitStack, codec: Codec) -> None:
    """Larger than the input: in fragments that fit it is refused with a reason; a datagram above it is malformed."""
    device = started(programs, stack, codec, TEXTS)
    device.open()
    device.client.ok("text label +")
    device.spin(12)
    values = [text_of("label", "a" * size) for size in (3, 4, 5)]
    device.agent.mtu = programs(TEXTS).input_size
    assert reasons(device, *values) == [LARGE] * 3
    assert device.client.statistics()["malformed"] == 0
    device.agent.mtu = MOST
    device.ask("set_parameters", parameters=values)
    answered = len(device.agent.answered)
    device.spin(12)
    assert len(device.agent.answered) == answered
    assert device.client.statistics()["malformed"] > 0
