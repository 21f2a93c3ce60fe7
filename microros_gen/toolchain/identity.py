# SPDX-License-Identifier: Apache-2.0
"""The identity of a compiler: its own description, the state of its programs, and its environment variables."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path

from microros_gen.records import dataclass
from microros_gen.toolchain.contents import joined
from microros_gen.toolchain.toolchain import run

# What gcc (10 and newer) says of each function: its frame, and whom it calls. Written next to the object, as .ci.
CALL_GRAPH = "-fcallgraph-info=su"
# Compilers read these besides their arguments.
_ENVIRONMENT = (
    "CPATH",
    "C_INCLUDE_PATH",
    "COMPILER_PATH",
    "GCC_COMPARE_DEBUG",
    "GCC_EXEC_PREFIX",
    "CCC_OVERRIDE_OPTIONS",
    "SOURCE_DATE_EPOCH",
)
_PROGRAM = re.compile(r'^ "?(/[^" ]+)', re.MULTILINE)


@dataclass(frozen=True)
class Identity:
    """A compiler: a digest of everything that decides its output, and whether it accepts CALL_GRAPH."""

    digest: str
    call_graph: bool


def identify(compiler: str, environ: Mapping[str, str]) -> Identity:
    """Return the identity of a compiler, whose driver is run for that: it says what it would run, and runs nothing."""
    probe = ["-###", "-x", "c", "-S", os.devnull, "-o", os.devnull]
    folder = Path(Path.cwd().anchor)  # clang says in which folder it runs
    probed = run([compiler, CALL_GRAPH, *probe], folder)
    call_graph = probed.returncode == 0
    if not call_graph:
        probed = run([compiler, *probe], folder)
    variables = (f"{name}={environ.get(name, '')}" for name in _ENVIRONMENT)
    return Identity(joined([probed.stdout, *_states(compiler, probed.stdout), *variables]), call_graph)


def _states(compiler: str, probed: str) -> Iterator[str]:
    """Yield the states of the driver and of the programs that it runs."""
    for name in (compiler, *_PROGRAM.findall(probed)):
        try:
            found = Path(name).stat()
        except OSError:
            continue  # a line that names no program
        if stat.S_ISREG(found.st_mode):  # and no folder of headers
            yield f"{name} {found.st_size} {found.st_mtime_ns}"
