# SPDX-License-Identifier: Apache-2.0
"""A component that no file of the package knows: it publishes the counters of the session as diagnostic_msgs."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

import microros_gen
from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import Images, ends_well, started, tool
from tests.support.e2e.relay import Relay

COMPONENT = Path(__file__).with_name("components") / "session_diagnostics"
APPLICATION = f"""\
version: 1
profiles: [pure_sender]
components: [+executor, +timers, {COMPONENT}]
nodes:
  - name: board
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    timers: [{{name: tick, period: 100 ms}}]
"""
TICKS = 80
COUNTERS = ["sent", "resent", "received", "malformed", "dropped", "reconnects"]


def test_the_package_does_not_know_it() -> None:
    package = Path(microros_gen.__file__).parent
    files = (
        path for path in package.rglob("*") if path.suffix in (".py", ".yaml", ".j2", ".c", ".h", ".json")
    )
    assert [path for path in files if COMPONENT.name in path.read_text(encoding="utf-8")] == []


@pytest.mark.system
@pytest.mark.ros
def test_rclpy_reads_what_it_publishes(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer, tmp_path: Path
) -> None:
    image = images.build(image_port.port, APPLICATION)
    example = image.out / "examples" / "pure_sender" / "main.c"
    program = image.application(example, tmp_path / "board", f"-DEXAMPLE_SAMPLES={TICKS}u")
    observer.subscribe("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
    with started(program) as process:
        arrays = _diagnostics(observer, 3)
        ends_well(process, 60.0)
    for array in arrays:
        (status,) = array["status"]
        assert (status["level"], status["name"]) == (0, "micro-ROS session")
        assert [row["key"] for row in status["values"]] == COUNTERS
        assert array["header"]["stamp"]["sec"] > 1_700_000_000
    sent = [int(array["status"][0]["values"][0]["value"]) for array in arrays]
    assert 0 < sent[0] < sent[1] < sent[2]
    stamps = [array["header"]["stamp"] for array in arrays]
    between = [(b["sec"] - a["sec"]) + (b["nanosec"] - a["nanosec"]) / 1e9 for a, b in pairwise(stamps)]
    assert all(period > 0.9 for period in between), "at most once a second"
    tool("build", "-c", image.out.parent / "microros.yaml", "-o", image.out)
    explained = _explain(image.out, "rcl_diagnostics_publish")
    assert explained["of"] == COMPONENT.name
    assert explained["reasons"] == ["components: +session_diagnostics (microros.yaml:3)"]
    assert explained["flash"] > 0
    assert "(from folder session_diagnostics)" in _explain(image.out, COMPONENT.name)["note"]


def _diagnostics(observer: Observer, count: int) -> list[dict[str, Any]]:
    """Return `count` samples of /diagnostics, or more."""
    return [value for _, value in observer.got(count, 30.0, "/diagnostics")]


def _explain(out: Path, what: str) -> dict[str, Any]:
    return dict(json.loads(tool("explain", out, what, "--format", "json")))
