# SPDX-License-Identifier: Apache-2.0
"""Levels of loggers by service, answered as a node of rclpy answers them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.logger_peer import MODEL, LoggerPeer, logger_peer
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+logger_services]
logging: [{to: callback, level: debug}]
nodes: [{name: device, namespace: /arm}]
"""
DEVICE = "/arm/device"
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
DEBUG, WARN, ERROR, FATAL = 10, 30, 40, 50


def both_set(peer: LoggerPeer, *levels: tuple[str, int]) -> list[list[object]]:
    found, wanted = (peer.set(node, *levels) for node in (DEVICE, MODEL))
    assert found == wanted
    return list(found)


def both_get(peer: LoggerPeer, *names: str) -> list[list[object]]:
    found, wanted = (peer.get(node, *names) for node in (DEVICE, MODEL))
    assert found == wanted
    return list(found)


def test_as_a_node_of_rclpy(
    images: Images, image_port: Relay, agent: object, domain: int, tmp_path: Path
) -> None:
    image = images.build(image_port.port, APPLICATION)
    program = image.application(C_FILES / "levels.c", tmp_path / "levels", *STRICT)
    with logger_peer(domain) as peer, started(program) as process:
        await_line(process, "ready")
        assert both_get(peer, "arm", "arm.left") == [["arm", 0], ["arm.left", 0]]
        assert both_set(peer, ("arm", WARN), ("arm.left", ERROR)) == [[True, ""]] * 2
        assert both_get(peer, "arm", "arm.left", "arm.right") == [
            ["arm", WARN],
            ["arm.left", ERROR],
            ["arm.right", 0],
        ]
        invalid = "Failed reason: Invalid logger level."
        assert both_set(peer, ("arm", 33), ("arm", 0)) == [[False, invalid], [True, ""]]
        assert both_get(peer, "arm") == [["arm", 0]]
        assert both_set(peer, ("arm", 60), ("arm", 5), ("", 255)) == [[False, invalid]] * 3
        assert both_set(peer, ("", WARN)) == [[True, ""]]
        assert both_get(peer, "", "arm") == [["", WARN], ["arm", 0]]
        assert peer.set(DEVICE, ("", 0)) == [[True, ""]]  # the level of the build; rclpy enables all
        assert peer.get(DEVICE, "") == [["", DEBUG]]
        assert both_get(peer) == []
        full = peer.set(DEVICE, ("a", WARN), ("b", WARN), ("c", WARN), ("d", WARN))
        assert [successful for successful, _ in full] == [True, True, True, False]
        assert full[3][1] == "all 4 loggers have a level: set pools: {loggers: 5} for d"
        assert both_set(peer, ("a", 0), ("b", 0), ("c", 0)) == [[True, ""]] * 3
        assert peer.set(DEVICE, ("loud", DEBUG)) == [[True, ""]]
        await_line(process, "loud: heard")
        assert peer.set(DEVICE, ("end", FATAL)) == [[True, ""]]
        ends_well(process, 30)
