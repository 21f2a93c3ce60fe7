# SPDX-License-Identifier: Apache-2.0
"""Two images of one chip: what their applications have to agree about, and the rings of both."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from tests.support.components.chips import part, planned, refused
from tests.support.runtime.images import FIRST, SECOND, SYSTEM, written


def test_its_rings(tmp_path: Path) -> None:
    """Both images have the same rings, each of them the other end."""
    written(tmp_path)
    first, second = part(tmp_path, "first"), part(tmp_path, "second")
    assert [
        (r.ring.topic, r.ring.ends, r.ring.at, r.ring.words, r.ring.slots, r.sends) for r in first.rings
    ] == [
        ("/ping", 4, 16, 1 + 5, 2, True),
        ("/pong", 10, 28, 1 + 1, 2, False),
    ]
    assert [(r.ring, r.sends) for r in second.rings] == [(r.ring, not r.sends) for r in first.rings]
    assert first.shared_key == second.shared_key != 0
    assert (first.shared_image, second.shared_image) == (0, 1)
    assert first.ring_words == second.ring_words == 28 + 2 * 2
    assert (first.ring_of, second.ring_of) == (("0", "1"), ("1", "0"))
    assert first.shown == "/ping (chip), /pong (chip); no agent is needed"


SUM = "{name: /sum, type: example_interfaces/srv/AddTwoInts, local: chip, queue: 3}"
SERVES, CALLS = (
    text.replace("+executor", "+executor, +services") + f"    {key}: [{SUM}]\n"
    for text, key in ((FIRST, "services"), (SECOND, "clients"))
)


def test_the_rings_of_a_service(tmp_path: Path) -> None:
    """One for its requests, which the client writes, and after it one for its replies."""
    written(tmp_path, SYSTEM, SERVES, CALLS)
    first, second = part(tmp_path, "first"), part(tmp_path, "second")
    head = 1 + 3
    assert [
        (r.ring.part, r.ring.words, r.ring.slots, r.sends) for r in first.rings if r.ring.topic == "/sum"
    ] == [
        ("Request", head + 4, 3, False),
        ("Response", head + 2, 3, True),
    ]
    assert [(r.ring, r.sends) for r in second.rings] == [(r.ring, not r.sends) for r in first.rings]
    assert first.shared_key == second.shared_key
    assert (first.calls, first.services, second.services) == (True, True, True)
    assert first.shown == "/ping (chip), /pong (chip), /sum (chip); no agent is needed"
    assert part(written(tmp_path), "first").shared_key != first.shared_key


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            SUM,
            "{name: /sun, type: std_srvs/srv/Trigger, local: chip}",
            "'/sum' has no client in any other image of the chip",
        ),
        ("clients", "services", "'/sum' has no client in any other image of the chip"),
        (
            "AddTwoInts",
            "SetBool",
            "'/sum' has the type example_interfaces/srv/AddTwoInts here, and the client of the board 'second' "
            "(second/microros.yaml:10) has example_interfaces/srv/SetBool",
        ),
        ("queue: 3", "queue: 4", "the ring of '/sum' has 3 slots here and 4 for the client of the board"),
    ],
)
def test_services_that_do_not_agree(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert words in refused(written(tmp_path, SYSTEM, SERVES, CALLS.replace(old, new)))


def test_limits_of_services_agree(tmp_path: Path) -> None:
    """They are those of the request and of the response."""
    ends = [
        text.replace("example_interfaces/srv/AddTwoInts", "std_srvs/srv/Trigger") for text in (SERVES, CALLS)
    ]
    assert part(written(tmp_path, SYSTEM, *ends), "first").calls
    other = ends[1].replace("queue: 3", "queue: 3, limits: {message: 5}")
    assert "the limits of '/sum' differ from those of the client of" in refused(
        written(tmp_path, SYSTEM, ends[0], other)
    )


def test_the_other_image_has_another_service(tmp_path: Path) -> None:
    folder = tmp_path / "example_interfaces" / "srv"
    folder.mkdir(parents=True)
    (folder / "AddTwoInts.srv").write_text("int64 a\nint64 b\n---\nint64 total\n")
    second = CALLS.replace("version: 1\n", "version: 1\ninterface_paths: [..]\n")
    words = "example_interfaces/srv/AddTwoInts is defined otherwise than for the client of the board 'second'"
    assert words in refused(written(tmp_path, SYSTEM, SERVES, second))


def test_the_plan_was_made_from_all_files(tmp_path: Path) -> None:
    written(tmp_path)
    found = {path.resolve() for path in compiler.read_paths(planned(tmp_path))}
    assert {tmp_path / "system.yaml", tmp_path / "second" / "microros.yaml"} <= found


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("depth: 2", "depth: 3"),
        ("string: 12", "string: 16"),
        ("std_msgs/msg/Int32", "std_msgs/msg/UInt32"),
        ("topic: ping", "topic: sing"),
        ("    publishers", "    domain_id: 3\n    publishers"),
    ],
)
def test_another_pair_has_another_key(tmp_path: Path, old: str, new: str) -> None:
    """What both images have alike is in it: one that was built earlier does not read other bytes as a message."""
    key = part(written(tmp_path), "first").shared_key
    changed = (text.replace(old, new) for text in (FIRST, SECOND))
    assert part(written(tmp_path, SYSTEM, *changed), "first").shared_key != key


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (
            ("type: std_msgs/msg/Int32, local: chip", "type: std_msgs/msg/Int32, local: never"),
            ("", ""),
            [
                "second/microros.yaml:8:18: error: '/pong' has no subscription in any other image of the chip",
                "Declare its other end there with `local: chip`",
            ],
        ),
        (
            ("", ""),
            ("topic: ping", "topic: sing"),
            [
                "first/microros.yaml:8:18: error: '/ping' has no subscription in any other image of the chip"
                ". Write",
                "second/microros.yaml:9:21: error: '/sing' has no publisher in any other image of the chip",
            ],
        ),
        (
            ("", ""),
            ("type: std_msgs/msg/String", "type: std_msgs/msg/Int32"),
            [
                "first/microros.yaml:8:38: error: '/ping' has the type std_msgs/msg/String here, and the subscription "
                "of the board 'second' (second/microros.yaml:9) has std_msgs/msg/Int32",
                "Give both the same type",
            ],
        ),
        (
            ("qos: {depth: 2}", "qos: {depth: 2, reliability: best_effort}"),
            ("", ""),
            [
                "first/microros.yaml:8:77: error: '/ping' is best effort here and never matches the subscription of "
                "the board 'second' (second/microros.yaml:9)",
            ],
        ),
        (
            ("", ""),
            ("depth: 2", "depth: 3"),
            [
                "first/microros.yaml:9:79: error: the ring of '/pong' has 2 slots here and 3 for the publisher of the "
                "board 'second' (second/microros.yaml:8)",
            ],
        ),
        (
            ("", ""),
            ("string: 12", "string: 13"),
            [
                "first/microros.yaml:8:18: error: the limits of '/ping' differ from those of the subscription of the "
                "board 'second' (second/microros.yaml:9)",
            ],
        ),
        (
            ("", ""),
            ("std_msgs/msg/String, local: chip", "std_msgs/msg/String, local: chip, limits: {string: 5}"),
            ["the limits of '/ping' differ"],
        ),
    ],
)
def test_images_that_do_not_agree(
    tmp_path: Path, first: tuple[str, str], second: tuple[str, str], words: list[str]
) -> None:
    """One run names the place, the other place and what to do."""
    shown = refused(written(tmp_path, SYSTEM, FIRST.replace(*first, 1), SECOND.replace(*second, 1)))
    for each in words:
        assert each in shown
    assert shown.count("error:") == sum("error:" in each for each in words) or len(words) == 1


def test_the_other_image_has_other_interfaces(tmp_path: Path) -> None:
    folder = tmp_path / "std_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "String.msg").write_text("string data\nuint8 more\n")
    (folder / "Int32.msg").write_text("int32 data\n")
    second = SECOND.replace("version: 1\n", "version: 1\ninterface_paths: [..]\n")
    shown = refused(written(tmp_path, SYSTEM, FIRST, second))
    assert "std_msgs/msg/String is defined otherwise than for the subscription of the board 'second'" in shown


@pytest.mark.parametrize(
    ("ends", "words"),
    [
        (
            "publishers: [{topic: ping, type: std_msgs/msg/String, local: chip}]\n"
            "    subscriptions: [{topic: ping, type: std_msgs/msg/String, local: chip}]",
            "a topic between images has one end in each: '/ping' has two in this one",
        ),
        (
            "publishers: [{topic: ping, type: std_msgs/msg/String, local: chip}]\n"
            "    subscriptions: [{topic: ping, type: std_msgs/msg/String, local: only}]",
            "nothing in the image publishes '/ping'",
        ),
        (
            "publishers: [{topic: ping, type: std_msgs/msg/String, local: chip, qos: {history: keep_all}}]",
            "'/ping' has `history: keep_all`",
        ),
        (
            "services: [{name: a, type: example_interfaces/srv/AddTwoInts, local: chip}]\n"
            "    clients: [{name: a, type: example_interfaces/srv/AddTwoInts, local: only}]",
            "a service between images has one end in each: '/a' has two in this one",
        ),
        (
            "publishers: [{topic: ping, type: std_msgs/msg/String, local: chip, qos: {depth: 255}}]",
            "255 messages of '/ping' are more than the 254 of a ring",
        ),
    ],
)
def test_ends_that_cannot_be(tmp_path: Path, ends: str, words: str) -> None:
    head = FIRST.split("    publishers")[0].replace("+executor", "+executor, +services")
    assert words in refused(written(tmp_path, SYSTEM, f"{head}    {ends}\n"))


@pytest.mark.parametrize(
    ("system", "first", "words"),
    [
        (
            SYSTEM,
            FIRST.replace("system: {file: ../system.yaml, board: first}\n", ""),
            "first/microros.yaml:7:18: error: `local: chip` needs the system that the other image is in",
        ),
        (
            SYSTEM.replace("chips:\n  - [first, second]\n", ""),
            FIRST,
            "first/microros.yaml:5:39: error: no chip of the system has the board 'first'",
        ),
        (
            SYSTEM.replace("[first, second]", "[first, third]"),
            FIRST,
            "system.yaml:6:13: error: the system has no board 'third'",
        ),
        (
            SYSTEM + "  - [second, first]\n",
            FIRST,
            "system.yaml:7:6: error: the board 'second' is named twice in `chips`, first in line 6",
        ),
        (
            SYSTEM.replace("[first, second]", "[first]"),
            FIRST,
            "system.yaml:6:5: error: a chip has 2 to 16 images; this one has 1",
        ),
        (
            SYSTEM.replace("[first, second]", f"[{', '.join(['first'] * 17)}]"),
            FIRST,
            "this one has 17. Name the boards that share a memory; further images exchange messages with them by",
        ),
        (
            SYSTEM.replace("second/microros", "third/microros"),
            FIRST,
            "cannot read the application file 'third/microros.yaml'",
        ),
    ],
)
def test_systems_without_the_chip(tmp_path: Path, system: str, first: str, words: str) -> None:
    assert words in refused(written(tmp_path, system, first))
