# SPDX-License-Identifier: Apache-2.0
"""Counts instructions of a bare-metal program between its calls of `mark`, in the trace of QEMU."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

_TRACE = re.compile(r"^Trace \d+: \S+ \[[0-9a-f]+/([0-9a-f]+)/\S* ?(\S*)")
LONGEST_RUN_S = 60


@dataclass(frozen=True)
class Region:
    """Instructions between two calls of `mark`: those of the measured code alone, and of functions left out."""

    counted: int
    left_out: int


def trace_regions(
    command: Sequence[str], image: Path, left_out: Iterable[str], mark: str = "mark"
) -> tuple[Region, ...]:
    """Run `image` in the emulator `command` and return one region for each pair of neighboring marks.

    One line of the trace is one instruction (one instruction a translation block). Functions in `left_out`, by the
    symbol that the emulator finds for an address, do not count. The program must end the emulator by itself.
    """
    full = [*command, "-kernel", str(image), "-d", "exec,nochain", "-singlestep"]
    skip = frozenset(left_out)
    with subprocess.Popen(full, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as process:
        assert process.stderr is not None
        try:
            return tuple(_regions(process.stderr, skip, mark))
        finally:
            process.kill()


def _regions(lines: Iterable[str], skip: frozenset[str], mark: str) -> Iterator[Region]:
    counted = out = 0
    seen = inside = False
    for line in lines:
        found = _TRACE.match(line)
        if found is None:
            continue
        symbol = found.group(2)
        if symbol == mark:
            if not inside and seen:
                yield Region(counted, out)
            counted = out = 0
            seen = inside = True
            continue
        if symbol in skip:
            out += 1
        else:
            inside = False
            counted += 1
