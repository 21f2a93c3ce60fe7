# SPDX-License-Identifier: Apache-2.0
"""Who refers to whom, from the relocations of the objects: what a linker follows to decide what stays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from elftools.elf.relocation import RelocationSection

from microros_gen.image.attribution import Chunk
from microros_gen.image.elf import Elf
from microros_gen.image.folder import Folder
from microros_gen.records import dataclass

ROOTS = ("main",)
Key = tuple[str, str]
"""Source file and symbol."""


@dataclass(frozen=True)
class References:
    """Edges between symbols of the image: to each, the symbols that refer to it."""

    referrers: Mapping[Key, frozenset[Key]]

    def chain(self, target: Key, roots: Iterable[str] = ROOTS) -> tuple[str, ...]:
        """Return the shortest way from a root to `target`, both included; empty if none exists."""
        wanted = set(roots)
        before: dict[Key, Key | None] = {target: None}
        waiting = [target]
        while waiting:
            following: list[Key] = []
            for key in waiting:
                if key[1] in wanted:
                    return _way(before, key)
                for other in sorted(self.referrers.get(key, ())):
                    if other not in before:
                        before[other] = key
                        following.append(other)
            waiting = following
        return ()


def read_references(folder: Folder, chunks: Iterable[Chunk]) -> References:
    """Read the relocations of every object that has a symbol in the image."""
    of_source: dict[Key, Chunk] = {}
    for chunk in chunks:
        for name in (chunk.symbol, *chunk.aliases):
            if name and chunk.source and chunk.owner.group not in ("compiler", "C library"):
                of_source[chunk.source, name] = chunk
    exported: dict[str, Key] = {}
    for key in of_source:
        exported.setdefault(key[1], key)
    found: dict[Key, set[Key]] = {}
    for source in sorted({source for source, _ in of_source}):
        item = folder.object(source)
        for name, to in _edges(item) if item is not None else ():
            target = (source, to) if (source, to) in of_source else exported.get(to)
            if target and (source, name) in of_source and target != (source, name):
                found.setdefault(target, set()).add((source, name))
    return References({key: frozenset(names) for key, names in found.items()})


def _edges(item: Elf) -> Iterable[Key]:
    """Yield pairs of names: what a relocation lies in, and what it refers to."""
    by_section: dict[int, list[str]] = {}
    for symbol in item.symbols:
        by_section.setdefault(symbol.section, []).append(symbol.name)
    for section in item.headers:
        if not isinstance(section, RelocationSection):
            continue
        owners = by_section.get(int(section["sh_info"]), [])
        table = item.headers[section["sh_link"]]
        for relocation in section.iter_relocations():
            symbol = table.get_symbol(relocation["r_info_sym"])
            names = [symbol.name]
            if symbol["st_info"]["type"] == "STT_SECTION" and isinstance(symbol["st_shndx"], int):
                names = by_section.get(symbol["st_shndx"], [])
            yield from ((owner, name) for owner in owners for name in names if name)


def _way(before: Mapping[Key, Key | None], key: Key | None) -> tuple[str, ...]:
    found = []
    while key is not None:
        found.append(key[1])
        key = before[key]
    return tuple(found)
