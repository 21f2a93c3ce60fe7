# SPDX-License-Identifier: Apache-2.0
"""A node with a life cycle on three processors: instructions in QEMU. What it takes is in the table of images."""

from __future__ import annotations

from pathlib import Path

from tests.bench.images import PROCESSORS
from tests.support.firmware.board import Builds
from tests.support.firmware.lifecycle import work


def bench_lifecycle(folder: Path) -> None:
    """Print one line a processor."""
    builds = Builds(folder)
    print("lifecycle: instructions: init; change_state and get_state, from request to reply")
    for board, processor in PROCESSORS.items():
        done = work(builds, board)
        print(f"  {processor:12} {done.init:8,} {done.change:8,} {done.get:8,}")
    print()
