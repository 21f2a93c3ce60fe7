# SPDX-License-Identifier: Apache-2.0
"""Part of `make golden`: records the exchange of each application of the corpus again."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.support.exchanges.recorded import GOLDEN, exchanges, files, recorded


def main() -> int:
    """Rewrite the recordings; remove those of applications that are gone."""
    GOLDEN.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        wanted = files(exchanges(Path(folder)))
    for name, text in wanted.items():
        (GOLDEN / name).write_text(text, encoding="utf-8", newline="\n")
    for path in GOLDEN.glob("*.txt"):
        if path.name not in wanted:
            path.unlink()
    print(f"{GOLDEN}: {len(recorded())} exchanges, {len(wanted)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
