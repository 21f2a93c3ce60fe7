# SPDX-License-Identifier: Apache-2.0
"""What the build system of a package needs."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from microros_gen.cli.doctor.finding import Finding, State, install
from microros_gen.package.description import PackageDescription, Tool


def package_findings(package: PackageDescription, environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield a finding for each tool of a package."""
    for tool in package.tools:
        yield _finding(tool, f"build with the package {package.name}", environ)


def _finding(tool: Tool, needed_for: str, environ: Mapping[str, str]) -> Finding:
    remedy = install(tool.debian) if tool.debian else tool.remedy
    if tool.variable:
        folder = environ.get(tool.variable, "")
        if folder and not Path(folder).is_dir():
            return Finding(tool.variable, State.BROKEN, needed_for, f"{folder} is no folder", remedy)
        return Finding(tool.variable, State.OK if folder else State.MISSING, needed_for, folder, remedy)
    name, path = " or ".join(tool.programs), environ.get("PATH")
    found = [where for program in tool.programs if (where := shutil.which(program, path=path))]
    state = State.OK if found else State.MISSING
    return Finding(name, state, needed_for, found[0] if found else "", remedy)
