# SPDX-License-Identifier: Apache-2.0
"""Which source of the library an object was made from, whoever compiled it: by its name and its symbols."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path, PurePosixPath

from microros_gen.documents.files import read_text
from microros_gen.toolchain.compile import object_name

_ENDINGS = re.compile(r"(\.(c|S|s))?\.(o|obj|lo|rel)$")
_WORD = re.compile(r"[A-Za-z_]\w*")
_INCLUDE = re.compile(r'^#include "([^"]+)"$', re.MULTILINE)
_SUFFIX = re.compile(r"(__plan_[0-9a-f]{16})?(\..*)?$")
"""What ties a symbol to its plan, and what compilers add to a name: `.constprop.0`, `.1234`."""


class Sources:
    """The sources of an output folder, by the names that build systems give to their objects."""

    def __init__(self, folder: Path, sources: Iterable[str]) -> None:
        """Note the names; texts are read when they are needed."""
        self._folder = folder
        self._words: dict[str, frozenset[str]] = {}
        self._files: dict[str, tuple[frozenset[str], tuple[str, ...]]] = {}
        self._by_stem: dict[str, list[str]] = {}
        for source in sources:
            for stem in {PurePosixPath(source).stem, PurePosixPath(object_name(source)).stem}:
                self._by_stem.setdefault(stem, []).append(source)

    def candidates(self, name: str) -> Sequence[str]:
        """Return the sources that an object of this name may be made from: `xrce_session.c.obj`."""
        base = name.rpartition("/")[2]
        return self._by_stem.get(_ENDINGS.sub("", base), ()) if _ENDINGS.search(base) else ()

    def of(self, name: str, symbols: Iterable[str]) -> str | None:
        """Return the source of an object with these symbols, most of which it has to have; None: it is not ours."""
        names = [_SUFFIX.sub("", symbol) for symbol in symbols]
        best, most = None, len(names) / 2
        for source in self.candidates(name) if names else ():
            known = self._words_of(source)
            count = sum(1 for symbol in names if symbol in known)
            if count > most:
                best, most = source, count
        return best

    def _words_of(self, source: str) -> frozenset[str]:
        """Return the words of a source and of the headers that it includes: they have inline functions."""
        if source not in self._words:
            found: set[str] = set()
            waiting, seen = [source], {source}
            while waiting:
                words, headers = self._file(waiting.pop())
                found |= words
                waiting += [header for header in headers if header not in seen]
                seen.update(headers)
            self._words[source] = frozenset(found)
        return self._words[source]

    def _file(self, name: str) -> tuple[frozenset[str], tuple[str, ...]]:
        """Return the words of a file and the headers of the folder that it includes, read once."""
        if name not in self._files:
            try:
                text = read_text(self._folder / name, errors="replace")
            except OSError:
                text = ""
            headers = tuple(f"include/{header}" for header in dict.fromkeys(_INCLUDE.findall(text)))
            self._files[name] = frozenset(_WORD.findall(text)), headers
        return self._files[name]
