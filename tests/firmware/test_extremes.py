# SPDX-License-Identifier: Apache-2.0
"""The worst that loops of the library can be given: each takes no more than its bound, and no bound is far above it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Builds
from tests.support.firmware.bounds import bounds_of, measured_calls
from tests.support.firmware.tasks import BOARD

SOURCE = C_FILES / "measured_extremes.c"
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services]
errors: code
limits: {"*": {string: 32}, std_msgs/msg/String: {data: 700}}
pools: {history: 8, input_history: 8}
logging: [{to: rosout, level: info}, {to: ring, level: info, size: 1 KiB}]
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: heard, type: std_msgs/msg/String, qos: {reliability: reliable}}]
    clients: [{name: off, type: std_srvs/srv/SetBool, queue: 8}]
"""
EXTREME = re.compile(r"^  EXTREME\(\s*(\w+),", re.MULTILINE)
AROUND = 16
"""Instructions of the program between the marks: the arguments, the call, and the ends of the marks."""
CLOSE = 6
"""How far above the longest call the bound of a function may be: each byte of a copy counts, and it takes words."""
FAR = {"xrce_stream_reliable_input_on_heartbeat"}
"""Their bound counts the ACKNACK as the largest message of the line."""
PORT = ("port_serial_write", "port_serial_read")
"""They wait for the line: neither what runs of them counts, nor what the bound would have."""


@pytest.mark.system
def test_the_worst_input_takes_no_more_than_the_bound_and_not_far_less(
    builds: Builds, tmp_path: Path
) -> None:
    built = builds.build(BOARD, APPLICATION)
    image = built.link(SOURCE, tmp_path / "extremes.elf")
    names = EXTREME.findall(SOURCE.read_text(encoding="utf-8"))
    counted = measured_calls(built, image, PORT)
    bounds = bounds_of(built, image, names, port=0)
    longest = dict[str, int]()
    for name, measured in zip(names, counted, strict=True):
        longest[name] = max(measured, longest.get(name, 0))
    assert set(bounds) == set(longest)
    for name, measured in longest.items():
        bound = bounds[name]
        assert bound.open == frozenset(), (name, bound.open)
        assert measured <= bound.count + AROUND, (name, measured, bound.count)
        assert name in FAR or bound.count <= CLOSE * measured, (name, measured, bound.count)
