# SPDX-License-Identifier: Apache-2.0
"""Formatters, linters and types are part of the default run."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from microros_gen.cli.generate import plan, write
from microros_gen.cli.options import SelectionOptions
from microros_gen.sources.interfaces import shipped_folder

ROOT = Path(__file__).resolve().parents[2]
PYTHON_FOLDERS = ["microros_gen", "tests", "examples"]
SUPPRESSIONS = ROOT / "tests" / "house" / "cppcheck-suppressions.txt"

# With the pure sender these select every alternative file of the runtime, and types with every kind of field.
APPLICATIONS = {
    "pure_sender": "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n",
    "declared": """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort}}
      - {topic: diagnostics, type: diagnostic_msgs/msg/DiagnosticArray}
limits: {"*": {string: 16, sequence: 4}}
liveliness: acknack
on_full: drop_oldest
errors: code
memory: {arena: 1024}
session: {key: device}
""",
    "blocking": "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\non_full: block 20 ms\n",
}


def run(*command: str) -> None:
    result = subprocess.run(command, cwd=ROOT, text=True, capture_output=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def c_files() -> list[str]:
    folder = ROOT / "microros_gen" / "components"
    return [str(p.relative_to(ROOT)) for p in sorted(folder.rglob("*.[ch]"))]


def test_ruff_check() -> None:
    run(sys.executable, "-m", "ruff", "check", *PYTHON_FOLDERS)


def test_ruff_format() -> None:
    run(sys.executable, "-m", "ruff", "format", "--check", *PYTHON_FOLDERS)


def test_mypy_strict() -> None:
    run(sys.executable, "-m", "mypy", "-p", "microros_gen")


def test_clang_format() -> None:
    run("clang-format", "--dry-run", "--Werror", *c_files())


@pytest.fixture(scope="module")
def trees(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The output folder of each application."""
    found = []
    for name, text in APPLICATIONS.items():
        folder = tmp_path_factory.mktemp(name)
        (folder / "microros.yaml").write_text(text)
        options = SelectionOptions(folder / "microros.yaml", (), (), (shipped_folder(),), None, None)
        planned, out = plan(options, folder / "out")
        write(planned, out)
        found.append(out)
    return found


def sources_once(trees: list[Path]) -> dict[Path, list[str]]:
    """The C files of each tree that no tree before it has, relative to the tree."""
    seen: set[str] = set()
    found = {}
    for tree in trees:
        names = sorted(p.relative_to(tree).as_posix() for p in tree.rglob("*.c"))
        found[tree] = [name for name in names if name not in seen]
        seen.update(names)
    return found


@pytest.mark.skipif(not shutil.which("clang-tidy"), reason="no clang-tidy")
def test_clang_tidy(trees: list[Path]) -> None:
    """What is off, and why, stands in .clang-tidy."""
    for tree, names in sources_once(trees).items():
        files = [str(tree / name) for name in names]
        configuration = f"--config-file={ROOT / '.clang-tidy'}"
        run("clang-tidy", "--quiet", configuration, *files, "--", "-std=c99", f"-I{tree / 'include'}")


@pytest.mark.skipif(not shutil.which("cppcheck"), reason="no cppcheck")
def test_cppcheck(trees: list[Path]) -> None:
    """What is suppressed, and why, stands in cppcheck-suppressions.txt."""
    for tree in trees:
        checks = ["--enable=warning,style,performance,portability", "--inline-suppr", "--error-exitcode=1"]
        suppressed = f"--suppressions-list={SUPPRESSIONS}"
        folders = [str(tree / "src"), str(tree / "examples")]
        run("cppcheck", "-q", "--std=c99", *checks, suppressed, f"-I{tree / 'include'}", *folders)


def test_each_suppression_has_its_reason() -> None:
    previous = ""
    for line in SUPPRESSIONS.read_text(encoding="utf-8").splitlines():
        assert not line or line.startswith("#") or previous, f"{line}: no reason above it"
        previous = line


@pytest.mark.parametrize("folder", ["microros_gen", "profiles", "tests", "examples"])
def test_every_source_carries_the_licence(folder: str) -> None:
    endings = {".py", ".c", ".h", ".yaml", ".lark", ".cmake"}
    for path in sorted((ROOT / folder).rglob("*")):
        golden = "golden" in path.parts or "corpus" in path.parts
        if path.suffix in endings and path.is_file() and not golden:
            head = path.read_text(encoding="utf-8").splitlines()[:3]
            assert any("SPDX-License-Identifier: Apache-2.0" in line for line in head), path
