# SPDX-License-Identifier: Apache-2.0
"""Images for an AVR, linked as Arduino's compiler links them, and run in simavr with their UART as a terminal."""

from __future__ import annotations

import json
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Builds, Built, check
from tests.support.firmware.footprint import SERVES
from tests.support.patience import deadline, seconds

UNO, MEGA = "arduino-uno", "arduino-mega"
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
READS = """\
version: 1
profiles: [pure_reader]
errors: code
session: {key: 1}
nodes: [{name: uno, subscriptions: [{topic: count, type: std_msgs/msg/Int32}]}]
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
ANSWERS = f"{SERVES}session: {{key: 5, connect_timeout: 20 s, create_timeout: 20 s}}\n"
_CLOCK_HZ = 16_000_000
_HEADER = Path("/usr/include/simavr/sim_avr.h")


class SimulatedBoard:
    """An image in simavr; `device` is the terminal of its first UART."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.device = self._number("line (.+)")

    def touched_stack(self) -> int:
        """Return the most bytes of stack that were used until now."""
        self.process.send_signal(signal.SIGUSR1)
        return int(self._number("stack ([0-9]+)"))

    def _number(self, pattern: str) -> str:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            found = re.fullmatch(pattern, line.rstrip("\n"))
            if found is not None:
                return found[1]
        raise AssertionError("the simulator ended")


def linked(builds: Builds, built: Built, source: str) -> Path:
    """Return an application of c/, linked with the library of `built` by the C library's own start-up code."""
    target, image = built.target, built.out.parent / f"{Path(source).stem}.elf"
    with builds.once(f"{built.out.parent.name}-{image.name}") as first:
        if first:
            compiled = str(image.with_suffix(".o"))
            flags = [*target.c_flags, "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{built.out / 'include'}"]
            check([target.compilers[0], *flags, "-c", str(C_FILES / source), "-o", compiled])
            library = str(built.out / "lib" / "libmicroros.a")
            files = [compiled, library, f"-Wl,-Map={image.with_suffix('.map')}", "-o", str(image)]
            check([target.compilers[0], *target.c_flags, *target.link_flags, *files])
    return image


def read_line(line: int, count: int) -> bytes:
    """Return the next `count` bytes that the board sends; `line` is the open terminal."""
    found = b""
    end = deadline(20)
    while len(found) < count:
        assert time.monotonic() < end, "the board does not answer"
        ready, _, _ = select.select([line], [], [], 1)
        found += os.read(line, count - len(found)) if ready else b""
    return found


def flash_and_ram(built: Built, image: Path) -> tuple[int, int]:
    """Return bytes of flash, and of RAM without the stack."""
    text, data, bss = map(int, check([built.tool("size"), str(image)]).splitlines()[1].split()[:3])
    return text + data, data + bss


def bounded(built: Built, image: Path) -> tuple[int, list[str]]:
    """Return the bound of the stack that `size` proves, and what it leaves out."""
    command = [sys.executable, "-m", "microros_gen", "size", str(built.out), "--format", "json"]
    stack = json.loads(check([*command, "--image", str(image)]))["stack"]
    return int(stack["total"]), list(stack["not_counted"])


@contextmanager
def simulated(builds: Builds, built: Built, image: Path) -> Iterator[SimulatedBoard]:
    """Start an image in simavr, and end it afterwards."""
    if not _HEADER.is_file() or shutil.which("cc") is None:
        pytest.skip("no libsimavr: apt-get install libsimavr-dev libelf-dev")
    program = built.out.parent.parent / "simavr_board"
    with builds.once(program.name) as first:
        if first:
            strict = ["-std=gnu11", "-O2", "-Wall", "-Wextra", "-Werror"]
            source = str(C_FILES / "simavr_board.c")
            check(["cc", *strict, source, "-o", str(program), "-lsimavr", "-lelf"])
    [processor] = [flag.removeprefix("-mmcu=") for flag in built.target.c_flags if flag.startswith("-mmcu=")]
    process = subprocess.Popen(
        [str(program), processor, str(_CLOCK_HZ), str(image)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "LC_ALL": "C"},
        text=True,
    )
    try:
        yield SimulatedBoard(process)
    finally:
        process.kill()
        process.communicate(timeout=seconds(10))
