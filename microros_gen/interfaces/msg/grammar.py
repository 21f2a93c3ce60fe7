# SPDX-License-Identifier: Apache-2.0
"""Any declaration of a .msg file, read by the grammar `msg.lark`, and what is wrong with one that it refuses."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from lark import Lark, Token
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.msg.declarations import Line
from microros_gen.interfaces.msg.syntax import Node, Word

_WORDS = {
    "PRIMITIVE": "a type",
    "STRING": "a type",
    "TYPE_NAME": "a type",
    "NAME": "a name",
    "BOUND": "a number above zero",
    "TEXT": "a value",
    "NUMBER": "a value",
    "QUOTED": "a string",
    "BARE": "a string",
    "_GAP": "a space",
    "_EQUAL": "'='",
    "_AT_MOST": "'<='",
    "_SLASH": "'/'",
    "_OPEN": "'['",
    "_CLOSE": "']'",
    "_LAST_CLOSE": "']'",
    "_COMMA": "','",
    "$END": "the end of the line",
}
_SEQUENCES = ("sequence", "vector", "list")
"""Sequences of IDL and C++: `sequence<T>`, `std::vector<T>`."""
_BOUNDED_TEXT = re.compile(r"(w?string)(?:<=|<) *([0-9]+) *>? *")


def parse(text: str) -> Node | None:
    """Return the syntax of a declaration; None where the grammar refuses it."""
    try:
        tree: Any = _grammar().parse(text)
    except UnexpectedInput:
        return None
    return _node(tree)


def _node(tree: Any) -> Node:
    """Return lark's tree without lark."""
    return Node(
        tree.data,
        tuple(
            Word(part, part.column or 1) if isinstance(part, Token) else _node(part) for part in tree.children
        ),
    )


@lru_cache(maxsize=1)
def _grammar() -> Lark:
    """Return the parser of one declaration, built when the first one is read."""
    return Lark.open("msg.lark", rel_to=__file__, parser="lalr", lexer="contextual", maybe_placeholders=False)


def report_syntax(line: Line, diagnostics: Diagnostics) -> None:
    """Report where a line leaves the grammar, and what could be there."""
    try:
        _grammar().parse(line.text)
    except UnexpectedInput as fault:
        _report(line, fault, diagnostics)


def _report(line: Line, fault: UnexpectedInput, diagnostics: Diagnostics) -> None:
    expected: set[str] = set()
    column = len(line.text) + 1
    if isinstance(fault, UnexpectedCharacters):
        expected, column = set(fault.allowed or ()), fault.column
    elif isinstance(fault, UnexpectedToken):
        expected = set(fault.accepts or fault.expected)
        token: Token = getattr(fault, "token")  # noqa: B009 (the stubs of lark-parser lack it)
        if token.type != "$END":
            column = token.column or column
    found = line.text[column - 1 : column]
    if column == 1 and found == " ":
        span = line.span(1, len(line.text) - len(line.text.lstrip()) + 1)
        diagnostics.error(
            "a declaration begins in the first column", span, "Remove the space before it", id="MG-2022"
        )
        return
    words = sorted({_WORDS[name] for name in expected if name in _WORDS})
    what = {"": "the end of the line", " ": "a space"}.get(found, f"'{found}'")
    diagnostics.error(
        f"expected {' or '.join(words)}, found {what}",
        line.span(column, column + 1),
        _syntax_hint(line.text, column, expected),
        id="MG-2023",
    )


def _syntax_hint(text: str, column: int, expected: set[str]) -> str | None:
    before, rest = text[: column - 1], text[column - 1 :]
    if text.startswith("//"):
        return f"A comment begins with '#': write '#{text.lstrip('/')}'"
    if text.strip("-") == "":
        return "Remove the line: only services (.srv) and actions (.action) have parts"
    corrected = _without_spaces(text, column) or _bounded_text(text)
    if corrected is not None:
        return f"Write '{corrected}'"
    if expected == {"BOUND"}:
        return f"For example '{before}10{rest or ' name'}'"
    if expected == {"_GAP"} and rest[:1].isalpha():
        return f"Write '{before} {rest}'"
    if not rest and " " not in text:
        return "A field is written 'type name', a constant 'type NAME=value'"
    return _extent_hint(before, rest, expected)


def _without_spaces(text: str, column: int) -> str | None:
    """Return a declaration without the spaces of the size that has `column`; None if it has none, or other faults."""
    opening, closing = text.rfind("[", 0, column), text.find("]", column - 1)
    if opening < 0 or closing < 0:
        return None
    corrected = f"{text[:opening]}{text[opening:closing].replace(' ', '')}{text[closing:]}"
    return corrected if corrected != text and parse(corrected) is not None else None


def _bounded_text(text: str) -> str | None:
    """Return the declaration of a string whose bound is written with spaces, or as IDL has it: `string<10>`."""
    found = _BOUNDED_TEXT.match(text)
    corrected = f"{found[1]}<={found[2]} {text[found.end() :]}" if found is not None else ""
    return corrected if found is not None and parse(corrected) is not None else None


def _extent_hint(before: str, rest: str, expected: set[str]) -> str | None:
    """Return the hint for a line that leaves the grammar at a size, a bound or a default."""
    if expected == {"_GAP"} and rest.startswith("["):
        return "An array has one dimension; put the second one into a separate message"
    if expected == {"_OPEN"}:
        return "The default of an array is written '[1, 2]'"
    if "_AT_MOST" in expected and rest.startswith(" "):
        return f"Write '{before}]{rest}'"
    if "_GAP" in expected and rest.startswith("<="):
        return "Only strings have a bound here, written 'string<=10'; that of a sequence is 'type[<=10]'"
    if "_GAP" in expected and rest.startswith("<") and before.rpartition(":")[2] in _SEQUENCES:
        return "A sequence is written 'type[]', one of at most 10 elements 'type[<=10]'"
    if "QUOTED" in expected and rest[:1] in ("'", '"'):
        return "The quote is not closed"
    return None
