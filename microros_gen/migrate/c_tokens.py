# SPDX-License-Identifier: Apache-2.0
"""C and C++ text → tokens with places. It is no compiler: macros are not expanded, both sides of an `#if` are read.

Omitted: comments, directives (their macros and conditions are kept), and code in `#if 0`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import field

from microros_gen.diagnostics import Source, Span, reads
from microros_gen.documents.python_literal import python_literal
from microros_gen.records import dataclass

_TOKEN = re.compile(
    r"""
    (?P<space>[ \t\r\f\v\n]+ | \\\r?\n)
  | (?P<comment>//(?:\\\r?\n|[^\n])* | /\*.*?(?:\*/|\Z))
  | (?P<raw>(?:u8|[uUL])?R"(?P<fence>[^()\s\\]{0,16})\(.*?\)(?P=fence)")
  | (?P<string>(?:u8|[uUL])?"(?:[^"\\\n]|\\.)*")
  | (?P<char>[uUL]?'(?:[^'\\\n]|\\.)+')
  | (?P<number>\.?[0-9](?:[eEpP][-+]|'(?=[0-9A-Fa-f])|[0-9A-Za-z_.])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<punct>->|::|\+\+|--|<<=|>>=|<<|>>|[-+*/%&|^<>=!]=|&&|\|\||\.\.\.|.)
    """,
    re.VERBOSE | re.DOTALL,
)
_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(?P<word>\w+)(?P<rest>(?:\\\r?\n|/\*.*?\*/|[^\n])*)", re.DOTALL)
_DEFINE = re.compile(r"\s*(?P<name>\w+)(?P<arguments>\()?(?P<body>.*)", re.DOTALL)


@dataclass(frozen=True)
class Token:
    """A token: `kind` is name, number, string, char or punct; `condition` is the innermost `#if` that it stands in."""

    kind: str
    text: str
    source: Source = field(repr=False)
    line: int
    column: int
    condition: str = ""

    @property
    def span(self) -> Span:
        """Its place."""
        return Span(self.source, self.line, self.column, self.column + len(self.text))

    def string(self) -> str:
        """Return what a string token means; escapes that Python and C have in common are resolved."""
        inner = self.text[self.text.index('"') + 1 : -1]
        if "R" in self.text[: self.text.index('"')]:
            return inner[inner.index("(") + 1 : inner.rindex(")")]
        try:
            return str(python_literal(f'"{inner}"'))
        except ValueError:
            return inner


@dataclass(frozen=True)
class Macro:
    """`#define name body`; `has_arguments`: it is like a function, and its body is not looked into."""

    name: str
    body: tuple[Token, ...]
    has_arguments: bool
    span: Span


@dataclass(frozen=True)
class Include:
    """A header that is included, by its name between the quotes or angle brackets; `condition`: it is in an `#if`."""

    name: str
    span: Span
    condition: str = ""


@dataclass(frozen=True)
class CText:
    """One file: its tokens and macros in their order, and what it includes."""

    source: Source
    tokens: tuple[Token, ...]
    macros: tuple[Macro, ...]
    includes: tuple[Include, ...]


@reads
def read_c(source: Source) -> CText:
    """Return the tokens of a file; any text can be read."""
    reader = _Reader(source)
    tokens = tuple(reader.read())
    return CText(source, tokens, tuple(reader.macros), tuple(reader.includes))


class _Reader:
    """Goes through one file."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._text = source.text.replace("\t", " ")
        self._conditions: list[str] = []
        self._guards: set[str] = set()
        self.macros: list[Macro] = []
        self.includes: list[Include] = []

    def read(self) -> Iterator[Token]:
        position, line, line_start = 0, 1, True
        begins = 0
        while position < len(self._text):
            directive = _DIRECTIVE.match(self._text, position) if line_start else None
            match = directive or _TOKEN.match(self._text, position)
            assert match is not None  # the last alternative takes any character
            kind = "directive" if directive else str(match.lastgroup if match.lastgroup != "fence" else "raw")
            if directive:
                self._directive(directive["word"], directive["rest"], line)
            elif kind not in ("space", "comment") and "0" not in self._conditions:
                yield self._token(kind, match.group(), line, position - begins + 1)
            text = match.group()
            if "\n" in text:
                line += text.count("\n")
                begins = position + text.rindex("\n") + 1
            line_start = (
                "\n" in text if kind == "space" else (line_start and kind == "comment") or kind == "directive"
            )
            position = match.end()

    def _token(self, kind: str, text: str, line: int, column: int) -> Token:
        return Token("string" if kind == "raw" else kind, text, self._source, line, column, self._innermost())

    def _innermost(self) -> str:
        return next((c for c in reversed(self._conditions) if c), "")

    def _directive(self, word: str, rest: str, line: int) -> None:
        rest = re.sub(r"/\*.*?\*/|//[^\n]*|\\\r?\n", " ", rest, flags=re.DOTALL).strip()
        if word in ("if", "ifdef", "ifndef"):
            self._conditions.append(self._condition(word, rest))
        elif word in ("elif", "else", "elifdef", "elifndef") and self._conditions:
            left = self._conditions.pop()
            self._conditions.append("" if left == "0" and word == "else" else f"#{word} {rest}".strip())
        elif word == "endif" and self._conditions:
            self._conditions.pop()
        elif word == "define" and "0" not in self._conditions:
            self._define(rest, line)
        elif word == "include" and "0" not in self._conditions:
            self.includes.append(Include(rest.strip('<>"'), Span(self._source, line, 1), self._innermost()))

    def _condition(self, word: str, rest: str) -> str:
        """Return how a condition is shown: `0` for what is never compiled, nothing for the guard of a header."""
        if word == "if" and rest == "0":
            return "0"
        if word == "ifndef" and re.search(rf"#\s*define\s+{re.escape(rest)}\b", self._text):
            return ""
        return "" if rest in ("__cplusplus", "defined(__cplusplus)", "1") else f"#{word} {rest}"

    def _define(self, rest: str, line: int) -> None:
        match = _DEFINE.match(rest)
        if match:
            body = tuple(t for t in read_c(Source(self._source.name, match["body"])).tokens)
            placed = tuple(Token(t.kind, t.text, self._source, line, 1) for t in body)
            self.macros.append(
                Macro(match["name"], placed, bool(match["arguments"]), Span(self._source, line, 1))
            )
