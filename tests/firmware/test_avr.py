# SPDX-License-Identifier: Apache-2.0
"""An Arduino Uno with 2 KiB of RAM is a node of ROS 2: sizes, and samples in both directions in a simulator."""

from __future__ import annotations

import os
import re
import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.avr import (
    ANSWERS,
    EXCHANGES,
    MEGA,
    READS,
    SENDS,
    UNO,
    bounded,
    flash_and_ram,
    linked,
    read_line,
    simulated,
)
from tests.support.firmware.board import C_FILES, Builds, Built, build, check, need, target
from tests.support.firmware.line import open_raw
from tests.support.firmware.running import started
from tests.support.paths import ROOT
from tests.support.patience import deadline

FLASH, RAM = 32 * 1024, 2048
POWER, WATCHDOG = 1, 4
"""Of port_reset_t."""


def test_what_a_sender_takes(builds: Builds) -> None:
    """Goals: 16,000 bytes of flash and 900 of RAM, with the driver of the UART."""
    need(UNO)
    built = builds.build(UNO, SENDS)
    flash, ram = flash_and_ram(built, built.image)
    assert flash <= 11_800
    assert ram <= 810


def test_texts_of_errors_stay_in_flash(builds: Builds) -> None:
    """An Uno has room for them: each object of the library's texts lies below the code."""
    need(UNO)
    built = builds.build(UNO, SENDS.replace("errors: code", "errors: text"))
    flash, ram = flash_and_ram(built, built.image)
    assert flash <= 15_000
    assert ram <= 1310
    names = [name for name in built.symbols() if name.startswith("microros_error_")]
    assert len(names) > 20
    assert all(built.symbols()[name] < FLASH for name in names)
    assert ram + bounded(built, built.image)[0] < RAM


@pytest.mark.system
def test_texts_of_errors_are_read_from_flash(builds: Builds) -> None:
    """One with the name of an argument, which lies there, too, and one with numbers."""
    built = builds.build(MEGA, SENDS.replace("errors: code", "errors: text"))
    wanted = b"support or allocator: NULL or not initialized\0domain 1000 is above 232\0"
    with simulated(builds, built, linked(builds, built, "error_texts.c")) as board:
        line = os.open(board.device, os.O_RDWR | os.O_NOCTTY)
        try:
            assert read_line(line, len(wanted)) == wanted
        finally:
            os.close(line)


@pytest.mark.system
def test_too_many_variables_are_an_error_with_a_remedy(tmp_path: Path) -> None:
    """With all places of a session and texts of errors."""
    need(UNO)
    done = build(tmp_path, UNO, EXCHANGES.replace("errors: code", "errors: text"))
    assert done.returncode == 1
    assert "The variables take more than the target's RAM: `errors: code` leaves out" in done.stderr


@pytest.mark.system
@pytest.mark.parametrize("name", [UNO, MEGA])
@pytest.mark.parametrize("application", [SENDS, READS, EXCHANGES], ids=["sends", "reads", "exchanges"])
def test_the_stack_has_a_bound(builds: Builds, name: str, application: str) -> None:
    """The generated example: what its callbacks are is known, so that nothing is left out."""
    need(name)
    built = builds.build(name, application)
    bound, left_out = bounded(built, built.image)
    assert left_out == []
    assert 250 < bound < 700


def test_a_budget_of_the_stack(tmp_path: Path) -> None:
    need(UNO)
    done = build(tmp_path, UNO, f"{SENDS}memory: {{stack: 100}}\n")
    assert done.returncode == 1
    assert re.search(r"worst stack from main with 3 interrupt handler\(s\) on top: [0-9]+ bytes", done.stderr)


@pytest.mark.ros
def test_a_server_of_set_bool(builds: Builds, observer: Observer, domain: int) -> None:
    """A Mega answers requests; the stack stays below its bound."""
    built = builds.build(MEGA, ANSWERS)
    image = linked(builds, built, "setbool.c")
    with simulated(builds, built, image) as board:
        with started(
            "agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain
        ) as agent:
            agent.wait_for("agent ready")
            for data in (True, False):
                observer.ask(do="set_bool", service="/set_bool", data=data)
                _answered(observer, data)
        touched = board.touched_stack()
    assert touched <= bounded(built, image)[0]


def _answered(observer: Observer, data: bool) -> None:
    end = deadline(60)
    while observer.ask(do="answers") != [[data, "ok"]]:
        assert time.monotonic() < end, "no answer"
        time.sleep(0.1)


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
        touched = board.touched_stack()
    bound, left_out = bounded(built, image)
    assert touched <= bound
    assert [name for name in left_out if "callback" not in name] == []
    assert ram + bound < RAM


def _published_until_heard(observer: Observer, number: int) -> None:
    end = deadline(60)
    while ["/count", {"data": number}] not in observer.ask(do="samples"):
        assert time.monotonic() < end, "not heard"
        where = {"topic": "/led", "type": "std_msgs/msg/Int16"}
        observer.ask(do="publish", values=[{"data": number}], **where)
        time.sleep(0.1)


@pytest.mark.parametrize("name", [UNO, MEGA])
def test_the_cause_of_a_reset(builds: Builds, name: str, tmp_path: Path) -> None:
    """It is turned on, then the watchdog resets it; each cause is told again until the next reset."""
    need(name)
    processor, image = target(name), tmp_path / "reset_cause.elf"
    parts = ROOT / "microros_gen"
    include = parts / "components" / "diagnosis" / "include"
    source = parts / "platform" / "cpu" / "avr" / "src" / "port_avr_reset.c"
    flags = [*processor.c_flags, "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{include}"]
    check([processor.compilers[0], *flags, str(C_FILES / "reset_cause.c"), str(source), "-o", str(image)])
    built = Built(builds.build(name, SENDS).out, processor)
    with simulated(builds, built, image) as board:
        line = open_raw(board.device)
        try:
            assert read_line(line, 6) == f"{POWER}{POWER}0{WATCHDOG}{WATCHDOG}0".encode()
        finally:
            os.close(line)
