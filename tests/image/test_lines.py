# SPDX-License-Identifier: Apache-2.0
"""Lines of instructions in an image that begins at address 0, where functions that are left out have some, too."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.image.elf import Elf
from microros_gen.image.lines import Lines, source_places

COMPILER = "arm-none-eabi-gcc"
FLAGS = ("-mcpu=cortex-m4", "-mthumb", "-g", "-Os", "-ffunction-sections", "-c")
LINK = (
    "-mcpu=cortex-m4",
    "-mthumb",
    "-nostdlib",
    "-Wl,--gc-sections",
    "-Wl,-Ttext=0",
    "-Wl,-e,kept",
    "-Wl,--no-warn-rwx-segments",
)
VECTORS = """\
  .section .text.a_vectors, "ax"
  .global vectors
vectors:
  .word 0, 0, 0, 0, 0, 0, 0, 0
"""
KEPT = "int kept(int (*to)(int));\nint kept(int (*to)(int)) {\n  return to(1) +\n    to(2);\n}\n"
LEFT_OUT = "int left(int n);\nint left(int n) {\n" + '  asm volatile("nop");\n' * 60 + "  return n;\n}\n"


@pytest.mark.skipif(
    shutil.which(COMPILER) is None, reason=f"no {COMPILER}: apt-get install gcc-arm-none-eabi"
)
@pytest.mark.builds
def test_no_line_of_a_function_that_is_left_out_hides_another_one(tmp_path: Path) -> None:
    texts = {"a.s": VECTORS, "both.c": KEPT + LEFT_OUT}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
        subprocess.run([COMPILER, *FLAGS, name, "-o", f"{name}.o"], cwd=tmp_path, check=True)
    objects = [f"{name}.o" for name in texts]
    keep = ["-Wl,--undefined=vectors", "-Wl,--sort-section=name"]
    subprocess.run([COMPILER, *LINK, *keep, *objects, "-o", "image.elf"], cwd=tmp_path, check=True)
    image = Elf(tmp_path / "image.elf")
    (kept,) = (s for s in image.symbols if s.name == "kept")
    assert 0 < kept.address < 120, "where the function that is left out would be, too"
    places = source_places(Lines(image), range(kept.address, kept.address + kept.size, 2))
    lines = {int(place.rpartition(":")[2]) for place in places.values()}
    assert lines
    assert max(lines) <= KEPT.count("\n")
