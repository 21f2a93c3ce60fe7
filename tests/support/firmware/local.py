# SPDX-License-Identifier: Apache-2.0
"""Instructions of a message from a publisher to a subscription of the same image, and of the way over the agent."""

from __future__ import annotations

from dataclasses import dataclass

from tests.support.firmware.board import Builds, target
from tests.support.firmware.footprint import AGENT_FUNCTIONS, EXIT, INTERRUPTS
from tests.support.firmware.instructions import trace_regions

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
errors: code
transport: {type: udp}
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32, local: WHERE}]
    subscriptions: [{topic: count, type: std_msgs/msg/Int32, local: WHERE}]
"""
_STEPS = 3
"""Regions of c/measured_local.c for each message: publish, the agent, take."""


@dataclass(frozen=True)
class Way:
    """Instructions of a publish call, and of the take call that returns the message."""

    publish: int
    take: int

    @property
    def whole(self) -> int:
        """Both calls together."""
        return self.publish + self.take


def way(builds: Builds, name: str, local: bool) -> Way:
    """Count the second message on a board: `local`, or over the agent of c/measured.h, whose work does not count."""
    text = APPLICATION.replace("WHERE", "only" if local else "never")
    flags = () if local else ("-DMEASURED_AGENT",)
    image = builds.application(builds.build(name, text), "measured_local.c", *flags)
    emulator = target(name).emulator
    assert emulator is not None
    command = [emulator.program, *emulator.arguments, *EXIT]
    left_out = (*AGENT_FUNCTIONS, *INTERRUPTS, "agent_returns")
    empty, *steps = (region.counted for region in trace_regions(command, image, left_out))
    assert len(steps) >= 2 * _STEPS, "the program ended early"
    return Way(steps[_STEPS] - empty, steps[_STEPS + 2] - empty)
