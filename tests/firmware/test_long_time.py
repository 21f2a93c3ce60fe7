# SPDX-License-Identifier: Apache-2.0
"""64-bit time of platforms whose milliseconds wrap, in programs that do not read it for months."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.platform.find import builtin_targets
from microros_gen.selection.find_components import components_folder, parts_folder
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.firmware.board import C_FILES, Builds, check, need, target
from tests.support.firmware.instructions import run_to_end

NAME = "qemu-mps2-an386"
WAITS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +clock]
errors: code
pools: {handles: 2, guard_conditions: 1}
nodes:
  - name: device
    publishers: [{topic: first, type: std_msgs/msg/Int32, local: only}]
    subscriptions: [{topic: first, type: std_msgs/msg/Int32, local: only}]
"""
CLIENT = "#pragma once\n#include <stdint.h>\ntypedef struct xrce_client_t {\n  uint8_t time_half;\n} xrce_client_t;\n"
BARE = parts_folder() / "os" / "bare"
ARDUINO = parts_folder() / "package" / "arduino" / "os"
SANITIZE = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.mark.system
def test_a_board_waits_for_months(builds: Builds) -> None:
    """On the emulated board, with the whole library: four wraps in one wait of an executor."""
    need(NAME, emulator=True)
    built = builds.build(NAME, WAITS)
    image = builds.application(built, "long_time.c")
    assert run_to_end(built.target, image) == (0, b"")


@pytest.mark.parametrize(
    ("os", "files"),
    [
        (BARE, ("port_bare_steady.c", "port_bare_epoch.c")),
        (ARDUINO, ("port_arduino_steady.c", "port_arduino_epoch.c")),
    ],
    ids=["bare", "arduino"],
)
def test_pumps_and_waits_alone_keep_the_time_of_a_port(
    tmp_path: Path, os: Path, files: tuple[str, ...]
) -> None:
    (tmp_path / "microros").mkdir()
    (tmp_path / "microros" / "xrce_client.h").write_text(CLIENT)
    (tmp_path / "Arduino.h").write_text("unsigned long millis(void);\nunsigned long micros(void);\n")
    long_time = components_folder() / "long_time"
    folders = (tmp_path, os / "include", long_time / "include", components_folder() / "base" / "include")
    includes = [f"-I{folder}" for folder in (*folders, C_FILES)]
    kind = [f"-DEPOCH_SET=port_{os.name if os == BARE else 'arduino'}_epoch_set"]
    program = tmp_path / "unit"
    sources = [str(C_FILES / "unit_long_time.c"), *(str(os / "src" / name) for name in files)]
    check(["gcc", *WARNINGS, *SANITIZE, *includes, *kind, *sources, "-o", str(program)])
    check([str(program)])


@pytest.mark.parametrize("name", builtin_targets())
def test_boards_without_a_system_count_milliseconds(name: str) -> None:
    """And a system that has a 64-bit clock is not asked to be read."""
    assert target(name).clock_wraps == (name != "host")
