# SPDX-License-Identifier: Apache-2.0
"""Publishers of one type with their own limits: what one of them refuses another one sends."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.runtime.driver import Client
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.harness import Tree, build

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    publishers:
      - {topic: short, type: std_msgs/msg/String, limits: {data: 3}}
      - {topic: long, type: std_msgs/msg/String, limits: {data: 90}}
      - {topic: fast, type: std_msgs/msg/String, limits: {data: 81}, qos: {reliability: best_effort}}
      - {topic: twice, type: std_msgs/msg/String, limits: {data: 1}}
      - {topic: twice, type: std_msgs/msg/String, limits: {data: 2}}
      - {topic: count, type: std_msgs/msg/Int32}
"""
RELIABLE_BODY, FAST_BODY = 96, 88
"""What a slot has for a body: 90 and 81 characters with length and terminator, rounded up to four bytes."""


def refusal(found: int, limit: int) -> str:
    return f"limit {limit}: set limits: {{std_msgs/msg/String: {{data: {found}}}}} in microros.yaml"


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The client of the other tests, over generated type support instead of the one by hand."""
    place = tmp_path_factory.mktemp("own_limits")
    (place / "microros.yaml").write_text(APPLICATION)
    options = compiler.Options(config=place / "microros.yaml", interface_paths=(shipped_folder(),))
    out = compiler.generate(options, place / "out").out
    sources = sorted(p for p in (out / "src").rglob("*.c") if not p.parent.name.startswith("port_posix"))
    return build(
        Tree(out, tuple(sources)),
        [
            "port_fake.c",
            "client.c",
            "client_ping.c",
            "client_no_read.c",
            "client_no_serve.c",
            "client_no_time.c",
            "client_no_extra.c",
        ],
        "own_limits",
    )


@pytest.fixture
def client(program: Path) -> Iterator[Client]:
    with Client(program, FakeAgent()) as client:
        client.ok("init")
        client.ok("node 0 arm -")
        yield client


def bodies(client: Client) -> list[bytes]:
    """Return what reached the agent, as strings."""
    return [body[4 : 3 + struct.unpack_from("<I", body)[0]] for _, body in client.agent.written]


def test_one_refuses_what_the_other_sends(client: Client) -> None:
    client.ok("publisher 0 0 String short reliable")
    client.ok("publisher 1 0 String long reliable")
    for publisher in (0, 1):
        client.ok(f"say {publisher} abc")
    result = client.call("say 0 abcd")
    assert (result.code, result.error) == (1, refusal(4, 3))
    client.ok("say 1 abcd")
    client.ok(f"say 1 {'x' * 90}")
    assert client.call(f"say 1 {'x' * 91}").error == refusal(91, 90)
    client.ok("flush 1000")
    assert bodies(client) == [b"abc", b"abc", b"abcd", b"x" * 90]
    assert client.statistics()["dropped"] == 0, "a refusal is no loss"


def test_the_limits_outlive_a_session(client: Client) -> None:
    client.ok("publisher 0 0 String short reliable")
    client.agent.restart()
    client.spin(times=20, step=100)
    assert client.statistics()["reconnects"] == 1
    client.ok("say 0 abc")
    assert client.call("say 0 abcd").error == refusal(4, 3)


def test_each_stream_has_room_for_those_that_write_to_it(client: Client) -> None:
    client.ok("publisher 0 0 String short reliable")
    client.ok("publisher 1 0 String fast best_effort")
    for publisher, room in ((0, RELIABLE_BODY), (1, FAST_BODY)):
        client.ok(f"raw {publisher} {4 + room} 1")
        refused = client.call(f"raw {publisher} {5 + room} 1").error
        assert refused == f"serialized message: not little endian CDR, or {5 + room} bytes above {4 + room}"
    client.ok(f"say 1 {'y' * 81}")
    assert client.call(f"say 1 {'y' * 82}").error == refusal(82, 81)


def test_the_largest_message_of_a_publisher_decides_whether_it_fits_a_stream(client: Client) -> None:
    """The best-effort stream is too small for 90 characters, and that is the largest of the type."""
    client.ok("publisher 0 0 String short best_effort")
    refused = client.call("publisher 1 0 String long best_effort")
    assert refused.code == 1
    assert refused.error.startswith("std_msgs/msg/String takes 95 bytes and its stream holds 88: ")
    client.ok("publisher 1 0 String long reliable")


def test_places_of_one_topic_are_taken_in_the_order_of_the_file(client: Client) -> None:
    for publisher in (0, 1):
        client.ok(f"publisher {publisher} 0 String twice reliable")
    assert client.call("say 0 ab").error == refusal(2, 1)
    client.ok("say 1 ab")
    client.ok("publisher_fini 1 0")
    client.ok("publisher 1 0 String twice reliable")
    assert client.call("say 1 abc").error == refusal(3, 2)


def test_a_type_without_limits_next_to_limited_ones(client: Client) -> None:
    client.ok("publisher 0 0 Int32 count reliable")
    client.ok("publish 0 7")
    client.ok("flush 1000")
    assert client.agent.written[-1][1] == struct.pack("<i", 7)
