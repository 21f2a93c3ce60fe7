# SPDX-License-Identifier: Apache-2.0
"""Where calls through pointers can go: to functions whose address is taken, and whose type is that of the pointer.

Which addresses are taken is in the relocations of the objects; types are in the debugging information.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from elftools.elf.constants import SH_FLAGS
from elftools.elf.relocation import RelocationSection

from microros_gen.image.attribution import Chunk
from microros_gen.image.dwarf import function_address, origin_of, plain_type, type_name, type_of
from microros_gen.image.elf import Elf
from microros_gen.image.folder import Folder
from microros_gen.records import dataclass

Signature = tuple[str, ...]
"""What a function gives and takes, spelled without typedefs and qualifiers."""

# Relocations of calls and jumps (ELF for the Arm Architecture 4.6.1; RISC-V ELF psABI; System V ABI, AMD64 and i386).
_BRANCHES: Mapping[str, frozenset[int]] = {
    "EM_ARM": frozenset({10, 28, 29, 30, 51, 102, 103}),
    "EM_RISCV": frozenset({16, 17, 18, 19, 44, 45}),
    "EM_X86_64": frozenset({4}),
    "EM_386": frozenset({2, 4}),
    "EM_AVR": frozenset({2, 3, 18}),
}
_AVR_WORDS = frozenset({24, 25})
"""R_AVR_LO8_LDI_GS and HI8: the address of code. That of the own section is where __prologue_saves__ returns to."""
_HOLDERS = ("DW_TAG_member", "DW_TAG_variable", "DW_TAG_formal_parameter")
FOREIGN = ("application", "other library", "unknown")
"""Owners whose code is the user's."""
_UNWINDING = (".eh_frame", ".ARM.ex", ".gcc_except_table", ".progmem.gcc_sw_table")
"""Sections that name parts of functions: for unwinding, and the tables of `switch`."""


@dataclass(frozen=True)
class Pointers:
    """`taken` are addresses of functions; `signatures` theirs; `members` those of pointers in structs, unions and
    variables, by name.

    `foreign` are functions of an application: whether it casts its callbacks is not known, so for them every pointer
    is like any other.
    """

    taken: frozenset[int]
    foreign: frozenset[int]
    signatures: Mapping[int, Signature]
    members: Mapping[str, frozenset[Signature]]

    def targets(self, member: str) -> frozenset[int] | None:
        """Return the functions that a call through `member` can reach; None where nobody knows.

        Empty: the image has none, as where an executor is given no handle.
        """
        exact = self.members.get(member)
        if exact is None:
            return None
        loose = frozenset(map(_loose, exact))
        return frozenset(address for address in self.taken if self._fits(address, exact, loose))

    def _fits(self, address: int, exact: frozenset[Signature], loose: frozenset[Signature]) -> bool:
        signature = self.signatures.get(address)
        if signature is None:
            return True
        return signature in exact or (address in self.foreign and _loose(signature) in loose)


def read_pointers(folder: Folder, image: Elf, functions: Mapping[int, Chunk]) -> Pointers:
    """Read the objects of an image and its debugging information; `functions` are those of the image by address."""
    foreign = frozenset(a for a, p in functions.items() if p.owner.group in FOREIGN)
    signatures, members = _read_types(image)
    return Pointers(frozenset(_taken(folder, functions)), foreign, signatures, members)


def _taken(folder: Folder, functions: Mapping[int, Chunk]) -> Iterator[int]:
    """Yield the functions that something holds the address of."""
    local = {(p.source, n): a for a, p in functions.items() for n in (p.symbol, *p.aliases)}
    exported = {name: address for (_, name), address in local.items()}
    for source in sorted({p.source for p in functions.values() if p.source}):
        of_source = [a for a, p in functions.items() if p.source == source]
        group = functions[of_source[0]].owner.group
        item = folder.object(source) if group not in ("compiler", "C library") else None
        if item is None:
            if group in FOREIGN:
                yield from of_source
            continue
        if _shares_sections(item):
            yield from of_source
        for name in _referred(item):
            address = local.get((source, name), exported.get(name))
            if address is not None:
                yield address


def _shares_sections(item: Elf) -> bool:
    """Whether several functions lie in one section: then an address among them may need no relocation."""
    sections = [s.section for s in item.symbols if s.function and s.size]
    return len(sections) != len(set(sections))


def _referred(item: Elf) -> Iterator[str]:
    """Yield the names of what an object refers to otherwise than by a call."""
    by_section: dict[int, list[str]] = {}
    for symbol in item.symbols:
        by_section.setdefault(symbol.section, []).append(symbol.name)
    for section in item.headers:
        if not isinstance(section, RelocationSection):
            continue
        holder = item.headers[section["sh_info"]]
        if not holder["sh_flags"] & SH_FLAGS.SHF_ALLOC or holder.name.startswith(_UNWINDING):
            continue
        yield from _names(item, section, by_section)


def _names(item: Elf, section: Any, by_section: Mapping[int, list[str]]) -> Iterator[str]:
    table, branches = item.headers[section["sh_link"]], _BRANCHES.get(item.machine, frozenset())
    for relocation in section.iter_relocations():
        if relocation["r_info_type"] in branches:
            continue
        symbol = table.get_symbol(relocation["r_info_sym"])
        is_own = symbol["st_shndx"] == section["sh_info"]
        if is_own and item.machine == "EM_AVR" and relocation["r_info_type"] in _AVR_WORDS:
            continue
        if symbol["st_info"]["type"] == "STT_SECTION" and isinstance(symbol["st_shndx"], int):
            yield from by_section.get(symbol["st_shndx"], ())
        else:
            yield symbol.name


def _read_types(image: Elf) -> tuple[Mapping[int, Signature], Mapping[str, frozenset[Signature]]]:
    signatures: dict[int, Signature] = {}
    members: dict[str, set[Signature]] = {}
    for unit in image.dwarf.iter_CUs() if image.dwarf else ():
        for die in unit.iter_DIEs():
            if die.tag == "DW_TAG_subprogram":
                address = function_address(image, die)
                if address is not None:
                    signatures.setdefault(address, _signature(origin_of(die)))
            elif die.tag in _HOLDERS:
                called = _pointed_function(die)
                if called is not None:
                    members.setdefault(type_name(origin_of(die)), set()).add(_signature(called))
    return signatures, {name: frozenset(found) for name, found in members.items()}


def _pointed_function(die: Any) -> Any | None:
    """Return the type of the functions that a member or variable points to, or None for others."""
    pointer = plain_type(type_of(origin_of(die)))
    if pointer is None or pointer.tag != "DW_TAG_pointer_type":
        return None
    called = plain_type(type_of(pointer))
    return called if called is not None and called.tag == "DW_TAG_subroutine_type" else None


def _signature(die: Any) -> Signature:
    takes: Iterable[Any] = (c for c in die.iter_children() if c.tag == "DW_TAG_formal_parameter")
    return tuple(_spelled(type_of(part)) for part in (die, *map(origin_of, takes)))


def _spelled(die: Any | None) -> str:
    plain = plain_type(die)
    if plain is None:
        return "void"
    if plain.tag == "DW_TAG_pointer_type":
        return f"*{_spelled(type_of(plain))}"
    return f"{plain.tag.removeprefix('DW_TAG_')} {type_name(plain) or type_name(die)}"


def _loose(signature: Signature) -> Signature:
    return tuple("*" if part.startswith("*") else part for part in signature)
