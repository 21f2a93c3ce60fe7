# SPDX-License-Identifier: Apache-2.0
"""Reads an ELF file (System V ABI, chapter 4): its sections and symbols, as data."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import Any

from elftools.common.exceptions import ELFError
from elftools.elf.constants import SH_FLAGS
from elftools.elf.elffile import ELFFile
from elftools.elf.sections import SymbolTableSection

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import LARGEST_IMAGE, read_bytes
from microros_gen.records import dataclass

THUMB = 1
"""The bit that Arm sets in the address of a Thumb function."""


@dataclass(frozen=True)
class Section:
    """A section. `kind` as `size` counts it: `text` is code and constants, `data` has initial values that a
    program may change, `bss` begins as zeros. None: it is no part of the program in memory.
    """

    index: int
    name: str
    address: int
    size: int
    kind: str | None
    strings: bool = False

    @property
    def end(self) -> int:
        """The address after it."""
        return self.address + self.size


@dataclass(frozen=True)
class Symbol:
    """A function or an object: its place (a Thumb function's without the bit) and its size, bytes."""

    name: str
    address: int
    size: int
    section: int
    function: bool
    exported: bool


class Elf:
    """An ELF file, read once. Raises UserError when `path` is none."""

    def __init__(self, path: Path, content: bytes | None = None) -> None:
        """Read it; `content` is that of a member of the library `path`."""
        self.path = path
        try:
            self.file: Any = ELFFile(BytesIO(read_bytes(path, LARGEST_IMAGE) if content is None else content))
        except (OSError, ELFError) as error:
            raise UserError(
                [
                    Diagnostic(
                        f"{path} cannot be measured: {error}",
                        hint="`size` and `explain` read ELF files",
                        id="MG-8402",
                    )
                ],
                status=1,
            ) from error
        self.machine = str(self.file["e_machine"])
        self.entry = int(self.file["e_entry"])
        self.little = bool(self.file.little_endian)
        self.bits = int(self.file.elfclass)
        self.flags = int(self.file["e_flags"])

    @property
    def arm(self) -> bool:
        """Whether it is for 32-bit Arm."""
        return self.machine == "EM_ARM"

    @cached_property
    def headers(self) -> tuple[Any, ...]:
        """The sections as pyelftools has them, at their indexes; it reads a section again for each question."""
        return tuple(self.file.iter_sections())

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """All sections in the order of the file, those of size 0 left out."""
        found = (self._section(index, header) for index, header in enumerate(self.headers))
        return tuple(s for s in found if s.size)

    @cached_property
    def loaded(self) -> tuple[Section, ...]:
        """The sections of the program in memory, by address."""
        return tuple(sorted((s for s in self.sections if s.kind), key=lambda s: (s.address, s.index)))

    @cached_property
    def symbols(self) -> tuple[Symbol, ...]:
        """Functions and objects that are defined here, by address; a name that others see before others."""
        found = set(self._symbols())
        return tuple(sorted(found, key=lambda s: (s.section, s.address, -s.size, not s.exported, s.name)))

    @cached_property
    def _functions(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The addresses at which functions begin, in their order, and those at which they end."""
        extents = sorted((s.address, s.address + s.size) for s in self.symbols if s.function and s.size)
        return tuple(begin for begin, _ in extents), tuple(end for _, end in extents)

    def is_code(self, address: int) -> bool:
        """Return whether a function of the image is at an address.

        The linker sets the addresses of a function that it leaves out to 0, where an image of a microcontroller has
        its vectors and then its first functions.
        """
        begins, ends = self._functions
        at = bisect_right(begins, address) - 1
        return at >= 0 and address < ends[at]

    @cached_property
    def dwarf(self) -> Any | None:
        """The debugging information of pyelftools, or None where the file has none."""
        return self.file.get_dwarf_info() if self.file.has_dwarf_info() else None

    def content(self, section: Section) -> bytes:
        """Return the bytes of a section; zeros for one that has none in the file."""
        data = self.headers[section.index].data()
        return bytes(data) if data else bytes(section.size)

    def _section(self, index: int, section: Any) -> Section:
        flags, kind = int(section["sh_flags"]), None
        if flags & SH_FLAGS.SHF_ALLOC:
            if section["sh_type"] == "SHT_NOBITS":
                kind = "bss"
            elif flags & SH_FLAGS.SHF_WRITE and not flags & SH_FLAGS.SHF_EXECINSTR:
                kind = "data"
            else:
                kind = "text"
        merged = SH_FLAGS.SHF_MERGE | SH_FLAGS.SHF_STRINGS
        strings = flags & merged == merged
        return Section(index, section.name, int(section["sh_addr"]), int(section["sh_size"]), kind, strings)

    def _symbols(self) -> Iterator[Symbol]:
        for section in self.headers:
            if not isinstance(section, SymbolTableSection) or section.name == ".dynsym":
                continue
            for symbol in section.iter_symbols():
                kind, where = symbol["st_info"]["type"], symbol["st_shndx"]
                if kind not in ("STT_FUNC", "STT_OBJECT", "STT_LOOS", "STT_NOTYPE") or not isinstance(
                    where, int
                ):
                    continue
                if not symbol.name or symbol.name.startswith("$"):
                    continue
                if kind == "STT_NOTYPE" and not symbol["st_size"]:
                    continue
                function = kind in ("STT_FUNC", "STT_LOOS")
                address = int(symbol["st_value"])
                if self.arm and function:
                    address &= ~THUMB
                exported = symbol["st_info"]["bind"] != "STB_LOCAL"
                yield Symbol(symbol.name, address, int(symbol["st_size"]), where, function, exported)
