# SPDX-License-Identifier: Apache-2.0
"""Finds the compiler of a target and runs it."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.platform.target import Target
from microros_gen.records import dataclass

# design, "The C side": clean under these with gcc and clang, 32 and 64 bit.
WARNINGS = (
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Werror",
)
LIBRARY_FLAGS = ("-ffunction-sections", "-fdata-sections")


@dataclass(frozen=True)
class Toolchain:
    """The programs of one target, as absolute paths, and the flags of every call.

    `archives`: the user has chosen the archiver, so that it makes the library and not this program.
    """

    compiler: str
    archiver: str
    c_flags: tuple[str, ...]
    link_flags: tuple[str, ...]
    libraries: tuple[str, ...]
    objcopy: str | None = None
    archives: bool = False


def find_toolchain(target: Target, environ: Mapping[str, str]) -> Toolchain:
    """Return the target's tool chain; for the host, CC, AR and CFLAGS of `environ` take precedence.

    Raises UserError that names the package to install if a program is missing.
    """
    is_host = target.name == "host"
    compilers = ((environ["CC"],) if is_host and environ.get("CC") else ()) or target.compilers
    chosen = environ.get("AR") if is_host else None
    archivers = (chosen,) if chosen else target.archivers
    extra = tuple(environ.get("CFLAGS", "").split()) if is_host else ()
    path = environ.get("PATH")
    compiler = _first_of(compilers, "a C compiler", target, path)
    archiver = _first_of(archivers, "an archiver", target, path)
    return Toolchain(
        compiler,
        archiver,
        (*target.c_flags, *LIBRARY_FLAGS, *extra),
        (*target.link_flags, *extra),
        target.libraries,
        None if target.hosted else sibling(archiver, "ar", "objcopy"),
        bool(chosen),
    )


def run(command: Sequence[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """Run `command` in `folder`; its output is text, with stderr joined to stdout."""
    return subprocess.run(
        list(command), cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
    )


def _first_of(names: Sequence[str], what: str, target: Target, path: str | None) -> str:
    for name in names:
        found = shutil.which(name, path=path)
        if found:
            return found
    raise UserError(
        [
            Diagnostic(
                f"target {target.name} needs {what} and none of {', '.join(names)} is on the PATH",
                hint=f"Install it (Debian, Ubuntu: apt-get install {target.package}), or generate without "
                "compiling: microros-gen generate",
                id="MG-8207",
            )
        ]
    )


def sibling(program: str, name: str, wanted: str) -> str | None:
    """Return the program `wanted` of the same tool chain: `arm-none-eabi-ar` → `arm-none-eabi-size`."""
    path = Path(program)
    stem = path.name.removesuffix(".exe")
    if not stem.endswith(name):
        return shutil.which(wanted)
    prefix = stem.removesuffix(name).removesuffix("gcc-").removesuffix("llvm-")
    return shutil.which(prefix + wanted, path=str(path.parent)) or shutil.which(prefix + wanted)
