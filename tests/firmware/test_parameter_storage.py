# SPDX-License-Identifier: Apache-2.0
"""Arrays that rclpy sets over the serial line outlast a reset of the board, in a memory that behaves as flash."""

from __future__ import annotations

import time
from typing import Any

import pytest

from tests.support.e2e.parameter_peer import ParameterPeer, parameter_peer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.running import started
from tests.support.patience import deadline

NAME = "qemu-mps2-an386"
PSRAM, AIRCR = "0x21000000", "0xe000ed0c"
"""16 MB of the board that the image does not use; the register that resets the processor (Armv7-M, B3.2.6)."""
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameter_storage]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: joints, type: "string[]", size: 3, default: [shoulder]}
      - {name: gains, type: "double[]", size: 4, default: [1.0]}
      - {name: label, type: string, default: left, size: 8}
      - {name: restart, type: bool}
"""
DEVICE = "/arm/device"
NAMES = ["joints", "gains", "label", "restart"]
JOINTS, GAINS = ["elbow", "", "wrist ä"], [0.5, -1e300, 3.25]
STRINGS, DOUBLES, STRING, BOOL = 9, 8, 4, 1


def reasons(peer: ParameterPeer, *values: tuple[str, Any]) -> list[str]:
    """Set parameters; return why not, in the order of the values."""
    results = peer.call(DEVICE, "set_parameters", list(values))["results"]
    return [result["reason"] for result in results]


@pytest.mark.system
@pytest.mark.ros
def test_arrays_outlast_a_reset(builds: Builds, domain: int) -> None:
    built = builds.merged(NAME, APPLICATION)
    need(NAME, emulator=True)
    places = (f"-DFLASH_ADDRESS={PSRAM}u", f"-DRESET_ADDRESS={AIRCR}u")
    image = builds.application(built, "parameter_storage.c", *places)
    with (
        parameter_peer(domain) as peer,
        board(built, image, restarts=True) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        peer.wait(DEVICE)
        assert running.words("storage_report", 3) == [1, 0, 0]
        first = peer.call(DEVICE, "get_parameters", NAMES)["values"]
        assert first == [[STRINGS, ["shoulder"]], [DOUBLES, [1.0]], [STRING, "left"], [BOOL, False]]
        too_long = reasons(peer, ("joints", ["a"] * 4), ("gains", [0.0] * 5))
        assert all("size" in reason or "long" in reason for reason in too_long), too_long
        assert reasons(peer, ("joints", JOINTS), ("gains", GAINS)) == ["", ""]
        assert reasons(peer, ("restart", True)) == [""]
        running.wait_for(lambda: running.words("storage_report", 3) == [2, 0, 0], 60)
        kept = [[STRINGS, JOINTS], [DOUBLES, GAINS], [STRING, "left"], [BOOL, False]]
        end = deadline(60)
        # Until the session is new, requests have no reply.
        while (
            answer := peer.ask(node=DEVICE, service="get_parameters", arguments=[NAMES], timeout=2)
        ) is None:
            assert time.monotonic() < end
        assert answer["values"] == kept
