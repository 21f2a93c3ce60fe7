# SPDX-License-Identifier: Apache-2.0
"""What `build` makes for each target: the library, the image, files to flash; and what it refuses before compiling."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from tests.support.firmware.board import BOARDS, C_FILES, Builds, Built, build, check, need
from tests.support.firmware.unneeded import NOT_NEEDED
from tests.support.slices import first, only, spread_rows

POOL = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
# What a C library has for input and output, memory, its own start-up and its state between calls.
EACH_BOARD = only(("qemu-mps2-an386",), BOARDS)
CMSIS = re.compile(
    r"\w+_(Handler|IRQHandler)|SystemInit|SystemCoreClock|__isr_vector|_estack|_s?[ed]?(data|bss)"
)


@pytest.mark.system
@pytest.mark.parametrize("name", first(["cortex-m0plus", "cortex-m4"]))
def test_a_target_without_memory_has_the_library_alone(tmp_path: Path, name: str) -> None:
    need(name)
    done = build(tmp_path, name)
    assert done.returncode == 0, done.stderr
    assert f"none: target {name} names a processor and no memory" in done.stdout
    assert (tmp_path / "out" / "lib" / "libmicroros.a").is_file()
    assert not (tmp_path / "out" / "bin").exists()
    assert "extends: " + name in (tmp_path / "out" / "README.md").read_text()


@pytest.mark.parametrize("name", EACH_BOARD)
def test_an_image_has_no_part_of_a_c_library_that_is_not_needed(builds: Builds, name: str) -> None:
    symbols = set(builds.build(name).symbols())
    assert "port_bare_start" in symbols
    assert "memcpy" in symbols
    assert {s for s in symbols if NOT_NEEDED.fullmatch(s)} == set()


@pytest.mark.parametrize("name", EACH_BOARD)
def test_next_to_the_elf_file_are_the_formats_of_programs_that_flash(builds: Builds, name: str) -> None:
    built = builds.build(name)
    binary = built.image.with_suffix(".bin").read_bytes()
    assert len(binary) < 16 * 1024
    assert built.image.with_suffix(".hex").read_text().startswith(":")
    flash, ram = built.target.flash, built.target.ram
    assert flash is not None
    assert ram is not None
    if name == "qemu-riscv32-virt":
        assert built.symbols()["port_riscv_reset"] == flash.origin
        return
    stack, reset = (int.from_bytes(binary[at : at + 4], "little") for at in (0, 4))
    assert stack == built.symbols()["port_stack_high"] == ram.origin + 2048
    assert reset == built.symbols()["port_cortex_m_reset"] | 1


def _vendors_firmware(built: Built, folder: Path, *flags: str) -> set[str]:
    """Link the archive as into a vendor's project; return the symbols of the image."""
    compiler = [built.target.compilers[0], *built.target.c_flags]
    source, compiled, image = C_FILES / "vendor.c", folder / "vendor.o", folder / "firmware.elf"
    check([*compiler, *flags, f"-I{built.out / 'include'}", "-c", str(source), "-o", str(compiled)])
    link = ("--specs=nano.specs", "-nostartfiles", "-Wl,--fatal-warnings", "-T", str(C_FILES / "vendor.ld"))
    check([*compiler, *link, str(compiled), str(built.out / "lib" / "libmicroros.a"), "-o", str(image)])
    return set(built.symbols(image))


def test_a_vendors_start_up_and_handlers_do_not_collide(builds: Builds, tmp_path: Path) -> None:
    """The archive, linked as into a vendor's project: its vector table, its SysTick_Handler, its linker script."""
    built = builds.build("qemu-mps2-an386")
    symbols = _vendors_firmware(built, tmp_path)
    assert {"port_time_ms", "port_bare_tick", "SysTick_Handler"} <= symbols
    assert not symbols & {
        "port_bare_start",
        "port_cortex_m_vectors",
        "port_cortex_m_reset",
        "port_cortex_m_fault",
    }
    library_symbols = set(built.symbols(built.out / "lib" / "libmicroros.a"))
    assert {s for s in library_symbols if CMSIS.fullmatch(s)} == set()


def test_functions_of_an_rtos_win_over_those_of_the_archive(builds: Builds, tmp_path: Path) -> None:
    """An application that has time and sleep from its RTOS defines them; no tick of the bare port is linked then."""
    symbols = _vendors_firmware(builds.build("qemu-mps2-an386"), tmp_path, "-DOWN_TIME")
    assert {"port_time_ms", "port_sleep_ms"} <= symbols
    assert "port_bare_tick" not in symbols


USER_BOARD = """\
target: mine
extends: cortex-m3
summary: mine
clock_hz: 48000000
flash: {origin: 0x08000000, size: 64 KiB}
ram: {origin: 0x20000000, size: 8 KiB}
interrupts: {5: mine_uart_interrupt}
"""


@pytest.fixture(scope="module")
def own_board(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """A user's board, whose UART this project does not drive."""
    need("cortex-m3")
    home = tmp_path_factory.mktemp("own_board")
    (home / "mine.yaml").write_text(USER_BOARD)
    done = build(home, "mine.yaml")
    assert done.returncode == 0, done.stderr
    assert "none: your application provides port_serial_open" in done.stdout
    from microros_gen.diagnostics import Diagnostics
    from microros_gen.platform.find import read_target

    found = read_target("mine.yaml", home, None, Diagnostics())
    assert found is not None
    return Built(home / "out", found.target)


@pytest.mark.system
def test_an_application_brings_the_serial_line_of_its_board(own_board: Built, tmp_path: Path) -> None:
    image = own_board.link(C_FILES / "own_serial.c", tmp_path / "own.elf", "-DOWN_SERIAL")
    symbols = own_board.symbols(image)
    table = image.with_suffix(".bin")
    check([own_board.tool("objcopy"), "-O", "binary", str(image), str(table)])
    entry = int.from_bytes(table.read_bytes()[4 * 21 : 4 * 22], "little")
    assert entry == symbols["mine_uart_interrupt"] | 1


@pytest.mark.system
def test_without_it_the_linker_says_what_is_missing(own_board: Built, tmp_path: Path) -> None:
    with pytest.raises(AssertionError) as error:
        own_board.link(C_FILES / "own_serial.c", tmp_path / "own.elf")
    assert "port_serial_open is missing: the application provides it, as the target file says" in str(
        error.value
    )


REFUSED = [
    ("session: {key: device}\n", "4:1", "session.key: device needs a number that no other device has"),
    ("memory: {stack: 5 MiB}\n", "4:", "a stack of 5242880 bytes leaves nothing of the 4194304 bytes of RAM"),
    ("transport: {type: serial, baud: 3000000}\n", "4:", "3000000 baud is not possible with 25000000 Hz"),
]


@pytest.mark.parametrize(("line", "place", "expected"), spread_rows(REFUSED), ids=["key", "stack", "baud"])
def test_what_a_board_cannot_have_is_refused_before_compiling(
    tmp_path: Path, line: str, place: str, expected: str
) -> None:
    need("qemu-mps2-an385")
    done = build(tmp_path, "qemu-mps2-an385", POOL + line)
    assert done.returncode == 2
    assert re.search(rf"microros.yaml:{place}.*error: {re.escape(expected)}", done.stderr), done.stderr
    assert not (tmp_path / "out").exists()


def test_a_missing_compiler_is_named_with_its_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    done = build(tmp_path, "cortex-m3")
    assert done.returncode == 2
    assert "target cortex-m3 needs a C compiler and none of arm-none-eabi-gcc is on the PATH" in done.stderr
    assert "apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" in done.stderr


@pytest.mark.system
def test_what_does_not_fit_into_ram_says_how_much_too_large_it_is(tmp_path: Path) -> None:
    need("cortex-m3")
    board = USER_BOARD.replace("8 KiB", "2304") + "uart: {driver: cmsdk, base: 0x40004000, irq: 0}\n"
    (tmp_path / "mine.yaml").write_text(board.replace("interrupts: {5: mine_uart_interrupt}\n", ""))
    done = build(tmp_path, "mine.yaml")
    assert done.returncode == 1
    assert re.search(r"It takes \d+ bytes more than the target's ram: lower memory.stack", done.stderr), (
        done.stderr
    )


@pytest.mark.system
@pytest.mark.skipif(shutil.which("cmake") is None, reason="no cmake")
def test_cmake_builds_the_same_image_with_the_tool_chain_file(builds: Builds, tmp_path: Path) -> None:
    built = builds.build("qemu-mps2-an386")
    folder = tmp_path / "a build folder"
    toolchain = f"-DCMAKE_TOOLCHAIN_FILE={built.out / 'toolchain.cmake'}"
    check(["cmake", "-S", str(built.out), "-B", str(folder), toolchain, "-DMICROROS_EXAMPLE=ON"])
    check(["cmake", "--build", str(folder)])
    assert (folder / "pure_sender.hex").is_file()
    assert (folder / "pure_sender.bin").is_file()
    functions = {name for name in built.symbols() if not name.startswith("$")}
    assert {
        name for name in built.symbols(folder / "pure_sender.elf") if not name.startswith("$")
    } == functions
