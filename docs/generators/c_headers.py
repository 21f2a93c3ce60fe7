# SPDX-License-Identifier: Apache-2.0
"""Reads the C headers of the components as this project formats them: a comment, and below it what it is of.

A group ends at a blank line outside of braces. A comment with a blank line below it is of the whole file or of the part
that follows.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_SKIPPED = re.compile(
    r"#\s*(ifdef|ifndef|endif|include|if|else|undef)\b.*|extern \"C\" \{|/\* clang-format o(n|ff) \*/|/\* SPDX-.*|"
    r"#define MICROROS_\w+_H"
)
_SECTION = re.compile(r"/\* --- (.*) --- \*/")
_NAMES = (
    re.compile(r"^#define (\w+)"),
    re.compile(r"^typedef [^;{}]*\(\*\s*(\w+)\)", re.DOTALL),
    re.compile(r"^\} (\w+);", re.MULTILINE),
    re.compile(r"^typedef [^;{}()]*?(\w+);", re.DOTALL),
    re.compile(r"^typedef enum \{[^}\n]*\} (\w+);"),
    re.compile(r"^(?:enum|struct) (\w+) \{"),
    re.compile(r"^static const \w+ (\w+) ="),
    re.compile(r"^(?:enum|typedef enum) \{ ?(\w+)[ ,=].*\}", re.DOTALL),
    re.compile(r"^(?!typedef|#|\}| |enum|struct \w+ \{)[\w *]+?\b(\w+)\((?!\*)"),
)


@dataclass(frozen=True)
class Item:
    """Declarations that belong together, and what the comment above them says ("" for none)."""

    text: str
    doc: str
    names: tuple[str, ...]


@dataclass(frozen=True)
class Section:
    """Items below a remark; the first section's `title` is empty and its `remark` is of the whole header."""

    title: str
    remark: str
    items: tuple[Item, ...] = field(default=())


def read_header(text: str) -> list[Section]:
    """Return the sections of a header."""
    sections: list[tuple[str, list[str], list[Item]]] = [("", [], [])]
    for comment, code in _groups(text):
        if found := _SECTION.fullmatch(comment.strip()):
            sections.append((found[1], [], []))
        elif code:
            sections[-1][2].append(Item(code, comment_text(comment), tuple(_names(code))))
        elif comment:
            sections[-1][1].append(comment_text(comment))
    return [Section(title, "\n\n".join(remarks), tuple(items)) for title, remarks, items in sections]


def comment_text(comment: str) -> str:
    """Return what a comment says, without its marks."""
    lines = [re.sub(r"^\s*(/\*|\*/|\*)? ?", "", line) for line in comment.replace("*/", "").splitlines()]
    return "\n".join(lines).strip()


def _groups(text: str) -> Iterator[tuple[str, str]]:
    """Yield (comment, declarations) of each group; one of the two may be empty."""
    comment: list[str] = []
    code: list[str] = []
    depth, in_comment, goes_on = 0, False, False
    for line in [*text.splitlines(), ""]:
        starts = not code and not in_comment and line.startswith("/*")
        if starts and comment and not _SKIPPED.fullmatch(line):
            yield "\n".join(comment), ""
            comment = []
        if not code and not in_comment and not starts and _is_skipped(line):
            continue
        if starts and _SKIPPED.fullmatch(line):
            continue
        if starts or in_comment:
            comment.append(line)
            in_comment = "*/" not in line
        elif line.strip() or depth > 0 or goes_on:
            code.append(line)
            depth += line.count("{") - line.count("}")
            goes_on = line.endswith("\\")
        else:
            if comment or code:
                yield "\n".join(comment), "\n".join(code)
            comment, code = [], []


def _is_skipped(line: str) -> bool:
    return bool(_SKIPPED.fullmatch(line)) or line == "}"


def _names(code: str) -> Iterator[str]:
    seen = set()
    for part in _declarations(code):
        for pattern in _NAMES:
            for found in pattern.findall(part):
                if found not in seen:
                    seen.add(found)
                    yield found
            if pattern.search(part):
                break


def _declarations(code: str) -> Iterator[str]:
    """Yield each declaration of a group, comments inside left out."""
    part: list[str] = []
    depth = 0
    for line in re.sub(r" */\*.*?\*/", "", code, flags=re.DOTALL).splitlines():
        part.append(line)
        depth += line.count("{") - line.count("}")
        ends = (
            not line.endswith("\\") if part[0].startswith("#") else depth == 0 and line.endswith((";", "}"))
        )
        if ends:
            yield "\n".join(part)
            part = []
    if part:
        yield "\n".join(part)
