# SPDX-License-Identifier: Apache-2.0
"""Times of `build` after a limit changed, and how many objects it compiles."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

from tests.bench.generation import Seconds, median, timed, tool
from tests.support.changed_limits import CHANGES
from tests.support.paths import ROOT

_COMPILED = re.compile(r"^compiled +(.+)$", re.MULTILINE)


def times_of_changed_limits(work: Path, environment: dict[str, str]) -> Iterator[tuple[str, Seconds, str]]:
    """Yield what changed, the median of two builds after it, and what `build` says of the objects."""
    work.mkdir(parents=True)
    without_store = {**environment, "MICROROS_GEN_OBJECTS": "off"}
    for index, (what, change) in enumerate(CHANGES.items()):
        config, out = work / f"{index}.yaml", work / str(index)
        command = tool(
            *("build", "-c", str(config), "-o", str(out)),
            *("--interface-path", str(ROOT / "microros_gen" / "idl")),
        )
        config.write_text(change.before)
        timed(command, without_store, 1)
        times = []
        for text in (change.after, change.before):
            config.write_text(text)
            times.append(timed(command, without_store, 1))
        config.write_text(change.after)
        built = subprocess.run(command, env=without_store, capture_output=True, text=True, check=True)
        match = _COMPILED.search(built.stdout)
        yield what, median(times), match[1] if match else "nothing"
