# SPDX-License-Identifier: Apache-2.0
"""Instructions of a message from a publisher to a callback: of the same image, of another image, and over the agent."""

from __future__ import annotations

from dataclasses import dataclass

from tests.support.firmware.board import Builds, target
from tests.support.firmware.footprint import AGENT_FUNCTIONS, INTERRUPTS
from tests.support.firmware.instructions import counted_regions

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
transport: {type: TRANSPORT}
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    publishers: [{topic: count, type: TYPE, local: WHERE}]
    subscriptions: [{topic: HEARD, type: TYPE, local: WHERE}]
"""
SYSTEM = """\
version: 1
boards: {device: {application: microros.yaml}, other: {application: other.yaml}}
chips: [[device, other]]
"""
REFERENCE = "system: {file: system.yaml, board: device}\n"
MESSAGES = {"Int32": ("std_msgs/msg/Int32", ()), "Pose": ("geometry_msgs/msg/Pose", ("-DMEASURED_POSE",))}
MEASURED = {"only": (), "never": ("-DMEASURED_AGENT",), "chip": ("-DMEASURED_CHIP",)}
TRANSPORTS = {"udp": (), "serial": ("-DMEASURED_LINE",)}
LINE_FUNCTIONS = (
    *("line_take", "line_stuff", "line_crc", "line_frame", "port_serial_open", "port_serial_close"),
    *("port_serial_room", "port_serial_write", "port_serial_send_kept", "port_serial_break_off"),
    *("port_serial_has_kept", "port_serial_is_idle", "port_serial_read", "port_bare_serial_arrived"),
)
"""Functions of c/measured_serial.h: the work of the driver and of the agent does not count."""
_STEPS = 4
"""Regions of c/measured_local.c for each message: what is around, publish, the agent, the executor."""
_BEFORE = 2
"""Regions before the first publish call: an empty one, and what is around."""


@dataclass(frozen=True)
class Way:
    """Instructions of a publish call, and of the executor's from its beginning to the callback."""

    publish: int
    spin: int

    @property
    def whole(self) -> int:
        """Both together."""
        return self.publish + self.spin


def way(builds: Builds, name: str, local: str, message: str = "Int32", transport: str = "udp") -> Way:
    """Count the second message on a board; `local` as in the application file.

    The work of the agent does not count, nor that of the other image of a chip, which sends the message back.
    """
    type_, flags = MESSAGES[message]
    text = APPLICATION.replace("WHERE", local).replace("TYPE", type_).replace("TRANSPORT", transport)
    more_files: tuple[tuple[str, str], ...] = ()
    if local == "chip":
        other = text.replace("count", "SAID").replace("HEARD", "count").replace("SAID", "heard")
        other = other.replace("device", "other") + REFERENCE.replace("device", "other")
        more_files = (("system.yaml", SYSTEM), ("other.yaml", other))
        text = text.replace("HEARD", "heard") + REFERENCE
    text = text.replace("HEARD", "count")
    flags = (*flags, *TRANSPORTS[transport], *MEASURED[local])
    image = builds.application(builds.build(name, text, more_files), "measured_local.c", *flags)
    left_out = (*AGENT_FUNCTIONS, *INTERRUPTS, *LINE_FUNCTIONS, "agent_returns")
    empty, *steps = counted_regions(target(name), image, left_out)
    second = _BEFORE - 1 + _STEPS
    assert len(steps) > second + 2, "the program ended early"
    return Way(steps[second] - empty, steps[second + 2] - empty)
