# SPDX-License-Identifier: Apache-2.0
"""From the text of an .idl file to its syntax tree (`idl.lark`), with every syntax error that can be told apart.

After an error the declaration around it is blanked out and the file is parsed again, so the errors of other
declarations are found in the same run and all places stay what they are.
"""

from __future__ import annotations

import re
from functools import lru_cache

from lark import Lark, Token
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.interfaces.msg.syntax import SyntaxNode
from microros_gen.records import dataclass

_MOST_ERRORS = 20
_ANY_TYPE = "a type"
_NUMBER = "a value"
_WORDS = {
    "BASE": _ANY_TYPE,
    "DOUBLE": _ANY_TYPE,
    "SHORT": _ANY_TYPE,
    "LONG": _ANY_TYPE,
    "UNSIGNED": _ANY_TYPE,
    "STRING_TYPE": _ANY_TYPE,
    "WSTRING_TYPE": _ANY_TYPE,
    "SEQUENCE": _ANY_TYPE,
    "IDENTIFIER": "a name",
    "TRUE": _NUMBER,
    "DECIMAL": _NUMBER,
    "STRING": _NUMBER,
    "INCLUDE": "a declaration",
    "_MODULE": "a declaration",
    "_STRUCT": "a declaration",
    "_CONST": "a declaration",
    "_LESS": "'<'",
    "_GREATER": "'>'",
    "_EQUAL": "'='",
    "_COMMA": "','",
    "_SEMICOLON": "';'",
    "_OPEN": "'{'",
    "_CLOSE": "'}'",
    "_OPEN_SIZE": "'['",
    "_CLOSE_SIZE": "']'",
    "_OPEN_GROUP": "'('",
    "_CLOSE_GROUP": "')'",
    "$END": "the end of the file",
}
_NOT_IN_ROS = {
    "union": "ROS 2 has no unions: declare a struct with a member for each case",
    "interface": "ROS 2 has no interfaces of IDL: declare a service (.srv)",
    "valuetype": "ROS 2 has no value types: declare a struct",
    "bitset": "ROS 2 has no bit sets: use an integer and constants",
    "bitmask": "ROS 2 has no bit masks: use an integer and constants",
    "native": "ROS 2 has no native types",
    "map": "ROS 2 has no maps: use a sequence of a struct with key and value",
}
_LEXEME = re.compile(
    r"//[^\n]*|/\*.*?\*/|L?\"(?:[^\"\\\n]|\\.)*\"|L?'(?:[^'\\\n]|\\.)[^'\n]*'|[ \t]*#[^\n]*|[;{}]|\w+|\s+|.",
    re.DOTALL,
)
_BLOCK_TAIL = re.compile(r"\s*(\w+(\[[^\]]*\])*\s*)?;")


@dataclass(frozen=True)
class Syntax:
    """The tree of a file, and the text of the declarations that were left out as they have a syntax error."""

    tree: SyntaxNode
    lost: str


@dataclass(frozen=True)
class _Error:
    """What the parser met: the place in the text, and the terminals that could stand there."""

    start: int
    end: int
    expected: frozenset[str]


def parse_syntax(source: Source, diagnostics: Diagnostics) -> Syntax | None:
    """Return the tree of `source` with the errors in `diagnostics`; None when nothing could be parsed."""
    text = source.text
    lost = ""
    for _ in range(_MOST_ERRORS):
        try:
            return Syntax(_grammar().parse(text), lost)
        except UnexpectedInput as fault:
            error = _error(fault, text)
        # Missing parts at the end of the file are reported once.
        if error.start < len(source.text) or text == source.text:
            _report(source, text, error, diagnostics)
        start, end, filler = _repair(text, error)
        lost += text[start:end] + "\n"
        repaired = text[:start] + filler + text[end:]
        if repaired == text:
            return None
        text = repaired
    return None


@lru_cache(maxsize=1)
def _grammar() -> Lark:
    """Return the parser of .idl files, built when the first one is read."""
    return Lark.open("idl.lark", rel_to=__file__, parser="lalr", lexer="contextual", maybe_placeholders=False)


def _error(fault: UnexpectedInput, text: str) -> _Error:
    if isinstance(fault, UnexpectedCharacters):
        start = fault.pos_in_stream or 0
        word = re.compile(r"\w+|.", re.DOTALL).match(text, start)
        return _Error(start, word.end() if word else start + 1, frozenset(fault.allowed or ()))
    if isinstance(fault, UnexpectedToken):
        token: Token = getattr(fault, "token")  # noqa: B009 (the stubs of lark-parser lack it)
        expected = frozenset(fault.accepts or fault.expected)
        if token.type == "$END":
            return _Error(len(text), len(text), expected)
        start = token.start_pos or 0
        return _Error(start, start + len(token), expected)
    return _Error(len(text), len(text), frozenset())


def _repair(text: str, error: _Error) -> tuple[int, int, str]:
    """Return the part of `text` to replace and by what: a missing end is added, else a declaration blanked."""
    if error.start >= len(text) and error.expected & {"_SEMICOLON", "_CLOSE"}:
        return len(text), len(text), ";" if "_SEMICOLON" in error.expected else "}"
    before = text[: error.start]
    if _semicolon_is_missing(text, error):
        place = len(before.rstrip())
        return place, place + (text[place] != "\n"), ";"
    start, end = _declaration_around(text, error.start)
    return start, end, re.sub(r"[^\n]", " ", text[start:end])


def _semicolon_is_missing(text: str, error: _Error) -> bool:
    """Return whether a declaration ended with its line, or before a brace, so that only a semicolon is missing."""
    before = text[: error.start]
    gap = before[len(before.rstrip()) :]
    closes = text.startswith("}", error.start) and bool(gap)
    return "_SEMICOLON" in error.expected and ("\n" in gap or closes)


def _declaration_around(text: str, place: int) -> tuple[int, int]:
    """Return where the declaration around `place` begins and ends.

    At the end of a block that is the whole block, unless something stands before it that has no end.
    """
    starts, start = [0], 0
    for match in _LEXEME.finditer(text):
        if match.start() >= place:
            break
        lexeme = match.group()
        if lexeme == "{":
            starts.append(start)
        elif lexeme == "}" and len(starts) > 1:
            starts.pop()
        if lexeme in ("{", "}", ";") or lexeme.lstrip().startswith("#"):
            start = match.end()
    if text.startswith("}", place):
        if text[start:place].strip():
            return start, place
        if len(starts) == 1:
            return place, _end_of_block(text, place + 1)
        return starts[-1], _end_of_block(text, place + 1)
    return start, _end_of_declaration(text, place)


def _end_of_declaration(text: str, place: int) -> int:
    depth = 0
    for match in _LEXEME.finditer(text, place):
        lexeme = match.group()
        if lexeme == "{":
            depth += 1
        elif lexeme == "}":
            if depth == 0:
                return match.start()
            depth -= 1
            if depth == 0:
                return _end_of_block(text, match.end())
        elif depth == 0 and (lexeme == ";" or lexeme.lstrip().startswith("#")):
            return match.end()
    return len(text)


def _end_of_block(text: str, place: int) -> int:
    """Return the end of the semicolon after a brace, with a name between them if there is one."""
    tail = _BLOCK_TAIL.match(text, place)
    return tail.end() if tail else place


def _report(source: Source, text: str, error: _Error, diagnostics: Diagnostics) -> None:
    start, end = error.start, error.end
    if _semicolon_is_missing(text, error):
        start = len(text[:start].rstrip())
        end = start + 1
        message = "expected ';' at the end of the declaration"
        diagnostics.error(message, _span(source, text, start, end), "Add it", id="MG-2055")
        return
    found = text[start:end]
    words = sorted({_WORDS[name] for name in error.expected if name in _WORDS})
    what = f"'{found}'" if found.strip() else "the end of the file"
    message = f"expected {' or '.join(words)}, found {what}" if words else f"{what} is not allowed here"
    diagnostics.error(
        message, _span(source, text, start, end), _hint(text, start, found, error.expected), id="MG-2056"
    )


def _hint(text: str, start: int, found: str, expected: frozenset[str]) -> str | None:
    if found in _NOT_IN_ROS:
        return _NOT_IN_ROS[found]
    if found == "#":
        return 'Of the preprocessor ROS 2 has #include "package/msg/Name.idl" alone'
    if found == ":" and "_OPEN" in expected:
        return "ROS 2 has no inheritance: repeat the members, or use a member of the other type"
    if found in ('"', "'"):
        return "The quote is not closed in its line" if "STRING" in expected else None
    if "IDENTIFIER" in expected and (found[:1] == "_" or not found.isascii()):
        return "A name begins with a letter from A to Z; letters, digits and _ follow"
    if found == "/" and text.startswith("/*", start):
        return "The comment is not closed"
    if found in ("struct", "enum") and "BASE" in expected:
        return "ROS 2 takes no type declared inside of another declaration"
    if found == "}" and "_SEMICOLON" in expected:
        return "The declaration before it ends with ';'"
    if not found and "_CLOSE" in expected:
        return "A brace is not closed"
    return None


def _span(source: Source, text: str, start: int, end: int) -> Span:
    line = text.count("\n", 0, start) + 1
    first = text.rfind("\n", 0, start) + 1
    return Span(source, line, start - first + 1, max(end, start + 1) - first + 1)
