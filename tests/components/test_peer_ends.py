# SPDX-License-Identifier: Apache-2.0
"""A board of a system whose end of a topic lacks `peer:`, which the other board's end has."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.components.boards import (
    MOTOR,
    SENSOR,
    SYSTEM,
    application,
    ends,
    peers,
    planned,
    refused,
    written,
)


@pytest.mark.parametrize("value", ["only", "also"])
def test_an_end_without_peer_is_reported_at_both_boards(tmp_path: Path, value: str) -> None:
    """A build of either board alone says it: neither works without the other."""
    sensor = SENSOR.replace("peer: only", f"peer: {value}")
    folder = written(tmp_path, SYSTEM, sensor, MOTOR.replace(", peer: only", ""))
    assert "no board that is linked with this one subscribes to '/a'" in refused(folder, "sensor")
    assert refused(folder, "motor") == (
        f"motor/microros.yaml:8:9: error: '/a' has no `peer:` here, and `peer: {value}` at the board 'sensor' "
        "(sensor/microros.yaml:8). Write `peer: only`, or remove `peer` there"
    )


def test_an_end_without_peer_next_to_one_with_it(tmp_path: Path) -> None:
    """A second subscription of the board may be for ROS; so may one of which a third board has the other end."""
    both = (
        ends("subscriptions", "topic: /a, peer: only")
        + "  - name: ros\n"
        + ends("subscriptions", "topic: /a")
    )
    sensor = SENSOR.replace("peer: only", "peer: also")
    folder = written(tmp_path, SYSTEM, sensor, application("motor", both))
    assert peers(folder, "motor").shown
    system = SYSTEM.replace("links:", "  arm: {application: arm/microros.yaml}\nlinks:")
    system += '  - {type: udp, ends: {sensor: "10.0.0.1:7501", arm: "10.0.0.3:7501"}}\n'
    written(tmp_path, system, sensor, application("motor", ends("subscriptions", "topic: /a")))
    (folder / "arm").mkdir()
    (folder / "arm" / "microros.yaml").write_text(MOTOR.replace("motor", "arm"))
    assert planned(folder, "motor").project
    assert peers(folder, "sensor").shown
