# SPDX-License-Identifier: Apache-2.0
"""ROS 2 for the agent, and for workspaces that colcon builds."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from importlib import metadata
from pathlib import Path

from microros_gen.cli.doctor.finding import Finding, State, install
from microros_gen.cli.doctor.tools import cmake_findings
from microros_gen.cli.doctor.wheels import faulty_files, fix_files

EXTRA = "colcon"
_WORKSPACES = "build colcon workspaces"
_GENERATORS = "share/rosidl_default_generators/package.xml"
_OWN = "share/ament_cmake_microros/package.xml"
_REQUIREMENT = re.compile(r"^([A-Za-z0-9._-]+)(?:==([0-9.]+))?.*; *extra == ['\"]" + EXTRA + "['\"]")
# In a separate process: rclpy with a wrong middleware may end it.
_LOADS = """\
import json
from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.loading import load_rclpy
try:
    load_rclpy()
except RosUnusableError as error:
    print(json.dumps([error.reason, error.hint]))
else:
    import rclpy
    print(json.dumps(rclpy.__file__))
"""


def agent_findings(environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield whether the agent, `run` and the servers can use ROS 2."""
    needed_for = "agent, run, servers, modes manage"
    done = subprocess.run(
        [sys.executable, "-c", _LOADS], env=dict(environ), text=True, capture_output=True, check=False
    )
    try:
        answer = json.loads(done.stdout.splitlines()[-1])
    except (ValueError, IndexError):
        reason = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        yield Finding("rclpy", State.BROKEN, needed_for, reason, "install ROS 2 Jazzy again")
        return
    if isinstance(answer, str):
        yield Finding("rclpy", State.OK, needed_for, answer)
    else:
        state = State.MISSING if "not installed" in answer[0] else State.BROKEN
        yield Finding("rclpy", state, needed_for, answer[0], answer[1].removeprefix("Run: "))


def colcon_findings(environ: Mapping[str, str], prefix: Path | None = None) -> Iterator[Finding]:
    """Yield what colcon needs: CMake, ROS 2 from an underlay or from pip, and this tool's ament packages.

    `prefix` is the Python environment, by default this one.
    """
    here = Path(sys.prefix) if prefix is None else prefix
    yield from cmake_findings("CMake projects, colcon", environ)
    underlays = [Path(p) for p in environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    sourced = next((p for p in underlays if p != here and (p / _GENERATORS).is_file()), None)
    if sourced is not None:
        yield Finding("ROS 2", State.OK, _WORKSPACES, str(sourced))
    else:
        yield from _wheels(here)
    yield _colcon(environ, here)
    yield _own_packages([*underlays, here])
    if sourced is None:
        yield from _underlay(underlays, here)


def _wheels(prefix: Path) -> Iterator[Finding]:
    missing = _missing_distributions()
    if missing is None:
        remedy = "install microros-gen by pip, from its clone or wheel"
        yield Finding("ROS 2", State.BROKEN, _WORKSPACES, "microros-gen is not installed by pip", remedy)
    elif missing:
        remedy = f"pip install {' '.join(missing)}"
        detail = f"{len(missing)} packages, or source a ROS 2 installation"
        yield Finding("ROS 2 wheels", State.MISSING, _WORKSPACES, detail, remedy)
    else:
        yield Finding("ROS 2 wheels", State.OK, _WORKSPACES, str(prefix))
    faulty = faulty_files(prefix)
    name = "CMake files of the wheels"
    if faulty:
        detail = f"{len(faulty)} name header folders that do not exist, such as {faulty[0].name}"
        remedy = f"microros-gen doctor {EXTRA} --fix"
        yield Finding(name, State.BROKEN, _WORKSPACES, detail, remedy, lambda: _fix(prefix))
    else:
        yield Finding(name, State.OK, _WORKSPACES)
    headers = Path(sysconfig.get_path("include")) / "Python.h"
    if headers.is_file():
        yield Finding("Python's headers", State.OK, _WORKSPACES, str(headers))
    else:
        remedy = install((f"python3.{sys.version_info.minor}-dev",))
        yield Finding("Python's headers", State.MISSING, _WORKSPACES, remedy=remedy)


def _fix(prefix: Path) -> None:
    fix_files(prefix)


def _missing_distributions() -> tuple[str, ...] | None:
    """Return the requirements of the extra that are not installed; None: this tool has no metadata."""
    try:
        requirements = metadata.requires("microros-gen") or []
    except metadata.PackageNotFoundError:
        return None
    matches = [m for m in map(_REQUIREMENT.match, requirements) if m]
    return tuple(m[1] + (f"=={m[2]}" if m[2] else "") for m in matches if not _is_installed(m[1], m[2]))


def _is_installed(name: str, version: str | None) -> bool:
    try:
        return version in (None, metadata.version(name))
    except metadata.PackageNotFoundError:
        return False


def _colcon(environ: Mapping[str, str], prefix: Path) -> Finding:
    path = shutil.which("colcon", path=environ.get("PATH"))
    if path is not None:
        return Finding("colcon", State.OK, _WORKSPACES, path)
    inside = prefix / "bin" / "colcon"
    if inside.is_file():
        return Finding(
            "colcon", State.BROKEN, _WORKSPACES, f"{inside} is not on the PATH", f". {prefix}/bin/activate"
        )
    return Finding("colcon", State.MISSING, _WORKSPACES, remedy="pip install colcon-common-extensions")


def _own_packages(prefixes: list[Path]) -> Finding:
    name = "ament_cmake_microros"
    found = next((p for p in prefixes if (p / _OWN).is_file()), None)
    if found is not None:
        return Finding(name, State.OK, _WORKSPACES, str(found))
    detail = "an editable installation does not have it"
    remedy = "pip install the clone or wheel of microros-gen, or build the clone with colcon in an underlay"
    return Finding(name, State.MISSING, _WORKSPACES, detail, remedy)


def _underlay(underlays: list[Path], prefix: Path) -> Iterator[Finding]:
    if prefix in underlays:
        yield Finding("AMENT_PREFIX_PATH", State.OK, _WORKSPACES, str(prefix))
    else:
        remedy = f'export AMENT_PREFIX_PATH="{prefix}"'
        detail = "does not contain this Python environment; set it in each shell"
        yield Finding("AMENT_PREFIX_PATH", State.MISSING, _WORKSPACES, detail, remedy)
