# SPDX-License-Identifier: Apache-2.0
"""The log writer whose lines survive a reset: a reset at every access, damaged memory, sizes and warnings."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.components.logging.plan import LoggingPlan
from microros_gen.components.logging_ring.plan import RingPlan
from microros_gen.components.logging_rosout.plan import RosoutPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import UNITS, planned, rendered, run
from tests.support.ids import without_id
from tests.support.runtime.harness import quick

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes: [{name: device}]
logging: [{to: rosout, level: warn}, {to: ring, level: debug, size: %d}]
"""
BOARD = APPLICATION + "target: qemu-mps2-an386\nsession: {key: 7}\n"
WRAPPED = 700
"""Bytes of a ring in which a dozen of lines do not fit."""


@pytest.mark.system
def test_lines_after_a_reset_at_every_access(tmp_path: Path) -> None:
    out = rendered(tmp_path, APPLICATION % WRAPPED)
    program, (by, flags) = tmp_path / "unit", quick()
    include = (f"-I{out / 'include'}", f"-I{out / 'src' / 'logging_ring'}", f"-I{UNITS}")
    run(by, "-std=gnu99", *flags, *include, UNITS / "unit_log_ring.c", "-o", program)
    assert int(run(program).split()[0]) > 1000


def test_a_ring_brings_rosout_with_it(tmp_path: Path) -> None:
    found = planned(tmp_path, APPLICATION.replace("{to: rosout, level: warn}, ", "") % 2048)
    features = found.project.runtime.features
    part = features.of("logging_ring")
    assert isinstance(part, RingPlan)
    assert (part.level, part.size) == (10, 2048)
    logging, rosout = features.of("logging"), features.of("logging_rosout")
    assert isinstance(logging, LoggingPlan)
    assert isinstance(rosout, RosoutPlan)
    assert (logging.text, logging.level) == ("rosout from info, ring from debug", 10)
    assert rosout.level == 20


@pytest.mark.parametrize("size", [0, 64, 40_000])
def test_a_ring_that_is_too_small_or_too_large(tmp_path: Path, size: int) -> None:
    with pytest.raises(UserError) as raised:
        planned(tmp_path, BOARD % size)
    (found,) = (without_id(d.headline()) for d in raised.value.diagnostics)
    what, hint = found.split(". ")
    assert what.endswith(
        f"microros.yaml:4:38: error: the log writer 'ring' has {size} bytes; "
        "'size' must be 292 (the largest line) to 32768"
    )
    assert hint == "Write `size: 1024`, or lower the limits of rcl_interfaces/msg/Log"


def test_where_the_linker_script_is_not_ours_the_section_is_named(tmp_path: Path) -> None:
    found = planned(tmp_path, APPLICATION % 1024)
    (warning,) = found.warnings
    assert "lines of the log writer 'ring' are lost at a reset: host has" in warning.message
    assert not planned(tmp_path, BOARD % 1024).warnings
