# SPDX-License-Identifier: Apache-2.0
"""Every way to create entities, from the application file to rclpy; the agent is given OUT/agent/ as users do."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import agent_options, running_agent
from tests.support.e2e.images import QUICK, Image, Images, ends_well, kill, started
from tests.support.e2e.programs import run_to, until
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

SAMPLES = 400
PERIOD = (*QUICK, "-DEXAMPLE_PERIOD_MS=20")
FLAGS = (*PERIOD, f"-DEXAMPLE_SAMPLES={SAMPLES}")
NODE = """\
  - name: talker
    namespace: /{name}
    publishers:
      - {{topic: count, type: std_msgs/msg/Int32}}
      - {{topic: fast, type: std_msgs/msg/Int32, qos: {{reliability: best_effort, depth: 1}}}}
"""
OTHER = """\
  - {{name: other, namespace: /{name}, publishers: [{{topic: ~/count, type: std_msgs/msg/Int32}}]}}
"""
WAYS = {
    "binary_reliable": (NODE, "entities: binary\ncreation: reliable\n"),
    "xml_best_effort": (NODE, "entities: xml\n"),
    "xml_reliable": (NODE + OTHER, "entities: xml\ncreation: reliable\n"),
    "reference": (NODE, "entities: reference\n"),
    "two_references": (NODE + OTHER, "entities: reference\ncreation: reliable\n"),
    "preconfigured": (NODE + OTHER, "entities: preconfigured\n"),
    "silent": (NODE, "entities: preconfigured\nliveliness: none\n"),  # it never opens its session again
}


@pytest.fixture
def subscribed(observer: Observer) -> Observer:
    for topic in (topic for name in WAYS for topic in topics_of(name)):
        observer.subscribe(topic, "std_msgs/msg/Int32", reliable=not topic.endswith("fast"))
    return observer


def built(
    images: Images, port: int, names: Iterable[str] = WAYS, flags: tuple[str, ...] = FLAGS
) -> Mapping[str, Image]:
    """Build an image for each way, in a separate namespace; a full stream is waited for, so nothing is lost."""
    head = "version: 1\nprofiles: [pure_sender]\non_full: block 2 s\npools: {history: 16}\nnodes:\n"
    texts = {name: f"{head}{WAYS[name][0].format(name=name)}{WAYS[name][1]}" for name in names}
    return {name: images.build(port, text, flags=flags) for name, text in texts.items()}


def files_of(found: Mapping[str, Image]) -> list[str]:
    """Return the options of the agent, one for each file that a build wrote."""
    return [option for image in found.values() for option in agent_options(image.out)]


def topics_of(name: str) -> list[str]:
    other = [f"/{name}/other/count"] if OTHER in WAYS[name][0] else []
    return [f"/{name}/count", f"/{name}/fast", *other]


def is_there(graph: dict[str, Any], name: str) -> bool:
    """Whether the node and its publishers are in the graph as they were declared."""
    talker = f"/{name}/talker"
    return (
        talker in graph["nodes"]
        and graph["publishers"].get(f"/{name}/count") == [[talker, "RELIABLE", "VOLATILE"]]
        and graph["publishers"].get(f"/{name}/fast") == [[talker, "BEST_EFFORT", "VOLATILE"]]
    )


def takes_samples(observer: Observer, topics: list[str], timeout_s: float = 25.0) -> dict[str, list[int]]:
    """Return the next samples, at least five of each topic."""
    found: dict[str, list[int]] = {topic: [] for topic in topics}
    end = deadline(timeout_s)
    while min(map(len, found.values())) < 5:
        assert time.monotonic() < end, found
        for name, value in observer.ask(do="samples"):
            if name in found:
                found[name].append(value["data"])
        time.sleep(0.02)
    return found


@pytest.mark.system
def test_every_way_to_create_reaches_ros(
    images: Images, image_port: Relay, relay: Relay, subscribed: Observer, domain: int
) -> None:
    """All at once: each node and publisher with its QoS in the graph, each sample in order, and nothing stays."""
    found = built(images, image_port.port)
    options = files_of(found)
    assert options.count("--references") == 2
    assert options.count("--entities") == 2
    topics = [topic for name in WAYS for topic in topics_of(name)]
    with (
        running_agent(domain, "--domain", str(domain), "--client-timeout", "2", *options) as agent,
        ExitStack() as stack,
    ):
        relay.connect(agent.port)
        images_running = [stack.enter_context(started(image.program)) for image in found.values()]
        subscribed.see(lambda graph: all(is_there(graph, name) for name in WAYS))
        samples = until(subscribed, [topic for topic in topics if topic.endswith("count")], SAMPLES - 1)
        for process in images_running:
            ends_well(process)
        for topic in topics:
            values = [sample["data"] for sample in samples[topic]]
            if topic.endswith("count"):
                run_to(SAMPLES - 1, values)
            else:
                assert values == sorted(values)
        subscribed.see(lambda seen: not any(f"/{name}/talker" in seen["nodes"] for name in WAYS))


def test_entities_return_with_a_restarted_agent(
    images: Images, image_port: Relay, relay: Relay, subscribed: Observer, domain: int
) -> None:
    names = ("two_references", "xml_reliable", "preconfigured", "silent")
    found = built(images, image_port.port, names, PERIOD)  # without an end: a slow machine takes its time
    options = ["--domain", str(domain), *files_of(found)]
    topics = [f"/{name}/count" for name in found]
    subscribed.ask(do="samples")
    with ExitStack() as stack:
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            running = [stack.enter_context(started(image.program)) for image in found.values()]
            before = takes_samples(subscribed, topics)
            relay.connect(0)
            agent.stop(signal.SIGKILL)
        subscribed.ask(do="samples")
        with running_agent(domain, *options) as agent:
            relay.connect(agent.port)
            after = takes_samples(subscribed, topics)
        for process in running:
            kill(process)
    for topic in topics:
        values = before[topic] + after[topic]
        assert values == sorted(set(values)), "in order, none twice"
