# SPDX-License-Identifier: Apache-2.0
"""`make test`: the suite but its long runs and `make lint`, side by side: one process more than there are cores."""

from __future__ import annotations

import os
import subprocess
import sys

from tests.support.paths import ROOT


def main() -> int:
    """Run pytest; its exit status is ours."""
    workers = str(1 + max(1, os.cpu_count() or 1))  # many tests wait for an agent most of the time
    command = [sys.executable, "-m", "pytest", "-n", workers, "--dist", "worksteal", "-q", "--durations=10"]
    command += ["-m", "not long and not lint", *sys.argv[1:]]
    return subprocess.run(command, cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
