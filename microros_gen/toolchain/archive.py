# SPDX-License-Identifier: Apache-2.0
"""Reads a library of objects (`ar`): the common format with the long names of GNU and BSD, and GNU's thin archives."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from microros_gen.documents.files import LARGEST_IMAGE, read_bytes
from microros_gen.records import dataclass

_MAGIC, _THIN = b"!<arch>\n", b"!<thin>\n"
_HEADER = 60
_TABLES = ("/", "//", "/SYM64/", "__.SYMDEF", "__.SYMDEF SORTED")


@dataclass(frozen=True)
class Member:
    """An object of a library: its name without folders, and its bytes."""

    name: str
    content: bytes


def read_archive(path: Path) -> Iterator[Member]:
    """Yield the objects of a library; none if the file is no library, and those before the end if it is truncated."""
    try:
        data = read_bytes(path, LARGEST_IMAGE)
    except OSError:
        return
    thin, names, at = data.startswith(_THIN), b"", len(_MAGIC)
    if not thin and not data.startswith(_MAGIC):
        return
    while at + _HEADER <= len(data):
        head, at = data[at : at + _HEADER], at + _HEADER
        try:
            name, size = head[:16].decode().rstrip(), int(head[48:58])
        except ValueError:
            return
        held = 0 if thin and name not in _TABLES else size
        content = data[at : at + held]
        at += held + held % 2
        if name == "//":
            names = content
        elif name.startswith("#1/") and name[3:].isdigit():
            length = int(name[3:])
            name, content = content[:length].rstrip(b"\0").decode("utf-8", "replace"), content[length:]
        elif name.startswith("/") and name[1:].isdigit():
            name = names[int(name[1:]) :].split(b"/\n", 1)[0].decode("utf-8", "replace")
        if name not in _TABLES:
            yield _member(path, name.removesuffix("/"), content, thin)


def _member(path: Path, name: str, content: bytes, thin: bool) -> Member:
    if thin:
        try:
            content = read_bytes(path.parent / name, LARGEST_IMAGE)
        except OSError:
            content = b""
    return Member(name.rsplit("/", 1)[-1], content)
