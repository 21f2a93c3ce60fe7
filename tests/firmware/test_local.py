# SPDX-License-Identifier: Apache-2.0
"""Local delivery on a board: its instructions, compared with the way over the agent (docs/verification/figures.md)."""

from __future__ import annotations

import pytest

from tests.support.firmware.board import Builds, need
from tests.support.firmware.local import way
from tests.support.slices import spread_rows

NAME = "qemu-mps2-an386"


@pytest.mark.system
@pytest.mark.parametrize(
    ("message", "transport", "most"),
    spread_rows(
        [("Int32", "serial", 0.09), ("Pose", "serial", 0.05), ("Int32", "udp", 0.30), ("Pose", "udp", 0.29)]
    ),
)
def test_its_instructions(builds: Builds, message: str, transport: str, most: float) -> None:
    """Goal: a tenth of the way over the agent; met on a serial line, not over UDP, where that way is shortest."""
    need(NAME, emulator=True)
    local, agent = (way(builds, NAME, where, message, transport) for where in ("only", "never"))
    assert local.whole <= most * agent.whole
    assert local.publish <= 126
    assert local.spin <= 338
