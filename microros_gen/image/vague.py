# SPDX-License-Identifier: Apache-2.0
"""Where a source does not tell which loop an instruction is of, or whose comment counts: there nothing has a bound.

The line of an instruction says which loop it is of. It does not where two loops begin in one line, where a macro is
a loop or may be one, and where a `goto` goes back. And of two functions with the same code the compiler may keep one
for both: the lines are those of one, while the comments of both hold for their own callers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from microros_gen.records import dataclass

_DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\\\n]|\\\n|\\.)*", re.MULTILINE)
_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)((?:[^\\\n]|\\\n|\\.)*)", re.MULTILINE)
_ONCE = re.compile(r"\bdo\b|\bwhile\s*\(\s*(?:0|false)\s*\)")
_REPEATS = re.compile(r"\b(?:for|while|goto)\b")
_GOTO = re.compile(r"\bgoto\s+(\w+)\s*;")
_BODY = re.compile(r"^\w[^;{}=()]*?\b\w+\([^;{}]*\)\s*\{", re.MULTILINE)
_TOKEN = re.compile(r"[A-Za-z_]\w*|\d\w*|[^\s\w]")
_STATED = re.compile(r"/\* at most (?:[^*]|\*(?!/))*\*/[^\n]*")

_TAKES_ARGUMENTS = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)\(", re.MULTILINE)
_INVOKED = re.compile(r"\b([A-Za-z_]\w*)\s*\(")
_NAME = re.compile(r"\b[A-Za-z_]\w*")
_UPPER = re.compile(r"[A-Z][A-Z0-9_]+")
_CONSTANT = re.compile(r"U?INT(?:8|16|32|64|MAX)_C")
_KEYWORDS = frozenset({"do", "else", "for", "if", "return", "sizeof", "switch", "while"})

Lines = tuple[int, int]
"""The first and the last of some lines."""


def without_directives(text: str) -> str:
    """Return a source with blanks in place of what is for the preprocessor, and the same lines."""
    return _DIRECTIVE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def loop_macros(text: str) -> frozenset[str]:
    """Return the macros of a source without comments that repeat something, but for `do { … } while (0)`."""
    return frozenset(name for name, body in _MACRO.findall(text) if _REPEATS.search(_ONCE.sub("", body)))


@dataclass(frozen=True)
class Macros:
    """The macros of sources: `loops` repeat something, `plain` ones have arguments and repeat nothing."""

    loops: frozenset[str] = frozenset()
    plain: frozenset[str] = frozenset()

    def with_those(self, texts: Iterable[str]) -> Macros:
        """Return these macros and those of further texts."""
        loops, taking = set(self.loops), set(self.plain)
        for text in texts:
            loops |= loop_macros(text)
            taking.update(_TAKES_ARGUMENTS.findall(text))
        return Macros(frozenset(loops), frozenset(taking - loops))

    def may_repeat(self, text: str) -> bool:
        """Return whether part of a source may have a loop of a macro.

        A macro of a header that is not read, as SLIST_FOREACH, is in upper case, or a block or a statement follows it
        without a semicolon.
        """
        if not self.loops.isdisjoint(_NAME.findall(text)):
            return True
        for match in _INVOKED.finditer(text):
            name = match[1]
            if name in _KEYWORDS or name in self.plain or _CONSTANT.fullmatch(name):
                continue
            if _UPPER.fullmatch(name) or re.match(r"\s*[\w{]", text[_after(text, match.end()) :]):
                return True
        return False


NO_MACROS = Macros()


def _after(text: str, begin: int) -> int:
    """Return where the parenthesis ends that was opened before `begin`."""
    depth, at = 1, begin
    while depth and at < len(text):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        at += 1
    return at


def circles(text: str) -> Iterator[Lines]:
    """Yield from where to where each `goto` of a source without comments goes back."""
    for match in _GOTO.finditer(text):
        begin = text.rfind("\n{", 0, match.start()) + 1
        label = re.search(rf"\b{match[1]}\s*:(?!:)", text[begin : match.start()])
        if label:
            yield line_at(text, begin + label.start()), line_at(text, match.start())


def contradicted(text: str, plain: str) -> Iterator[Lines]:
    """Yield the functions of which another one has the same code but other comments; `plain` lacks the comments."""
    found: dict[str, list[tuple[Lines, list[str]]]] = {}
    rows = text.splitlines()
    for match in _BODY.finditer(plain):
        end = plain.find("\n}", match.end())
        lines = (line_at(plain, match.start()), line_at(plain, end if end >= 0 else len(plain)))
        comments = _STATED.findall("\n".join(rows[lines[0] - 1 : lines[1]]))
        found.setdefault(_code(plain[match.end() : end]), []).append((lines, comments))
    for same in found.values():
        if any(comments != same[0][1] for _, comments in same):
            yield from (lines for lines, _ in same)


def line_at(text: str, at: int) -> int:
    """Return the number of the line, from 1, with the character at an index."""
    return text.count("\n", 0, at) + 1


def _code(body: str) -> str:
    """Return a body whose names are numbers: what the compiler makes of it may be equal where these are."""
    names: dict[str, str] = {}
    tokens = (
        names.setdefault(token, f"n{len(names)}") if token[0].isalpha() or token[0] == "_" else token
        for token in _TOKEN.findall(body)
    )
    return " ".join(tokens)
