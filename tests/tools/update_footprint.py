# SPDX-License-Identifier: Apache-2.0
"""`make footprint`: measures every image that has ceilings and writes tests/firmware/footprint.json."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.support.firmware.board import Builds
from tests.support.firmware.ceilings import FILE, update


def main() -> int:
    """Measure, write and say where."""
    with tempfile.TemporaryDirectory() as folder:
        update(Builds(Path(folder)))
    print(f"{FILE}: written; `git diff` shows what changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
