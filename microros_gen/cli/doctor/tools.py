# SPDX-License-Identifier: Apache-2.0
"""Tool chains and emulators of targets, and CMake."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from microros_gen.cli.doctor.finding import Finding, State, install
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.platform.find import read_target
from microros_gen.platform.target import Target
from microros_gen.toolchain.toolchain import Toolchain, find_toolchain

CMAKE = (3, 16)
"""The oldest version, as the CMakeLists.txt that `init` writes says."""

_SHOWN = 3
_PROGRAM = "#include <stdint.h>\n#include <string.h>\nint main(void) { return 0; }\n"


def read_targets(names: Sequence[str]) -> tuple[Target, ...]:
    """Return the targets with these names. Raises UserError where one is faulty."""
    diagnostics = Diagnostics()
    found = [read_target(name, Path(), None, diagnostics) for name in names]
    diagnostics.check()
    return tuple(f.target for f in found if f is not None)


def target_findings(targets: Sequence[Target], environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield a finding for each tool chain and emulator that `targets` name, with all targets that need it."""
    chains: dict[tuple[object, ...], list[Target]] = {}
    emulators: dict[tuple[str, str], list[str]] = {}
    for target in targets:
        chains.setdefault((target.compilers, target.archivers, target.package), []).append(target)
        if target.emulator is not None:
            key = (target.emulator.program, target.emulator.package)
            emulators.setdefault(key, []).append(target.name)
    for same in chains.values():
        yield _chain(same, environ)
    for (program, package), names in emulators.items():
        yield program_finding(program, (package,), f"run for {listed(names)}", environ)


def program_finding(
    name: str, packages: Sequence[str], needed_for: str, environ: Mapping[str, str]
) -> Finding:
    """Return whether the program `name` is on the PATH of `environ`; `packages` are Debian's."""
    path = shutil.which(name, path=environ.get("PATH"))
    if path is None:
        return Finding(name, State.MISSING, needed_for, remedy=install(packages))
    return Finding(name, State.OK, needed_for, path)


def cmake_findings(needed_for: str, environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield findings for CMake and for a program that it drives."""
    found = program_finding("cmake", ("cmake",), needed_for, environ)
    version = _version((found.detail, "--version")) if found.state is State.OK else None
    if version is not None and version < CMAKE:
        wanted, is_there = (".".join(map(str, v)) for v in (CMAKE, version))
        remedy = f"install CMake {wanted} or newer: pip install cmake"
        found = Finding(
            "cmake", State.BROKEN, needed_for, f"{found.detail} has the version {is_there}", remedy
        )
    yield found
    drivers = [name for name in ("ninja", "make") if shutil.which(name, path=environ.get("PATH"))]
    if drivers:
        path = shutil.which(drivers[0], path=environ.get("PATH")) or ""
        yield Finding("ninja or make", State.OK, needed_for, path)
    else:
        yield Finding("ninja or make", State.MISSING, needed_for, remedy=install(("ninja-build",)))


def listed(names: Sequence[str]) -> str:
    """Return names in words, of a long list the first ones."""
    shown = names if len(names) <= _SHOWN + 1 else names[:_SHOWN]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")


def _chain(targets: Sequence[Target], environ: Mapping[str, str]) -> Finding:
    first = targets[0]
    name, needed_for = first.compilers[0], f"build for {listed([t.name for t in targets])}"
    packages = first.package.split()
    try:
        tools = {target.name: find_toolchain(target, environ) for target in targets}
    except UserError:
        return Finding(name, State.MISSING, needed_for, remedy=install(packages))
    for target in targets:
        reason = _refusal(target, tools[target.name], environ)
        if reason:
            detail = f"{tools[target.name].compiler}: {reason}"
            return Finding(name, State.BROKEN, needed_for, detail, install(packages))
    return Finding(name, State.OK, needed_for, tools[first.name].compiler)


def _refusal(target: Target, tools: Toolchain, environ: Mapping[str, str]) -> str:
    """Return the first error of the compiler on a small program; empty: it finds its headers (a host: links)."""
    step = ["-o", "/dev/null"] if target.hosted else ["-E", "-o", "/dev/null"]
    command = [tools.compiler, *tools.c_flags, *tools.link_flags, "-x", "c", "-", *step]
    done = subprocess.run(
        command, input=_PROGRAM, env=dict(environ), text=True, capture_output=True, check=False
    )
    if done.returncode == 0:
        return ""
    lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
    return next((line for line in lines if "error" in line), lines[-1]).strip()


def _version(command: Sequence[str]) -> tuple[int, ...] | None:
    done = subprocess.run(list(command), text=True, capture_output=True, check=False)
    match = re.search(r"(\d+)\.(\d+)", done.stdout)
    return (int(match[1]), int(match[2])) if match else None
