# SPDX-License-Identifier: Apache-2.0
"""The console of a board, sent by interrupt: a log call never waits for the line, and dropped lines are reported."""

from __future__ import annotations

import fcntl
import os
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from tests.support.agent.observer import Observer
from tests.support.firmware.board import C_FILES, Built, board, compile_merged_image, need, run_tool
from tests.support.firmware.instructions import trace_regions
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.slices import first

LINES = 60
SIZE = 400
PIPE_SIZE = 4096
CORTEX_M, RISC_V = "qemu-mps2-an386", "qemu-riscv32-virt"
OWN = f"{CORTEX_M} with a driver of the application"
CONSOLES = {
    CORTEX_M: "uart: {driver: cmsdk, base: 0x40005000, irq: 2}\n"
    "stdio: {to: uart, driver: cmsdk, base: 0x40004000, irq: 0, baud: BAUD}\n",
    RISC_V: "stdio: {to: uart, driver: ns16550, base: 0x10000000, irq: 10, baud: BAUD}\n",
    OWN: "uart: {driver: cmsdk, base: 0x40005000, irq: 2}\n"
    "provides: [console_send]\ninterrupts: {1: own_console_interrupt}\n",
}
"""The first UART of QEMU is the console, so that `arguments` can name its line."""
MACHINES = {
    CORTEX_M: ("qemu-system-arm", "-M, mps2-an386"),
    RISC_V: ("qemu-system-riscv32", "-M, virt, -bios, none, -m, 128M"),
}
FLAGS = {CORTEX_M: (), RISC_V: ("-DCONSOLE_UDP",), OWN: ("-DCONSOLE_OWN",)}
APPLICATION = f"""\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
session: {{key: 7}}
transport: TRANSPORT
logging: [{{to: console, size: {SIZE}}}]
"""
RING = """\
version: 1
profiles: [pure_sender]
logging: [{to: rosout, level: warn}, {to: ring, level: debug}, {to: console, level: debug}]
session: {key: 7, connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: device, namespace: /arm}]
"""
LINE = re.compile(r"\[(\w+)\] \[\d+\.\d{9}\] \[(\w+)\]: (.*)")
MOST_INSTRUCTIONS = 3500
"""Of one log call on a Cortex-M4; the line of 36 bytes takes 78,000 cycles of 25 MHz at 115,200 baud."""

INTERRUPTS = ("port_bare_tick", "port_cortex_m_console_interrupt", "port_console_next")
"""They send the bytes while the program works; how many of them fall into one log call depends on the line."""


def firmware(
    home: Path, way: str, application: str, console: str, baud: int = 115_200, command: str = "generate"
) -> Built:
    """Make the library for a console of CONSOLES at the line `console` of QEMU; `build`: as one that is measured."""
    name = way.split()[0]
    program, machine = MACHINES[name]
    text = f"target: mine\nextends: {name}\n" + CONSOLES[way].replace("BAUD", str(baud))
    text += f"emulator: {{program: {program}, package: qemu, arguments: [{machine}, {console}]}}\n"
    (home / "mine.yaml").write_text(text)
    found = read_target("mine.yaml", home, None, Diagnostics())
    assert found is not None
    done = run_tool(command, home, "mine.yaml", application)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "waits until" not in done.stderr
    built = Built(home / "out", replace(found.target, name=name))
    if command == "generate":
        compile_merged_image(built)
    return built


class StalledLine:
    """A line that takes nothing until `release`: a pipe that is full."""

    def __init__(self, folder: Path) -> None:
        self.arguments = f'-chardev, "pipe,id=console,path={folder / "console"}", -serial, "chardev:console"'
        for suffix in ("in", "out"):
            os.mkfifo(folder / f"console.{suffix}")
        self._pipe = os.open(folder / "console.out", os.O_RDWR | os.O_NONBLOCK)
        fcntl.fcntl(self._pipe, fcntl.F_SETPIPE_SZ, PIPE_SIZE)
        self._filled = os.write(self._pipe, b"#" * PIPE_SIZE)
        assert self._filled == PIPE_SIZE
        self._text = b""

    def release(self) -> None:
        """Take what fills the pipe, and let the board send."""
        assert os.read(self._pipe, self._filled) == b"#" * self._filled

    def lines(self, last: str) -> list[tuple[str, str, str]]:
        """Wait for a line that ends with `last`; return the level, logger and text of all lines until then."""
        end = deadline(30)
        while not (self._text.endswith(b"\n") and last in self._text.splitlines()[-1].decode()):
            try:
                self._text += os.read(self._pipe, PIPE_SIZE)
            except BlockingIOError:
                assert time.monotonic() < end, self._text
                time.sleep(0.02)
        found = [LINE.fullmatch(line) for line in self._text.decode().splitlines()]
        return [(match[1], match[2], match[3]) if match else ("", "", "?") for match in found]

    def close(self) -> None:
        os.close(self._pipe)


@contextmanager
def stalled_line(folder: Path) -> Iterator[StalledLine]:
    """Create a line in `folder`, and close it afterwards."""
    line = StalledLine(folder)
    try:
        yield line
    finally:
        line.close()


@pytest.mark.system
@pytest.mark.parametrize("way", first(CONSOLES))
def test_a_burst_on_a_stalled_line_fits_or_is_reported(tmp_path: Path, way: str) -> None:
    need(way.split()[0], emulator=True)
    application = APPLICATION.replace("TRANSPORT", "{type: udp}" if way == RISC_V else "{type: serial}")
    with stalled_line(tmp_path) as line:
        built = firmware(tmp_path, way, application, line.arguments)
        image = built.link(C_FILES / "console.c", tmp_path / "console.elf", *FLAGS[way])
        with board(built, image) as running:
            running.go_on()
            running.wait_for(lambda: running.words("console_report") == [1])
            _, dropped, elapsed, idle = running.words("console_report", 4)
            line.release()
            found = line.lines("messages dropped")
            running.wait_for(lambda: running.words("console_report", 4)[3] == 1)
    burst = [("INFO", "board", f"burst {number}") for number in range(LINES - dropped)]
    fitting = [text for text in found if text[1] == "board"]
    assert fitting == burst
    assert SIZE / 2 < sum(len(f"[INFO] [0.000000000] [board]: {text}\n") for _, _, text in burst) <= SIZE + 32
    assert found[-1] == ("WARN", "rcutils", f"{dropped} messages dropped")
    assert idle == 0
    assert elapsed < 100, "60 lines take 180 ms at 115,200 baud, and a stalled line takes forever"


@pytest.mark.system
@pytest.mark.parametrize("baud", first([9600, 921_600]))
def test_a_log_call_takes_bounded_instructions_on_any_line(tmp_path: Path, baud: int) -> None:
    need(CORTEX_M, emulator=True)
    application = APPLICATION.replace("TRANSPORT", "{type: serial}")
    counts = []
    with stalled_line(tmp_path) as line:
        built = firmware(tmp_path, CORTEX_M, application, line.arguments, baud, "build")
        image = built.link(C_FILES / "console.c", tmp_path / "console.elf", "-DCONSOLE_MARKS")
        emulator = built.target.emulator
        assert emulator is not None
        fixed = ("-nographic", "-monitor", "none", "-semihosting-config", "enable=on,target=native")
        free = (*emulator.arguments[:2], "-serial", "null")
        for arguments in (emulator.arguments, free):
            command = [emulator.program, *arguments, *fixed, "-icount", "shift=4,sleep=off"]
            counts.append([r.counted for r in trace_regions(command, image, INTERRUPTS)])
    assert [len(found) for found in counts] == [LINES, LINES]
    for found in counts:
        assert 0 < max(found) < MOST_INSTRUCTIONS, found


@pytest.mark.system
@pytest.mark.ros
def test_the_ring_outlasts_a_reset_in_the_middle_of_the_output(
    tmp_path: Path, domain: int, observer: Observer
) -> None:
    need(CORTEX_M, emulator=True)
    observer.subscribe("/rosout", "rcl_interfaces/msg/Log", transient_local=True)
    with stalled_line(tmp_path) as line:
        built = firmware(tmp_path, CORTEX_M, RING, line.arguments)
        image = built.link(C_FILES / "log_ring.c", tmp_path / "ring.elf", "-DFAULT_ADDRESS=0xa0000000u")
        with (
            board(built, image, restarts=True) as running,
            started(
                "agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain
            ) as agent,
        ):
            agent.wait_for("agent ready")
            running.go_on()
            running.wait_for(lambda: running.words("ring_report") == [1], 60)
            line.release()
            end, found = deadline(60), list[str]()
            while "before the fault 2" not in found:
                samples = observer.ask(do="samples")
                found += [s["msg"] for topic, s in samples if topic == "/rosout" and s["name"] == "board"]
                assert time.monotonic() < end, found
                time.sleep(0.02)
            printed = line.lines("session open")
    assert found == ["after the fault 3", *(f"before the fault {number}" for number in range(3))]
    assert ("WARN", "board", "after the fault 3") in printed
    assert ("", "", "?") not in printed[1:], "only the first line can be what was left of a reset"
