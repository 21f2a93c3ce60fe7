# SPDX-License-Identifier: Apache-2.0
"""Flash of the type support of every message of sensor_msgs on a Cortex-M4, encoders and decoders apart."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.support.paths import ROOT

IDL = ROOT / "microros_gen" / "idl"
CORTEX_M4 = ["-std=c99", "-mcpu=cortex-m4", "-mthumb", "-Os", "-ffunction-sections", "-fdata-sections"]
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+cdr_decode]
interfaces: [sensor_msgs]
pools: {publishers: 1}
transport: {type: udp, mtu: 60000}
limits: {"*": {string: 16, sequence: 4}}
"""
EXISTING = 14011 + 1620
"""Text and data of the existing stack's for all of sensor_msgs: encode, decode and sizes (recorded)."""


def bench_type_flash(work: Path) -> None:
    """Compile the type support of sensor_msgs and print a line for each file, and what all of it takes linked."""
    if shutil.which("arm-none-eabi-gcc") is None:
        sys.exit("flash of types needs arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi")
    work.mkdir(parents=True, exist_ok=True)
    (work / "types.yaml").write_text(APPLICATION)
    out = work / "types"
    command = [
        sys.executable,
        "-m",
        "microros_gen",
        "generate",
        "-c",
        str(work / "types.yaml"),
        "-o",
        str(out),
    ]
    checked_output([*command, "--interface-path", str(IDL)], work)
    encoders = compiled(out, "src/sensor_msgs/*__type_support.c")
    decoders = compiled(out, "src/sensor_msgs/*__decode.c")
    shared = compiled(out, "src/cdr_decode/cdr_*.c")
    print(
        "flash of type support: sensor_msgs, Cortex-M4, -Os; bytes of code and constants, each file by itself"
    )
    print(f"{'':58} {'encode':>8} {'decode':>8}")
    for (source, encoder), decoder in zip(encoders.items(), decoders.values(), strict=True):
        print(f"  {source.removesuffix('__type_support.c'):<56} {flash([encoder]):8} {flash([decoder]):8}")
    print(f"  {'parts that all decoders share':<56} {'':8} {flash(list(shared.values())):8}")
    each = [linked(list(encoders.values()), work), linked([*decoders.values(), *shared.values()], work)]
    print(f"  {'all, linked: equal names of members are there once':<56} {each[0]:8} {each[1]:8}")
    every = [*encoders.values(), *decoders.values()]
    messages = [path for path in every if not path.name.startswith("srv__")]
    print(f"  {'both together':<56} {linked([*every, *shared.values()], work):17}")
    print(f"  {'both together, without the service':<56} {linked([*messages, *shared.values()], work):17}")
    print(f"  {'existing stack (recorded)':<56} {EXISTING:17}")
    print()


def compiled(out: Path, pattern: str) -> dict[str, Path]:
    """Compile what matches; return the objects by the names of their sources."""
    objects = {}
    for source in sorted(out.glob(pattern)):
        objects[source.name] = source.with_suffix(".o")
        checked_output(
            ["arm-none-eabi-gcc", *CORTEX_M4, "-Iinclude", "-c", source, "-o", objects[source.name]], out
        )
    return objects


def linked(objects: list[Path], work: Path) -> int:
    """Return the flash of all objects in one image, with nothing left out."""
    image = work / "types.elf"
    linker = ["arm-none-eabi-ld", "-O2", "-e", "0", "--unresolved-symbols=ignore-all"]
    checked_output([*linker, "-o", image, *objects], work)
    return flash([image])


def flash(objects: list[Path]) -> int:
    """Return text and data of all of them, bytes."""
    lines = checked_output(["arm-none-eabi-size", *objects], Path.cwd()).splitlines()[1:]
    return sum(int(line.split()[0]) + int(line.split()[1]) for line in lines)


def checked_output(command: Sequence[str | Path], folder: Path) -> str:
    """Run `command`; end the bench with its output when it fails, or return it."""
    words = [str(word) for word in command]
    result = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(words)} failed:\n{result.stdout}{result.stderr}")
    return result.stdout
