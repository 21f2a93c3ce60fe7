# SPDX-License-Identifier: Apache-2.0
"""Digests of the files that an object was made from.

microros_config.h is in most files, and a changed limit changes a few of its lines. An object counts only those lines
whose names occur in the other files that it was made from, comments left out; so an object that a change cannot reach
is kept.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence
from functools import cached_property
from pathlib import Path

CONFIG = "include/microros_config.h"
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
# Texts come first: what looks like a comment in one is none. What is not closed ends with its line.
_TEXT_OR_COMMENT = re.compile(
    r"""("(?:\\.|[^"\\\n])*"?|'(?:\\.|[^'\\\n])*'?)|/\*.*?\*/|//(?:\\\n|[^\n])*""", re.DOTALL
)
_DEFINE = re.compile(r"#define ([A-Za-z_]\w*)(.*)")


class Contents:
    """The files of an output folder, and the files that they include from elsewhere; each is read once."""

    def __init__(self, out: Path) -> None:
        """Prepare to read `out`, whose files must not change while this object is used."""
        self._out = out
        self._bytes: dict[str, bytes | None] = {}
        self._digests: dict[str, str] = {}
        self._names: dict[str, frozenset[str]] = {}
        self._of_files: dict[tuple[str, ...], str] = {}

    def of_file(self, name: str) -> str:
        """Return the digest of a file's bytes."""
        found = self._digests.get(name)
        if found is None:
            content = self.read(name)
            found = "missing" if content is None else hashlib.sha256(content).hexdigest()
            self._digests[name] = found
        return found

    def of_files(self, files: Sequence[str]) -> str:
        """Return the digest of all relevant contents of `files`: of CONFIG, only the lines that the others use."""
        key = tuple(files)
        if key not in self._of_files:
            self._of_files[key] = self._joined(files)
        return self._of_files[key]

    def _joined(self, files: Sequence[str]) -> str:
        others = [name for name in files if name != CONFIG]
        lines: tuple[str, ...] = ()
        if len(others) < len(files):
            lines = self._config.reached(frozenset().union(*map(self._configured, others)))
        return joined([*files, *map(self.of_file, others), *lines])

    def read(self, name: str) -> bytes | None:
        """Return the bytes of a file, or None if it cannot be read."""
        if name not in self._bytes:
            try:
                self._bytes[name] = (self._out / name).read_bytes()
            except OSError:
                self._bytes[name] = None
        return self._bytes[name]

    def _text(self, name: str) -> str:
        return (self.read(name) or b"").decode("utf-8", "replace")

    @cached_property
    def _config(self) -> Config:
        return Config(self._text(CONFIG))

    def _configured(self, name: str) -> frozenset[str]:
        """Return the names in a file that CONFIG defines."""
        if name not in self._names:
            text, defined = self._text(name), self._config.names
            found = defined.intersection(_IDENTIFIER.findall(text))
            if found and "/" in text:
                found = defined.intersection(_IDENTIFIER.findall(without_comments(text)))
            self._names[name] = found
        return self._names[name]


class Config:
    """The definitions of microros_config.h."""

    def __init__(self, text: str) -> None:
        """Split the text into lines `#define NAME value` and others."""
        matches = [(line, _DEFINE.fullmatch(line)) for line in text.splitlines()]
        self._always = tuple(line for line, match in matches if match is None or line.endswith("\\"))
        self._defined = {match[1]: match[2] for _, match in matches if match is not None}
        self.names = frozenset(self._defined)

    def reached(self, names: frozenset[str]) -> tuple[str, ...]:
        """Return the lines that count for a file with the identifiers `names`.

        That is every line that is no `#define NAME value`, the definitions of `names`, and those that they use.
        """
        reached: set[str] = set()
        waiting = [name for name in self._defined if name in names]
        while waiting:
            name = waiting.pop()
            if name not in reached:
                reached.add(name)
                waiting += [
                    used for used in _IDENTIFIER.findall(self._defined[name]) if used in self._defined
                ]
        return (*self._always, *(f"{name}{self._defined[name]}" for name in sorted(reached)))


def without_comments(text: str) -> str:
    """Return C source text with a space for each comment."""
    return _TEXT_OR_COMMENT.sub(lambda found: found[1] or " ", text)


def joined(parts: Iterable[str]) -> str:
    """Return the digest of several texts."""
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()
