# SPDX-License-Identifier: Apache-2.0
"""All RAM of a linked application that grows with the message it receives, in times of that message."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest

from tests.support.firmware.board import Builds, Built, need
from tests.support.firmware.footprint import image_sections
from tests.support.slices import first, spread_rows

CORTEX_M4 = "qemu-mps2-an386"
GOAL = 2.5
SMALL = 4
APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+executor]
errors: code
transport: {transport}
nodes:
  - name: eyes
    subscriptions:
      - {{topic: scan, type: sensor_msgs/msg/LaserScan, storage: {storage}, {qos}}}
limits:
  sensor_msgs/msg/LaserScan: {{header: {{frame_id: 16}}, ranges: {ranges}, intensities: {ranges}}}
"""
BEST_EFFORT = "qos: {reliability: best_effort, depth: 1}"
LINES = {
    "serial, reliable": ("{type: serial}", "qos: {depth: 1}"),
    "serial, reliable, queue": ("{type: serial}", "queue: 1"),
    "serial, best effort": ("{type: serial, mtu: 8192}", BEST_EFFORT),
    "udp, reliable": ("{type: udp}", "queue: 1"),
    "udp, best effort": ("{type: udp, mtu: 8192}", BEST_EFFORT),
}


def _text(line: str, ranges: int, storage: str = "none") -> str:
    transport, qos = LINES[line]
    return APPLICATION.format(transport=transport, qos=qos, ranges=ranges, storage=storage)


def _built(builds: Builds, line: str, ranges: int, storage: str = "none") -> Built:
    """How the sources are compiled does not change what RAM the image has."""
    return builds.merged(CORTEX_M4, _text(line, ranges, storage))


def _ram(builds: Builds, built: Built, line: str, ranges: int) -> int:
    suffix = "best_effort" if "best effort" in line else "default"
    flags = [f"-DSCAN_RANGES={ranges}", f"-DSCAN_INIT=rclc_subscription_init_{suffix}"]
    flags += ["-DSCAN_UDP"] if line.startswith("udp") else []
    return image_sections(built, builds.application(built, "scan.c", *flags)).ram


def _largest(built: Built) -> int:
    types = json.loads((built.out / "manifest.json").read_text())["types"]
    return int(types["sensor_msgs/msg/LaserScan"]["max_encoded_size"])


def _times(builds: Builds, line: str, ranges: int, storage: str = "none") -> float:
    """Return the RAM that grows with the message, in times of the message.

    It is what an image has more than one for a small message, and all that this one can have of it: that many times
    the goal, and the input buffer that no plan goes below.
    """
    large, small = (_built(builds, line, count, storage) for count in (ranges, SMALL))
    grown = _ram(builds, large, line, ranges) - _ram(builds, small, line, SMALL)
    least = int(json.loads((small.out / "manifest.json").read_text())["pools"]["input_size"])
    return (grown + GOAL * _largest(small) + least) / _largest(large)


@pytest.mark.system
@pytest.mark.parametrize("line", first(LINES))
def test_a_laser_scan_at_depth_1(builds: Builds, line: str) -> None:
    """Queue, input buffer, the interrupt's ring, bound storage, and the message with its buffers in the program."""
    need(CORTEX_M4)
    assert _times(builds, line, 360) <= GOAL


@pytest.mark.system
def test_storage_that_the_library_binds_is_the_difference(builds: Builds) -> None:
    """Without `storage: none` the library has memory for the message besides that of the program."""
    need(CORTEX_M4)
    line = "udp, reliable"
    kept, none = (_ram(builds, _built(builds, line, 360, s), line, 360) for s in ("planned", "none"))
    assert 2 * 4 * 360 <= kept - none < 2 * 4 * 360 + 64


def _size(built: Built) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what `size` says, and of the subscription."""
    command = [sys.executable, "-m", "microros_gen", "size", str(built.out), "--format", "json"]
    report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    [scan] = [entity for entity in report["entities"] if entity["kind"] == "subscription"]
    return report, scan


@pytest.mark.system
def test_a_queue_of_bytes_takes_what_it_is_given(builds: Builds) -> None:
    """Ten samples that share the bytes of one of the largest: nine less, and where the oldest and newest are."""
    need(CORTEX_M4)
    texts = [
        APPLICATION.format(transport="{type: udp}", qos=f"queue: 10{key}", ranges=360, storage="none")
        for key in ("", ", queue_bytes: 2952")
    ]
    slots, shared = (builds.build(CORTEX_M4, text) for text in texts)
    [declared] = json.loads((shared.out / "manifest.json").read_text())["entities"]["subscriptions"]
    assert (declared["queue"], declared["queue_bytes"]) == (10, 2952)
    (before, with_slots), (after, with_bytes) = _size(slots), _size(shared)
    saved = 10 * declared["slot_size"] - 2952
    assert with_slots["ram"] - with_bytes["ram"] == saved - 8
    assert before["totals"]["ram"] - after["totals"]["ram"] >= saved - 8, "and a smaller input buffer"
    assert after["totals"]["flash"] - before["totals"]["flash"] < 600


@pytest.mark.system
@pytest.mark.parametrize(
    ("line", "loaned"), spread_rows([("udp, best effort", True), ("udp, reliable", False)])
)
def test_size_counts_a_slot_in_the_input_buffer_once(builds: Builds, line: str, loaned: bool) -> None:
    """Samples that wait there take no memory of the subscription."""
    need(CORTEX_M4)
    built = builds.build(CORTEX_M4, _text(line, 360))
    report, scan = _size(built)
    buffer = sum(part["bytes"] for part in report["ram"] if part["use"] == "input buffer")
    assert (buffer > _largest(built)) == loaned == (scan["ram"] < 200)
    assert scan["shared"] == ([{"what": "input buffer", "bytes": buffer, "users": 1}] if loaned else [])
