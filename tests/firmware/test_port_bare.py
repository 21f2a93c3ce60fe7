# SPDX-License-Identifier: Apache-2.0
"""The parts of the ports for boards that need no board, on the host: counters that wrap, full rings, numbers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.application.model import Application
from microros_gen.application.transport_decl import Transport
from microros_gen.client.plan.board import plan_board, ring_size
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from microros_gen.platform.target import Uart
from microros_gen.selection.find_components import components_folder, parts_folder
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.firmware.board import C_FILES, check
from tests.support.plans import POOL, changed

COMPONENTS = components_folder()
BARE = parts_folder() / "os" / "bare"
BOARD = (
    "#pragma once\n#define PORT_BOARD_RING_SIZE 64u\n"
    "#define PORT_BOARD_OUTPUT_SIZE 61u\n#define PORT_BOARD_UART_BAUD 115200u\n"
    "#define PORT_BOARD_KEEPS_OUTPUT true\n"
    "static inline void port_board_watchdog(void)\n{\n}\n"
)
SANITIZE = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")


def test_time_sleep_epoch_and_ring(tmp_path: Path) -> None:
    (tmp_path / "microros").mkdir()
    (tmp_path / "microros" / "port_board.h").write_text(BOARD)
    bare, base = BARE, COMPONENTS / "base"
    includes = [f"-I{path}" for path in (tmp_path, bare / "src", bare / "include", base / "include")]
    program = tmp_path / "unit"
    check(["gcc", *WARNINGS, *SANITIZE, *includes, str(C_FILES / "unit_bare.c"), "-o", str(program)])
    check([str(program)])


def test_the_ring_of_the_console(tmp_path: Path) -> None:
    (tmp_path / "microros").mkdir()
    (tmp_path / "microros" / "port_board.h").write_text("#define PORT_BOARD_CONSOLE_SIZE 200u\n")
    bare, console = BARE, COMPONENTS / "logging_console"
    folders = (tmp_path, bare / "src", bare / "include", console / "include", COMPONENTS / "base" / "include")
    includes = [f"-I{path}" for path in folders]
    program = tmp_path / "unit"
    check(["gcc", *WARNINGS, *SANITIZE, *includes, str(C_FILES / "unit_console.c"), "-o", str(program)])
    check([str(program)])


def test_timers_and_steady_time_over_sixty_days(tmp_path: Path) -> None:
    (tmp_path / "microros_config.h").write_text("#define MICROROS_TIMERS_MAX 2u\n")
    bare, base = BARE, COMPONENTS / "base"
    includes = [f"-I{path}" for path in (tmp_path, bare / "src", bare / "include", base / "include")]
    program = tmp_path / "unit"
    check(["gcc", *WARNINGS, *SANITIZE, *includes, str(C_FILES / "unit_bare_timers.c"), "-o", str(program)])
    check([str(program)])


def plan(reliable_slots: int, input_size: int) -> RuntimePlan:
    return changed(
        POOL,
        streams__reliable_slots=reliable_slots,
        input__size=input_size,
        transport__kind="serial",
        transport__line_input=input_size,
    )


@pytest.mark.parametrize(("slots", "size"), [(0, 64), (4, 64), (16, 64), (0, 512), (16, 4096)])
def test_the_ring_holds_the_longest_message_and_an_answer_for_each_slot(slots: int, size: int) -> None:
    """7E, source, destination, length, payload, CRC; of random bytes one in 128 is stuffed, and the ring has four times
    as many, and two more for each frame.
    """
    most = (1 + 4 + size + 2) + size // 32 + 2 + slots * (1 + 4 + 13 + 2 + 2)
    ring = ring_size(plan(slots, size))
    assert most < ring <= most + 4, "one byte of a ring is never used"


@pytest.mark.parametrize(
    ("baud", "size", "ring"), [(115_200, 3000, 232), (921_600, 3000, 752), (9600, 3000, 76)]
)
def test_the_ring_holds_20_ms_of_a_large_best_effort_sample(baud: int, size: int, ring: int) -> None:
    """Ten bits a byte; a quarter of the sample at most, and never less than what must not be lost: 64 bytes."""
    assert ring_size(changed(plan(0, size), transport__line_input=64, transport__baud=baud)) == ring


@pytest.mark.parametrize(
    ("driver", "clock_hz", "baud", "divisor"),
    [
        ("cmsdk", 25_000_000, 115_200, 217),
        ("cmsdk", 25_000_000, 1200, 20833),
        ("cmsdk", 25_000_000, 921_600, 27),
        ("nrf51", 16_000_000, 115_200, 0x01D7E000),  # the value of Nordic's table
        ("nrf51", 16_000_000, 9600, 0x00275000),
        ("ns16550", 3_686_400, 115_200, 2),
        ("ns16550", 48_000_000, 115_200, 26),
        ("cmsdk", 1_000_000, 115_200, None),
        ("ns16550", 1_843_200, 921_600, None),
    ],
)
def test_the_divisor_of_a_uart_is_within_what_its_receiver_bears(
    driver: str, clock_hz: int, baud: int, divisor: int | None
) -> None:
    name = "qemu-riscv32-virt" if driver == "ns16550" else "qemu-mps2-an385"
    found = read_target(name, Path(), None, Diagnostics())
    assert found is not None
    target = replace(found.target, uart=Uart(driver, 0x40004000, 1, clock_hz))
    diagnostics = Diagnostics()
    application = Application(transport=Transport("serial", baud=baud))
    board = plan_board(application, target, plan(4, 64), diagnostics)
    assert diagnostics.has_errors() == (divisor is None)
    assert divisor is None or board.uart_divisor == divisor
