# SPDX-License-Identifier: Apache-2.0
"""The packages that boards with an ESP8266 use, compiled for its processor by Debian's compiler."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.package.render import describe, plan_package, render_package

COMPILER = "xtensa-lx106-elf-gcc"
LIBRARY = Path("/usr/lib/xtensa-lx106-elf/include")
"""Headers of picolibc for this processor."""
FLAGS = ["-std=c99", "-Os", "-mlongcalls", "-Wall", "-Wextra", "-Werror", "-isystem", str(LIBRARY)]


@pytest.mark.builds
@pytest.mark.system
@pytest.mark.parametrize("name", ["arduino", pytest.param("platformio", marks=pytest.mark.variant)])
def test_the_library_is_compiled(name: str, tmp_path: Path) -> None:
    """All but what needs the core of Arduino: without a warning, and with no constant that is copied to RAM."""
    if shutil.which(COMPILER) is None or not LIBRARY.exists():
        pytest.skip(f"{COMPILER} or picolibc for it is not installed")
    sources = []
    for path, content in render_package(plan_package(describe(name), None)).items():
        place = tmp_path / "package" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
        if path.startswith("src/") and path.endswith(".c") and b"Arduino.h" not in content:
            sources.append(str(place))
    assert len(sources) > 150
    folders = [word for folder in ("src", "include") for word in ("-I", str(tmp_path / "package" / folder))]
    call = [COMPILER, *FLAGS, *folders, "-c", *sources]
    done = subprocess.run(call, cwd=tmp_path, text=True, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    objects = sorted(map(str, tmp_path.glob("*.o")))
    call = [COMPILER.replace("gcc", "size"), "-A", *objects]
    sizes = subprocess.run(call, text=True, capture_output=True, check=True).stdout
    copied = [
        line.split() for line in sizes.splitlines() if line.startswith(".data") and line.split()[1] != "0"
    ]
    assert copied == []
