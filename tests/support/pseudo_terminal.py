# SPDX-License-Identifier: Apache-2.0
"""Runs a command at a terminal, as somebody who types it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from threading import Thread

from tests.support.environments import clean_environ
from tests.support.patience import seconds

_COLOR_VARIABLES = ("NO_COLOR", "FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "CI", "TERM")


@dataclass(frozen=True)
class Shown:
    """What a terminal showed, with its control sequences and with lines that end in \\n; `piped` is stdout."""

    status: int
    text: str
    piped: str = ""


def at_terminal(
    arguments: Sequence[str], folder: Path, *, pipe_stdout: bool = False, **variables: str
) -> Shown:
    """Run `microros-gen` with stdin, stdout (unless `pipe_stdout`) and stderr at a pseudo-terminal."""
    ours, theirs = os.openpty()
    environment = clean_environ(XDG_CACHE_HOME=str(folder / "cache"))
    environment = {n: v for n, v in environment.items() if n not in _COLOR_VARIABLES}
    environment |= {"TERM": "xterm", **variables}
    collected: list[bytes] = []

    def collect() -> None:
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # Linux: the other end was closed
                return
            if not part:
                return
            collected.append(part)

    process = subprocess.Popen(
        [sys.executable, "-m", "microros_gen", *arguments],
        cwd=folder,
        env=environment,
        stdin=theirs,
        stdout=subprocess.PIPE if pipe_stdout else theirs,
        stderr=theirs,
    )
    os.close(theirs)
    reader = Thread(target=collect)
    reader.start()
    piped, _ = process.communicate(timeout=seconds(120))
    reader.join(timeout=seconds(10))
    os.close(ours)
    text = b"".join(collected).decode().replace("\r\n", "\n")
    return Shown(process.returncode, text, (piped or b"").decode())
