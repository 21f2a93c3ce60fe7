# SPDX-License-Identifier: Apache-2.0
"""Remembers the last run of a command, so that a run with nothing changed ends before anything is parsed.

A record lies in the user's cache folder, never in the output: it holds the state (size and times of change) of
everything that was read, the folders that were searched, the tool's own files, and of every file written. Any
difference, and any doubt, means a full run; so a run is not recorded when something that it read changed after
it had begun. Nothing is lost when the cache is.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

import microros_gen
from microros_gen.documents.files import read_json
from microros_gen.records import dataclass

# What decides besides files: where interfaces are searched, and of which distribution they are.
_ENVIRONMENT = ("AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "ROS_DISTRO")
_MISSING = [-1, -1, -1]
# File systems stamp files with the time of the last tick of the kernel: up to 10 ms old.
_CLOCK_STEP_NS = 10_000_000
# Beside the package in a repository; in a wheel they are part of it.
_TOOL_BESIDE = ("profiles",)


@dataclass(frozen=True)
class Run:
    """A run that need not be repeated: where it wrote, and what it said of its result and on stderr."""

    out: Path
    summary: str
    files: int
    warnings: str = ""


def find_run(command: Mapping[str, object], environ: Mapping[str, str]) -> Run | None:
    """Return the recorded run of `command` when nothing that it read or wrote has changed, else None."""
    try:
        data = read_json(_record(command, environ))
        watched = {**data["inputs"], **data["outputs"]}
        if data["tool"] != _tool_state() or any(_state(p) != s for p, s in watched.items()):
            return None
        return Run(Path(data["out"]), str(data["summary"]), int(data["files"]), str(data["warnings"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def record_run(
    command: Mapping[str, object],
    environ: Mapping[str, str],
    run: Run,
    inputs: Iterable[str | Path],
    outputs: Iterable[str | Path],
    started_ns: int,
) -> None:
    """Record a finished run. A cache that cannot be written is no error: the next run is a full one.

    `started_ns` is the time (nanoseconds since the epoch) before anything was read: an input that is as young may
    have been read before its change.
    """
    states = _states(inputs)
    if any(max(state[1:]) >= started_ns - _CLOCK_STEP_NS for state in states.values()):
        return
    data = {
        "tool": _tool_state(),
        "inputs": states,
        "outputs": _states(outputs),
        "out": str(run.out),
        "files": run.files,
        "summary": run.summary,
        "warnings": run.warnings,
    }
    path = _record(command, environ)
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_suffix(f".{os.getpid()}.tmp")
        temporary.write_text(json.dumps(data), encoding="utf-8", newline="\n")
        temporary.replace(path)


def cache_folder(environ: Mapping[str, str]) -> Path:
    """Return the tool's folder in the user's cache (XDG Base Directory Specification)."""
    base = environ.get("XDG_CACHE_HOME") or environ.get("LOCALAPPDATA")
    return (Path(base) if base else Path.home() / ".cache") / "microros-gen"


def compiled_templates(environ: Mapping[str, str]) -> Path:
    """Return the file that keeps the compiled templates of this installation between runs."""
    installation = hashlib.sha256(f"{microros_gen.__file__} {sys.version}".encode()).hexdigest()
    return cache_folder(environ) / "templates" / f"{installation[:16]}.bin"


def _record(command: Mapping[str, object], environ: Mapping[str, str]) -> Path:
    key = [
        {name: str(value) for name, value in sorted(command.items())},
        str(Path.cwd()),
        sys.prefix,
        {name: environ.get(name) for name in _ENVIRONMENT},
    ]
    digest = hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()
    return cache_folder(environ) / "runs" / f"{digest[:32]}.json"


def _states(paths: Iterable[str | Path]) -> dict[str, list[int]]:
    """Return the state of each path, by its absolute name. A Path for each of a thousand takes longer than that."""
    here = str(Path.cwd())
    return {os.path.join(here, path): _state(path) for path in paths}  # noqa: PTH118


def _state(path: str | Path) -> list[int]:
    """Return size and times of change, or a mark where nothing is; a folder's times tell of its names.

    The second time is that of the entry itself, which shows a file of the same size that was put in its place with
    its old time (POSIX; on Windows it is the time of creation).
    """
    try:
        found = os.stat(path)  # noqa: PTH116
    except OSError:
        return _MISSING
    return [found.st_size, found.st_mtime_ns, found.st_ctime_ns]


def tool_files() -> Iterator[Path]:
    """Yield the tool's own files: templates, components, profiles and modules; first the folder of its package.

    An installation creates that folder again, even if it gives the files older times.
    """
    yield Path(microros_gen.__file__).parent
    yield from (Path(entry.path) for entry in _tool_entries())


def _tool_state() -> str:
    """Return a digest of the state of the tool's own files."""
    digest = hashlib.sha256(microros_gen.__version__.encode())
    digest.update(str([_state(folder) for folder in _package_folders()]).encode())
    for entry in _tool_entries():
        found = entry.stat()
        digest.update(f"{entry.path} {found.st_size} {found.st_mtime_ns}\n".encode())
    return digest.hexdigest()


def _tool_entries() -> Iterator[os.DirEntry[str]]:
    package = Path(microros_gen.__file__).parent
    pending = [str(package), *(str(package.parent / name) for name in _TOOL_BESIDE)]
    while pending:
        for entry in _entries(pending.pop()):
            if not entry.is_dir(follow_symlinks=False):
                yield entry
            elif entry.name not in ("__pycache__", "idl", "agent"):
                pending.append(entry.path)


def _entries(folder: str) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return sorted(entries, key=lambda e: e.name)
    except OSError:
        return []


def _package_folders() -> list[Path]:
    """Return the folders with Python packages: installing another Jinja, say, changes one of them."""
    return [Path(name) for name in sys.path if name.endswith(("site-packages", "dist-packages"))]
