# SPDX-License-Identifier: Apache-2.0
"""Instructions of local delivery on three processors in QEMU, inside an image and between two, and over the agent."""

from __future__ import annotations

from pathlib import Path

from tests.bench.images import PROCESSORS
from tests.support.firmware.board import Builds
from tests.support.firmware.local import MESSAGES, TRANSPORTS, way


def bench_local(folder: Path) -> None:
    """Print two lines for each processor, message and transport: inside an image, and between two images of a chip."""
    builds = Builds(folder)
    print("local: instructions of publish and of the executor up to the callback; over the agent; ratio")
    for board, processor in PROCESSORS.items():
        for message in MESSAGES:
            for transport in TRANSPORTS:
                agent = way(builds, board, "never", message, transport)
                for where in ("only", "chip"):
                    local = way(builds, board, where, message, transport)
                    print(
                        f"  {processor:12} {message:6} {transport:7} {where}: {local.publish:4} + {local.spin:4}; "
                        f"{agent.publish:5} + {agent.spin:5}; {local.whole / agent.whole:.3f}"
                    )
    print()
