# SPDX-License-Identifier: Apache-2.0
"""Gives every byte of an image an owner: symbol → input section → object → source file → component.

What a section holds and nobody owns (gaps between input sections) is padding, so that the parts of a kind add up
to what `size` prints.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.image.elf import Elf, Section, Symbol
from microros_gen.image.folder import Folder
from microros_gen.image.linker_map import Placed, is_of_tool_chain, member_of
from microros_gen.image.placement import UNMAPPED, layout_of
from microros_gen.records import dataclass
from microros_gen.toolchain.compile import LIBRARY

GROUPS = (
    "component",
    "type support",
    "application",
    "other library",
    "start-up",
    "compiler",
    "C library",
    "linker",
    "unknown",
    "padding",
)
"""Kinds of owners, in the order of tables. `linker`: tables that it makes (PLT, GOT, dynamic linking).

`other library`: archives that the user brought. `unknown`: of an image without a map, what no symbol table tells.
"""

_START_UP = re.compile(r"(^|/)([SgM]?crt[1in]|crt(begin|end)[ST]?|rcrt1)\.o$")
_COMPILER = re.compile(r"^lib(gcc\w*|clang_rt[\w.-]*)\.a$")
_LINKER_MADE = re.compile(
    r"^\.(interp|dyn\w*|hash|gnu\.(hash|version\w*)|rela?\.?\w*(\..*)?|plt(\..*)?|iplt|got(\..*)?|eh_frame_hdr"
    r"|note\.gnu\.(build-id|property)|glue_7t?|vfp11_veneer|v4_bx|relr\.\w+)$"
)
_MERGED_TEXT = re.compile(r"\.str1\.\d+$|^\.rodata$")
_SHOWN_TEXT = 40
_LARGEST_GAP = 16
"""Bytes of padding that an alignment may need."""
_LIBRARY_NAME = LIBRARY.rsplit("/", 1)[-1]


@dataclass(frozen=True)
class Owner:
    """Whose bytes they are: a group of GROUPS, and a name in it (component, type, archive)."""

    group: str
    name: str


@dataclass(frozen=True)
class Chunk:
    """Neighboring bytes of one owner. `kind` is text, data or bss; `symbol` is None for what has no name.

    `source` is a C file below the output folder, or the linker's name of an object that was not made from one.
    """

    kind: str
    section: str
    input: str
    address: int
    size: int
    owner: Owner
    source: str | None = None
    symbol: str | None = None
    function: bool = False
    aliases: tuple[str, ...] = ()

    @property
    def flash(self) -> int:
        """Bytes of read-only memory: code, constants, initial values."""
        return self.size if self.kind != "bss" else 0

    @property
    def ram(self) -> int:
        """Bytes of static memory that the program may change."""
        return self.size if self.kind != "text" else 0


PADDING = Owner("padding", "alignment")
LINKER = Owner("linker", "tables of the linker")
UNKNOWN = Owner("unknown", "not known without a map")
RESERVED = {
    ".stack": Owner("start-up", "reserved for the stack"),
    ".heap": Owner("start-up", "reserved for a heap"),
}


def attribute(folder: Folder, image: Elf) -> tuple[Chunk, ...]:
    """Return the parts of a linked image, by section and address. UserError where the linker left no map."""
    layout = layout_of(folder, image)
    if not layout.placed:
        raise _no_map(folder)
    owners = Owners(folder, layout.sources)
    texts = _texts(folder, layout.placed, owners)
    by_output: dict[str, list[Placed]] = {}
    for item in layout.placed:
        by_output.setdefault(item.output, []).append(item)
    chunks: list[Chunk] = []
    for section in image.loaded:
        symbols = _sized(s for s in image.symbols if s.section == section.index)
        parts = _cover(section, by_output.get(section.name, ()), owners)
        for part in parts:
            chunks += _split(part, symbols, image, section, texts)
    return tuple(chunks)


def _no_map(folder: Folder) -> UserError:
    what, hint = f"{folder.path} has no map of its image", "Build it again: microros-gen build"
    if folder.linked is not None:
        what = f"{folder.linked.image} has neither a map nor symbols"
        hint = f"Link it without -s and with -Wl,-Map={folder.linked.map}, or give its map with --map"
    return UserError([Diagnostic(what, hint=hint, id="MG-8401")])


def attribute_library(folder: Folder) -> tuple[Chunk, ...]:
    """Return the parts of every object of the library, before a linker drops unused ones.

    Nothing has an address yet: the sections are laid one after the other, so that each piece has its own.
    """
    owners = Owners(folder, {})
    chunks: list[Chunk] = []
    base = 0
    for source in folder.sources:
        item = folder.object(source)
        if item is None:
            continue
        owner, name = owners.of_source(source), source
        for section in item.loaded:
            symbols = _sized(s for s in item.symbols if s.section == section.index)
            whole = Chunk(
                str(section.kind), section.name, section.name, section.address, section.size, owner, name
            )
            chunks += (replace(p, address=base + p.address) for p in _by_symbol(whole, symbols))
            base += section.address + section.size
    return tuple(chunks)


class Owners:
    """Whose an object is, by the name that the linker gives it."""

    def __init__(self, folder: Folder, sources: Mapping[Placed, str]) -> None:
        """Take what is known of the library's objects in an image that somebody else linked."""
        self._folder = folder
        self._sources = sources
        self.mapped = bool(folder.placed)
        self._components = frozenset(folder.components)

    def of_source(self, source: str) -> Owner:
        """Return the owner of a C file of the library."""
        name = source.split("/")[1]
        if source in self._folder.types:
            return Owner("type support", self._folder.types[source])
        return Owner("component" if name in self._components else "type support", name)

    def of(self, placed: Placed) -> tuple[Owner, str | None]:
        """Return the owner of an input section and its source."""
        if _LINKER_MADE.match(placed.section) or placed.object in ("<internal>", "linker stubs"):
            return LINKER, None
        if placed in self._sources:
            return self.of_source(self._sources[placed]), self._sources[placed]
        if placed.object == UNMAPPED:
            return UNKNOWN, None
        archive, member = member_of(placed.object)
        short = archive.rsplit("/", 1)[-1]
        if archive and short == _LIBRARY_NAME and member in self._folder.objects:
            source = self._folder.objects[member]
            return self.of_source(source), source
        if archive:
            return Owner(_group_of(short), short), f"{short}({member})"
        short = placed.object.rsplit("/", 1)[-1]
        if _START_UP.search(placed.object):
            return Owner("start-up", short), short
        if placed.object.startswith(".build/"):
            source = placed.object.removeprefix(".build/").removesuffix(".o") + ".c"
            return Owner("application", source), source
        return Owner("application", short), placed.object


def _group_of(archive: str) -> str:
    if _COMPILER.match(archive):
        return "compiler"
    return "C library" if is_of_tool_chain(archive) else "other library"


def _cover(section: Section, placed: Iterable[Placed], owners: Owners) -> Iterator[Chunk]:
    """Yield pieces that cover `section` without gap or overlap."""
    kind, at = str(section.kind), section.address
    for item in placed:
        begin, end = max(item.address, at), min(item.address + item.size, section.end)
        if begin >= end:
            continue
        if begin > at:
            yield _gap(section, at, begin, owners.mapped)
        owner, source = owners.of(item)
        yield Chunk(kind, section.name, item.section, begin, end - begin, owner, source)
        at = end
    if at < section.end:
        yield _gap(section, at, section.end, owners.mapped)


def _gap(section: Section, begin: int, end: int, mapped: bool) -> Chunk:
    """Return what no object has: all of a section is the linker's; without a map, most of it has no symbol."""
    kind, whole = str(section.kind), (begin, end) == (section.address, section.end)
    if not mapped and not _LINKER_MADE.match(section.name) and (whole or end - begin >= _LARGEST_GAP):
        owner = RESERVED.get(section.name, UNKNOWN)
        return Chunk(kind, section.name, section.name, begin, end - begin, owner)
    owner = RESERVED.get(section.name, LINKER) if whole else PADDING
    return Chunk(kind, section.name, "", begin, end - begin, owner)


def _split(
    chunk: Chunk, symbols: Sequence[Symbol], image: Elf, section: Section, texts: Mapping[bytes, Chunk]
) -> Iterator[Chunk]:
    if chunk.kind == "text" and _MERGED_TEXT.search(chunk.input) and texts:
        begin = chunk.address - section.address
        content = image.content(section)[begin : begin + chunk.size]
        named = any(chunk.address <= s.address < chunk.address + chunk.size for s in symbols)
        if not named:
            yield from _by_text(chunk, content, texts)
            return
    yield from _by_symbol(chunk, symbols)


def _by_symbol(chunk: Chunk, symbols: Sequence[Symbol]) -> Iterator[Chunk]:
    at, end = chunk.address, chunk.address + chunk.size
    for symbol in symbols:
        begin, stop = max(symbol.address, at), min(symbol.address + symbol.size, end)
        if begin >= stop:
            continue
        if begin > at:
            yield replace(chunk, address=at, size=begin - at)
        same = tuple(
            s.name
            for s in symbols
            if (s.address, s.size) == (symbol.address, symbol.size) and s.name != symbol.name
        )
        yield replace(
            chunk,
            address=begin,
            size=stop - begin,
            symbol=symbol.name,
            function=symbol.function,
            aliases=same,
        )
        at = stop
    if at < end:
        yield replace(chunk, address=at, size=end - at)


def _by_text(chunk: Chunk, content: bytes, texts: Mapping[bytes, Chunk]) -> Iterator[Chunk]:
    """Split strings that the linker merged, each to the first source file that has it.

    What is no string of any source (a rest that begins in a neighboring section) stays with its section.
    """
    at, end = chunk.address, chunk.address + chunk.size
    for text in content.split(b"\0"):
        size = min(len(text) + 1, end - at)
        if size <= 0:
            return
        found = texts.get(text) if text else None
        shown = text.decode("utf-8", "replace")
        shown = shown if len(shown) <= _SHOWN_TEXT else f"{shown[: _SHOWN_TEXT - 1]}…"
        name = f'"{shown}"' if found else None
        owner, source = (found.owner, found.source) if found else (chunk.owner, chunk.source)
        yield replace(chunk, address=at, size=size, owner=owner, source=source, symbol=name)
        at += size


def _texts(folder: Folder, placed: Iterable[Placed], owners: Owners) -> Mapping[bytes, Chunk]:
    """Return each string constant of the objects in the image, with the owner that comes first."""
    found: dict[bytes, Chunk] = {}
    code = [p for p in placed if p.section.startswith(".text")]
    owner_of_source = {source: owner for p in code for owner, source in [owners.of(p)] if source is not None}
    for source in sorted(owner_of_source):
        elf = None if owner_of_source[source].group in ("compiler", "C library") else folder.object(source)
        for section in elf.sections if elf is not None else ():
            if section.strings and section.kind:
                for text in elf.content(section).split(b"\0") if elf is not None else ():
                    found.setdefault(text, Chunk("text", "", "", 0, 0, owner_of_source[source], source))
    return found


def _sized(symbols: Iterable[Symbol]) -> tuple[Symbol, ...]:
    return tuple(s for s in symbols if s.size)
