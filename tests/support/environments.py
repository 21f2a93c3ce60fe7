# SPDX-License-Identifier: Apache-2.0
"""Other Python interpreters, and virtual environments that have only what microros-gen needs."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from tests.support.paths import ROOT

OLDEST = (3, 10)
ENVIRONMENTS = ROOT / "build" / "test-environments"
_DEPENDENCIES = re.compile(r"^dependencies = \[(.*)\]$", re.MULTILINE)


def dependencies() -> list[str]:
    """Return the requirements of pyproject.toml (Python 3.10 has no reader of TOML)."""
    match = _DEPENDENCIES.search((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert match, "pyproject.toml lists its dependencies in one line"
    return re.findall(r'"([^"]+)"', match.group(1))


@cache
def interpreters() -> dict[tuple[int, int], str]:
    """Return one interpreter for each version from 3.10 that is on the PATH or that pyenv has."""
    found: dict[tuple[int, int], str] = {sys.version_info[:2]: sys.executable}
    for candidate in _candidates():
        query = "import sys, venv; print(*sys.version_info[:2], sys.implementation.name)"
        output = subprocess.run([candidate, "-c", query], capture_output=True, text=True, check=False)
        words = output.stdout.split()
        if output.returncode == 0 and words[2] == "cpython" and (int(words[0]), int(words[1])) >= OLDEST:
            found.setdefault((int(words[0]), int(words[1])), candidate)
    return dict(sorted(found.items()))


def _candidates() -> Iterator[str]:
    for minor in range(OLDEST[1], 20):
        name = shutil.which(f"python3.{minor}")
        if name and "shims" not in name:
            yield name
    for path in sorted(Path.home().glob(".pyenv/versions/3.*/bin/python")):
        if re.match(r"3\.\d{2}\.", path.parents[1].name):
            yield str(path)


def clean_environ(**more: str) -> dict[str, str]:
    """Return an environment without Python's, ROS's and the compiler's variables."""
    dropped = (
        "PYTHON",
        "VIRTUAL_ENV",
        "AMENT_",
        "COLCON_",
        "ROS_",
        "LD_LIBRARY_PATH",
        "CC",
        "AR",
        "CFLAGS",
        "LC_",
    )
    kept = {name: value for name, value in os.environ.items() if not name.startswith(dropped)}
    return kept | more


def new_environment(interpreter: str, folder: Path, requirements: list[str]) -> Path:
    """Make a virtual environment with `requirements` in `folder`; return its interpreter."""
    steps = ([interpreter, "-m", "venv", "--without-pip", str(folder)], install(folder, requirements))
    for step in steps:
        done = subprocess.run(step, env=clean_environ(), capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise OSError(f"{' '.join(step)}\n{done.stdout}{done.stderr}")
    return folder / "bin" / "python"


def install(folder: Path, requirements: list[str]) -> list[str]:
    """Return the command that installs `requirements` into the environment `folder`."""
    pip = [sys.executable, "-m", "pip", "--python", str(folder / "bin" / "python"), "install", "-q"]
    return [*pip, "--disable-pip-version-check", *requirements]


def with_dependencies(interpreter: str, version: tuple[int, int]) -> Path:
    """Return the interpreter of an environment with the dependencies, made once and kept below build/.

    Raises OSError where it cannot be made: there is no network, or no wheel for this Python.
    """
    key = hashlib.sha256(f"{interpreter} {dependencies()}".encode()).hexdigest()[:8]
    folder = ENVIRONMENTS / f"python{version[0]}.{version[1]}-{key}"
    if not folder.is_dir():
        ENVIRONMENTS.mkdir(parents=True, exist_ok=True)
        fresh = ENVIRONMENTS / f".{folder.name}.{os.getpid()}"
        try:
            new_environment(interpreter, fresh, dependencies())
            with suppress(OSError):  # another process was first
                fresh.rename(folder)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
    return folder / "bin" / "python"
