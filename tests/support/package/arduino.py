# SPDX-License-Identifier: Apache-2.0
"""Sketches with the Arduino library: for boards by Arduino's own builder, and for the host with a small core."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.firmware.avr import SimulatedBoard
from tests.support.firmware.board import C_FILES
from tests.support.paths import TESTS
from tests.support.patience import seconds
from tests.support.runtime.harness import EVERYWHERE
from tests.support.runtime.merged import merged

LIBRARY = "micro_ros_arduino"
SKETCHES = TESTS / "package" / "sketches"
CORE = TESTS / "package" / "arduino_core"
MEGA, UNO = "mega:cpu=atmega2560", "uno"
_PROCESSORS = {MEGA: "atmega2560", UNO: "atmega328p"}
_CLOCK_HZ = 16_000_000
_HARDWARE = Path("/usr/share/arduino/hardware/arduino/avr/boards.txt")
_SETTINGS = (
    # Debian's core takes it for granted, and Debian's avr-gcc does not define it for C++
    "compiler.cpp.extra_flags=-DDECIMAL_DIG=__DECIMAL_DIG__",
    "compiler.c.extra_flags=-Wno-type-limits",  # a size of 16 bits is never above a limit of 32
    "runtime.tools.avr-gcc.path=/usr",
    "runtime.tools.ctags.path=/usr",
)


@dataclass(frozen=True)
class Sketch:
    """A sketch that was built: its image and what Arduino's builder counts, in bytes."""

    image: Path
    flash: int
    ram: int


def library(folder: Path, config: Path | None = None) -> Path:
    """Write the library below `folder`/libraries; return its folder."""
    out = folder / "libraries" / LIBRARY
    compiler.write(render_package(plan_package(describe("arduino"), config)), out)
    return out


def built(folder: Path, board: str, sketch: Path) -> Sketch:
    """Build a sketch with the library below `folder`, as the Arduino IDE does."""
    if shutil.which("arduino-builder") is None or not _HARDWARE.is_file():
        pytest.skip("no Arduino: apt-get install arduino-builder arduino-core-avr")
    # With one name for all sketches, Arduino's builder keeps the objects of the library.
    build, cache, place = folder / f"build-{board[:4]}", folder / "cache", folder / "sketches" / "sketch"
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(sketch.parent, place)
    (place / sketch.name).rename(place / "sketch.ino")
    build.mkdir(exist_ok=True)
    cache.mkdir(exist_ok=True)
    call = ["arduino-builder", "-compile", "-warnings", "all", "-fqbn", f"arduino:avr:{board}"]
    call += ["-hardware", "/usr/share/arduino/hardware", "-hardware", "/usr/share/arduino-builder"]
    call += ["-tools", "/usr/bin", "-libraries", str(folder / "libraries")]
    call += ["-build-path", str(build), "-build-cache", str(cache)]
    call += [f"-prefs={setting}" for setting in _SETTINGS]
    done = subprocess.run(
        [*call, str(place / "sketch.ino")], capture_output=True, text=True, timeout=seconds(200), check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"libraries/{LIBRARY}/" not in done.stderr, done.stderr  # -warnings all: it has none
    flash, ram = (
        re.search(r"uses (\d+) bytes", done.stdout),
        re.search(r"variables use (\d+) bytes", done.stdout),
    )
    assert flash is not None
    assert ram is not None
    image = folder / f"{sketch.stem}-{board[:4]}.elf"
    shutil.copy(build / "sketch.ino.elf", image)
    return Sketch(image, int(flash[1]), int(ram[1]))


@contextmanager
def simulated(folder: Path, board: str, sketch: Sketch) -> Iterator[SimulatedBoard]:
    """Start a sketch in simavr, with Serial as a terminal; end it afterwards."""
    if not Path("/usr/include/simavr/sim_avr.h").is_file():
        pytest.skip("no libsimavr: apt-get install libsimavr-dev libelf-dev")
    program = folder / "simavr_board"
    if not program.exists():
        source = str(C_FILES / "simavr_board.c")
        subprocess.run(
            ["cc", "-std=gnu11", "-O2", source, "-o", str(program), "-lsimavr", "-lelf"], check=True
        )
    process = subprocess.Popen(
        [str(program), _PROCESSORS[board], str(_CLOCK_HZ), str(sketch.image)],
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


def host_program(folder: Path, sketch: Path, transport: str) -> Path:
    """Compile a sketch and the library for the host; `transport` is the text of a header that the sketch includes."""
    own = folder / f"host-{sketch.stem}"
    own.mkdir()
    (own / "transport_of_test.h").write_text(transport)
    source = folder / "libraries" / LIBRARY / "src"
    includes = [f"-I{place}" for place in (own, CORE, source)]
    sanitize = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    # Only in `make system`, as for other programs: they take twice the time.
    common = [*(sanitize if os.environ.get(EVERYWHERE) == "all" else ("-O0",)), *includes]
    objects = []
    for number, unit in enumerate(merged(sorted(source.rglob("*.c")))):
        text = own / f"{number}.c"
        text.write_text("".join(f'#include "{path}"\n' for path in unit))
        objects.append(text.with_suffix(".o"))
        _compile("gcc", "-std=gnu11", *common, "-c", str(text), "-o", str(objects[-1]))
    for path in (*sorted(source.glob("*.cpp")), *sorted(CORE.glob("*.cpp"))):
        objects.append(own / f"{path.stem}.o")
        _compile("g++", "-std=gnu++11", "-Wall", *common, "-c", str(path), "-o", str(objects[-1]))
    objects.append(own / "sketch.o")
    _compile(
        "g++",
        "-std=gnu++11",
        "-x",
        "c++",
        "-include",
        "Arduino.h",
        *common,
        "-c",
        str(sketch),
        "-o",
        str(objects[-1]),
    )
    program = own / sketch.stem
    _compile("g++", *common, *map(str, objects), "-o", str(program))
    return program


def _compile(*call: str) -> None:
    done = subprocess.run(call, capture_output=True, text=True, timeout=seconds(200), check=False)
    assert done.returncode == 0, done.stderr[:4000]
