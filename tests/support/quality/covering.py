# SPDX-License-Identifier: Apache-2.0
"""Which files of the corpus `make lint` analyzes: together they have each different line and each condition."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from microros_gen.selection.find_components import load_catalogue
from tests.support.quality.corpus import Tree, Unit, keys, rendered_names

_WORDS_OF_C = re.compile(
    r"(bool|break|case|char|const|continue|default|do|double|else|enum|extern|float|for|goto|if|inline|int|long|NULL"
    r"|return|short|signed|sizeof|static|struct|switch|typedef|union|unsigned|void|volatile|while"
    r"|size_t|u?int(8|16|32|64)_t)"
)
_INCLUDED = re.compile(r'^[ \t]*#[ \t]*include[ \t]+["<]([^">\n]+)[">]', re.MULTILINE)
_CONDITION = re.compile(r"^[ \t]*#[ \t]*(?:if|elif)(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
# A guard of a header, or a value that a macro has by default: no code depends on it.
_DEFAULT = re.compile(r"^[ \t]*#[ \t]*ifndef[ \t]+(\w+)[ \t]*\n[ \t]*#[ \t]*define[ \t]+\1\b", re.MULTILINE)


def covering_units(trees: Sequence[Tree]) -> list[Unit]:
    """Return files that together have each different line of all files, as few as are found from the largest on.

    Two lines are the same where only numbers and texts in quotation marks differ. Files of types are rendered from a
    handful of templates, as are tables of components: there two lines are the same where names differ, too.

    A file is read in every configuration of its conditions where one of them, or one of a header that it includes, is
    in no file before it.
    """
    components, rendered = frozenset(load_catalogue()), rendered_names()
    texts: dict[str, dict[str, tuple[Tree, str]]] = {}
    for tree in trees:
        for source in tree.sources:
            text = (tree.out / source).read_text(encoding="utf-8")
            texts.setdefault(_family(source, components), {}).setdefault(text, (tree, source))
    chosen = [
        place
        for name, same in texts.items()
        for place in _covering(same, name.startswith("*") or Path(name).name in rendered)
    ]
    seen: set[tuple[str, str]] = set()
    found = []
    for (tree, source), key in zip(chosen, keys(chosen), strict=True):
        new = conditions(tree, source) - seen
        seen |= new
        found.append(Unit(tree, source, key if new else f"{key}-1", bool(new)))
    return found


def conditions(tree: Tree, source: str) -> set[tuple[str, str]]:
    """Return the conditions of the preprocessor in a file and in the headers of the tree that it includes, by file."""
    return {(path, line) for path, text in included(tree, source).items() for line in _conditions(text)}


def known_headers(every: Sequence[Unit]) -> list[list[str]]:
    """Return for each file the headers that another one has read with the same text.

    A header with conditions counts as another one where the numbers of the plan differ. What is read in every
    configuration reads each of its headers, too.
    """
    seen: set[tuple[str, str, str]] = set()
    known: dict[int, list[str]] = {}
    for at, unit in sorted(enumerate(every), key=lambda place: not place[1].in_every_configuration):
        texts = included(unit.tree, unit.source)
        plan = (unit.tree.out / "include" / "microros_config.h").read_text(encoding="utf-8")
        del texts[unit.source]
        read = {path: (path, text, plan if _conditions(text) else "") for path, text in texts.items()}
        known[at] = (
            [] if unit.in_every_configuration else sorted(p for p, same in read.items() if same in seen)
        )
        seen |= set(read.values())
    return [known[at] for at in range(len(every))]


def included(tree: Tree, source: str) -> dict[str, str]:
    """Return the texts of a file and of the headers of the tree that it includes, by path."""
    found: dict[str, str] = {}
    left = [tree.out / source]
    while left:
        path = left.pop()
        name = path.relative_to(tree.out).as_posix()
        if name in found or not path.is_file():
            continue
        found[name] = path.read_text(encoding="utf-8")
        for header in _INCLUDED.findall(found[name]):
            left += [path.parent / header, tree.out / "include" / header]
    return found


@cache
def _conditions(text: str) -> frozenset[str]:
    code = _DEFAULT.sub("", text)
    return frozenset(line for line in _CONDITION.findall(code) if "__cplusplus" not in line)


def _family(source: str, components: frozenset[str]) -> str:
    """Return what files of one template have in common: their path, and of files of types `*` and the ending."""
    folder, _, name = source.removeprefix("src/").partition("/")
    is_of_type = source.startswith("src/") and folder not in components
    return f"*__{name.rpartition('__')[2]}" if is_of_type else source


def _covering(texts: Mapping[str, tuple[Tree, str]], is_any_name: bool) -> list[tuple[Tree, str]]:
    lines = {text: _lines(text, is_any_name) for text in texts}
    left = set().union(*lines.values())
    found = []
    while left:
        best = max(lines, key=lambda text: len(lines[text] & left))
        left -= lines[best]
        found.append(texts[best])
    return found


def _lines(text: str, is_any_name: bool) -> set[str]:
    code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)
    code = re.sub(r"\b(0x[0-9A-Fa-f]+|\d+)", "N", re.sub(r'"(\\.|[^"\n])*"', "S", code))
    if is_any_name:
        code = re.sub(r"[A-Za-z_]\w*", lambda name: name[0] if _WORDS_OF_C.fullmatch(name[0]) else "I", code)
    return {line.strip() for line in code.splitlines() if line.strip()}
