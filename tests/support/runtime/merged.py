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
# What the headers of the system read (files that agree on it share a unit), and what holds to the end of a unit.
FEATURES = re.compile(r"^\s*#\s*define\s+_.*$\n?", re.MULTILINE)
TO_THE_END = re.compile(r"^\s*#\s*(?:pragma|undef)\b", re.MULTILINE)


@dataclass(frozen=True)
class Names:
    """The words of a file, those that it declares for itself, and the macros that it defines for the system's headers.

    `alone`: it changes what follows it.
    """

    words: frozenset[str]
    own: frozenset[str]
    features: tuple[str, ...]
    alone: bool


@dataclass
class _Unit:
    features: tuple[str, ...]
    files: list[Path] = field(default_factory=list)
    words: set[str] = field(default_factory=set)
    own: set[str] = field(default_factory=set)

    def takes(self, names: Names) -> bool:
        same = self.features == names.features
        return same and self.own.isdisjoint(names.words) and self.words.isdisjoint(names.own)

    def add(self, file: Path, names: Names) -> None:
        self.files.append(file)
        self.words |= names.words
        self.own |= names.own


@cache
def names_of(text: str) -> Names:
    """Return the names in a C file."""
    code = COMMENT_OR_TEXT.sub(" ", text)
    features = tuple(line.strip() for line in FEATURES.findall(code))
    code = FEATURES.sub("", code)
    own = {*STATIC.findall(code), *MACRO.findall(code)}
    own |= {name for found in TYPE.findall(code) for name in found if name}
    own |= {word for inside in ENUMERATION.findall(code) for word in WORD.findall(inside)}
    alone = TO_THE_END.search(code) is not None
    return Names(frozenset(WORD.findall(code)), frozenset(own), features, alone)


def merged(files: Iterable[Path]) -> tuple[tuple[Path, ...], ...]:
    """Return `files` in groups, each of which can be one translation unit; assembler files are alone."""
    units: list[_Unit] = []
    alone: list[tuple[Path, ...]] = []
    for file in files:
        names = names_of(file.read_text(encoding="utf-8"))
        if names.alone or file.suffix != ".c":
            alone.append((file,))
            continue
        unit = next((unit for unit in units if unit.takes(names)), None)
        if unit is None:
            units.append(unit := _Unit(names.features))
        unit.add(file, names)
    return (*(tuple(unit.files) for unit in units), *alone)


def text_of(files: Sequence[Path]) -> str:
    """Return the text of a unit."""
    return "".join(f'#include "{file.resolve()}"\n' for file in files)
