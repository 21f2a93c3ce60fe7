# SPDX-License-Identifier: Apache-2.0
"""Lines for /rosout with a scripted agent: which ones wait, which ones are dropped and counted; no call waits."""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.support.agent.process import own_domain
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.harness import build
from tests.support.runtime.surface import write_application

SIZE = 700
APPLICATION = f"""\
version: 1
profiles: [pure_sender]
logging: [{{to: rosout, level: warn, size: {SIZE}}}]
nodes:
  - name: device
    namespace: /arm
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
limits: {{rcl_interfaces/msg/Log: {{name: 8, msg: 40, file: 20, function: 12}}}}
pools: {{history: 4}}
"""
ROSOUT, COUNT = 0, 1
SLOTS = 4
WARN, ERROR, FATAL = 30, 40, 50


class Line(NamedTuple):
    """An rcl_interfaces/msg/Log."""

    sec: int
    nanosec: int
    level: int
    name: str
    msg: str
    file: str
    function: str
    line: int


def line_of(body: bytes) -> Line:
    """Decode CDR: numbers and strings, each aligned to four bytes."""
    at = 8

    def aligned() -> int:
        return (at + 3) & ~3

    sec, nanosec, level = struct.unpack_from("<iIB", body)
    at, texts = 9, []
    for _ in range(4):
        (size,) = struct.unpack_from("<I", body, aligned())
        start = aligned() + 4
        texts.append(body[start : start + size])
        at = start + size
    (number,) = struct.unpack_from("<I", body, aligned())
    assert aligned() + 4 == len(body)
    assert all(text.endswith(b"\0") for text in texts)
    name, msg, file, function = (text[:-1].decode() for text in texts)
    return Line(sec, nanosec, level, name, msg, file, function, number)


def lines(agent: FakeAgent) -> list[Line]:
    """Return what the agent received on /rosout."""
    identity = ((ROSOUT << 4) | 5).to_bytes(2, "big")
    return [line_of(body) for target, body in agent.written if target == identity]


def texts(agent: FakeAgent, library: bool = False) -> list[str]:
    """Return the texts of the application, or those of the library itself."""
    return [line.msg for line in lines(agent) if (line.name == "microros") == library]


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("rosout") / "tree", APPLICATION)
    return build(tree.without_port(), ["port_fake.c", "client_logs.c"], "logs")


@pytest.fixture
def agent() -> FakeAgent:
    return FakeAgent()


@pytest.fixture
def client(program: Path, agent: FakeAgent) -> Iterator[Client]:
    with Client(program, agent) as running:
        yield running


def test_lines_before_the_session_are_sent_in_it(client: Client, agent: FakeAgent) -> None:
    client.tell("epoch 1700000000123")
    for text in ("first", "second"):
        client.ok(f"warn {text}")
    client.ok("debug below the level of the writer")
    client.ok("init")
    client.spin(4)
    assert [(line.level, line.name, line.msg) for line in lines(agent)] == [
        (WARN, "arm", "first"),
        (WARN, "arm", "second"),
    ]
    first = lines(agent)[0]
    assert first.function == "call"
    assert first.file.endswith("client_logs.c")
    assert len(first.file) == 20
    assert first.line > 50
    assert (first.sec, first.nanosec) == (1700000000, 123000000)


ROOM = f"""\
version: 1
profiles: [pure_sender]
logging: [{{to: rosout, level: warn, size: {SIZE}}}]
nodes:
  - {{name: device, namespace: /arm, publishers: [{{topic: count, type: std_msgs/msg/Int32}}]}}
limits: {{rcl_interfaces/msg/Log: {{name: 24, msg: 40, file: 20, function: 12}}}}
"""
OK, BAD_ALLOC, INVALID, NOT_FOUND = 0, 10, 11, 107
SUBLOGGERS = (
    ("add", "arm.device", "child", OK),
    ("add", "arm.device", "child", OK),
    ("remove", "arm.device", "child", OK),
    ("remove", "arm.device", "child", OK),
    ("remove", "arm.device", "child", NOT_FOUND),
    ("add", "arm.device", "", INVALID),
    ("add", "arm.device", None, INVALID),
    ("add", None, "child", INVALID),
    ("add", "", "child", NOT_FOUND),
    ("add", "none", "child", NOT_FOUND),
    ("add", "arm.dev", "child", NOT_FOUND),
    ("add", "arm.device.child", "x", NOT_FOUND),
    ("add", "arm/device", "child", NOT_FOUND),
    ("add", "device", "child", NOT_FOUND),
    ("remove", "arm.device", "", INVALID),
    ("remove", None, "child", INVALID),
    ("remove", "none", "child", NOT_FOUND),
    ("add", "arm.device", "x", OK),
    ("add", "arm.device.x", "y", OK),
    ("remove", "arm.device", "x.y", OK),
    ("add", "arm.device.x", "y", OK),
    ("remove", "arm.device", "x", OK),
    ("remove", "arm.device.x", "y", OK),
    ("add", "arm.device", "last", OK),
)
"""Calls for the logger `arm.device`, and what rcl returns."""


@pytest.fixture(scope="module")
def roomy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("subloggers") / "tree", ROOM)
    return build(tree.without_port(), ["port_fake.c", "client_logs.c"], "subloggers")


def sublogger(client: Client, call: str, *names: str | None) -> int:
    words = ("0" if name is None else name or "-" for name in names)
    return client.call(" ".join((call, *words))).code


def test_subloggers(roomy: Path, agent: FakeAgent) -> None:
    with Client(roomy, agent) as client:
        assert sublogger(client, "add", "arm.device", "child") == NOT_FOUND
        client.ok("init")
        for call, logger, name, code in SUBLOGGERS:
            assert sublogger(client, call, logger, name) == code, (call, logger, name)
        client.ok("keep no publisher")
        assert sublogger(client, "add", "arm.device", "late") == NOT_FOUND
        client.ok("open it again")
        assert sublogger(client, "remove", "arm.device", "last") == NOT_FOUND
        assert sublogger(client, "add", "arm.device", "n" * 14) == BAD_ALLOC
        for number in range(4):
            assert sublogger(client, "add", "arm.device", f"n{number}") == OK
        full = client.call("add arm.device more")
        assert (full.code, "set pools: {loggers: 5} for " in full.error) == (BAD_ALLOC, True)
        assert sublogger(client, "add", "arm.device", "n3") == OK


@pytest.mark.ros
def test_rcl_returns_the_same_for_subloggers() -> None:
    """In a separate process: rcl has one table of loggers."""
    calls = [(call, logger, name) for call, logger, name, _ in SUBLOGGERS]
    done = subprocess.run(
        [sys.executable, "-c", _RCL, json.dumps(calls)],
        env={**os.environ, "ROS_DOMAIN_ID": str(own_domain())},
        capture_output=True,
        text=True,
        check=True,
    )
    assert json.loads(done.stdout) == [code for *_, code in SUBLOGGERS]


_RCL = """\
import ctypes, json, pathlib, sys
import rclpy

rclpy.init()
node = rclpy.create_node("device", namespace="/arm")
rcl = ctypes.CDLL(str(pathlib.Path(sys.prefix, "lib", "librcl.so")))
rcutils = ctypes.CDLL(str(pathlib.Path(sys.prefix, "lib", "librcutils.so")))
codes = []
for call, *names in json.loads(sys.argv[1]):
    function = getattr(rcl, f"rcl_logging_rosout_{call}_sublogger")
    codes.append(function(*(name if name is None else name.encode() for name in names)))
    rcutils.rcutils_reset_error()
print(json.dumps(codes))
"""


def test_lines_without_room_are_counted_and_reported_once(client: Client, agent: FakeAgent) -> None:
    for number in range(20):
        client.ok(f"warn line {number}")
    client.ok("init")
    client.spin(40)
    kept = [text for text in texts(agent) if text.startswith("line ")]
    assert kept == [f"line {number}" for number in range(len(kept))]
    lost = 20 - len(kept)
    assert 5 < lost < 18
    assert texts(agent)[len(kept) :] == [f"{lost} messages dropped"]
    assert f"dropped={lost}" in " ".join(client.ok("counts").lines)
    client.ok("warn after")
    client.spin(2)
    assert texts(agent)[len(kept) + 1 :] == ["after"]


def test_texts_are_bounded_between_characters(client: Client, agent: FakeAgent) -> None:
    client.ok("init")
    client.ok("warn " + "ä" * 40)
    client.ok("named a.long.name")
    client.spin(2)
    first, second = lines(agent)
    assert first.msg == "ä" * 18 + "..."
    assert (second.level, second.name) == (FATAL, "a.lon...")
    assert (second.file, second.function, second.line) == ("", "", 0)
    assert "truncated=2 dropped=0" in " ".join(client.ok("counts").lines)


def test_lines_leave_room_for_the_application(client: Client, agent: FakeAgent) -> None:
    """An agent that acknowledges nothing gets lines in half of the slots; samples have the others."""
    client.ok("init")
    agent.drop_answer = lambda answer: True
    for number in range(6):
        client.ok(f"warn {number}")
    client.spin(3)
    published = 0
    while client.call("publish").code == 0:
        published += 1
    assert published == SLOTS // 2
    assert len(agent.values(COUNT)) == published
    agent.drop_answer = lambda answer: False
    client.spin(40, 100)
    assert texts(agent) == [str(number) for number in range(6)]


def test_a_silent_agent_delays_no_call(client: Client, agent: FakeAgent) -> None:
    """Logging takes no time: the fake clock stands still. Lines that wait are sent in the next session."""
    client.ok("init")
    agent.silent = True
    for number in range(30):
        client.ok(f"warn {number}")
    agent.silent = False
    agent.restart()
    client.spin(200, 50)
    assert texts(agent)[:3] == ["0", "1", "2"]
    assert texts(agent)[-1].endswith(" messages dropped")


def test_the_library_logs_what_happens_to_the_session(client: Client, agent: FakeAgent) -> None:
    client.ok("init")
    client.spin(2)
    assert texts(agent, library=True) == []  # "session open" is below the level
    agent.silent = True
    client.spin(100, 100)
    for _ in range(3):
        client.call("publish")
    agent.silent = False
    agent.restart()
    agent.refuse = {"datawriter": 0x82}
    client.spin(40, 100)
    agent.refuse = {}
    client.spin(100, 100)
    found = [line for line in lines(agent) if line.name == "microros"]
    assert [(line.level, line.msg) for line in found][:2] == [(WARN, "session lost"), (ERROR, found[1].msg)]
    assert found[1].msg.startswith("the agent refused ")


def test_a_publisher_that_is_closed_keeps_lines(client: Client, agent: FakeAgent) -> None:
    client.ok("init")
    client.ok("keep")
    client.ok("warn waits")
    client.spin(4)
    assert texts(agent) == []
    client.ok("open")
    client.spin(4)
    assert texts(agent) == ["waits"]
    client.ok("end")
    client.ok("warn between")
    client.ok("init")
    client.spin(4)
    assert texts(agent) == ["waits", "between"]
    assert texts(agent, library=True) == []  # to close a session is not to lose it
