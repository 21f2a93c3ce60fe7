# SPDX-License-Identifier: Apache-2.0
"""Few translation units in place of many C files: most of the time of a compiler goes into its start and the headers.

Files share a unit where nothing that one of them declares for itself is a word of another, so each means what it means
alone. That each file compiles alone, with the headers that it includes, is what the tests of compilers hold.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

COMMENT_OR_TEXT = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.DOTALL)
WORD = re.compile(r"[A-Za-z_]\w*")
STATIC = re.compile(r"^static\b[^;={]*?(\w+)\s*(?:\[[^;={]*)?[(;={]", re.MULTILINE)
MACRO = re.compile(r"^\s*#\s*define\s+(\w+)", re.MULTILINE)
TYPE = re.compile(
    r"^(?:typedef\b[^;{]*?(\w+)\s*;|typedef\b[^;{]*?\(\*\s*(\w+)\)|\}\s*(\w+)\s*;"
    r"|(?:typedef\s+)?(?:struct|union|enum)\s+(\w+))",
    re.MULTILINE,
)
ENUMERATION = re.compile(r"\benum\b[^;{]*\{([^}]*)\}")
# What the headers of the system read, and what holds to the end of a unit.
TO_THE_END = re.compile(r"^\s*#\s*(?:define\s+_|pragma\b|undef\b)", re.MULTILINE)


@dataclass(frozen=True)
class Names:
    """The words of a file, and those that it declares for itself; `alone`: it changes what follows it."""

    words: frozenset[str]
    own: frozenset[str]
    alone: bool


@dataclass
class _Unit:
    files: list[Path] = field(default_factory=list)
    words: set[str] = field(default_factory=set)
    own: set[str] = field(default_factory=set)

    def takes(self, names: Names) -> bool:
        return self.own.isdisjoint(names.words) and self.words.isdisjoint(names.own)

    def add(self, file: Path, names: Names) -> None:
        self.files.append(file)
        self.words |= names.words
        self.own |= names.own


@cache
def names_of(text: str) -> Names:
    """Return the names in a C file."""
    code = COMMENT_OR_TEXT.sub(" ", text)
    own = {*STATIC.findall(code), *MACRO.findall(code)}
    own |= {name for found in TYPE.findall(code) for name in found if name}
    own |= {word for inside in ENUMERATION.findall(code) for word in WORD.findall(inside)}
    return Names(frozenset(WORD.findall(code)), frozenset(own), TO_THE_END.search(code) is not None)


def merged(files: Iterable[Path]) -> tuple[tuple[Path, ...], ...]:
    """Return `files` in groups, each of which can be one translation unit."""
    units: list[_Unit] = []
    alone: list[tuple[Path, ...]] = []
    for file in files:
        names = names_of(file.read_text(encoding="utf-8"))
        if names.alone:
            alone.append((file,))
            continue
        unit = next((unit for unit in units if unit.takes(names)), None)
        if unit is None:
            units.append(unit := _Unit())
        unit.add(file, names)
    return (*(tuple(unit.files) for unit in units), *alone)


def text_of(files: Sequence[Path]) -> str:
    """Return the text of a unit."""
    return "".join(f'#include "{file.resolve()}"\n' for file in files)
