# SPDX-License-Identifier: Apache-2.0
"""The constants of C sources, and the numbers that expressions of them are: with `+ - * /` and parentheses."""

from __future__ import annotations

import re
from collections.abc import Mapping

_DEFINED = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+([^\n]+?)[ \t]*$", re.MULTILINE)
_ENUM = re.compile(r"\benum\b[^{;()]*\{([^}]*)\}")
_CAST = re.compile(r"\(\s*(?:u?int(?:8|16|32|64)_t|size_t|int)\s*\)")
_NUMBER = re.compile(r"\b(0[xX][0-9a-fA-F]+|\d+)[uUlL]*\b")
_TOKEN = re.compile(r"\s*(\d+|\w+|[-+*/()])")
_DEEPEST = 16
UNKNOWN = "?"
"""The value of a constant that has several: no expression."""


def read_constants(text: str) -> dict[str, str]:
    """Return the macros and enumerators of a source without comments, as it has them.

    A macro that has several values, of which `#if` chooses one, has none that is known.
    """
    found: dict[str, str] = {}
    for name, value in _DEFINED.findall(text):
        found[name] = value if found.get(name, value) == value else UNKNOWN
    for body in _ENUM.findall(text):
        before = "0"
        for part in body.split(","):
            name, is_set, value = map(str.strip, part.partition("="))
            if name:
                before = value if is_set else before
                found[name] = f"({before})"
                before = f"({before}) + 1"
    return found


def value_of(text: str, constants: Mapping[str, str]) -> int | None:
    """Return the number that an expression of constants is, or None where it is none, or negative."""
    tokens = _tokens(text, constants, 0)
    if tokens is None:
        return None
    try:
        value = _sum(tokens)
    except (IndexError, ValueError, ZeroDivisionError):
        return None
    return value if value >= 0 and not tokens else None


def _tokens(text: str, constants: Mapping[str, str], depth: int) -> list[str] | None:
    """Return an expression without names: the text of a macro takes the place of its name, as the compiler reads it."""
    plain = _NUMBER.sub(lambda m: str(_number(m[1])), _CAST.sub("", text)).strip()
    tokens, at = list[str](), 0
    while at < len(plain):
        match = _TOKEN.match(plain, at)
        if not match:
            return None
        token, at = match[1], match.end()
        if token[0].isalpha() or token[0] == "_":
            inner = constants.get(token) if depth < _DEEPEST else None
            of_name = _tokens(inner, constants, depth + 1) if inner is not None else None
            if of_name is None:
                return None
            tokens += of_name
        else:
            tokens.append(token)
    return tokens


def _number(text: str) -> int:
    """Return a number of C: hexadecimal, octal or decimal."""
    if text[:2].lower() == "0x":
        return int(text, 16)
    return int(text, 8) if re.fullmatch("0[0-7]+", text) else int(text)


def _sum(tokens: list[str]) -> int:
    value = _product(tokens)
    while tokens and tokens[0] in "+-":
        sign = 1 if tokens.pop(0) == "+" else -1
        value += sign * _product(tokens)
    return value


def _product(tokens: list[str]) -> int:
    value = _atom(tokens)
    while tokens and tokens[0] in "*/":
        if tokens.pop(0) == "*":
            value *= _atom(tokens)
        else:
            value //= _atom(tokens)
    return value


def _atom(tokens: list[str]) -> int:
    token = tokens.pop(0)
    if token == "(":
        value = _sum(tokens)
        if tokens.pop(0) != ")":
            raise ValueError
        return value
    return int(token)
