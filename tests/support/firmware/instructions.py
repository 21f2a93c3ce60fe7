# SPDX-License-Identifier: Apache-2.0
"""Counts instructions of a bare-metal program between its calls of `mark`, in the trace of QEMU."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from microros_gen.platform.target import Target
from tests.support.patience import seconds

_TRACE = re.compile(r"^Trace \d+: \S+ \[[0-9a-f]+/([0-9a-f]+)/\S* ?(\S*)")
LONGEST_RUN_S = 60
EXIT = ("-nographic", "-semihosting-config", "enable=on,target=native", "-icount", "shift=4,sleep=off")
"""Arguments of an emulator: the program ends it, and its time is that of its instructions."""


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


def counted_regions(target: Target, image: Path, left_out: Iterable[str] = ()) -> Sequence[int]:
    """Return the instructions from each mark to the next one, run on a target; those of `left_out` do not count."""
    regions = trace_regions(emulator_command(target), image, left_out)
    return [region.counted for region in regions]


def emulator_command(target: Target) -> Sequence[str]:
    """Return the command that runs an image on a target; the image follows `-kernel`."""
    emulator = target.emulator
    assert emulator is not None
    return [emulator.program, *emulator.arguments, *EXIT]


def run_to_end(target: Target, image: Path) -> tuple[int, bytes]:
    """Run an image until it ends the emulator; return its status and what it and the emulator reported."""
    command = [*emulator_command(target), "-kernel", str(image)]
    done = subprocess.run(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=seconds(60), check=False
    )
    return done.returncode, done.stderr


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
