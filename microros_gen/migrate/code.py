# SPDX-License-Identifier: Apache-2.0
"""Finds and reads the C and C++ sources of an application."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, Diagnostics, Source, UserError
from microros_gen.documents.files import read_bytes, read_text, reason_of

COMPILED = (".c", ".cc", ".cpp", ".cxx", ".ino")
"""What a compiler is given; .ino are sketches, which Arduino makes into C++."""

READ = (*COMPILED, ".h", ".hh", ".hpp")
"""What says something about the application."""

_INCLUDE = re.compile(r"(?m)^[ \t]*#[ \t]*include[ \t]*[\"<]([\w./+-]+)[\">]")
_LARGEST = 1 << 20
_MANIFEST = "manifest.json"  # in every folder that this tool wrote
_LIBRARY = "rclc/rclc.h"  # a copy of micro-ROS, with the headers of its packages around it
_LEFT_OUT = ("build", "install", "log", "managed_components", "node_modules")
_VENDOR = re.compile(r"CMSIS|STM32\w+_HAL_Driver|Third_Party")  # what STM32CubeMX puts next to an application
_SEPARATE = ("example", "examples", "test", "tests")  # programs of an application or of a library in it


def code_files(folder: Path) -> tuple[Path, ...]:
    """Return all C and C++ files below `folder`, or the file that it names, headers included, sorted."""
    return tuple(_paths(folder))


def code_folder(path: Path) -> Path:
    """Return the folder of the sources `path`, which may be a single file."""
    return path.parent if path.is_file() else path


def read_all(paths: Iterable[Path], diagnostics: Diagnostics) -> dict[Path, bytes]:
    """Return the files that can be read; errors for all others."""
    found: dict[Path, bytes] = {}
    for path in paths:
        try:
            found[path] = code_bytes(path)
        except UserError as error:
            diagnostics.extend(error.diagnostics)
    return found


def code_bytes(path: Path) -> bytes:
    """Return a file of the sources as it is. Raises UserError if it cannot be read or is too large."""
    try:
        return read_bytes(path, _LARGEST)
    except OSError as error:
        raise UserError([_unreadable(path, error)]) from error


def _unreadable(path: Path, error: OSError) -> Diagnostic:
    return Diagnostic(f"cannot read '{path}': {reason_of(error)}", id="MG-9004")


def c_sources(folder: Path) -> tuple[Path, ...]:
    """Return the files below `folder`, or the file that it names, that a compiler is given, sorted."""
    return tuple(path for path in _paths(folder) if path.suffix in COMPILED)


def include_folders(folder: Path) -> tuple[Path, ...]:
    """Return the folders in which a compiler finds what the sources below `folder` include, sorted.

    Those of the sources, and those at which the path of a header of theirs begins: `include` for
    `#include "arm/gains.h"` and the file include/arm/gains.h.
    """
    files = _paths(folder)
    found = {path.parent for path in files if path.suffix in COMPILED}
    headers = [path for path in files if path.suffix not in COMPILED]
    included = included_headers(folder)
    for path in headers:
        endings = {name for name in included if path.as_posix().endswith(f"/{name}")}
        found.update(path.parents[name.count("/")] for name in endings)
    return tuple(sorted(found))


def included_headers(folder: Path) -> tuple[str, ...]:
    """Return the names of the headers that the sources below `folder` include, sorted."""
    return tuple(sorted({name for path in _paths(folder) for name in _INCLUDE.findall(text_of(path))}))


def text_of(path: Path) -> str:
    """Return the text of a source; empty if it cannot be read, or is larger than programs are."""
    try:
        return read_text(path, errors="replace") if path.stat().st_size <= _LARGEST else ""
    except OSError:
        return ""


def read_code(folder: Path, diagnostics: Diagnostics) -> tuple[Source, ...]:
    """Return the texts of all sources and headers below `folder`, sorted by path; a file is taken too.

    Bytes that are no UTF-8 are replaced: only comments and strings have them. Errors where there is nothing to read.
    """
    if not folder.exists():
        diagnostics.error(
            f"folder '{folder}' not found", hint="Give the folder of the application's sources", id="MG-9003"
        )
        return ()
    found: list[Source] = []
    for path in _paths(folder):
        try:
            if path.stat().st_size <= _LARGEST:
                found.append(Source(str(path), read_text(path, errors="replace")))
        except OSError as error:
            diagnostics.add(_unreadable(path, error))
    if not found and not diagnostics.has_errors():
        hint = f"Files that are read end in {', '.join(READ)}"
        diagnostics.error(f"'{folder}' has no C or C++ sources", hint=hint, id="MG-9005")
    return tuple(found)


def _paths(folder: Path) -> list[Path]:
    if folder.is_file():
        return [folder]
    found = (path for path in folder.rglob("*") if path.suffix in READ and path.is_file())
    generated = {path.parent for path in folder.rglob(_MANIFEST)}
    generated |= {path.parents[1] for path in folder.rglob(_LIBRARY)} - {folder}
    kept = sorted(
        path
        for path in found
        if not _is_left_out(path.relative_to(folder)) and not generated.intersection(path.parents)
    )
    return [path for path in kept if not _is_separate(path.relative_to(folder))] or kept


def _is_separate(path: Path) -> bool:
    return any(part.lower() in _SEPARATE for part in path.parts[:-1])


def _is_left_out(path: Path) -> bool:
    return any(
        part.startswith(".") or part in _LEFT_OUT or _VENDOR.fullmatch(part) for part in path.parts[:-1]
    )
