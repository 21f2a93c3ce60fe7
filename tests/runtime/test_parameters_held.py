# SPDX-License-Identifier: Apache-2.0
"""Parameters that a server elsewhere holds, on the device: agent, server and time are in the hands of the test."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.parameter_server.exchange import (
    ACKNOWLEDGE,
    BEGIN,
    LIST,
    LIST_CHANGES,
    OK,
    OLD,
    OTHER_BOARD,
    OTHER_SESSION,
    SET,
)
from microros_gen.parameter_server.node import CHANGED, DECLARED, DELETED, UNCHANGED
from microros_gen.parameter_server.values import INTEGER
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.parameter_program import (
    IDENTITY_SIZE,
    STEP_MS,
    WRAP_MS,
    is_acknowledgement,
    program_of,
)
from tests.support.runtime.serving_agent import ServingAgent, identity

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameters: {at: agent}
pools: {history: 2}
"""
EXCHANGE, NOTICE = "microros_parameter_msgs/srv/Exchange", "microros_parameter_msgs/msg/Notice"
SERVICE, WRITER = b"\x00\x28", b"\x00\x05"
TIMEOUT = 2
NAMES = ["a", "b", "c", "d"]


class Device:
    """The program, and requests to it as a server sends them."""

    def __init__(self, client: Client, agent: ServingAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec = client, agent, codec
        self._requests = self.number = 0
        self.session = 7

    def spin(self, times: int) -> None:
        for _ in range(times):
            self.client.wait(STEP_MS)
            assert self.client.call("spin").code == 0

    def notices(self) -> list[dict[str, Any]]:
        bodies = [body for target, body in self.agent.written if target == WRITER]
        return [self._codec.decode(NOTICE, b"\0\1\0\0" + body) for body in bodies]

    def ask(self, what: int, **members: Any) -> dict[str, Any]:
        """Send a request; return the response."""
        self._requests += 1
        self.number += 1
        (board,) = {notice["board"] for notice in self.notices()}
        request = {
            "what": what,
            "board": board,
            "session": self.session,
            "number": self.number,
            **members,
        }
        body = self._codec.encode(f"{EXCHANGE}_Request", request)[ENCAPSULATION_BYTES:]
        self.client.queued += self.agent.give(SERVICE, identity(self._requests) + body)
        self.spin(12)
        own = identity(self._requests)
        (answer,) = [b[IDENTITY_SIZE:] for b in self.agent.answered if b[:IDENTITY_SIZE] == own]
        return self._codec.decode(f"{EXCHANGE}_Response", b"\0\1\0\0" + answer)

    def list(self, what: int = BEGIN) -> list[tuple[str, int, int]]:
        """Return name, value and change of what is listed, page by page."""
        page = self.ask(what)
        found = list(page["parameters"])
        while page["next"] < page["total"]:
            page = self.ask(LIST if what == BEGIN else what, first=page["next"])
            assert page["parameters"]
            found += page["parameters"]
        assert len(found) == page["total"]
        return [
            (item["descriptor"]["name"], item["value"]["integer_value"], item["change"]) for item in found
        ]

    def set(self, name: str, value: int, **members: Any) -> tuple[int, bool, str]:
        parameters = [{"name": name, "value": {"type": INTEGER, "integer_value": value}}]
        response = self.ask(SET, parameters=parameters, **members)
        return response["status"], response["successful"], response["reason"]

    def acknowledge(self, revision: int) -> None:
        assert self.ask(ACKNOWLEDGE, revision=revision)["status"] == OK

    def value(self, name: str) -> str:
        return self.client.ok(f"get {name}").lines[0]


@pytest.fixture(scope="module")
def codec() -> Codec:
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces((Named(EXCHANGE, None), Named(NOTICE, None)), finder, Diagnostics()))


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return program_of(tmp_path_factory.mktemp("held") / "a", APPLICATION).path


@pytest.fixture
def empty_device(program: Path, codec: Codec) -> Iterator[Device]:
    agent = ServingAgent(mtu=200)
    with Client(program, agent) as client:
        client.ok("init")
        created = Device(client, agent, codec)
        client.ok("open")
        created.spin(12)
        yield created


@pytest.fixture
def device(empty_device: Device) -> Device:
    return with_parameters(empty_device, NAMES)


def with_parameters(device: Device, names: list[str]) -> Device:
    for name in names:
        device.client.ok(f"add {name}")
    device.spin(12)
    return device


def test_a_notice_and_the_pages_of_a_session(empty_device: Device) -> None:
    names = [letter * 49 for letter in NAMES]
    device = with_parameters(empty_device, names)
    notice = device.notices()[-1]
    assert (notice["node"], notice["session"], notice["revision"]) == ("/arm/device", 0, 4)
    first = device.ask(BEGIN)
    assert (first["status"], first["total"], first["board"]) == (OK, 4, notice["board"])
    assert len(first["parameters"]) == first["next"] < 4, "all in one page: nothing is tested"
    assert device.list() == [(name, 0, DECLARED) for name in names]
    assert device.client.call("held").code == TIMEOUT
    device.acknowledge(notice["revision"])
    assert device.list(LIST) == [(name, 0, UNCHANGED) for name in names]
    assert device.list(LIST_CHANGES) == []
    assert device.client.ok("held").lines == ("overruled 0",)


def test_a_set_and_what_is_refused(device: Device) -> None:
    device.list()
    assert device.set("a", 5) == (OK, True, "")
    assert device.value("a") == "value 5"
    undeclared = "parameter 'x' cannot be set because it was not declared"
    assert device.set("x", 5) == (OK, False, undeclared)
    assert device.set("a", 6, board=1) == (OTHER_BOARD, False, "")
    assert device.set("a", 6, session=8) == (OTHER_SESSION, False, "")
    assert device.set("a", 6, session=0) == (OTHER_SESSION, False, "")
    assert device.set("a", 6, number=1) == (OLD, False, "")
    assert device.ask(BEGIN, session=0)["status"] == OTHER_SESSION
    assert device.value("a") == "value 5"
    response = device.ask(SET, parameters=[])
    assert (response["successful"], response["reason"]) == (False, "parameter list cannot be empty")


def test_numbers_of_requests_wrap(device: Device) -> None:
    device.number = 2**32 - 3
    device.list()
    for value, number in ((1, 2**32 - 1), (2, 0), (3, 1)):
        assert device.set("a", value, number=number) == (OK, True, "")
    assert device.set("a", 4, number=2**32 - 1)[0] == OLD
    assert device.value("a") == "value 3"


def test_changes_by_the_node(device: Device) -> None:
    device.list()
    device.acknowledge(4)
    device.client.ok("write b 9")
    device.client.ok("delete d")
    device.spin(50)
    notice = device.notices()[-1]
    assert (notice["session"], notice["revision"]) == (7, 6)
    page = device.ask(LIST_CHANGES)
    items = {item["descriptor"]["name"]: item for item in page["parameters"]}
    assert {name: item["change"] for name, item in items.items()} == {"b": CHANGED, "d": DELETED}
    assert 50 * STEP_MS <= items["b"]["age"] <= 64 * STEP_MS
    device.client.ok("write b 10")  # after the page: that is not acknowledged with it
    device.acknowledge(page["revision"])
    assert device.list(LIST_CHANGES) == [("b", 10, CHANGED)]
    assert [name for name, _, _ in device.list(LIST)] == ["a", "b", "c"]
    result = device.client.call("held")
    assert result.code == TIMEOUT
    assert result.error.startswith("parameters of device: no parameter server took 1 changes for ")
    device.acknowledge(page["revision"] + 1)
    assert device.client.call("held").code == 0


def test_a_change_that_is_overruled(device: Device) -> None:
    device.list()
    device.acknowledge(4)
    device.client.ok("write b 9")
    assert device.set("b", 3) == (OK, True, "")
    assert device.set("a", 4) == (OK, True, "")
    assert device.client.ok("held").lines == ("overruled 1",)
    assert device.list(LIST_CHANGES) == []
    assert (device.value("a"), device.value("b")) == ("value 4", "value 3")


def test_a_server_that_is_away(device: Device) -> None:
    """The device continues with its values, reports that, and publishes notices over the wrap of its clock."""
    device.agent.written.clear()
    device.client.ok("write a 3")
    device.spin(500)
    assert device.client.now_ms > WRAP_MS
    assert 2 <= len(device.notices()) <= 4, "one for the change, then after waits that double"
    result = device.client.call("held")
    assert result.code == TIMEOUT
    assert "took 4 changes for" in result.error
    assert device.value("a") == "value 3"
    assert device.list()[0] == ("a", 3, CHANGED)
    device.acknowledge(5)
    device.agent.written.clear()
    device.spin(500)
    assert device.notices() == []


def pauses(device: Device, count: int) -> list[int]:
    """Return the milliseconds between each two of the next `count` notices."""
    found: list[int] = []
    begin = device.client.now_ms
    while len(found) < count:
        device.agent.written.clear()
        device.spin(1)
        if device.notices():
            found.append(device.client.now_ms - begin)
            begin = device.client.now_ms
        assert device.client.now_ms - begin < 60_000, found
    return found[1:]


def near(found: list[int], seconds: list[int]) -> bool:
    """Return whether each pause is that many seconds, up to the steps in which the time of the test goes on."""
    limits = zip(found, seconds, strict=True)
    return all(abs(pause - 1000 * wanted) <= 10 * STEP_MS for pause, wanted in limits)


def test_notices_become_rare_while_no_server_asks(empty_device: Device) -> None:
    """Up to one in 32 s, over the wrap of the clock; a server that comes, and goes again, is told soon."""
    device = empty_device
    assert len(device.notices()) == 1
    assert device.client.now_ms < WRAP_MS
    assert near(pauses(device, 8), [4, 8, 16, 32, 32, 32, 32])
    device.client.ok("add a")
    assert near(pauses(device, 2), [32]), "a change is reported at once, and nobody asks"
    device.spin(8000 // STEP_MS)
    assert device.list() == [("a", 0, DECLARED)]
    assert near(pauses(device, 3), [8, 16]), "it asked, and did not acknowledge"


def test_a_new_session_makes_notices_frequent_again(device: Device) -> None:
    assert pauses(device, 7)[-1] > 30_000
    device.agent.restart()
    device.client.ok("publish")
    while device.client.statistics()["reconnects"] == 0:
        device.spin(1)
    assert near(pauses(device, 4), [2, 4, 8])


def test_another_agent_gets_a_notice(device: Device) -> None:
    device.list()
    device.acknowledge(4)
    device.agent.restart()
    device.client.ok("publish")
    before = len(device.notices())
    for _ in range(100):
        device.spin(40)
        if len(device.notices()) > before:
            break
    assert device.client.statistics()["reconnects"] == 1
    assert device.notices()[-1]["session"] == 7
    assert device.set("a", 5) == (OK, True, "")


def test_notices_wait_for_room(device: Device) -> None:
    device.list()
    device.acknowledge(4)
    device.agent.written.clear()
    device.agent.drop_answer = is_acknowledgement
    while device.client.call("publish").code == 0:
        pass
    device.client.ok("write a 1")
    device.client.ok("write a 2")
    device.spin(12)
    assert device.notices() == []
    device.agent.drop_answer = lambda datagram: False
    device.spin(60)
    assert device.notices()[0]["revision"] == 6
    assert device.client.statistics()["dropped"] == 1


@pytest.fixture
def stored(
    codec: Codec, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[], AbstractContextManager[Device]]:
    """Give what starts a program with values in storage; its power is lost at the end of the block."""
    text = APPLICATION.replace("[+parameters]", "[+parameters, +parameter_storage]")
    program = program_of(tmp_path_factory.mktemp("stored") / "a", text, "client_parameters_stored.c").path
    monkeypatch.setenv("MICROROS_STORAGE", str(tmp_path))

    @contextmanager
    def start() -> Iterator[Device]:
        agent = ServingAgent(mtu=200)
        with Client(program, agent) as client:
            client.ok("init")
            yield Device(client, agent, codec)

    return start


def test_stored_values_and_held_ones(stored: Callable[[], AbstractContextManager[Device]]) -> None:
    """Stored values are there without a server, and count as declared for one: what it holds wins."""
    with stored() as device:
        assert device.client.ok("restart a").lines == ("skipped 0",)
        device.spin(12)
        assert device.list() == [("a", 0, DECLARED)]
        assert device.set("a", 5) == (OK, True, "")
        device.client.ok("keep")
        device.client.ok("write a 6")  # not kept: the power is lost before
    with stored() as device:
        device.client.ok("restart a")
        assert device.value("a") == "value 5"
        device.spin(12)
        result = device.client.call("held")
        assert (result.code, "took 1 changes" in result.error) == (TIMEOUT, True)
        device.session = 8
        assert device.list() == [("a", 5, DECLARED)], "not CHANGED: a server that holds another value sets it"
        assert device.set("a", 9) == (OK, True, "")
        assert device.value("a") == "value 9"
        assert device.client.ok("held").lines == ("overruled 0",)
        late = device.client.call("load")
        assert late.code == 1
        assert "load before rclc_executor_add_parameter_server" in late.error
        assert device.value("a") == "value 9"
        device.client.ok("keep")
    with stored() as device:
        device.client.ok("restart a")
        assert device.value("a") == "value 9"


def test_stored_values_without_their_parameter(stored: Callable[[], AbstractContextManager[Device]]) -> None:
    with stored() as device:
        device.client.ok("restart a")
        device.client.ok("write a 3")
        device.client.ok("keep")
    with stored() as device:
        assert device.client.ok("restart b").lines == ("skipped 1",)
        assert device.value("b") == "value 0"
