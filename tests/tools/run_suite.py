# SPDX-License-Identifier: Apache-2.0
"""`make test`, `quick`, `system`, `check`, `lint`: which tests each of them runs, side by side.

python -m tests.tools.run_suite [test | quick | system | check | lint] [options of pytest]
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tests.support.examples import EXAMPLES
from tests.support.paths import ROOT, TESTS
from tests.support.runtime.harness import EVERYWHERE
from tests.tools.concerned import changed, concerned, imports

# Units in Python: of these, a developer runs after each change those that it concerns.
UNITS = (
    *("diagnostics", "documents", "interfaces", "application", "selection", "typesupport", "platform"),
    *(
        "client",
        "output",
        "toolchain",
        "image",
        "compiler",
        "migrate",
        "modes",
        "agent",
        "cli",
        "ros",
        "quality",
    ),
)


@dataclass(frozen=True)
class Run:
    """What pytest is told: the expression of markers, folders below tests/ (none: all), processes beyond the cores."""

    markers: str
    folders: tuple[str, ...] = ()
    more_processes: int = 2
    of_change: bool = False
    """Of the folders, those that the change in the working tree concerns."""
    environment: Mapping[str, str] = field(default_factory=dict)
    without: tuple[str, ...] = ()
    """Folders below tests/ that this run leaves out: another has them."""
    again: int = 0
    """Up to so many failed tests run once more, alone; what fails alone has failed."""


DEFAULT = "not long and not lint and not system and not variant"
SANITIZED = ("runtime", "components", "e2e")
"""Folders whose programs `make test` compiles without sanitizers."""
HANGS_S = 1800
"""A test that takes longer hangs, even on a machine with much other work (tests/support/patience.py)."""
PYTEST = (
    *(sys.executable, "-m", "pytest", "-q"),
    # It fails with the stacks of all threads; pytest goes on in another process.
    *("-o", f"faulthandler_timeout={HANGS_S}", "-o", "faulthandler_exit_on_timeout=true"),
)
TESTS_FAILED = 1
"""pytest's exit status: all tests ran, some failed."""
EVERYTHING = {EXAMPLES: "all", EVERYWHERE: "all"}
RUNS: Mapping[str, tuple[Run, ...]] = {
    "test": (Run(DEFAULT),),
    "quick": (Run(f"{DEFAULT} and not ros and not builds", UNITS, 0, True, {EXAMPLES: "few"}),),
    "system": (
        Run(
            "(system or variant or hypothesis or examples) and not long and not lint",
            without=SANITIZED,
            environment=EVERYTHING,
        ),
        Run("not long and not lint", SANITIZED, environment=EVERYTHING),
    ),
    # Each test of `test` and `system` once, compiled as in `test`. All sanitizers, examples and variants take too long
    # for CI.
    # Beside emulators, DDS and agents of other tests, on a slow machine, a test can fail that is right.
    # Half of their time is waiting, for agents and DDS: more of them at once.
    "check": (Run("not long and not lint and not variant", more_processes=4, again=15),),
    "lint": (Run("lint and not long", more_processes=1),),
}


def command(run: Run, options: Sequence[str]) -> list[str]:
    """Return the call of pytest: two processes more than there are cores where tests wait for an agent or for DDS."""
    workers = str(max(1, os.cpu_count() or 1) + run.more_processes)
    call = [*PYTEST, "-n", workers, "--dist", "worksteal", "--durations=10"]
    chosen = run.folders
    if run.of_change and (paths := changed()):
        chosen = concerned(paths, imports(), run.folders)
        print(f"{len(paths)} files changed: unit tests of {', '.join(chosen)}", flush=True)
    folders = [f"tests/{folder}" for folder in chosen if (TESTS / folder).is_dir()]
    ignored = [f"--ignore=tests/{folder}" for folder in run.without]
    return [*call, "-m", run.markers, *folders, *ignored, *options]


def compile_tests() -> None:
    """Let pytest compile the test modules of a fresh clone: each of its processes would compile all of them.

    That takes 13 s of processor time a process. One process for each core collects a share of the folders.
    """
    folders = sorted({path.parent for path in TESTS.glob("*/test_*.py")}, key=_bytes_of_tests, reverse=True)
    if any((folder / "__pycache__").is_dir() for folder in folders):
        return
    cores = os.cpu_count() or 1
    shares = [share for number in range(cores) if (share := folders[number::cores])]
    collect = [sys.executable, "-m", "pytest", "--collect-only", "-qq"]
    collecting = [
        subprocess.Popen(
            [*collect, *map(str, share)], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT
        )
        for share in shares
    ]
    for process in collecting:  # a module with an error is reported by the run
        process.wait()


def _bytes_of_tests(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.glob("test_*.py"))


def failed_tests(cache: Path) -> tuple[str, ...]:
    """Return the tests of pytest's cache that have failed, sorted."""
    path = cache / "v" / "cache" / "lastfailed"
    return tuple(sorted(json.loads(path.read_text(encoding="utf-8")))) if path.is_file() else ()


def carry_out(run: Run, options: Sequence[str], root: Path = ROOT) -> int:
    """Run pytest in `root`, and once more for a few tests that failed; return the status, say which passed alone."""
    environment = {**os.environ, **run.environment}

    def status_of(call: Sequence[str]) -> int:
        return subprocess.run(call, cwd=root, env=environment, check=False).returncode

    with tempfile.TemporaryDirectory() as folder:
        cache = ("-o", f"cache_dir={folder}")
        status = status_of([*command(run, options), *cache])
        failed = failed_tests(Path(folder))
        if status != TESTS_FAILED or not 0 < len(failed) <= run.again:
            return status
        print(f"{len(failed)} tests failed beside others. Alone:", flush=True)
        # By name: collecting all tests again takes minutes.
        status = status_of([*PYTEST, *failed, *cache])
        again = failed_tests(Path(folder))
    for name in failed:
        print(f"{'failed' if name in again else 'passed'} alone: {name}", flush=True)
    return status


def main(arguments: Sequence[str]) -> int:
    """Run pytest once or more; the first status that is no success is ours."""
    name, options = ("test", arguments)
    if arguments and arguments[0] in RUNS:
        name, options = arguments[0], arguments[1:]
    compile_tests()
    statuses = [carry_out(run, options) for run in RUNS[name]]
    return next((status for status in statuses if status), 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
