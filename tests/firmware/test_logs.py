# SPDX-License-Identifier: Apache-2.0
"""Log messages of a board: rclpy receives them from /rosout, over the serial line; a burst holds nothing up."""

from __future__ import annotations

import time
from typing import Any

import pytest
from _pytest.mark import ParameterSet

from tests.support.agent.observer import Observer
from tests.support.firmware.board import BOARDS, Board, Builds, board, need
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.profile_with_diagnostics import APPLICATION as PROFILE
from tests.support.profile_with_diagnostics import ENTITIES

NAME = "qemu-mps2-an386"
APPLICATION = """\
version: 1
profiles: [pure_sender]
logging: [{to: rosout, level: info}]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: device, namespace: /arm}]
"""
MANY = 60


def received(observer: Observer, last: str) -> list[dict[str, Any]]:
    """Wait for a text of the board; return its lines until then."""
    end, found = deadline(60), list[dict[str, Any]]()
    while not any(last in line["msg"] for line in found):
        lines = [line for topic, line in observer.ask(do="samples") if topic == "/rosout"]
        found += [line for line in lines if line["name"] in ("board", "rcutils")]
        assert time.monotonic() < end, found
        time.sleep(0.02)
    return found


def done(running: Board) -> bool:
    return running.words("logs_report", 1) == [1]


@pytest.mark.system
@pytest.mark.ros
def test_rclpy_receives_what_the_board_logs(builds: Builds, domain: int, observer: Observer) -> None:
    built = builds.merged(NAME, APPLICATION)
    need(NAME, emulator=True)
    image = builds.application(built, "logs.c")
    observer.subscribe("/rosout", "rcl_interfaces/msg/Log", transient_local=True)
    with (
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()
        running.wait_for(lambda: done(running), 60)
        found = received(observer, "messages dropped")
        _, dropped = running.words("logs_report", 2)
    assert (found[0]["level"], found[0]["msg"]) == (20, "before the session")
    assert found[0]["function"] == "main"
    assert found[0]["file"].endswith("logs.c")
    burst = [line["msg"] for line in found[1:-1]]
    assert burst == [f"burst {number}" for number in range(len(burst))]
    assert len(burst) + dropped == MANY
    assert found[-1]["msg"] == f"{dropped} messages dropped"
    assert 0 < dropped < MANY


def ways() -> list[ParameterSet]:
    """Return the host with each way to create entities, and one board of each architecture; others for long runs.

    What the boards of one architecture differ in, flags of the processor and memory, does not depend on the
    profile: the chosen one has the least memory.
    """
    rows = [(name, way) for name in ("host", *BOARDS) for way in ENTITIES]
    chosen = {("qemu-microbit", "binary")}
    variants = {("qemu-riscv32-virt", "xml"), *(("host", way) for way in ENTITIES)}
    marks = {**dict.fromkeys(variants, pytest.mark.variant), **dict.fromkeys(chosen, pytest.mark.system)}
    return [pytest.param(*row, marks=marks.get(row, pytest.mark.long)) for row in rows]


@pytest.mark.parametrize(("name", "entities"), ways())
def test_the_profile_with_diagnostics_builds(builds: Builds, name: str, entities: str) -> None:
    """With XML, types of services take more than the 512 bytes that a message has by default on a serial line."""
    need(name)
    built = builds.build(name, PROFILE.format(entities=entities))
    assert built.image.is_file()
