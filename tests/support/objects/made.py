# SPDX-License-Identifier: Apache-2.0
"""Files of the cache by what they were made from, where the maker knows that without asking a compiler."""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.support.objects.cache import CACHE, KEPT_DAYS

FOLDER = CACHE / "made"
_INCLUDED = re.compile(rb'^\s*#\s*include\s+"([^"]+\.c)"', re.MULTILINE)


@cache
def _folder() -> Path:
    """Return the folder, without what was not used for some days."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    oldest = time.time() - KEPT_DAYS * 86400
    for entry in FOLDER.iterdir():
        if entry.stat().st_mtime < oldest:
            shutil.rmtree(entry, ignore_errors=True)
    return FOLDER


@cache
def version(compiler: str) -> str:
    """Return what a compiler says of itself."""
    return subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout


def digest(*parts: object) -> str:
    """Return what identifies `parts`, by their representation."""
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def headers_digest(*folders: Path) -> str:
    """Return what identifies the names and contents of all headers below `folders`."""
    found = sorted((p.relative_to(folder).as_posix(), p) for folder in folders for p in folder.rglob("*.h"))
    return digest([(name, path.read_bytes()) for name, path in found])


def source_contents(source: Path, *folders: Path) -> list[tuple[str, bytes]]:
    """Return names and contents of a source and of the sources that it includes, from its folder or `folders`."""
    found: dict[Path, bytes] = {}
    waiting = [source]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found[path] = path.read_bytes()
            names = [match.decode() for match in _INCLUDED.findall(found[path])]
            places = [[folder / name for folder in (path.parent, *folders)] for name in names]
            waiting += [next(filter(Path.is_file, each)) for each in places]
    return [(path.name, content) for path, content in found.items()]


def made(key: str, name: str, make: Callable[[Path], str]) -> tuple[Path, str]:
    """Return the file `name` of the cache, and what `make` says when it could not make it.

    While one process makes it the others wait: they would take as long, and the processor from the first.
    """
    kept = _folder() / key / name
    if kept.is_file():
        os.utime(kept.parent)
        return kept, ""
    kept.parent.mkdir(exist_ok=True)
    with (kept.parent / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if kept.is_file():
            return kept, ""
        with TemporaryDirectory(dir=kept.parent) as folder:
            fresh = Path(folder, name)
            words = make(fresh)
            if not words:
                fresh.replace(kept)
    return kept, words
