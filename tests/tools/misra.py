# SPDX-License-Identifier: Apache-2.0
"""`make misra`: counts per rule and file from cppcheck's MISRA addon, and the table of docs/verification/quality.md."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from tests.support.quality import misra
from tests.support.quality.corpus import make_trees, units


def main() -> int:
    """Write the page; 1 when a finding has no deviation, or a deviation no finding. There are no arguments."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    with tempfile.TemporaryDirectory() as folder:
        trees = make_trees(Path(folder))
        places = misra.check(trees, units(trees))
    print(misra.by_rule_and_file(places), end="")
    deviations = misra.load_deviations()
    misra.write_page(misra.table(deviations))
    open_points = [f"no deviation: {line}" for line in misra.undocumented(places, deviations)]
    open_points += [f"no finding: {line}" for line in misra.unused(places, deviations)]
    print("\n".join(open_points))
    return 1 if open_points else 0


if __name__ == "__main__":
    sys.exit(main())
