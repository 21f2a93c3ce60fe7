# SPDX-License-Identifier: Apache-2.0
"""`make misra`: counts per rule and file from cppcheck's MISRA addon, and the table of docs/verification/quality.md.

With files of components or templates of types, it prints the findings in these alone and writes nothing.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from tests.support.quality import misra, misra_files
from tests.support.quality.corpus import make_trees, units


def check_corpus(folder: Path) -> int:
    """Write the page; 1 when a finding has no deviation, or a deviation no finding."""
    trees = make_trees(folder)
    places = misra.check(trees, units(trees))
    print(misra.by_rule_and_file(places), end="")
    deviations = misra.load_deviations()
    misra.write_page(misra.table(deviations))
    open_points = [f"no deviation: {line}" for line in misra.undocumented(places, deviations)]
    open_points += [f"no finding: {line}" for line in misra.unused(places, deviations)]
    print("\n".join(open_points))
    return 1 if open_points else 0


def check_files(paths: Sequence[Path], folder: Path, number: int) -> int:
    """Print each finding in `paths` with its place; 1 when one has no deviation, 2 when a file is in no tree."""
    try:
        found = misra_files.findings(paths, folder, number)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    deviations = misra.load_deviations()
    is_open = False
    for rule, path, line, column in sorted(found, key=lambda f: (f[1:], misra.rule_key(f[0]))):
        has_none = bool(misra.undocumented(Counter([(rule, path)]), deviations))
        is_open = is_open or has_none
        print(f"{path}:{line}:{column}: rule {rule} ({'no deviation' if has_none else 'deviation'})")
    return int(is_open)


def main() -> int:
    """Check all, or the files that are named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, help="sources, headers or templates of components")
    parser.add_argument("--trees", type=int, default=misra_files.TREES, help="trees to read each file in")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return check_files(chosen.files, folder, chosen.trees) if chosen.files else check_corpus(folder)


if __name__ == "__main__":
    sys.exit(main())
