# SPDX-License-Identifier: Apache-2.0
"""A node with modes on a board: its size, also of each mode, and what remains without them."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.cli.size.format import constants
from microros_gen.image.report import measure
from tests.support.firmware.board import Builds, generate, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.slices import beyond

NAME = "qemu-mps2-an386"
PARAMETERS = """\
version: 1
profiles: [managed_service]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}
      - {name: gain, type: integer, default: 3}
      - {name: limit, type: double, default: 1.0}
      - {name: brake, type: bool}
"""
MODES = """\
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0.2, brake: true}
      FAST: {speed: 2.0, gain: 5, limit: 2.5}
"""
APPLICATION = f"{PARAMETERS}{MODES}components: [+node_modes]\n"
WITHOUT = f"{PARAMETERS}components: [+parameters]\n"
SIZES = {NAME: (34_836, 6_804, 1_184), "qemu-mps2-an505": (34_892, 6_804, 1_188)}
"""Flash, RAM without the stack, worst stack."""
MORE = (3_428, 592)
"""Flash and RAM of modes on the Cortex-M4: what the image has more than without them."""
EACH = {"mode arm_device_DEFAULT": 36, "mode arm_device_FAST": 32, "mode arm_device_SLOW": 36}
"""Bytes of each mode: 8 for a number, 1 for each parameter where the system sets one."""


@pytest.mark.system
@pytest.mark.parametrize(("name", "limits"), beyond(SIZES, {"qemu-mps2-an505"}))
def test_its_size(builds: Builds, name: str, limits: tuple[int, int, int]) -> None:
    """Life cycle, parameters and modes, executor, over a serial line."""
    need(name)
    built = builds.build(name, APPLICATION)
    image = builds.application(built, "modes.c")
    size = image_sections(built, image)
    found = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(value <= limit for value, limit in zip(found, limits, strict=True)), found


@pytest.mark.system
def test_what_modes_take(builds: Builds) -> None:
    need(NAME)
    built, plain = builds.build(NAME, APPLICATION), builds.build(NAME, WITHOUT)
    image = image_sections(built, builds.application(built, "modes.c"))
    without = image_sections(plain, builds.application(plain, "modes_without.c"))
    found = (image.text + image.data - without.text - without.data, image.ram - without.ram)
    assert all(value <= limit for value, limit in zip(found, MORE, strict=True)), found


@pytest.mark.system
def test_the_size_of_each_mode_is_reported(builds: Builds) -> None:
    """In flash; a number has 8 bytes, and the texts of others are in the mode that writes them."""
    need(NAME)
    built = builds.build(NAME, APPLICATION)
    report = measure(built.out, builds.application(built, "modes.c"))
    assert {use: size for owner, use, size in constants(report) if owner == "node_modes"} == EACH


def test_a_client_without_modes_has_nothing_of_them(tmp_path: Path) -> None:
    generate(tmp_path, NAME, WITHOUT)
    plain = tmp_path / "out"
    assert (plain / "src" / "parameters").exists()
    assert not (plain / "src" / "node_modes").exists()
    assert "modes" not in (plain / "include" / "microros" / "xrce_client.h").read_text()
