# SPDX-License-Identifier: Apache-2.0
"""Writes a library of ELF objects (`ar`) with its table of symbols, as GNU's archiver does.

That one loads the compiler's plugin for link-time optimization again for each object, which takes 30 ms of a build.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from pathlib import Path

from microros_gen.documents.files import LARGEST_IMAGE, read_bytes
from microros_gen.records import dataclass

_LTO = b".gnu.lto_"
"""In the name of each section that only the compiler's plugin can read."""

_SHORTEST = 52  # bytes of the file's header for 32 bits
_RELOCATABLE = 1  # e_type
_SYMBOL_TABLE = 2  # sh_type
_OF_LINKERS = (1, 2, 10)
"""Bindings (System V ABI, chapter 4, and GNU's): global, weak, unique."""

_LONGEST_NAME = 15  # bytes in a header, without the slash
_LARGEST_OFFSET = (1 << 32) - 1


@dataclass(frozen=True)
class _Layout:
    """The structures of ELF files of one class: offsets of fields of the file's header, formats without byte order.

    The fields of a section and of a symbol follow in the order of System V ABI, chapter 4.
    """

    section_table: tuple[int, str]
    section_count: int
    section: str
    symbol: str
    binding: int
    index: int


_LAYOUTS = {
    1: _Layout((32, "I"), 46, "10I", "IIIBBH", 3, 5),
    2: _Layout((40, "Q"), 58, "IIQQQQIIQQ", "IBBHQQ", 1, 3),
}
_ORDERS = {1: "<", 2: ">"}


def write_library(path: Path, objects: Sequence[Path]) -> bool:
    """Write the library `path` of `objects`; false, and no file, if it takes the archiver.

    It does if one of them is no ELF object, or has code for link-time optimization.
    The bytes are those of `ar rcsD` (GNU Binutils 2.40). OSError if an object cannot be read, or `path` be written.
    """
    contents = [read_bytes(file, LARGEST_IMAGE) for file in objects]
    symbols = [_symbols(content) for content in contents]
    if any(of_object is None for of_object in symbols):
        return False
    names, table = _names([file.name for file in objects])
    tables = _member("//", table, None) if table else b""
    counted = sum(len(of_object or ()) for of_object in symbols)
    texts = b"".join(name + b"\0" for of_object in symbols for name in of_object or ())
    at = 8 + 60 + _even(4 + 4 * counted + len(texts)) + len(tables)
    offsets: list[int] = []
    for content, of_object in zip(contents, symbols, strict=True):
        offsets += [at] * len(of_object or ())
        at += 60 + _even(len(content))
    if at > _LARGEST_OFFSET:
        return False
    index = struct.pack(f">{counted + 1}I", counted, *offsets) + texts
    members = [_member(name, content, 0o644) for name, content in zip(names, contents, strict=True)]
    # The size of the index counts its last byte, which makes it even; that of an object does not.
    index += b"\0" * (len(index) % 2)
    path.write_bytes(b"".join((b"!<arch>\n", _member("/", index, 0), tables, *members)))
    return True


def _symbols(content: bytes) -> list[bytes] | None:
    """Return what an object defines for others, in its order; None if this module cannot say."""
    if content[:4] != b"\x7fELF" or len(content) < _SHORTEST or _LTO in content:
        return None
    layout, order = _LAYOUTS.get(content[4]), _ORDERS.get(content[5])
    if layout is None or order is None:
        return None
    try:
        return list(_defined(content, layout, order))
    except (struct.error, ValueError, IndexError):
        return None


def _defined(content: bytes, layout: _Layout, order: str) -> Iterator[bytes]:
    """Yield the names. ValueError, IndexError or struct.error if it is no object to link."""
    (kind,) = struct.unpack_from(f"{order}H", content, 16)
    at, form = layout.section_table
    (table,) = struct.unpack_from(order + form, content, at)
    size, count = struct.unpack_from(f"{order}HH", content, layout.section_count)
    section = struct.Struct(order + layout.section)
    if kind != _RELOCATABLE or size != section.size or count == 0:
        raise ValueError
    sections = [section.unpack_from(content, table + i * size) for i in range(count)]
    symbol = struct.Struct(order + layout.symbol)
    for _, sh_type, _, _, offset, length, link, first, _, _ in sections:
        if sh_type != _SYMBOL_TABLE:
            continue
        strings = sections[link][4]
        begin = offset + first * symbol.size  # what precedes is local
        for fields in symbol.iter_unpack(content[begin : offset + length]):
            if fields[layout.index] != 0 and fields[layout.binding] >> 4 in _OF_LINKERS:
                start = strings + fields[0]
                yield content[start : content.index(b"\0", start)]


def _names(names: Sequence[str]) -> tuple[list[str], bytes]:
    """Return what the headers of the objects say as name, and the table of the names that are too long for them."""
    short: list[str] = []
    table = b""
    for name in names:
        if len(name.encode()) <= _LONGEST_NAME:
            short.append(f"{name}/")
        else:
            short.append(f"/{len(table)}")
            table += f"{name}/\n".encode()
    return short, table + b"\n" * (len(table) % 2)


def _member(name: str, content: bytes, mode: int | None) -> bytes:
    """Return a header without time and owner, the content, and what makes it even; `mode` None: a table of names."""
    owner = ("", "", "", "") if mode is None else ("0", "0", "0", f"{mode:o}")
    head = "{:16}{:12}{:6}{:6}{:8}{:<10}`\n".format(name, *owner, len(content))
    return head.encode() + content + b"\n" * (len(content) % 2)


def _even(size: int) -> int:
    return size + size % 2
