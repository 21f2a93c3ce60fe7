# SPDX-License-Identifier: Apache-2.0
"""A client that follows the time of this project's agent, on the machine whose time that is."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.agent.process import AgentProcess
from tests.support.components.rendered import run
from tests.support.e2e.images import C_FILES, Images
from tests.support.e2e.relay import Relay

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+time_source]
time_source: {period: 100 ms}
nodes: [{name: n, publishers: [{topic: never, type: std_msgs/msg/Int32}]}]
"""


def test_it_follows_the_agent(images: Images, image_port: Relay, agent: AgentProcess, tmp_path: Path) -> None:
    program = images.build(image_port.port, APPLICATION).application(
        C_FILES / "time_source.c", tmp_path / "time_source", "-std=gnu99", "-Wall", "-Werror"
    )
    error_us, accepted, _, state = map(int, run(program).split())
    assert accepted >= 10
    assert state == 1
    assert abs(error_us) < 20_000, (
        "a round trip here takes less than a millisecond, but the machine may be busy"
    )
