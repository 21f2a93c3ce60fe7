# SPDX-License-Identifier: Apache-2.0
"""Instructions of local delivery on three processors in QEMU, and of the way over the agent."""

from __future__ import annotations

from pathlib import Path

from tests.bench.images import PROCESSORS
from tests.support.firmware.board import Builds
from tests.support.firmware.local import way


def bench_local(folder: Path) -> None:
    """Print one line for each processor."""
    builds = Builds(folder)
    print("local: instructions of publish and take of an Int32, inside the image; over the agent; ratio")
    for board, processor in PROCESSORS.items():
        local, agent = way(builds, board, True), way(builds, board, False)
        print(
            f"  {processor:12} {local.publish:4} + {local.take:4}; {agent.publish:5} + {agent.take:5}; "
            f"{local.whole / agent.whole:.2f}"
        )
    print()
