# SPDX-License-Identifier: Apache-2.0
"""An Arduino Uno with 2 KiB of RAM is a node of ROS 2: sizes, and samples in both directions in a simulator."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.avr import UNO, flash_and_ram, linked, simulated
from tests.support.firmware.board import Builds, build, need
from tests.support.firmware.running import started
from tests.support.patience import deadline

SENDS = """\
version: 1
profiles: [pure_sender]
errors: code
liveliness: none
session: {key: 1}
nodes:
  - name: uno
    publishers: [{topic: count, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}]
"""
EXCHANGES = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers]
errors: code
# a busy test machine
session: {key: 2, connect_timeout: 20 s, create_timeout: 20 s}
nodes:
  - name: uno
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: led, type: std_msgs/msg/Int16}]
    timers: [{name: report, period: 100 ms}]
"""
FLASH, RAM = 32 * 1024, 2048


def test_what_a_sender_takes(builds: Builds) -> None:
    """Goals: 16,000 bytes of flash and 900 of RAM, with the driver of the UART."""
    need(UNO)
    built = builds.build(UNO, SENDS)
    flash, ram = flash_and_ram(built, built.image)
    assert flash <= 11_800
    assert ram <= 810


@pytest.mark.system
def test_too_many_variables_are_an_error_with_a_remedy(tmp_path: Path) -> None:
    """The profile alone, with texts of errors: avr-gcc has constants in RAM."""
    need(UNO)
    done = build(tmp_path, UNO)
    assert done.returncode == 1
    assert "The variables take more than the target's RAM: `errors: code` leaves out" in done.stderr


@pytest.mark.ros
def test_samples_of_both_directions(builds: Builds, observer: Observer, domain: int) -> None:
    """Publisher, subscription, timer and executor; the agent restarts in between."""
    need(UNO)
    built = builds.build(UNO, EXCHANGES)
    image = linked(builds, built, "uno.c")
    flash, ram = flash_and_ram(built, image)
    assert flash <= FLASH
    observer.subscribe("/count", "std_msgs/msg/Int32")
    with simulated(builds, built, image) as board:
        serial = ("agent", "serial", "--dev", board.device, "--domain", str(domain))
        for number in (1234, -1235):
            with started(*serial, domain=domain) as agent:
                agent.wait_for("agent ready")
                _published_until_heard(observer, number)
        assert ram + board.touched_stack() < RAM


def _published_until_heard(observer: Observer, number: int) -> None:
    end = deadline(60)
    while ["/count", {"data": number}] not in observer.ask(do="samples"):
        assert time.monotonic() < end, "not heard"
        where = {"topic": "/led", "type": "std_msgs/msg/Int16"}
        observer.ask(do="publish", values=[{"data": number}], **where)
        time.sleep(0.1)
