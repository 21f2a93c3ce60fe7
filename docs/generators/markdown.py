# SPDX-License-Identifier: Apache-2.0
"""Plain text to Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

_CODE = re.compile(r"(`[^`\n]+`)")
_IDENTIFIER = re.compile(r"(?<![\w/.:-])(--[a-z][a-z-]*|[A-Za-z][\w/.]*_[\w/.]*\w(?:\(\))?)(?!\w)")

_ENTITIES = str.maketrans({"<": "&lt;", ">": "&gt;", "|": "&#124;", "{": "&#123;", "}": "&#125;"})
_MARKS = {c: f"&#{ord(c)};" for c in "\\*_[]<>&|{}"}


def cell(text: str) -> str:
    """Return `text` on one line, with identifiers as code and what Markdown would read as marks escaped."""
    joined = " ".join(text.split())
    return "".join(_code(part) if part.startswith("`") else _plain(part) for part in _CODE.split(joined))


def _code(span: str) -> str:
    """Return a code span; one with braces as HTML, for what reads Markdown takes them as attributes."""
    if "{" not in span:
        return span
    return f"<code>{''.join(_MARKS.get(c, c) for c in span[1:-1])}</code>"


def _plain(text: str) -> str:
    chunks = _IDENTIFIER.split(text)
    for i, chunk in enumerate(chunks):
        chunks[i] = f"`{chunk}`" if i % 2 else re.sub(r"([\\*_\[\]])", r"\\\1", chunk).translate(_ENTITIES)
    return "".join(chunks)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; cells are Markdown already."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
