# SPDX-License-Identifier: Apache-2.0
"""Return codes of calls with wrong, missing or empty arguments: the generated library against ROS 2's librcl."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from api.test_surface import generate
from runtime.harness import compile_objects, link

pytestmark = pytest.mark.ros
SOURCE = Path(__file__).parent / "c" / "returns.c"

DIFFERENT: dict[str, tuple[int, int]] = {}
"""Call: what librcl returns, and what is returned here, for a reason."""


def said(*command: str | Path, **environment: str) -> list[tuple[str, int]]:
    """Return what a command prints, in its order."""
    done = subprocess.run(
        command, env={**os.environ, **environment}, capture_output=True, text=True, check=True, timeout=60
    )
    return [(name, int(value)) for name, value in (line.rsplit(" ", 1) for line in done.stdout.splitlines())]


def test_every_call_returns_what_librcl_returns(tmp_path: Path) -> None:
    prefix = Path(sys.prefix)
    theirs = tmp_path / "theirs.so"
    folders = [f"-I{p}" for p in sorted((prefix / "include").iterdir()) if p.is_dir()]
    libraries = [f"-L{prefix / 'lib'}", "-lrcl", "-lrmw", "-lrcutils", "-Wl,--allow-shlib-undefined"]
    command = ["gcc", "-w", "-shared", "-fPIC", *folders, str(SOURCE), *libraries, "-o", str(theirs)]
    subprocess.run(command, check=True)
    tree = generate(tmp_path / "ours", "custom")
    flags = ("-O0", "-Wno-unused-parameter", "-Wno-pedantic", "-Wno-sign-conversion", "-Wno-conversion")
    objects = compile_objects(tree, [SOURCE, *tree.sources], "gcc", flags)
    mine = said(link(objects, "gcc", (), tmp_path / "mine"))
    bundled = sorted(Path(sysconfig.get_path("purelib")).glob("*.libs"))
    paths = os.pathsep.join(map(str, (prefix / "lib", *bundled)))
    # Some of librcl's libraries are for Python alone, so an interpreter has to load them.
    load = f"import ctypes; ctypes.CDLL({str(theirs)!r}).main()"
    known = said(sys.executable, "-c", load, LD_LIBRARY_PATH=paths, ROS_DOMAIN_ID="")
    assert [name for name, _ in mine] == [name for name, _ in known]
    differing = {
        f"{index} {name}": (other, own)
        for index, ((name, own), (_, other)) in enumerate(zip(mine, known, strict=True))
        if own != other
    }
    assert {key.split(" ", 1)[1]: pair for key, pair in differing.items()} == DIFFERENT
    assert len(mine) > 150
