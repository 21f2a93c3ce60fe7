# SPDX-License-Identifier: Apache-2.0
"""Instructions of single functions: what runs in the emulator, and the bound of the call graph."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from microros_gen.image.elf import Elf
from microros_gen.image.folder import read_folder
from microros_gen.image.lock_holds import longest_calls
from microros_gen.image.paths import Length
from microros_gen.image.report import measure_folder
from tests.support.firmware.board import Built
from tests.support.firmware.instructions import counted_regions


def measured_calls(built: Built, image: Path, left_out: Iterable[str] = ()) -> Sequence[int]:
    """Return the instructions between each two marks of a program; functions of `left_out` do not count."""
    return counted_regions(built.target, image, left_out)[0::2]


def bounds_of(
    built: Built, image: Path, names: Sequence[str], port: int | None = None
) -> Mapping[str, Length]:
    """Return the longest call of each of these functions; `port`: of those of the port."""
    return longest_calls(measure_folder(read_folder(built.out, image)), Elf(image), names, port=port)
