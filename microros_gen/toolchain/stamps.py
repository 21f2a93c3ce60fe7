# SPDX-License-Identifier: Apache-2.0
"""Which objects are up to date: a digest of the command and of every file that an object was made from.

microros_config.h is in most files, and a changed limit changes a few of its lines. An object counts only those lines
whose names occur in the other files that it was made from; so an object that a change cannot reach is kept.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

from microros_gen.documents.files import read_json

CONFIG = "include/microros_config.h"
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_DEFINE = re.compile(r"#define ([A-Za-z_]\w*)(.*)")


class Stamps:
    """The stamps of one output folder, read from and kept in `path`."""

    def __init__(self, out: Path, path: Path) -> None:
        """Read the stamps of the last run; nothing is up to date where they cannot be read."""
        self._out = out
        self._path = path
        self._stamps: dict[str, dict[str, object]] = {}
        self._digests: dict[str, str] = {}
        self._identifiers: dict[str, frozenset[str]] = {}
        try:
            kept = read_json(path, follow=False)
            self._stamps = kept if isinstance(kept, dict) else {}
        except (OSError, ValueError):
            self._stamps = {}

    def is_fresh(self, name: str, command: Sequence[str]) -> bool:
        """Return whether the object `name` is there, and `command` would make it from what it was made from."""
        stamp = self._stamps.get(name)
        if not isinstance(stamp, dict) or not (self._out / name).is_file():
            return False
        files = stamp.get("files")
        if not isinstance(files, list):
            return False
        if stamp.get("digest") == self._digest(command, files):
            return True
        if CONFIG not in files or stamp.get("reached") != self._reached(command, files):
            return False
        self.record(name, command, files)
        return True

    def record(self, name: str, command: Sequence[str], files: list[str]) -> None:
        """Note that `command` has made the object `name` from `files`."""
        stamp: dict[str, object] = {"digest": self._digest(command, files), "files": files}
        if CONFIG in files:
            stamp["reached"] = self._reached(command, files)
        self._stamps[name] = stamp

    def save(self, names: Iterable[str]) -> None:
        """Keep the stamps of these objects."""
        kept = {name: self._stamps[name] for name in names if name in self._stamps}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._path.write_text(json.dumps(kept, sort_keys=True), encoding="utf-8")

    def _digest(self, command: Sequence[str], files: Iterable[str]) -> str:
        return _joined([*command, *(self._file_digest(name) for name in files)])

    def _reached(self, command: Sequence[str], files: Iterable[str]) -> str:
        """Return the digest in which only the lines of CONFIG count that the other files can see."""
        others = [name for name in files if name != CONFIG]
        names = frozenset().union(*(self._names(name) for name in others))
        lines = reached_lines(self._text(CONFIG), names)
        return _joined([*command, *(self._file_digest(name) for name in others), *lines])

    def _names(self, name: str) -> frozenset[str]:
        if name not in self._identifiers:
            self._identifiers[name] = frozenset(_IDENTIFIER.findall(self._text(name)))
        return self._identifiers[name]

    def _text(self, name: str) -> str:
        try:
            return (self._out / name).read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""

    def _file_digest(self, name: str) -> str:
        if name not in self._digests:
            try:
                self._digests[name] = hashlib.sha256((self._out / name).read_bytes()).hexdigest()
            except OSError:
                self._digests[name] = "missing"
        return self._digests[name]


def reached_lines(config: str, names: frozenset[str]) -> tuple[str, ...]:
    """Return the lines of `config` that count for a file with the identifiers `names`.

    That is every line that is no `#define NAME value`, the definitions of `names`, and those that they use.
    """
    defined, always = _definitions(config)
    reached: set[str] = set()
    waiting = [name for name in defined if name in names]
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += [used for used in _IDENTIFIER.findall(defined[name]) if used in defined]
    return (*always, *(f"{name}{defined[name]}" for name in sorted(reached)))


@cache
def _definitions(config: str) -> tuple[dict[str, str], tuple[str, ...]]:
    matches = [(line, _DEFINE.fullmatch(line)) for line in config.splitlines()]
    always = tuple(line for line, match in matches if match is None or line.endswith("\\"))
    return {match[1]: match[2] for _, match in matches if match is not None}, always


def _joined(parts: Iterable[str]) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()
