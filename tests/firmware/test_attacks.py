# SPDX-License-Identifier: Apache-2.0
"""Programs that attack the analysis of loops and calls: a bound is above what runs, or the analysis refuses one."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Builds
from tests.support.firmware.bounds import bounds_of, measured_calls
from tests.support.firmware.tasks import BOARD
from tests.support.slices import first

SOURCE = C_FILES / "measured_attacks.c"
APPLICATION = """\
version: 1
profiles: [pure_sender]
errors: code
nodes: [{name: device, publishers: [{topic: count, type: std_msgs/msg/Int32}]}]
"""
ATTACK = re.compile(r"MEASURE\((?:sink = (?:\(uint32_t\))?)?(attack_\w+)\(")
AROUND = 12
"""Instructions of the program between the marks: the arguments, the call, and the ends of the marks."""
UNKNOWN = "is called for an unknown number of bytes"
LOOP = "a loop without a bound"
REFUSED = {
    "attack_table": "a call through a pointer",
    "attack_wrap": LOOP,
    "attack_wrap_for": LOOP,
    "attack_memcpy": UNKNOWN,
    "attack_strlen": UNKNOWN,
    "attack_strncat": UNKNOWN,
    "attack_macro": LOOP,
    "attack_foreign_macro": LOOP,
    "attack_one_line": LOOP,
    "attack_goto": LOOP,
    "attack_goto_around": LOOP,
    "attack_end_of_two": LOOP,
    "attack_chosen": LOOP,
    "attack_same": LOOP,
    "attack_recursion": LOOP,
    "attack_changed": LOOP,
    "attack_by_pointer": LOOP,
}
"""Attacks of which no source tells the rounds or bytes. All others have a bound."""


@pytest.mark.system
@pytest.mark.parametrize("level", first(["-Os", "-O2", "-O3"]))
def test_no_attack_takes_more_instructions_than_its_bound(builds: Builds, tmp_path: Path, level: str) -> None:
    built = builds.build(BOARD, APPLICATION)
    image = built.link(SOURCE, tmp_path / "attacks.elf", level)
    names = ATTACK.findall(SOURCE.read_text(encoding="utf-8"))
    bounds = bounds_of(built, image, names)
    counted = measured_calls(built, image)
    assert set(bounds) == set(names)
    for name, measured in zip(names, counted, strict=True):
        found = bounds[name]
        assert measured > AROUND, (name, "it does nothing")
        assert bool(found.open) == (name in REFUSED), (name, found)
        if found.open:
            assert any(REFUSED[name] in why for why in found.open), (name, found.open)
        else:
            assert measured <= found.count + AROUND, (name, measured, found.count)
