# SPDX-License-Identifier: Apache-2.0
"""No module of the package, and no class of a plan, is larger than one can keep in mind."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import microros_gen

PACKAGE = Path(microros_gen.__file__).parent
MOST_LINES = 400
MOST_FIELDS = 25
PLANS = ("client/plan/*.py", "typesupport/plan/*.py", "components/*/plan.py")


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


def large_classes(text: str) -> Iterator[tuple[str, int]]:
    """Yield the classes with more than MOST_FIELDS fields, and how many each has."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ClassDef):
            count = sum(isinstance(statement, ast.AnnAssign) for statement in node.body)
            if count > MOST_FIELDS:
                yield node.name, count


def test_no_class_of_a_plan_has_more_fields() -> None:
    modules = [path for plan in PLANS for path in PACKAGE.glob(plan)]
    assert len(modules) > 30
    assert [found for path in modules for found in large_classes(path.read_text(encoding="utf-8"))] == []


def test_a_large_class_is_found() -> None:
    fields = "".join(f"    x{i}: int\n" for i in range(MOST_FIELDS + 1))
    assert list(large_classes(f"class Large:\n{fields}class Small:\n    x: int\n")) == [
        ("Large", MOST_FIELDS + 1)
    ]
