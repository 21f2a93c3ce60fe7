# SPDX-License-Identifier: Apache-2.0
"""Local delivery on a board: its instructions, compared with the way over the agent (docs/verification/figures.md)."""

from __future__ import annotations

import pytest

from tests.support.firmware.board import Builds, need
from tests.support.firmware.local import way

NAME = "qemu-mps2-an386"


@pytest.mark.system
def test_its_instructions(builds: Builds) -> None:
    """Goal: a tenth of the way over the agent; not met for an Int32 over UDP, where that way is shortest."""
    need(NAME, emulator=True)
    local, agent = way(builds, NAME, True), way(builds, NAME, False)
    assert local.publish <= 166
    assert local.take <= 178
    assert local.whole <= 0.26 * agent.whole
