# SPDX-License-Identifier: Apache-2.0
"""No module of the package is longer than one can keep in mind."""

from __future__ import annotations

from pathlib import Path

import microros_gen

PACKAGE = Path(microros_gen.__file__).parent
MOST_LINES = 400


def long_modules(package: Path) -> dict[str, int]:
    """Return the modules with more than MOST_LINES lines, and how many each has."""
    counts = {
        path.relative_to(package).as_posix(): len(path.read_text(encoding="utf-8").splitlines())
        for path in package.rglob("*.py")
    }
    assert counts, "no module was found"
    return {name: count for name, count in counts.items() if count > MOST_LINES}


def test_no_module_has_more_lines() -> None:
    assert long_modules(PACKAGE) == {}


def test_a_long_one_is_found(tmp_path: Path) -> None:
    (tmp_path / "fits.py").write_text("x = 1\n" * MOST_LINES)
    (tmp_path / "long.py").write_text("x = 1\n" * (MOST_LINES + 1))
    assert long_modules(tmp_path) == {"long.py": MOST_LINES + 1}
