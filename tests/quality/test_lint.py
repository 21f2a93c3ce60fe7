# SPDX-License-Identifier: Apache-2.0
"""Formatters and linters are part of the default run, types of `make lint`."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.support.paths import ROOT

pytestmark = pytest.mark.builds

PYTHON_FOLDERS = ["microros_gen", "tests", "examples", "docs"]
SUPPRESSIONS = ROOT / "tests" / "quality" / "cppcheck-suppressions.txt"


def run(*command: str) -> None:
    result = subprocess.run(command, cwd=ROOT, text=True, capture_output=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def c_files() -> list[str]:
    folders = (ROOT / "microros_gen" / "components", ROOT / "examples")
    return [str(p.relative_to(ROOT)) for folder in folders for p in sorted(folder.rglob("*.[ch]"))]


def test_ruff_check() -> None:
    run(sys.executable, "-m", "ruff", "check", *PYTHON_FOLDERS)


def test_ruff_format() -> None:
    run(sys.executable, "-m", "ruff", "format", "--check", *PYTHON_FOLDERS)


@pytest.mark.lint
def test_mypy_strict() -> None:
    run(sys.executable, "-m", "mypy")


def test_clang_format() -> None:
    run("clang-format", "--dry-run", "--Werror", *c_files())


def test_each_suppression_has_its_reason() -> None:
    previous = ""
    for line in SUPPRESSIONS.read_text(encoding="utf-8").splitlines():
        assert not line or line.startswith("#") or previous, f"{line}: no reason above it"
        previous = line


@pytest.mark.parametrize("folder", ["microros_gen", "profiles", "tests", "examples", "cmake", "docs"])
def test_every_source_carries_the_licence(folder: str) -> None:
    endings = {".py", ".c", ".h", ".yaml", ".lark", ".cmake"}
    for path in sorted((ROOT / folder).rglob("*")):
        golden = "golden" in path.parts or "corpus" in path.parts
        if path.suffix in endings and path.is_file() and not golden:
            head = path.read_text(encoding="utf-8").splitlines()[:3]
            assert any("SPDX-License-Identifier: Apache-2.0" in line for line in head), path
