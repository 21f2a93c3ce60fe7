# SPDX-License-Identifier: Apache-2.0
"""A ROS 2 from PyPI that builds colcon workspaces, kept between runs; and how to run commands in it."""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from tests.support.environments import ENVIRONMENTS, clean_environ, dependencies
from tests.support.paths import ROOT, TESTS
from tests.support.patience import seconds

WORKSPACE = TESTS / "workspace" / "colcon"
PAGE = ROOT / "docs" / "howto" / "ros_build.md"
SETUP, *COMMANDS = re.findall(
    r"^```sh\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
)
"""What makes the environment, and what is done in it, as the page says."""


def ros_environment() -> Path:
    """Return the folder of the virtual environment that the commands of the page make, kept between runs.

    Raises OSError where they fail: there is no network, or no wheel for this Python.
    """
    key = hashlib.sha256(f"{sys.executable} {SETUP} {dependencies()}".encode()).hexdigest()[:8]
    home = ENVIRONMENTS / f"ros-build-{key}"
    home.mkdir(parents=True, exist_ok=True)
    with (home / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (home / "done").is_file():
            _make(home)
            (home / "done").touch()
    return home / "ros"


def _make(home: Path) -> None:
    shutil.rmtree(home / "ros", ignore_errors=True)
    (home / "microros_gen").unlink(missing_ok=True)
    (home / "microros_gen").symlink_to(ROOT)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["sh", "-ec", SETUP],
        cwd=home,
        env=clean_environ(PATH=path),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise OSError(f"{done.stdout[-2000:]}{done.stderr[-4000:]}")


def environ(folder: Path, cache: Path) -> dict[str, str]:
    """Return the environment of a shell in which `folder` is active and is the underlay, as the page leaves it."""
    path = os.pathsep.join([str(folder / "bin"), os.environ["PATH"]])
    return clean_environ(PATH=path, AMENT_PREFIX_PATH=str(folder), XDG_CACHE_HOME=str(cache))


def shell(folder: Path, environment: Mapping[str, str], script: str) -> subprocess.CompletedProcess[str]:
    """Run a script of the shell in a folder."""
    return subprocess.run(
        ["sh", "-c", script],
        cwd=folder,
        env=environment,
        text=True,
        capture_output=True,
        timeout=seconds(600),
        check=False,
    )


def clone(folder: Path) -> Path:
    """Return a folder that looks like a fresh clone of this repository."""
    folder.mkdir(parents=True)
    for name in (
        "cmake",
        "docs",
        "examples",
        "microros_gen",
        "profiles",
        "tests",
        "CMakeLists.txt",
        "colcon.pkg",
    ):
        (folder / name).symlink_to(ROOT / name)
    return folder
