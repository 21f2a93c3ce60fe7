# SPDX-License-Identifier: Apache-2.0
"""Where the objects of an image lie: by the linker's map, else by symbols; and which of them are the library's."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath

from microros_gen.image.dwarf import read_units
from microros_gen.image.elf import Elf, Symbol
from microros_gen.image.folder import Folder
from microros_gen.image.linker_map import Placed, member_of
from microros_gen.records import dataclass

UNMAPPED = "<no map>"
"""The object of what nobody has a name for."""


@dataclass(frozen=True)
class Layout:
    """What lies where. `sources` has the library's source of those pieces that have one."""

    placed: tuple[Placed, ...]
    sources: Mapping[Placed, str]


def layout_of(folder: Folder, image: Elf) -> Layout:
    """Return the layout of a linked image. Without a map, only what has a symbol is in it."""
    if folder.linked is None:
        return Layout(folder.placed, {})
    if not folder.placed:
        return _by_symbols(folder, image)
    return Layout(folder.placed, _recognized(folder, image))


def _recognized(folder: Folder, image: Elf) -> Mapping[Placed, str]:
    """Return the sources of the objects that are the library's, in whatever archive or by themselves."""
    named = _Named(image)
    loaded = {section.name for section in image.loaded}
    found: dict[Placed, str] = {}
    silent: list[tuple[Placed, str]] = []
    homes: set[str] = set()
    by_object: dict[str, list[Placed]] = {}
    for item in folder.placed:
        if item.output in loaded:
            by_object.setdefault(item.object, []).append(item)
    for name, items in by_object.items():
        archive, member = member_of(name)
        last, candidates = "", folder.by_name.candidates(member or name)
        for item in items if candidates else ():
            symbols = (
                named.within(item) if len(candidates) > 1 else [n for i in items for n in named.within(i)]
            )
            source = folder.by_name.of(member or name, symbols)
            if source is None and symbols:
                continue
            last = source or last or candidates[0]
            if source is None:
                silent.append((item, last))
            else:
                found[item] = source
                homes.add(archive or name)
    found.update({i: source for i, source in silent if (member_of(i.object)[0] or i.object) in homes})
    return found


class _Named:
    """The symbols of an image by address."""

    def __init__(self, image: Elf) -> None:
        self._symbols = sorted((s.address, s.name) for s in image.symbols if s.size)

    def within(self, item: Placed) -> list[str]:
        begin = bisect_left(self._symbols, (item.address, ""))
        end = bisect_left(self._symbols, (item.address + item.size, ""))
        return [name for _, name in self._symbols[begin:end]]


def _by_symbols(folder: Folder, image: Elf) -> Layout:
    """Return a piece for each symbol, whose object the symbol tables of the objects and DWARF tell."""
    defined: dict[tuple[str, bool], list[tuple[str, int]]] = {}
    recorded = tuple(map(str, folder.linked.objects)) if folder.linked is not None else ()
    for name in (*folder.sources, *recorded):
        item = folder.object(name)
        for symbol in item.symbols if item is not None else ():
            defined.setdefault((symbol.name, symbol.exported), []).append((name, symbol.size))
    units = read_units(image)
    placed: list[Placed] = []
    sources: dict[Placed, str] = {}
    for section in image.loaded:
        for symbol in (s for s in image.symbols if s.section == section.index and s.size):
            name = _object_of(symbol, defined, units.get(symbol.address, ""), folder.sources)
            chunk = Placed(section.name, section.name, name, symbol.address, symbol.size)
            placed.append(chunk)
            if name in folder.sources:
                sources[chunk] = name
    return Layout(tuple(sorted(placed, key=lambda p: (p.address, -p.size, p.object))), sources)


def _object_of(
    symbol: Symbol,
    defined: Mapping[tuple[str, bool], list[tuple[str, int]]],
    unit: str,
    sources: Iterable[str],
) -> str:
    """Return whose symbol it is: an object that defines one of this name, else what DWARF names."""
    known = defined.get((symbol.name, symbol.exported), [])
    fits = [name for name, _ in known if unit and _is_made_from(name, unit)]
    if not unit or symbol.exported:
        fits = fits or [name for name, size in known if size == symbol.size] or [name for name, _ in known]
    if fits:
        return fits[0]
    return next((source for source in sources if _is_made_from(source, unit)), unit or UNMAPPED)


def _is_made_from(name: str, unit: str) -> bool:
    """Whether `name`, a source of the library or an object, is that of a compilation unit."""
    if name.startswith("src/"):
        return unit == name or unit.endswith(f"/{name}")
    base, file = PurePosixPath(name).name, PurePosixPath(unit).name
    return base.rpartition(".")[0] in (file, file.rpartition(".")[0])
