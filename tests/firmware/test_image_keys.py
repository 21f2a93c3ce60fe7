# SPDX-License-Identifier: Apache-2.0
"""Keys of a target file that shape its image: an offset for a bootloader, memories, hooks, standard output."""

from __future__ import annotations

import subprocess
import time
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from tests.support.firmware.board import (
    C_FILES,
    Built,
    board,
    build,
    check,
    compile_merged_image,
    need,
    run_tool,
)
from tests.support.firmware.line import scripted_agent
from tests.support.firmware.unneeded import NOT_NEEDED
from tests.support.patience import deadline
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import only

DMA, FAST, OFFSET = 0x21800000, 0x21000000, 0x10000
BOOTED = f"""\
target: booted
extends: qemu-mps2-an386
flash: {{origin: 0, size: 4 MiB, offset: 64 KiB}}
ram: {{origin: 0x20000000, size: 64 KiB}}
memories:
  fast: {{origin: {FAST:#x}, size: 64 KiB, holds: [stack]}}
  dma: {{origin: {DMA:#x}, size: 64 KiB, holds: [serial, .dma]}}
hooks: {{clocks: booted_clocks, watchdog: booted_watchdog}}
emulator:
  program: qemu-system-arm
  package: qemu-system-arm
  arguments: [-M, mps2-an386, -device, "loader,file=BOOT,addr=0,force-raw=on"]
"""
PRINTED = "number 42 ff and text\nallocator there\nline 0\nline 1\nline 2\n"
FLOATS = "".join(f"{number:.3f} {number:e}\n" for number in (-3.140625, 1.0e-300, 1.0e15, 2.25e-308))
PRINTING = {
    "semihosting": ("qemu-mps2-an386", "{to: semihosting}"),
    "uart": ("qemu-mps2-an386", "{to: uart, driver: cmsdk, base: 0x40005000}"),
    "float": ("qemu-mps2-an386", "{to: semihosting, floats: true}"),
    "none": ("qemu-mps2-an386", "{to: none}"),
    "riscv semihosting": ("qemu-riscv32-virt", "{to: semihosting}"),
    "riscv float": ("qemu-riscv32-virt", "{to: semihosting}"),
}


SHORT = ("uart",)
"""What the default suite has."""


def built(home: Path, text: str) -> Built:
    """Generate for a target file of the user's, and compile."""
    (home / "mine.yaml").write_text(text)
    found = read_target("mine.yaml", home, None, Diagnostics())
    assert found is not None
    done = run_tool("generate", home, "mine.yaml")
    assert done.returncode == 0, done.stdout + done.stderr
    firmware = Built(home / "out", found.target)
    compile_merged_image(firmware)
    return firmware


@pytest.mark.system
def test_an_image_after_a_bootloader_has_its_vectors_hooks_and_memories(tmp_path: Path) -> None:
    need("qemu-mps2-an386", emulator=True)
    boot = tmp_path / "boot.bin"
    compiler = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-nostdlib", "-Wl,-Ttext=0", "-Wl,-e,0"]
    places = (f"-DBOOT_SPOILED={DMA:#x}", f"-DBOOT_IMAGE={OFFSET:#x}")
    check([*compiler, *places, str(C_FILES / "boot.S"), "-o", str(tmp_path / "boot.elf")])
    check(["arm-none-eabi-objcopy", "-O", "binary", str(tmp_path / "boot.elf"), str(boot)])
    firmware = built(tmp_path, BOOTED.replace("BOOT", str(boot)))
    firmware = replace(firmware, target=replace(firmware.target, name="qemu-mps2-an386"))
    image = firmware.link(C_FILES / "booted.c", tmp_path / "booted.elf")
    agent = FakeAgent()
    with board(firmware, image) as running, scripted_agent(running.device, agent):
        running.go_on()
        running.wait_for(lambda: len(agent.values()) >= 5)
        vectors, clocks, watchdog, cleared = running.words("booted_report", 4)
    assert agent.values()[:5] == [0, 1, 2, 3, 4], "its own interrupts come"
    assert (vectors, clocks, cleared) == (OFFSET, 0x434C4B, 1)
    assert watchdog >= 4 * 20, "each millisecond of a wait"
    symbols = firmware.symbols(image)
    assert symbols["port_cortex_m_vectors"] == OFFSET
    assert symbols["port_stack_low"] == FAST
    assert {
        DMA <= symbols[name] < DMA + 0x10000 for name in ("port_ring", "port_output", "booted_buffer")
    } == {True}


@pytest.mark.system
def test_a_hook_missing_in_the_application_is_named(tmp_path: Path) -> None:
    need("cortex-m3")
    firmware = built(tmp_path, "target: mine\nextends: qemu-mps2-an385\nhooks: {watchdog: feed_the_dog}\n")
    assert "feed_the_dog" in (firmware.out / "README.md").read_text()
    with pytest.raises(AssertionError) as error:
        firmware.link(C_FILES / "prints.c", tmp_path / "prints.elf")
    assert "feed_the_dog" in str(error.value)


@pytest.mark.system
@pytest.mark.parametrize("way", only(SHORT, PRINTING))
def test_printf_goes_where_the_target_file_says(tmp_path: Path, way: str) -> None:
    name, stdio = PRINTING[way]
    need(name, emulator=True)
    firmware = built(tmp_path, f"target: mine\nextends: {name}\nstdio: {stdio}\n")
    assert {
        s for s in firmware.symbols() if NOT_NEEDED.fullmatch(s) or s.startswith("port_stdio")
    } == set(), "the example does not print, so nothing of it is there"
    floats = ("-DPRINTS_FLOATS",) if way.endswith("float") else ()
    image = firmware.link(C_FILES / "prints.c", tmp_path / "prints.elf", *floats)
    expected = "" if way == "none" else PRINTED + FLOATS * len(floats)
    emulator = firmware.target.emulator
    assert emulator is not None
    uart = tmp_path / "uart.txt"
    debugger = ("-semihosting-config", "enable=on,target=native")
    lines = ("-serial", "null", "-serial", f"file:{uart}") if way == "uart" else ("-serial", "null")
    fixed = (*emulator.arguments, "-display", "none", "-monitor", "none", *lines, *debugger)
    printed = tmp_path / "printed.txt"
    with printed.open("w") as file:
        process = subprocess.Popen(
            [emulator.program, *fixed, "-kernel", str(image)], stdout=file, stderr=subprocess.STDOUT
        )
        try:
            end = time.monotonic() + 1.5 if way == "none" else deadline(30)
            found = uart if way == "uart" else printed
            while time.monotonic() < end and (not found.exists() or len(found.read_text()) < len(expected)):
                time.sleep(0.05)
        finally:
            process.kill()
            process.wait(10)
    assert found.read_text() == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("flash: {origin: 0, size: 4 MiB, offset: 100}\n", "is not a multiple of 128. Set flash.offset: 128"),
        ("stdio: {to: uart, driver: cmsdk, base: 0x40004000}\n", "'stdio' of mine prints to the UART of the agent"),
        ("port: port_riscv\nstdio: {to: none, floats: true}\n", "'stdio.floats' has no effect with port_riscv"),
        ("memories: {fast: {origin: 0x21000000, size: 1 KiB, holds: [stack]}}\n", "a stack of 2048 bytes leaves"),
    ],
)  # fmt: skip
def test_what_an_image_cannot_have_is_refused_before_compiling(
    tmp_path: Path, text: str, expected: str
) -> None:
    need("qemu-mps2-an386")
    (tmp_path / "mine.yaml").write_text(f"target: mine\nextends: qemu-mps2-an386\n{text}")
    done = build(tmp_path, "mine.yaml")
    assert done.returncode == 2, done.stdout
    assert expected in done.stderr


def test_a_processor_without_the_register_cannot_have_an_offset(tmp_path: Path) -> None:
    need("qemu-microbit")
    (tmp_path / "mine.yaml").write_text(
        "target: mine\nextends: qemu-microbit\nflash: {origin: 0, size: 256 KiB, offset: 16 KiB}\n"
    )
    done = build(tmp_path, "mine.yaml")
    assert done.returncode == 2
    assert "the Cortex-M0 of mine has no vector table offset register" in done.stderr
