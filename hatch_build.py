# SPDX-License-Identifier: Apache-2.0
"""Wheels whose agent has a compiled core: `MICROROS_GEN_COMPILED=1 pip install SOURCES`, with a C compiler.

mypyc translates the modules of CORE, as they are, into extension modules. They lie beside the sources in the wheel, and
Python prefers them. Without the variable, or in an editable installation, the wheel is the one for all machines.
"""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

VARIABLE = "MICROROS_GEN_COMPILED"
TOOLS = ["mypy[mypyc]>=1.17,<3"]
"""What a compiled core is built with, besides a C compiler and the headers of Python."""
FOLDER = "microros_gen_core_"
"""What the name of the temporary folder begins with."""
PACKAGE = "microros_gen/agent"
CORE = (
    "clients",
    "core",
    "cutting",
    "deliveries",
    "entities",
    "fairness",
    "graph_work",
    "history",
    "input_pool",
    "operations",
    "own_time",
    "processing",
    "rates",
    "reading",
    "ros/endpoints",
    "ros/requesters",
    "ros/services",
    "session",
    "streams_in",
    "streams_out",
    "transport/datagrams",
    "transport/udp",
    "turns",
    "wire/cdr",
    "wire/message",
    "workers/remote",
)
"""What runs for each message, and the classes that it shares."""
QUICK = f"{PACKAGE}/quick_calls"
"""The calls that are written in C."""
_CONFIGURATION = "[mypy]\nignore_missing_imports = True\ndisable_error_code = import-untyped\n"
# Run with the copy of the sources as the working directory: mypyc names modules by their paths.
_BUILD = """\
import sys
from mypyc.build import mypycify
from setuptools import Extension, setup
quick = sys.argv.pop(1)
extensions = mypycify(["--config-file", "mypy.ini", *sys.argv[1:]], opt_level="2", debug_level="0")
extensions.append(Extension(quick.replace("/", "."), [quick + ".c"]))
setup(name="core", packages=[], ext_modules=extensions, script_args=["-q", "build_ext", "--build-lib", "built"])
"""


class CompiledCore(BuildHookInterface[Any]):
    """The hook of hatchling, `custom` in pyproject.toml."""

    def dependencies(self) -> list[str]:
        """Return what the build needs in addition; also for an editable wheel, which cannot be told apart here."""
        return TOOLS if is_wanted(self.target_name) else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, and let hatchling pack what was built. Raises SystemExit if compiling fails."""
        if not is_wanted(self.target_name, version):
            return
        self._folder = Path(tempfile.mkdtemp(prefix=FOLDER))
        atexit.register(self._remove)  # `finalize` is not called if packing fails
        try:
            built = compile_core(Path(self.root), self._folder)
        except BaseException:
            self._remove()
            raise
        build_data["force_include"].update({str(path): name for name, path in built.items()})
        build_data["pure_python"], build_data["infer_tag"] = False, True

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove what was built."""
        if hasattr(self, "_folder"):
            self._remove()

    def _remove(self) -> None:
        shutil.rmtree(self._folder, ignore_errors=True)


def is_wanted(target: str, version: str = "standard") -> bool:
    """Return whether an artifact is to have a compiled core: a wheel that is not editable, if the user asks for it."""
    return target == "wheel" and version != "editable" and os.environ.get(VARIABLE, "") not in ("", "0")


def compile_core(root: Path, folder: Path) -> dict[str, Path]:
    """Compile the core of the sources below `root` in the existing `folder`; return the files by their places.

    Raises SystemExit with what the compiler says if it fails.
    """
    shutil.copytree(root / "microros_gen", folder / "microros_gen", ignore=_all_but_python)
    (folder / "mypy.ini").write_text(_CONFIGURATION, encoding="utf-8")
    modules = [f"{PACKAGE}/{name}.py" for name in CORE]
    done = subprocess.run(
        [sys.executable, "-c", _BUILD, QUICK, *modules],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise SystemExit(f"{VARIABLE}: the agent's core cannot be compiled:\n{done.stdout}{done.stderr}")
    built = folder / "built"
    return {path.relative_to(built).as_posix(): path for path in sorted(built.rglob("*")) if path.is_file()}


def _all_but_python(folder: str, names: list[str]) -> set[str]:
    """Return the files to leave out of the copy."""
    return {
        name
        for name in names
        if not name.endswith((".py", ".pyi", ".c")) and not (Path(folder) / name).is_dir()
    }
