# SPDX-License-Identifier: Apache-2.0
"""Holds of the lock by the task of the session on byte streams: what runs stays below what the call graph says."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES
from tests.support.firmware.local import LINE_FUNCTIONS
from tests.support.firmware.tasks import built_tasks, counted, holds_of

HEADERS = {"serial": "measured_serial.h", "tcp": "measured_tcp.h"}
LEFT_OUT = (
    *LINE_FUNCTIONS,
    *("port_tcp_open", "port_tcp_close", "port_tcp_send", "port_tcp_receive", "tcp_take", "tcp_answer"),
)
HEARTBEAT = 0x0B
LEAST = {"serial": 3000, "tcp": 1000}
"""Instructions of a hold that a message full of HEARTBEATs must have: five answers."""
CLOSE = {"serial": 15, "tcp": 20}
"""How far above the heaviest message its bound may be: there each stream sends all that it can, at its largest."""
CHUNKS = {"serial": ("",), "tcp": ("", "-DTCP_CHUNK=1")}


@pytest.mark.system
@pytest.mark.parametrize("transport", ["serial", pytest.param("tcp", marks=pytest.mark.variant)])
def test_a_message_full_of_submessages_is_below_the_bound_of_a_byte_stream(
    tmp_path: Path, transport: str
) -> None:
    """Each HEARTBEAT is answered. TCP takes and gives all bytes at once, or one at a time."""
    tasked = built_tasks(tmp_path, transport)
    header = ("-include", "microros/port.h", "-include", str(C_FILES / HEADERS[transport]))
    longest = []
    for chunk in CHUNKS[transport]:
        flags = (*header, f"-DMEASURED_FULL={HEARTBEAT}", *([chunk] if chunk else []))
        image = tasked.link(C_FILES / "measured_tasks.c", tmp_path / "full.elf", *flags)
        session = holds_of(tasked, image)["session"]
        assert session["open"] == []
        holds = counted(tasked, *flags, "-DMEASURED_HOLDS=RCLC_TASK_SESSION", left_out=LEFT_OUT)
        longest.append(max(holds[0::2]))  # between two of them the task does not hold the lock
        assert LEAST[transport] < longest[-1] <= session["instructions"], (longest, session)
    assert session["instructions"] < CLOSE[transport] * max(longest), (longest, session)
