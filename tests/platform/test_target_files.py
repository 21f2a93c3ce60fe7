# SPDX-License-Identifier: Apache-2.0
"""Target files: built-in ones hold to the schema, a user's extends them, and each wrong key or value has a place."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import yaml
from jsonschema import Draft202012Validator

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.schema import load_schema
from microros_gen.platform.find import TARGETS, FoundTarget, builtin_targets, read_target
from microros_gen.platform.part import KINDS
from microros_gen.platform.part_file import builtin_parts, read_part
from microros_gen.platform.target import Region
from microros_gen.platform.target_file import SCHEMA as TARGET_SCHEMA
from microros_gen.selection.find_components import parts_folder
from tests.support.ids import without_id

SCHEMA = load_schema(TARGET_SCHEMA)
BOARD = """\
target: mine
extends: cortex-m3
clock_hz: 48000000
flash: {origin: 0x08000000, size: 256 KiB}
ram: {origin: 0x20000000, size: 32 KiB}
"""


def read(folder: Path, text: str) -> tuple[FoundTarget | None, list[str]]:
    (folder / "mine.yaml").write_text(text)
    diagnostics = Diagnostics()
    found = read_target("mine.yaml", folder, None, diagnostics)
    return found, [without_id(d.headline()).replace(f"{folder}/", "") for d in diagnostics]


@pytest.mark.parametrize("path", sorted(TARGETS.glob("*.yaml")), ids=lambda path: path.stem)
def test_built_in_targets_hold_to_the_schema(path: Path) -> None:
    data = yaml.safe_load(path.read_text())
    assert not list(Draft202012Validator(SCHEMA).iter_errors(data))
    assert data["target"] == path.stem


@pytest.mark.parametrize("name", builtin_targets())
def test_every_built_in_target_reads(name: str) -> None:
    diagnostics = Diagnostics()
    found = read_target(name, Path(), None, diagnostics)
    assert found is not None, list(diagnostics)
    assert found.own == ()
    assert {part.kind for part in found.target.parts} <= set(KINDS)
    assert found.target.part("os") is not None


@pytest.mark.parametrize("name", builtin_parts("cpu"))
def test_each_driver_of_a_processor_has_its_files(name: str) -> None:
    diagnostics = Diagnostics()
    part = read_part("cpu", name, Path(), None, diagnostics)
    assert part is not None, list(diagnostics)
    assert part.cpu is not None
    provides = {provision.capability: provision.sources for provision in part.component.provides}
    drivers = {dict(source.when)["board.serial_driver"] for source in provides["uart"]}
    assert drivers == {driver.name for driver in part.cpu.drivers}
    output = {dict(source.when)["board.stdio_driver"] for source in provides.get("stdio_put", ())}
    assert output == {driver.name for driver in part.cpu.drivers if driver.stdio}
    by_interrupt = {dict(source.when)["board.console_driver"] for source in provides.get("console_send", ())}
    assert by_interrupt == output
    described = SCHEMA["properties"]["uart"]["properties"]["driver"]["description"]
    assert all(driver in described for driver in drivers)
    registers = SCHEMA["properties"]["registers"]["description"]
    assert all(
        f"`{register}`" in registers for register in (*part.cpu.registers, *part.cpu.optional_registers)
    )


def test_an_interrupt_of_standard_output_needs_a_handler(tmp_path: Path) -> None:
    shutil.copytree(parts_folder() / "cpu" / "cortex_m", tmp_path / "cpu")
    facts = tmp_path / "cpu" / "cpu.yaml"
    facts.write_text(
        "".join(line for line in facts.open(encoding="utf-8") if "console_handler" not in line),
        encoding="utf-8",
    )
    stdio = "cpu: ./cpu\nstdio: {to: uart, driver: cmsdk, base: 64, irq: 5}\n"
    found, messages = read(tmp_path, BOARD + stdio)
    assert found is None
    assert any(
        "7:49: error: 'stdio.irq' has no effect: port_cortex_m sends standard output" in m for m in messages
    ), messages
    assert read(tmp_path, BOARD + stdio.replace(", irq: 5", ""))[0] is not None


def test_a_file_adds_a_board_to_a_cpu(tmp_path: Path) -> None:
    found, messages = read(tmp_path, BOARD + "c_flags: [-DBOARD=1]\n")
    assert found is not None, messages
    target = found.target
    assert target.name == "mine"
    assert target.compilers == ("arm-none-eabi-gcc",)
    assert target.c_flags[-2:] == ("-mcpu=cortex-m3", "-DBOARD=1")
    assert (target.flash, target.ram) == (Region(0x08000000, 256 * 1024), Region(0x20000000, 32 * 1024))
    assert target.has_image
    assert (target.data_model, target.transport) == ("ilp32", "serial")
    assert [source.name for source in found.own] == [str(tmp_path / "mine.yaml")]


def test_extends_is_relative_to_the_file_that_says_it(tmp_path: Path) -> None:
    (tmp_path / "boards").mkdir()
    (tmp_path / "boards" / "base.yaml").write_text(BOARD)
    found, messages = read(
        tmp_path, "target: top\nextends: boards/base.yaml\nram: {origin: 0x20000000, size: 8 KiB}\n"
    )
    assert found is not None, messages
    assert found.target.ram == Region(0x20000000, 8 * 1024)
    assert len(found.own) == 2


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("target: mine\n", "mine.yaml:1:1: error: missing key 'summary' in the target"),
        (
            BOARD + "flahs: 1\n",
            "mine.yaml:6:1: error: unknown key 'flahs' in the file. Did you mean 'flash'?",
        ),
        (
            BOARD + "transport: seriel\n",
            "mine.yaml:6:12: error: 'transport' must be udp, tcp, serial, canfd or custom",
        ),
        *(
            (
                f"{BOARD}cycles_per_instruction: {cycles}\n",
                "mine.yaml:6:25: error: 'cycles_per_instruction' must be a number of cycles, 0.01 to 10000",
            )
            for cycles in ("0", "-1", "10001", ".nan", ".inf")
        ),
        (BOARD.replace("256 KiB", "256 KB"), "mine.yaml:4:35: error: 'flash.size' must be a number of bytes"),
        (
            BOARD.replace("clock_hz: 48000000\n", ""),
            "mine.yaml:1:1: error: an image needs the key 'clock_hz'",
        ),
        (
            BOARD.replace("ram:", "#ram:"),
            "mine.yaml:4:8: error: 'flash' without 'ram' is not enough for an image",
        ),
        (BOARD.replace("0x20000000", "0x08000000"), "mine.yaml:5:6: error: 'flash' and 'ram' overlap"),
        (
            BOARD.replace("0x20000000", "0xFFFFF000"),
            "mine.yaml:5:6: error: 'ram' ends beyond the 32-bit address space",
        ),
        (
            BOARD + "uart: {driver: cmsdk, base: 0x40004000}\n",
            "error: missing key 'irq' in 'uart'. Add `irq: …`",
        ),
        (
            BOARD + "uart: {driver: ns16550, base: 0, irq: 0}\n",
            "6:16: error: port_cortex_m has no driver 'ns16550'",
        ),
        (
            BOARD + "uart: {driver: cmsdk, base: 0, irq: 3}\ninterrupts: {3: usart}\n",
            "7:14: error: interrupt 3 is taken by 'uart'",
        ),
        (
            BOARD + "uart: {driver: cmsdk, base: 0, irq: 3}\ninterrupts: {4: usart}\n",
            "7:14: error: interrupt 4 is taken by 'uart'",
        ),
        (
            BOARD + "stdio: {to: uart, driver: cmsdk, base: 64, irq: 5}\ninterrupts: {6: usart}\n",
            "7:14: error: interrupt 6 is taken by 'stdio'. Remove it here, or remove `stdio:`",
        ),
        (
            BOARD
            + "uart: {driver: cmsdk, base: 0, irq: 3}\nstdio: {to: uart, driver: cmsdk, base: 64, irq: 3}\n",
            "7:49: error: interrupt 4 is taken by 'uart'. Write the interrupt of this UART",
        ),
        (
            BOARD + "stdio: {to: semihosting, irq: 3}\n",
            "6:31: error: stdio: semihosting has no `irq`",
        ),
        (
            BOARD + "uart: {driver: application, irq: 3}\n",
            "6:29: error: 'uart.irq' has no effect: the application drives the line",
        ),
        (
            BOARD + "interrupts: {480: a}\n",
            "6:14: error: the keys of 'interrupts' must be numbers of interrupts",
        ),
        (
            BOARD + "interrupts: {4: a-b}\n",
            "6:17: error: 'interrupts.4' must be the name of a C function",
        ),
        (BOARD.replace("cortex-m3", "riscv32"), "mine.yaml:1:1: error: port_riscv needs the address of plic"),
        (BOARD.replace("cortex-m3", "cortex-m9"), "mine.yaml:2:10: error: unknown target 'cortex-m9'"),
        (BOARD.replace("cortex-m3", "mine.yaml"), "mine.yaml:2:10: error: 'mine.yaml' extends itself"),
        (
            BOARD.replace("cortex-m3", "lost.yaml"),
            "mine.yaml:2:10: error: cannot read the target file 'lost.yaml'",
        ),
    ],
)
def test_what_is_wrong_has_a_place_and_a_hint(tmp_path: Path, text: str, expected: str) -> None:
    found, messages = read(tmp_path, text)
    assert found is None
    assert any(expected in line for line in messages), messages


def test_all_errors_of_a_file_are_reported_at_once(tmp_path: Path) -> None:
    _, messages = read(tmp_path, BOARD + "hosted: 5\nemulator: {}\nunique_id: {address: 2, words: 9}\n")
    assert [line.split(":")[1] for line in messages] == ["6", "7", "7", "8", "8"]
