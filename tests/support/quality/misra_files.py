# SPDX-License-Identifier: Apache-2.0
"""The MISRA findings in a few files of components, from the first trees that have them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from tests.support.paths import ROOT
from tests.support.quality import misra
from tests.support.quality.corpus import APPLICATIONS, Tree, Unit, make_tree, units
from tests.support.quality.covering import included

TREES = 4
"""Trees that are read for each file: more of them seldom have another line of it."""

_COMPONENTS = ("microros_gen", "components")
_TYPES = ("microros_gen", "templates", "types")


def pattern_of(path: Path) -> re.Pattern[str]:
    """Return what the file or template `path` is called in a tree; raises ValueError for what is in no tree."""
    if not path.is_file():
        raise ValueError(f"{path}: no such file")
    full = path.resolve()
    parts = full.relative_to(ROOT).parts if full.is_relative_to(ROOT) else full.parts
    name = parts[-1].removesuffix(".j2")
    if parts[:2] == _COMPONENTS and len(parts) > 4 and parts[3] in ("src", "include"):
        folder = [*parts[3:4], *parts[2:3]] if parts[3] == "src" else parts[3:4]
        return re.compile(re.escape("/".join([*folder, *parts[4:-1], name])) + "$")
    if parts[:3] == _TYPES:
        return re.compile(rf"(src|include)/[a-z0-9_]+_msgs/.*__{re.escape(name)}$")
    raise ValueError(f"{path}: neither below microros_gen/components nor microros_gen/templates/types")


def units_of(patterns: Sequence[re.Pattern[str]], folder: Path, number: int = TREES) -> list[Unit]:
    """Return the C files that hold what `patterns` name, or include it, in up to `number` trees for each."""
    left = dict.fromkeys(patterns, number)
    found: list[Unit] = []
    for name in _order(patterns):
        wanted = [pattern for pattern, count in left.items() if count > 0]
        if not wanted:
            break
        tree = make_tree(name, folder)
        for pattern in wanted:
            sources = tuple(_sources(tree, pattern))
            left[pattern] -= bool(sources)
            found += units([replace(tree, sources=sources)])
    return [*{unit.key: unit for unit in found}.values()]


def _order(patterns: Sequence[re.Pattern[str]]) -> list[str]:
    """Return the applications, those first whose text has a word of a pattern: few trees have a rare component."""
    words = {word for pattern in patterns for word in re.findall(r"[a-z]{5,}", pattern.pattern)}

    def score(name: str) -> int:
        return -sum(word.removesuffix("s") in f"{name} {APPLICATIONS[name]}" for word in words)

    return sorted(APPLICATIONS, key=score)


def _sources(tree: Tree, pattern: re.Pattern[str]) -> Iterator[str]:
    """Yield the files themselves; of a header, the first file that includes it."""
    matching = [source for source in tree.sources if pattern.match(source)]
    if matching or pattern.pattern.startswith("src"):
        yield from matching
        return
    for source in tree.sources:
        if any(pattern.match(path) for path in included(tree, source)):
            yield source
            return


def findings(paths: Sequence[Path], folder: Path, number: int = TREES) -> set[misra.Finding]:
    """Return the findings in `paths`; raises ValueError where a path is in no tree."""
    patterns = [pattern_of(path) for path in paths]
    every = units_of(patterns, folder, number)
    for path, pattern in zip(paths, patterns, strict=True):
        if not any(pattern.match(name) for unit in every for name in included(unit.tree, unit.source)):
            raise ValueError(f"{path}: in no tree of the corpus")
    return {f for f in misra.findings_of(every) if any(pattern.match(f[1]) for pattern in patterns)}
