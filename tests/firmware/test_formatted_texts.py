# SPDX-License-Identifier: Apache-2.0
"""Instructions that texts of the log and of errors take on a Cortex-M4 at most, against the bound of the call graph."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Builds
from tests.support.firmware.bounds import bounds_of, measured_calls
from tests.support.firmware.tasks import BOARD

LINES, ERRORS = 18, 7
"""Texts that c/measured_formats.c formats; after them one of the application."""
AROUND = 12
"""Instructions of the program between the marks: the arguments, the call, and the ends of the marks."""
CLOSE = 10
"""How far above the heaviest text the bound may be."""
FUNCTIONS = ("rcutils_logging_format", "microros_error_set", "rcutils_set_error_state")

APPLICATION = """\
version: 1
profiles: [pure_sender]
errors: text
logging: [{to: rosout, level: info}, {to: console, level: info}]
nodes: [{name: device, publishers: [{topic: count, type: std_msgs/msg/Int32}]}]
"""


FLOATS = 30
"""Numbers that c/measured_floats.c formats."""
CLOSE_FLOAT = 20
"""As CLOSE: the compiler makes one loop of two in microros_digits_begin, so that their rounds are multiplied."""


@pytest.mark.system
def test_no_floating_point_number_takes_more_than_the_call_graph_says(builds: Builds, tmp_path: Path) -> None:
    """The largest and the smallest double with the highest precision: all digits are exact, and each is counted."""
    built = builds.build(BOARD, APPLICATION + "components: [+logging_float]\n")
    image = built.link(C_FILES / "measured_floats.c", tmp_path / "floats.elf")
    name = "microros_format_floating"
    bound = bounds_of(built, image, [name])[name]
    measured = measured_calls(built, image)
    assert (len(measured), bound.open) == (FLOATS, frozenset())
    assert max(measured) <= bound.count + AROUND, (measured, bound.count)
    assert bound.count < CLOSE_FLOAT * max(measured), (measured, bound.count)


@pytest.mark.system
def test_no_text_takes_more_instructions_than_the_call_graph_says(builds: Builds, tmp_path: Path) -> None:
    built = builds.build(BOARD, APPLICATION)
    image = built.link(C_FILES / "measured_formats.c", tmp_path / "formats.elf")
    bounds = bounds_of(built, image, FUNCTIONS)
    assert [bounds[name].open for name in FUNCTIONS] == [frozenset()] * len(FUNCTIONS)
    counted = measured_calls(built, image)
    assert len(counted) == LINES + ERRORS + 1
    parts = (counted[:LINES], counted[LINES : LINES + ERRORS], counted[LINES + ERRORS :])
    for name, measured in zip(FUNCTIONS, parts, strict=True):
        most = bounds[name].count
        assert max(measured) <= most + AROUND, (name, measured, most)
        assert most < CLOSE * max(measured), (name, measured, most)
