# SPDX-License-Identifier: Apache-2.0
"""What the tool builds, run: samples and graph as a ROS 2 process sees them, with sanitizers in the image."""

from __future__ import annotations

import math
import time
from contextlib import ExitStack
from itertools import pairwise
from typing import Any

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import DECLARED, SANITIZE, Image, Images, ends_well, kill, started
from tests.support.e2e.programs import run_to, until
from tests.support.e2e.relay import Relay
from tests.support.patience import seconds

pytestmark = pytest.mark.ros

SAMPLES = 150
FULL = (
    "int32: publisher /int32: stream full, 4 unacknowledged: the agent is away,"
    " or raise pools: {history: 5} in microros.yaml"
)
SHORT_RUN = (*SANITIZE, f"-DEXAMPLE_SAMPLES={SAMPLES}", "-DEXAMPLE_PERIOD_MS=20")


def declared(name: str) -> str:
    """Return the declared application in a separate namespace; with it goes the client key."""
    return DECLARED.replace("/arm", f"/{name}") + "pools: {history: 16}\n"


def subscribe(observer: Observer, name: str) -> None:
    observer.subscribe(f"/{name}/imu/data", "sensor_msgs/msg/Imu", reliable=False)
    observer.subscribe(f"/{name}/count", "std_msgs/msg/Int32")
    observer.subscribe(f"/{name}/imu_node/state", "std_msgs/msg/String", transient_local=True)


def are_known(publishers: list[list[str]] | None) -> bool:
    """Return whether publishers have been discovered, and the names of their nodes, which come a moment later."""
    return bool(publishers) and not any("_NODE_NAME_UNKNOWN_" in node for node, *_ in publishers or ())


def check_graph(graph: dict[str, Any], name: str) -> None:
    node = f"/{name}/imu_node"
    assert graph["nodes"].count(node) == 1
    assert graph["topics"][f"/{name}/imu/data"] == ["sensor_msgs/msg/Imu"]
    assert graph["topics"][f"/{name}/count"] == ["std_msgs/msg/Int32"]
    assert graph["topics"][f"{node}/state"] == ["std_msgs/msg/String"]
    assert graph["publishers"][f"/{name}/imu/data"] == [[node, "BEST_EFFORT", "VOLATILE"]]
    assert graph["publishers"][f"/{name}/count"] == [[node, "RELIABLE", "VOLATILE"]]
    assert graph["publishers"][f"{node}/state"] == [[node, "RELIABLE", "TRANSIENT_LOCAL"]]


@pytest.mark.system
def test_what_every_compiler_makes(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """The profile alone, and the declared application by gcc, clang and for 32 bit, all at the same time: each
    sample in order with its contents on both streams, the graph as asked for, no word of a sanitizer, and each
    leaves the graph with its end.
    """
    compilers = {
        "gcc": ("gcc", SHORT_RUN),
        "clang": ("clang", (*SHORT_RUN, "-O0")),
        "m32": ("gcc", ("-m32", *SHORT_RUN, "-O0")),
    }
    built = {
        name: images.build(image_port.port, declared(name), compiler, flags)
        for name, (compiler, flags) in compilers.items()
    }
    alone = images.build(image_port.port, "", "gcc", SHORT_RUN)
    observer.subscribe("/int32", "std_msgs/msg/Int32")
    for name in built:
        subscribe(observer, name)
    observer.ask(do="samples")
    with ExitStack() as stack:
        processes = [stack.enter_context(started(image.program)) for image in (alone, *built.values())]
        states = [f"/{name}/imu_node/state" for name in built]
        graph = observer.see(lambda g: all(are_known(g["publishers"].get(at)) for at in (*states, "/int32")))
        found = until(observer, [*(f"/{name}/count" for name in built)], SAMPLES - 1)
        for process in processes[1:]:
            ends_well(process)
        _, refused = processes[0].communicate(timeout=seconds(15))
    for topic, value in observer.ask(do="samples"):
        found.setdefault(topic, []).append(value)
    assert graph["nodes"].count("/pure_sender") == 1
    assert graph["topics"]["/int32"] == ["std_msgs/msg/Int32"]
    assert graph["publishers"]["/int32"] == [["/pure_sender", "RELIABLE", "VOLATILE"]]
    check_counter([value["data"] for value in found["/int32"]], refused.splitlines(), processes[0].returncode)
    for name in built:
        check_graph(graph, name)
        run_to(SAMPLES - 1, [value["data"] for value in found[f"/{name}/count"]])
        check_measurements(found[f"/{name}/imu/data"])
        assert {value["data"] for value in found[f"/{name}/imu_node/state"]} == {"imu_node"}
    ours = {"/pure_sender", *(f"/{name}/imu_node" for name in built)}
    seen = observer.see(lambda g: not ours & set(g["nodes"]))
    assert not any(seen["publishers"].get(f"/{name}/count") for name in built)


def check_counter(values: list[int], errors: list[str], status: int) -> None:
    """Check that every sample that was accepted came, once and in order, and that the others were refused in
    words: with the four places that a stream has by default, a busy machine may fill it.
    """
    assert set(errors) <= {FULL}
    assert status == (1 if errors else 0)
    assert all(a < b for a, b in pairwise(values))
    assert values[-1] - values[0] + 1 - len(values) <= len(errors)
    assert len(values) >= 5


def check_measurements(measurements: list[Any]) -> None:
    """Check the fields that the example fills, and that it leaves the others alone."""
    turns = [value["angular_velocity"]["x"] for value in measurements]
    counts = [round(turn / 0.1) for turn in turns]
    assert all(a < b for a, b in pairwise(counts))
    assert len(counts) >= max(20, 0.8 * (SAMPLES - counts[0])), "best effort, but not at its worst"
    # The 32-bit image rounds 0.1 * count in the wider registers of the x87 first.
    assert all(abs(turn - 0.1 * round(turn / 0.1)) <= math.ulp(turn) for turn in turns)
    now = time.time()
    for value in measurements:
        assert value["header"]["frame_id"] == "imu_node"
        stamp = value["header"]["stamp"]
        assert now - 30 < stamp["sec"] + stamp["nanosec"] * 1e-9 <= now
        turn = value["angular_velocity"]["x"]
        assert set(value["angular_velocity"].values()) == {turn}
        assert set(value["linear_acceleration"].values()) == {turn}
        assert value["orientation"] == {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
        assert value["orientation_covariance"] == [0.0] * 9
    stamps = [(v["header"]["stamp"]["sec"], v["header"]["stamp"]["nanosec"]) for v in measurements]
    assert stamps == sorted(stamps)


@pytest.mark.system
def test_an_image_that_is_killed_leaves_the_graph_and_returns(
    profile_image: Image, agent: AgentProcess, observer: Observer
) -> None:
    with started(profile_image.program) as process:
        observer.see(lambda g: "/pure_sender" in g["nodes"])
        kill(process)
    start = time.monotonic()
    observer.see(lambda g: "/pure_sender" not in g["nodes"])
    assert time.monotonic() - start > 0.5, "only the time-out of the agent can tell"
    with started(profile_image.program):
        graph = observer.see(lambda g: "/pure_sender" in g["nodes"])
        assert graph["nodes"].count("/pure_sender") == 1
