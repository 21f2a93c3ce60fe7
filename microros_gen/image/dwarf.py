# SPDX-License-Identifier: Apache-2.0
"""What the debugging information (DWARF 4 and 5) says of variables and functions: their places and their parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath
from typing import Any, Literal

from elftools.common.exceptions import DWARFError, ELFError

from microros_gen.image.elf import THUMB, Elf
from microros_gen.records import dataclass

_QUALIFIERS = ("DW_TAG_typedef", "DW_TAG_const_type", "DW_TAG_volatile_type")
_OP_ADDR = 0x03
DEEPEST = 4


@dataclass(frozen=True)
class Part:
    """A part of a variable: `.reliable.message[2]`, its offset and size in bytes."""

    path: str
    offset: int
    size: int


@dataclass(frozen=True)
class Place:
    """Where something is defined: a file as it was given to the compiler, and a line (0: not known)."""

    file: str
    line: int


@dataclass(frozen=True)
class Facts:
    """By address: the name of each variable's type and its parts; and where each symbol is defined."""

    types: Mapping[int, str]
    parts: Mapping[int, tuple[Part, ...]]
    places: Mapping[int, Place]


NO_FACTS = Facts({}, {}, {})


def read_facts(image: Elf) -> Facts:
    """Return what the image says; nothing where it was built without `-g`."""
    dwarf = image.dwarf
    if dwarf is None:
        return NO_FACTS
    types: dict[int, str] = {}
    parts: dict[int, tuple[Part, ...]] = {}
    places: dict[int, Place] = {}
    for unit in dwarf.iter_CUs():
        files = _files(dwarf, unit)
        for die in unit.iter_DIEs():
            address = _address(image, die)
            if address is None:
                continue
            origin = origin_of(die)
            places.setdefault(address, _place(origin, files))
            if die.tag == "DW_TAG_variable" and "DW_AT_type" in origin.attributes:
                kind = origin.get_DIE_from_attribute("DW_AT_type")
                types.setdefault(address, type_name(kind))
                parts.setdefault(address, tuple(_parts(kind, "", 0, 0)))
    return Facts(types, parts, places)


def read_variables(item: Elf) -> Mapping[str, tuple[str, tuple[Part, ...]]]:
    """Return type and parts of each static variable of an object by name: it has no addresses yet.

    Empty without `-g`, and where pyelftools cannot relocate what the object says.
    """
    found: dict[str, tuple[str, tuple[Part, ...]]] = {}
    try:
        for unit in item.dwarf.iter_CUs() if item.dwarf else ():
            for die in unit.iter_DIEs():
                if die.tag == "DW_TAG_variable" and _address(item, die) is not None:
                    origin = origin_of(die)
                    kind = type_of(origin)
                    if kind is not None:
                        found.setdefault(_name(origin), (type_name(kind), tuple(_parts(kind, "", 0, 0))))
    except (ELFError, DWARFError):
        return {}
    return found


def read_units(image: Elf) -> Mapping[int, str]:
    """Return the source file, as it was given to the compiler, of each function and static variable by address."""
    found: dict[int, str] = {}
    for unit in image.dwarf.iter_CUs() if image.dwarf else ():
        name = _name(unit.get_top_DIE())
        for die in unit.iter_DIEs():
            address = _address(image, die)
            if address is not None:
                found.setdefault(address, name)
    return found


def function_address(image: Elf, die: Any) -> int | None:
    """Return where a function begins, or None for what is none, or has no code."""
    if die.tag != "DW_TAG_subprogram" or "DW_AT_low_pc" not in die.attributes:
        return None
    address = int(die.attributes["DW_AT_low_pc"].value)
    return address & ~THUMB if image.arm else address


def _address(image: Elf, die: Any) -> int | None:
    if die.tag == "DW_TAG_subprogram":
        return function_address(image, die)
    if die.tag == "DW_TAG_variable" and "DW_AT_location" in die.attributes:
        location = die.attributes["DW_AT_location"].value
        if isinstance(location, list) and location and location[0] == _OP_ADDR:
            size = image.bits // 8
            order: Literal["little", "big"] = "little" if image.little else "big"
            return int.from_bytes(bytes(location[1 : 1 + size]), order)
    return None


def origin_of(die: Any) -> Any:
    """Return the DIE that has name, type and place: an instance of an inlined function only points to it."""
    for attribute in ("DW_AT_abstract_origin", "DW_AT_specification"):
        if attribute in die.attributes:
            return origin_of(die.get_DIE_from_attribute(attribute))
    return die


def _files(dwarf: Any, unit: Any) -> Mapping[int, str]:
    program = dwarf.line_program_for_CU(unit)
    if program is None:
        return {}
    header = program.header
    first = 0 if header["version"] >= 5 else 1
    folders = [f.decode() for f in header["include_directory"]]
    found = {}
    for index, entry in enumerate(header["file_entry"]):
        folder = entry["dir_index"] - first
        where = folders[folder] if 0 <= folder < len(folders) and (folder or first) else ""
        found[index + first] = str(PurePosixPath(where, entry["name"].decode()))
    return found


def _place(die: Any, files: Mapping[int, str]) -> Place:
    file, line = die.attributes.get("DW_AT_decl_file"), die.attributes.get("DW_AT_decl_line")
    return Place(files.get(file.value, "") if file else "", line.value if line else 0)


def _name(die: Any) -> str:
    attribute = die.attributes.get("DW_AT_name")
    return attribute.value.decode() if attribute else ""


def type_of(die: Any) -> Any | None:
    """Return the type of a DIE, or None for void."""
    return die.get_DIE_from_attribute("DW_AT_type") if "DW_AT_type" in die.attributes else None


def type_name(die: Any | None) -> str:
    """Return the outermost name: a typedef's, or what an array or a qualified type is made of."""
    while die is not None and not _name(die):
        die = type_of(die)
    return _name(die) if die is not None else ""


def plain_type(die: Any | None) -> Any | None:
    """Return a type without typedefs and qualifiers."""
    while die is not None and die.tag in _QUALIFIERS:
        die = type_of(die)
    return die


def _size(die: Any | None, word: int) -> int:
    die = plain_type(die)
    if die is None:
        return 0
    if die.tag == "DW_TAG_array_type":
        total = _size(type_of(die), word)
        for count in _counts(die):
            total *= count
        return total
    attribute = die.attributes.get("DW_AT_byte_size")
    return int(attribute.value) if attribute else word


def _counts(die: Any) -> list[int]:
    found = []
    for child in die.iter_children():
        if child.tag == "DW_TAG_subrange_type":
            bound, count = child.attributes.get("DW_AT_upper_bound"), child.attributes.get("DW_AT_count")
            found.append(int(count.value) if count else int(bound.value) + 1 if bound else 0)
    return found


def _parts(die: Any, path: str, offset: int, depth: int) -> Iterator[Part]:
    """Yield the parts of a type: members of structs; elements of arrays whose elements have parts themselves."""
    word = die.cu.header["address_size"]
    kind = plain_type(die)
    if kind is None or depth > DEEPEST:
        yield Part(path, offset, _size(die, word))
    elif kind.tag == "DW_TAG_structure_type":
        for member in kind.iter_children():
            if member.tag == "DW_TAG_member" and "DW_AT_data_member_location" in member.attributes:
                at = offset + int(member.attributes["DW_AT_data_member_location"].value)
                yield from _parts(type_of(member), f"{path}.{_name(member)}", at, depth + 1)
    elif kind.tag == "DW_TAG_array_type":
        yield from _elements(kind, path, offset, depth)
    else:
        yield Part(path, offset, _size(kind, word))


def _elements(die: Any, path: str, offset: int, depth: int) -> Iterator[Part]:
    word = die.cu.header["address_size"]
    element, counts = type_of(die), _counts(die)
    plain = plain_type(element)
    is_struct = plain is not None and plain.tag == "DW_TAG_structure_type"
    if not counts or (not is_struct and len(counts) < 2):
        yield Part(path, offset, _size(die, word))
        return
    size = _size(element, word)
    for count in counts[1:]:
        size *= count
    for index in range(counts[0]):
        here = f"{path}[{index}]"
        if is_struct and len(counts) == 1:
            yield from _parts(element, here, offset + index * size, depth + 1)
        else:
            yield Part(here, offset + index * size, size)


def file_name(unit: Any, program: Any, index: int) -> str:
    """Return the path of a file of a line table, with the folder of its object where it is relative.

    Files count from 1 on, and the folder 0 is that of the object (DWARF 4, 6.2.4); DWARF 5 lists all of them.
    """
    has_all = program.header["version"] >= 5
    entry = program["file_entry"][index if has_all else index - 1]
    folder = unit.get_top_DIE().attributes.get("DW_AT_comp_dir")
    own = folder.value if folder is not None else b""  # optional: libgcc of AVR has none
    folders = [*([] if has_all else [own]), *program["include_directory"]]
    if has_all:
        folders[0] = own
    parts = (folders[0], folders[entry["dir_index"]], entry["name"])
    return "/".join(str(part.decode("utf-8", "replace")) for part in parts[_first(parts) :] if part)


def _first(parts: tuple[bytes, ...]) -> int:
    """Return the last part that is an absolute path, or 0."""
    return max((i for i, part in enumerate(parts) if part.startswith(b"/")), default=0)
