# SPDX-License-Identifier: Apache-2.0
"""Instructions that messages of the library itself take with the lock, against the bound of the call graph."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Builds
from tests.support.firmware.bounds import bounds_of, measured_calls
from tests.support.firmware.tasks import BOARD
from tests.support.slices import first

APPLICATION = """\
version: 1
profiles: [pure_sender]
errors: code
logging: [{writers}]
nodes: [{{name: device, publishers: [{{topic: count, type: std_msgs/msg/Int32}}]}}]
"""
WRITERS = {
    "both": "{to: rosout, level: info}, {to: console, level: info}",
    "ring": "{to: rosout, level: info}, {to: console, level: info}, {to: ring, level: info, size: 2 KiB}",
}
CALLS = 16
"""Calls of c/measured_library_log.c, each of which logs five messages."""
AROUND = 12
"""Instructions of the program between the marks: the arguments, the call, and the ends of the marks."""
CLOSE = 10
"""How far above the heaviest call the bound may be: each text counts as the longest one, a ring as full of nothing."""
HEAVY = 20_000
"""Instructions that five messages for two writers take at least."""


@pytest.mark.system
@pytest.mark.parametrize("writers", first(WRITERS))
@pytest.mark.parametrize("more", first(["", "+logging_float, +logging_wide"]))
def test_five_messages_of_the_library_are_below_their_bound_and_close_to_it(
    builds: Builds, tmp_path: Path, writers: str, more: str
) -> None:
    """The formats of an application do not count: with floating-point numbers their bound is a thousand million."""
    built = builds.build(BOARD, APPLICATION.format(writers=WRITERS[writers]) + f"components: [{more}]\n")
    image = built.link(C_FILES / "measured_library_log.c", tmp_path / "log.elf")
    counted = measured_calls(built, image)
    bound = bounds_of(built, image, ["microros_library_log"])["microros_library_log"]
    assert (len(counted), bound.open) == (CALLS, frozenset())
    assert HEAVY < max(counted) <= bound.count + AROUND, (counted, bound.count)
    assert bound.count < CLOSE * max(counted), (counted, bound.count)
