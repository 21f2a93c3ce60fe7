# SPDX-License-Identifier: Apache-2.0
"""Targets of libFuzzer: C files of c/ with a rendered runtime, under sanitizers, over the corpus that is kept.

`python -m tests.support.runtime.fuzzing [SECONDS]` fuzzes each target for so long and keeps of old and new inputs
the fewest that reach the same code.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan
from tests.support.paths import TESTS
from tests.support.plans import POOL, READER, changed
from tests.support.runtime.harness import Tree, build, components, render

CORPUS = TESTS / "runtime" / "corpus"
SECONDS = int(os.environ.get("MICROROS_FUZZ_SECONDS", "600"))
INSTRUMENTED = ("-fsanitize=fuzzer-no-link,address,undefined", "-fno-sanitize-recover=all")
COMPILE = ("-g", "-O1", *INSTRUMENTED)
QUICK = ("-g0", "-O0", *INSTRUMENTED)
"""For a few thousand inputs: optimizing would take longer than running them."""
LINK = ("-fsanitize=fuzzer,address,undefined",)


@dataclass(frozen=True)
class Target:
    """One target: its C files, the plan of the runtime and which of the runtime's files it has (empty: all)."""

    name: str
    fixtures: tuple[str, ...]
    plan: RuntimePlan
    sources: tuple[str, ...] = ()
    longest: int = 600


FRAMING = Target(
    "framing",
    ("fuzz_framing.c",),
    changed(POOL, transport__kind="serial"),
    ("xrce_framing.c", "xrce_framing_send.c"),
)
SESSION = Target(
    "session",
    ("fuzz_session.c", "port_agent.c", "types_read.c"),
    changed(
        READER,
        streams__mtu=128,
        input__queues=(QueuePlan(3, 16), QueuePlan(2, 100)),
        input__arrives_in_fragments=True,
        input__reliable_slots=3,
        session__has_time_sync=True,
        session__has_state=True,
        session__hard_liveliness_ms=10_000,
    ),
    longest=1500,
)
TARGETS = (FRAMING, SESSION)


def fuzzer(target: Target, folder: Path, flags: Sequence[str] = COMPILE) -> Path:
    """Compile `target`; its objects are cached by their content."""
    names = [name for name in components(target.plan) if name != "port_posix"]
    tree = render(folder / target.name, target.plan, names)
    chosen = tuple(s for s in tree.sources if not target.sources or s.name in target.sources)
    return build(
        Tree(tree.folder, chosen), target.fixtures, f"fuzz_{target.name}", "clang", flags, link_flags=LINK
    )


def fuzz(program: Path, target: Target, *corpora: Path, options: Sequence[str]) -> str:
    """Run over `corpora`, the first of which takes what is found; return what libFuzzer said. Raises on a finding."""
    environment = {k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}
    # No limit of its resident memory: Linux counts that of pytest, which started it, as its own peak.
    limits = (f"-max_len={target.longest}", "-timeout=30", "-rss_limit_mb=0")
    command = [str(program), *limits, *options, *map(str, corpora)]
    done = subprocess.run(
        command, cwd=corpora[0], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr[-6000:]
    return done.stderr


def minimize(target: Target, folder: Path, seconds: int) -> None:
    """Fuzz for `seconds`, then write the smallest corpus that reaches as much."""
    program = fuzzer(target, folder)
    found, least = folder / f"{target.name}_found", folder / f"{target.name}_least"
    for place in (found, least):
        place.mkdir()
    kept = CORPUS / target.name
    fuzz(program, target, found, kept, options=("-reduce_inputs=1", f"-max_total_time={seconds}"))
    fuzz(program, target, least, found, kept, options=("-merge=1", "-reduce_inputs=1"))
    shutil.rmtree(kept)
    shutil.copytree(least, kept)


def main() -> int:
    """Minimize every target."""
    seconds = int(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    with tempfile.TemporaryDirectory() as folder:
        for target in TARGETS:
            minimize(target, Path(folder), seconds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
