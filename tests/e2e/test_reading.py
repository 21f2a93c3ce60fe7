# SPDX-License-Identifier: Apache-2.0
"""Subscriptions without an executor: rclpy, this project's agent and an image with sanitizers, also of 32 bit."""

from __future__ import annotations

import random
import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, SANITIZE, Images, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_reader]
nodes:
  - name: ear
    subscriptions:
      - {topic: numbers, type: std_msgs/msg/Int32, queue: 8, qos: {depth: 1000}}
      - {topic: words, type: std_msgs/msg/String, qos: {reliability: best_effort, depth: 5}}
limits: {"*": {string: 8}}
"""
LAST = 299


def publish(observer: Observer, topic: str, type_name: str, *values: object) -> None:
    data = [{"data": value} for value in values]
    observer.ask(do="publish", topic=topic, type=type_name, values=data)


def await_match(observer: Observer, topic: str) -> None:
    end = deadline(15)
    while not observer.ask(do="matched", topic=topic):
        assert time.monotonic() < end, f"nobody subscribes to {topic}"
        time.sleep(0.05)


@pytest.mark.parametrize("entities", ["binary", pytest.param("xml", marks=pytest.mark.variant)])
def test_rclpy_publishes_and_the_client_takes(
    images: Images,
    image_port: Relay,
    agent: AgentProcess,
    observer: Observer,
    tmp_path: Path,
    entities: str,
) -> None:
    """Every reliable sample once and in order; a word above its limit is refused in words; the graph shows the node."""
    flags = ("-m32", *SANITIZE) if entities == "xml" else ()
    image = images.build(image_port.port, f"{APPLICATION}entities: {entities}\n", flags=flags)
    program = image.application(C_FILES / "listen.c", tmp_path / "listen", "-std=c99", "-Wall", "-Werror")
    publish(observer, "/numbers", "std_msgs/msg/Int32")
    publish(observer, "/words", "std_msgs/msg/String")
    with started(program, str(LAST)) as process:
        await_match(observer, "/numbers")
        await_match(observer, "/words")
        publish(observer, "/words", "std_msgs/msg/String", "short", "much longer", "again")
        time.sleep(0.3)
        for value in range(0, LAST + 1, 50):
            publish(observer, "/numbers", "std_msgs/msg/Int32", *range(value, min(value + 50, LAST + 1)))
        out, errors = process.communicate(timeout=seconds(30))
    assert (process.returncode, errors) == (0, "")
    lines = out.splitlines()
    assert [line for line in lines if line.startswith("number")] == [f"number {i}" for i in range(LAST + 1)]
    assert [line for line in lines if line.startswith("word")] == ["word short", "word again"]
    (refused,) = (line for line in lines if line.startswith("refused"))
    assert (
        refused.endswith("received 16 bytes, 16 fit: raise limits of std_msgs/msg/String in microros.yaml")
        or "capacity for 8: set limits: {std_msgs/msg/String: {data: 11}} in microros.yaml" in refused
    )


SHARED = """\
version: 1
profiles: [pure_reader]
nodes:
  - name: ear
    subscriptions:
      - {topic: words, type: std_msgs/msg/String, queue: 20, queue_bytes: 1100, qos: {depth: 1000}}
limits: {"*": {string: 1000}}
"""


@pytest.mark.parametrize(
    "flags", [(), pytest.param(("-m32", *SANITIZE), marks=pytest.mark.variant)], ids=["64", "32"]
)
def test_samples_of_any_size_share_the_bytes_of_a_queue(
    images: Images,
    image_port: Relay,
    agent: AgentProcess,
    observer: Observer,
    tmp_path: Path,
    flags: tuple[str, ...],
) -> None:
    """rclpy writes faster than the program takes; the large ones come in fragments. Each arrives once, in order."""
    image = images.build(image_port.port, SHARED, flags=flags)
    program = image.application(C_FILES / "words.c", tmp_path / "words", "-std=c99", "-Wall", "-Werror")
    chance = random.Random(1)
    sizes = [chance.choice((1, 20, 400, 1000, chance.randrange(1, 1001))) for _ in range(120)]
    letters = [chr(ord("a") + number % 26) for number in range(len(sizes))]
    publish(observer, "/words", "std_msgs/msg/String")
    with started(program, "3") as process:
        await_match(observer, "/words")
        for first in range(0, len(sizes), 40):
            block = zip(letters[first : first + 40], sizes[first : first + 40], strict=True)
            publish(observer, "/words", "std_msgs/msg/String", *(letter * size for letter, size in block))
        publish(observer, "/words", "std_msgs/msg/String", "end")
        out, errors = process.communicate(timeout=seconds(60))
    assert (process.returncode, errors) == (0, "")
    expected = [f"{letter} {size} whole" for letter, size in zip(letters, sizes, strict=True)]
    assert out.splitlines() == [*expected, "e 3 -", "dropped 0 refused 0"]
