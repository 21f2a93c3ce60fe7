# SPDX-License-Identifier: Apache-2.0
"""A parameter server on three processors: image, instructions in QEMU, and what one more parameter takes."""

from __future__ import annotations

from pathlib import Path

from tests.bench.images import PROCESSORS
from tests.support.firmware.board import Builds
from tests.support.firmware.parameters import ADDED, TYPES, cost, taken, work

CORTEX_M4 = "qemu-mps2-an386"


def bench_parameters(folder: Path) -> None:
    """Print one table for each."""
    builds = Builds(folder)
    print("parameters: four of them, six services, executor; flash / RAM / worst stack that `size` proves")
    for board, processor in PROCESSORS.items():
        for label, flags in (("declared", ()), ("added by the program", ADDED)):
            found = taken(builds, board, flags)
            print(f"  {processor:12} {label:24} {found.flash:,} / {found.size.ram:,} / {found.stack:,}")
    print("  instructions: init; get and set by request; get and set by call")
    for board, processor in PROCESSORS.items():
        done = work(builds, board)
        print(
            f"  {processor:12} {done.init:8,} {done.get:8,} {done.set:8,} {done.get_call:8,} {done.set_call:8,}"
        )
    print("  one more on the Cortex-M4, flash / RAM: messages for four; messages for all")
    for kind in TYPES:
        alone, whole = (cost(builds, CORTEX_M4, kind, messages) for messages in (False, True))
        print(f"  {kind:12} {alone[0]:6.1f} / {alone[1]:5.1f} {whole[0]:8.1f} / {whole[1]:5.1f}")
    print()
