# SPDX-License-Identifier: Apache-2.0
"""The plan of messages that are larger than the MTU of their link."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.compiler import render
from tests.support.components.boards import SYSTEM, application, ends, peers, planned, written

TEXT = "topic: /a, peer: only, limits: {{string: {}}}"
OVERHEAD = 12 + 5
"""Bytes of WRITE_DATA with a string besides its characters."""


def pair(folder: Path, sent: int, taken: int, mtu: int = 128, rate: str = "") -> Path:
    """Write a system in which `sensor` sends strings to `motor`."""
    return written(
        folder,
        SYSTEM.replace("type: udp", f"type: udp, mtu: {mtu}"),
        application("sensor", ends("publishers", TEXT.format(sent) + rate)),
        application("motor", ends("subscriptions", TEXT.format(taken))),
    )


@pytest.mark.parametrize("length", [128 - OVERHEAD, 128 - OVERHEAD + 1])
def test_fragments_begin_above_the_mtu(tmp_path: Path, length: int) -> None:
    folder = pair(tmp_path, length, length)
    sensor, motor = peers(folder, "sensor"), peers(folder, "motor")
    in_fragments = length + OVERHEAD > 128
    assert (sensor.fragments, sensor.joins) == (in_fragments, False)
    assert (motor.fragments, motor.joins) == (False, in_fragments)
    assert motor.joined == (length + OVERHEAD if in_fragments else 0)
    front = 4 if in_fragments else 0  # for the header of the first fragment
    assert sensor.slot_size == (length + OVERHEAD + front + 3) & ~3


def test_the_receiver_has_room_for_what_is_sent_not_for_its_own_limits(tmp_path: Path) -> None:
    assert peers(pair(tmp_path, 300, 2000), "motor").joined == 300 + OVERHEAD
    assert peers(pair(tmp_path, 100, 2000), "motor").joined == 0


def test_an_image_without_fragments_has_no_code_for_them(tmp_path: Path) -> None:
    names = set(render(planned(pair(tmp_path, 100, 100))))
    assert "src/peer/xrce_peer_slots.c" in names
    assert not {"src/peer/xrce_peer_slots_fragments.c", "src/peer/xrce_peer_fragments.c"} & names


def test_a_board_that_only_receives_fragments(tmp_path: Path) -> None:
    names = set(render(planned(pair(tmp_path, 300, 300), "motor")))
    assert {"src/peer/xrce_peer_slots.c", "src/peer/xrce_peer_fragments.c"} <= names
    assert "src/peer/xrce_peer_slots_fragments.c" not in names


def test_the_largest_message_of_each_link(tmp_path: Path) -> None:
    """What goes to one board is no reason to send the same to another one, which has no room for it."""
    system = SYSTEM.replace("boards:\n", "boards:\n  arm: {application: arm/microros.yaml}\n")
    system += '  - {type: udp, mtu: 256, ends: {sensor: "10.0.0.1:7501", arm: "10.0.0.3:7501"}}\n'
    sensor = ends("publishers", TEXT.format(700), "topic: /b, peer: only")
    (tmp_path / "arm").mkdir()
    arm = application("arm", ends("subscriptions", "topic: /b, peer: only"))
    (tmp_path / "arm" / "microros.yaml").write_text(arm)
    motor = application("motor", ends("subscriptions", TEXT.format(700)))
    folder = written(tmp_path, system, application("sensor", sensor), motor)
    part = peers(folder, "sensor")
    assert {link.board: size for link, size in zip(part.links, part.in_fragments.largest, strict=True)} == {
        "motor": 700 + OVERHEAD,
        "arm": 256,
    }


def test_a_reply_in_fragments_has_its_identity(tmp_path: Path) -> None:
    service = "    {}: [{{type: std_srvs/srv/Trigger, name: /say, peer: only, limits: {{message: 600}}}}]\n"
    services = "components: [+services]\n"
    written(
        tmp_path,
        SYSTEM,
        application("sensor", service.format("services"), services),
        application("motor", service.format("clients"), services),
    )
    reply = 12 + 24 + 1 + 3 + 4 + 600 + 1
    assert peers(tmp_path, "motor").joined == reply
    assert peers(tmp_path, "sensor").in_fragments.largest == (reply,)


def test_each_fragment_counts_in_a_rate(tmp_path: Path) -> None:
    """Parts of 120 bytes with headers of 8, each of which is acknowledged."""
    folder = pair(tmp_path, 300, 300, rate=", rate: 10 Hz")
    [sent], [answered] = peers(folder, "sensor").loads, peers(folder, "motor").loads
    assert sent.line.publishers[0].messages == (128, 128, 8 + 300 + OVERHEAD - 4 - 240)
    assert answered.line.answers == 3 * 10 + 10
