# SPDX-License-Identifier: Apache-2.0
"""Measures the library with the tool chain's own `size`: two numbers for the summary of `build`.

`report` measures the image in full.
"""

from __future__ import annotations

from pathlib import Path

from microros_gen.records import dataclass
from microros_gen.toolchain.compile import LIBRARY
from microros_gen.toolchain.toolchain import Toolchain, run, sibling


@dataclass(frozen=True)
class Usage:
    """Bytes of the library: `flash` is code, constants and initial values; `ram` is data and bss."""

    flash: int
    ram: int


def measure_library(out: Path, tools: Toolchain) -> Usage | None:
    """Return the output of `size` for the library; None if the tool chain has no `size`."""
    program = sibling(tools.archiver, "ar", "size")
    if program is None:
        return None
    result = run([program, "-B", LIBRARY], out)
    if result.returncode != 0:
        return None
    flash, ram = 0, 0
    for line in result.stdout.splitlines()[1:]:
        text, data, bss = (int(part) for part in line.split()[:3])
        flash, ram = flash + text + data, ram + data + bss
    return Usage(flash, ram)
