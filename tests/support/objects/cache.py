# SPDX-License-Identifier: Apache-2.0
"""One cache of objects for all tests and workers: compilers in the PATH that do not compile the same text twice.

An object is kept by the content of what it was made from (cached.c says exactly what), in build/objects. Tests call
compilers as always. The store of `build` is off: it finds an object with debug information in the same folder only,
and each test has its own. `MICROROS_TEST_OBJECTS=off` leaves the PATH as it is, and each test its store.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import time
from pathlib import Path

from tests.support.paths import ROOT

CACHE = ROOT / "build" / "objects"
SOURCE = Path(__file__).with_name("cached.c")
COMPILERS = (
    *("gcc", "cc", "g++", "c++", "clang", "clang++"),
    *("arm-none-eabi-gcc", "riscv64-unknown-elf-gcc", "avr-gcc"),
)
KEPT_DAYS = 3
STORE = "MICROROS_GEN_OBJECTS"
"""What tells `build` where its objects are; empty: in the cache folder of the user that a test makes up; or `off`."""


def put_into_path(cache: Path = CACHE) -> None:
    """Let the PATH of this process and of those that it starts begin with the cache's compilers."""
    folder = cache / "bin"
    path = os.environ.get("PATH", os.defpath)
    is_there = str(folder) in path.split(os.pathsep)
    if is_there or os.environ.get("MICROROS_TEST_OBJECTS") == "off" or shutil.which("gcc") is None:
        return
    make(folder)
    remove_old(cache)
    os.environ["PATH"] = f"{folder}{os.pathsep}{path}"
    os.environ.setdefault(STORE, "off")


def real(compiler: str) -> str:
    """Return the path of a compiler without the cache: for callers that keep what they made themselves."""
    others = [
        place for place in os.environ.get("PATH", os.defpath).split(os.pathsep) if place != str(CACHE / "bin")
    ]
    return shutil.which(compiler, path=os.pathsep.join(others)) or compiler


def make(folder: Path) -> None:
    """Write the compilers of `folder`: links to one program, for each compiler that this machine has."""
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / f"cached-{hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:16]}"
    if not program.is_file():
        fresh = folder / f"{program.name}.{os.getpid()}"
        flags = ("-std=c11", "-O2", "-Wall", "-Wextra", "-Wno-format-truncation")
        subprocess.run(["gcc", *flags, str(SOURCE), "-o", str(fresh)], check=True)
        fresh.replace(program)
    for name in COMPILERS:
        link = folder / name
        if shutil.which(name) is None:
            link.unlink(missing_ok=True)
        elif not link.is_symlink() or link.readlink() != Path(program.name):
            fresh = folder / f"{name}.{os.getpid()}"
            fresh.symlink_to(program.name)
            fresh.replace(link)


def remove_old(cache: Path) -> None:
    """Remove the entries that no test has used for some days."""
    oldest = time.time() - KEPT_DAYS * 86400
    for ending in (".err", ".to"):
        for entry in cache.glob(f"??/*{ending}"):
            if entry.lstat().st_mtime < oldest:
                for path in entry.parent.glob(f"{entry.stem}.*"):
                    path.unlink(missing_ok=True)
