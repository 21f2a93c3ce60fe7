# SPDX-License-Identifier: Apache-2.0
"""The wheel, and environments that have it."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from tests.support.environments import clean_environ, install, with_dependencies
from tests.support.paths import ROOT

# What the wheel is made from, and what a fresh clone has; folders that git does not know are not in it.
SOURCES = ("pyproject.toml", "hatch_build.py", "README.md", "LICENSE", "microros_gen", "profiles", "cmake")


@dataclass(frozen=True)
class Installed:
    """The wheel, and an environment that has it."""

    wheel: Path
    program: Path

    def run(self, *arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
        command = [str(self.program), *arguments]
        environment = clean_environ(XDG_CACHE_HOME=str(folder / "cache"))
        return subprocess.run(
            command, cwd=folder, env=environment, text=True, capture_output=True, check=False
        )


def copy_of_sources(folder: Path) -> None:
    """Make `folder` and copy what the wheel is made from into it."""
    folder.mkdir()
    for name in SOURCES:
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(path, folder / name)


def install_wheel(base: Path) -> Installed:
    """Build the wheel in a copy of what it is made from, and install it into an environment below `base`."""
    source = base / "clone"
    copy_of_sources(source)
    wheel = [sys.executable, "-m", "pip", "wheel", "-q", "--disable-pip-version-check", "--no-deps"]
    result = subprocess.run(
        [*wheel, "-w", str(base), str(source)], text=True, capture_output=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    (path,) = base.glob("microros_gen-*.whl")
    shutil.rmtree(source)
    environment_with_dependencies(base / "environment")
    install_file(base / "environment", path)
    return Installed(path, base / "environment" / "bin" / "microros-gen")


def install_file(environment: Path, wheel: Path) -> None:
    """Install a wheel, and nothing that it needs."""
    subprocess.run(install(environment, ["--no-deps", str(wheel)]), env=clean_environ(), check=True)


def environment_with_dependencies(folder: Path) -> None:
    """Make an environment that sees the packages of the kept one with the dependencies, and nothing else."""
    kept = with_dependencies(sys.executable, sys.version_info[:2])
    where = "import sysconfig; print(sysconfig.get_path('purelib'))"
    packages = subprocess.run([str(kept), "-c", where], text=True, capture_output=True, check=True).stdout
    subprocess.run(
        [sys.executable, "-m", "venv", "--without-pip", str(folder)], env=clean_environ(), check=True
    )
    (own,) = folder.glob("lib/python3*/site-packages")
    (own / "dependencies.pth").write_text(packages)
