# SPDX-License-Identifier: Apache-2.0
"""Remembers the last run of a command, so that a run with nothing changed ends before anything is parsed.

A record lies in the user's cache folder, never in the output: it holds the state (size and time of change) of
everything that was read, the folders that were searched, the tool's own files, and of every file written. Any
difference, and any doubt, means a full run. Nothing is lost when the cache is.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import microros_gen

# What decides besides files: where interfaces are searched, and which Python's packages.
_ENVIRONMENT = ("AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH")
_MISSING = [-1, -1]


@dataclass(frozen=True)
class Run:
    """A run that need not be repeated: where it wrote, and what it said of its result."""

    out: Path
    summary: str
    files: int


def find_run(command: Mapping[str, object], environ: Mapping[str, str]) -> Run | None:
    """Return the recorded run of `command` when nothing that it read or wrote has changed, else None."""
    try:
        data = json.loads(_record(command, environ).read_text(encoding="utf-8"))
        watched = {**data["inputs"], **data["outputs"]}
        if data["tool"] != _tool_state() or any(_state(Path(p)) != s for p, s in watched.items()):
            return None
        return Run(Path(data["out"]), str(data["summary"]), len(data["outputs"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def record_run(
    command: Mapping[str, object],
    environ: Mapping[str, str],
    run: Run,
    inputs: Iterable[Path],
    outputs: Iterable[Path],
) -> None:
    """Record a finished run. A cache that cannot be written is no error: the next run is a full one."""
    data = {
        "tool": _tool_state(),
        "inputs": {str(p.absolute()): _state(p) for p in inputs},
        "outputs": {str(p.absolute()): _state(p) for p in outputs},
        "out": str(run.out),
        "summary": run.summary,
    }
    path = _record(command, environ)
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_suffix(f".{os.getpid()}.tmp")
        temporary.write_text(json.dumps(data), encoding="utf-8")
        temporary.replace(path)


def cache_folder(environ: Mapping[str, str]) -> Path:
    """Return the tool's folder in the user's cache (XDG Base Directory Specification)."""
    base = environ.get("XDG_CACHE_HOME") or environ.get("LOCALAPPDATA")
    return (Path(base) if base else Path.home() / ".cache") / "microros-gen"


def _record(command: Mapping[str, object], environ: Mapping[str, str]) -> Path:
    key = [
        {name: str(value) for name, value in sorted(command.items())},
        str(Path.cwd()),
        sys.prefix,
        {name: environ.get(name) for name in _ENVIRONMENT},
    ]
    digest = hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()
    return cache_folder(environ) / "runs" / f"{digest[:32]}.json"


def _state(path: Path) -> list[int]:
    """Return size and time of change, or a mark where nothing is; a folder's time tells of its names."""
    try:
        found = path.stat()
    except OSError:
        return _MISSING
    return [found.st_size, found.st_mtime_ns]


def _tool_state() -> str:
    """Return a digest of the state of the tool's own files: templates, components and modules."""
    digest = hashlib.sha256(microros_gen.__version__.encode())
    pending = [str(Path(microros_gen.__file__).parent)]
    while pending:
        with os.scandir(pending.pop()) as entries:
            for entry in sorted(entries, key=lambda e: e.name):
                if entry.is_dir(follow_symlinks=False):
                    if entry.name not in ("__pycache__", "idl", "agent"):
                        pending.append(entry.path)
                else:
                    found = entry.stat()
                    digest.update(f"{entry.path} {found.st_size} {found.st_mtime_ns}\n".encode())
    return digest.hexdigest()
