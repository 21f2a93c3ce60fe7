# SPDX-License-Identifier: Apache-2.0
"""The layout of tests/: a folder for each package, helpers in support/, no test module imports another."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import microros_gen
from tests.support.paths import ROOT, TESTS

PACKAGE = Path(microros_gen.__file__).parent
OWN = {
    "bench": "`make bench`, a program",
    "docs": "what the pages say",
    "e2e": "from the command line to ROS 2",
    "exchanges": "recorded bytes on the wire",
    "firmware": "images for boards, in QEMU",
    "golden": "`make golden` writes it",
    "proof": "`make proof`, a program",
    "quality": "analyzers, layers, this file",
    "runtime": "the C components",
    "support": "helpers",
    "tools": "programs of the Makefile",
    "workspace": "a user's CMake project, colcon workspace, CI and environment",
}
"""Folders of tests/ that mirror no package."""


def packages(folder: Path) -> set[str]:
    return {path.relative_to(folder).parts[0] for path in folder.rglob("*.py") if path.parent != folder}


_IMPORT = re.compile(r"^[^\n#]*\b(?:from|import)\b(?:[^\n(]*\([^)]*\)|(?:\\\n|[^\n])*)", re.MULTILINE)
_MAYBE_WRONG = re.compile(r"\bfrom\s*\.|\btest_|\bconftest\b")


def imported(path: Path) -> Iterator[tuple[int, str]]:
    """Return line and module of each import; of `from a import b` both a and a.b.

    Only a module where an import may be wrong is parsed, which takes most of the time.
    """
    text = path.read_text(encoding="utf-8")
    if not any(_MAYBE_WRONG.search(statement) for statement in _IMPORT.findall(text)):
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            yield node.lineno, module
            yield from ((node.lineno, f"{module}.{alias.name}") for alias in node.names)


def wrong_imports(tests: Path) -> list[str]:
    """Return each import of a test module, of a conftest or of a test's function, and each relative one."""
    found = set()
    for path in sorted(tests.rglob("*.py")):
        for line, module in imported(path):
            parts = module.split(".")
            is_test = parts[0] == "tests" and any(
                part.startswith("test_") or part == "conftest" for part in parts
            )
            if is_test or module.startswith("."):
                found.add(f"{path.relative_to(tests)}:{line}")
    return sorted(found)


def test_every_package_has_its_tests() -> None:
    missing = {name for name in packages(PACKAGE) if not list((TESTS / name).glob("test_*.py"))}
    assert missing == set()


def test_every_folder_mirrors_a_package_or_has_a_reason() -> None:
    assert packages(TESTS) <= packages(PACKAGE) | OWN.keys()
    assert {name for name in OWN if not (TESTS / name).is_dir()} == set()


def test_no_test_module_imports_another() -> None:
    assert wrong_imports(TESTS) == []


def test_support_has_no_tests() -> None:
    assert list((TESTS / "support").rglob("test_*.py")) == []


def test_nothing_but_this_repository_is_put_into_the_path() -> None:
    """Helpers are modules of the package `tests`; pyproject.toml adds docs/, as mkdocs does."""
    changes = [
        str(path.relative_to(TESTS))
        for path in sorted(TESTS.rglob("*.py"))
        if "sys.path" in (text := path.read_text(encoding="utf-8"))
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("sys.path.")
    ]
    assert changes == []


def test_no_folder_is_left_out_by_tools() -> None:
    """Linters, pytest and code browsers leave out folders of this name."""
    folders = (PACKAGE, TESTS, *(ROOT / name for name in ("cmake", "docs", "examples", "profiles")))
    named = [path for folder in folders for path in folder.rglob("build") if path.is_dir()]
    assert named == []


def test_the_check_finds_wrong_imports(tmp_path: Path) -> None:
    (tmp_path / "agent").mkdir()
    for name, text in (
        ("test_a.py", "from tests.agent.test_b import x\n"),
        ("test_b.py", "from tests.agent import test_a\n"),
        ("test_c.py", "from tests.agent.conftest import x\n"),
        ("test_d.py", "from . import x\n"),
        ("test_e.py", "import os\nfrom tests.support.agent.fakes import x\n"),
    ):
        (tmp_path / "agent" / name).write_text(text)
    assert wrong_imports(tmp_path) == [f"agent/test_{name}.py:1" for name in "abcd"]
