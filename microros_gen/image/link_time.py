# SPDX-License-Identifier: Apache-2.0
"""Functions of the library that a linker compiled again: they are no longer those of its sources and objects."""

from __future__ import annotations

import re
from collections.abc import Iterable

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import LARGEST_RECORD, read_text
from microros_gen.image.attribution import Chunk
from microros_gen.image.folder import Folder
from microros_gen.records import dataclass

_MADE = re.compile(r"\.ltrans\d*(\.ltrans)?\.o$|\.lto\.(\d+\.|[\w.]*)?o$|\bld-temp\.o$|^<?lto\.tmp>?")
"""Objects of link-time optimization: of gcc's plugin, of lld, of LLVM's plugin."""
_DEFINED = re.compile(r"^(?!static\b|#)[a-z_][\w *]*?\b(\w+)\([^;{]*\n?\{", re.MULTILINE)


@dataclass(frozen=True)
class Remade:
    """A function of the library, and the object of the linker that has it."""

    function: str
    object: str


def is_made_by_linker(name: str) -> bool:
    """Whether the map names an object that link-time optimization made."""
    return _MADE.search(name) is not None


def remade(folder: Folder, chunks: Iterable[Chunk]) -> Remade | None:
    """Return the first function of the library that link-time optimization made; None: without one.

    What it made of the application alone stays apart: the library's functions are called there, and not changed.
    """
    found = [c for c in chunks if c.function and c.symbol and c.source and is_made_by_linker(c.source)]
    if not found:
        return None
    defined = {name for source in folder.sources for name in _defined(folder, source)}
    for chunk in sorted(found, key=lambda c: c.address):
        name = str(chunk.symbol).partition(".")[0]  # of a clone: name.constprop.0
        if name in defined:
            return Remade(name, str(chunk.source).rpartition("/")[2])
    return None


def refuse_remade(folder: Folder, chunks: Iterable[Chunk]) -> None:
    """Raise UserError with status 1 if the library was optimized at link time.

    A lock that is taken in the middle of another function, or a loop that was joined with another one, would be
    overlooked.
    """
    found = remade(folder, chunks)
    if found is not None:
        what = (
            f"{folder.image_name}: the library was optimized at link time: {found.function}() is in {found.object}, "
            "and not as its source has it"
        )
        hint = "Compile the library without -flto (the application may have it), and link again"
        raise UserError([Diagnostic(what, hint=hint, id="MG-9860")], status=1)


def _defined(folder: Folder, source: str) -> list[str]:
    try:
        text = read_text(folder.path / source, errors="replace", largest=LARGEST_RECORD)
    except OSError:
        return []
    return _DEFINED.findall(text) if source.endswith(".c") else []
