# SPDX-License-Identifier: Apache-2.0
"""Programs that print what each call returns."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

from tests.support.paths import TESTS
from tests.support.patience import seconds

FOLDER = TESTS / "runtime" / "c" / "api"
FLAGS = (
    "-O0",
    "-Wno-unused-parameter",
    "-Wno-pedantic",
    "-Wno-sign-conversion",
    "-Wno-conversion",
    f"-I{FOLDER}",
)


def results_of(folder: Path, *command: str | Path, **environment: str) -> list[tuple[str, int]]:
    """Return what a program of c/ tells, in its order."""
    reported = folder / "told.txt"
    known = {**os.environ, **environment, "TELL": str(reported)}
    done = subprocess.run(
        command, env=known, capture_output=True, text=True, check=False, timeout=seconds(60)
    )
    lines = reported.read_text(encoding="utf-8").splitlines()
    assert done.returncode == 0, (lines[-1], done.stderr[-2000:])
    return returned(lines)


def returned(lines: Iterable[str]) -> list[tuple[str, int]]:
    """Return calls and what they returned."""
    return [(name, int(value)) for name, value in (line.rsplit(" ", 1) for line in lines)]
