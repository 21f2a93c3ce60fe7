# SPDX-License-Identifier: Apache-2.0
"""`make test`: the whole suite, side by side on every core."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    """Run pytest; its exit status is ours."""
    workers = str(max(2, os.cpu_count() or 1))
    command = [sys.executable, "-m", "pytest", "-n", workers, "--dist", "worksteal", "-q", "--durations=10"]
    command += ["-m", "not long", *sys.argv[1:]]
    return subprocess.run(command, cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
