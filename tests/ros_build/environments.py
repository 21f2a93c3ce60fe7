# SPDX-License-Identifier: Apache-2.0
"""A ROS 2 from PyPI that builds colcon workspaces, kept between runs; and how to run commands in it."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from cli.environments import ENVIRONMENTS, ROOT, clean_environ, dependencies, new_environment

WORKSPACE = Path(__file__).resolve().parent / "workspace"
# What an interface package and colcon need; some of the wheels do not name all that they need themselves.
_ROS = (
    *("rosidl-default-generators", "rosidl-default-runtime", "rosidl-core-generators", "rosidl-core-runtime"),
    *(
        "ament-package",
        "ament-cmake",
        "ament-cmake-ros",
        "ament-cmake-gtest",
        "ament-cmake-gmock",
        "ament-cmake-pytest",
    ),
    *(
        "ament-cmake-include-directories",
        "ament-cmake-libraries",
        "python-cmake-module",
        "fastrtps-cmake-module",
    ),
)
REQUIREMENTS = [
    *(f"ros-jazzy-{name}" for name in _ROS),
    *("empy==3.3.4", "catkin_pkg", "numpy", "colcon-common-extensions"),
]
# Not by the scripts that pip wrote: the environment was made in another folder, and they name that.
_PROGRAMS = """\
colcon() { python -c 'import sys; from colcon_core.command import main; sys.exit(main())' "$@"; }
rosidl() { python -c 'import sys; from rosidl_cli.cli import main; sys.exit(main())' "$@"; }
"""


def ros_environment() -> Path:
    """Return the folder of a virtual environment with REQUIREMENTS and the tool's dependencies, made once.

    Raises OSError where it cannot be made: there is no network, or no wheel for this Python.
    """
    wanted = [*REQUIREMENTS, *dependencies()]
    key = hashlib.sha256(f"{sys.executable} {wanted}".encode()).hexdigest()[:8]
    folder = ENVIRONMENTS / f"ros-build-{key}"
    if not folder.is_dir():
        ENVIRONMENTS.mkdir(parents=True, exist_ok=True)
        fresh = ENVIRONMENTS / f".{folder.name}.{os.getpid()}"
        try:
            new_environment(sys.executable, fresh, wanted)
            _mend(fresh, folder)
            with suppress(OSError):  # another process was first
                fresh.rename(folder)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
    return folder


def _mend(fresh: Path, folder: Path) -> None:
    """Name this machine's folders of headers where the wheels name those of the machine that built them."""
    ask = "import sysconfig, numpy; print(sysconfig.get_path('include')); print(numpy.get_include())"
    said = subprocess.run(
        [fresh / "bin/python", "-c", ask], text=True, capture_output=True, check=True
    ).stdout
    python, numpy = said.replace(str(fresh), str(folder)).splitlines()
    for path in fresh.glob("share/*/cmake/*_pyExport.cmake"):
        text = path.read_text()
        text = re.sub(r'/opt/python/[^;"]*/numpy/[^;"]*', numpy, text)
        path.write_text(re.sub(r'/opt/python/[^;"]*/include/[^;"]*', python, text))


def environ(folder: Path, cache: Path) -> dict[str, str]:
    """Return the environment of a shell in which `folder` is active and is the underlay."""
    path = os.pathsep.join([str(folder / "bin"), os.environ["PATH"]])
    return clean_environ(PATH=path, AMENT_PREFIX_PATH=str(folder), XDG_CACHE_HOME=str(cache))


def shell(folder: Path, environment: Mapping[str, str], script: str) -> subprocess.CompletedProcess[str]:
    """Run a script of the shell in a folder; `colcon` and `rosidl` are those of the environment."""
    return subprocess.run(
        ["sh", "-c", f"{_PROGRAMS}{script}"],
        cwd=folder,
        env=environment,
        text=True,
        capture_output=True,
        timeout=600,
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
