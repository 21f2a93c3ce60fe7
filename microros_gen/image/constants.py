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


def read_constants(text: str) -> dict[str, str]:
    """Return the macros and enumerators of a source without comments, as it has them."""
    found: dict[str, str] = dict(_DEFINED.findall(text))
    for body in _ENUM.findall(text):
        before = "0"
        for part in body.split(","):
            name, is_set, value = map(str.strip, part.partition("="))
            if name:
                before = value if is_set else before
                found[name] = before
                before = f"({before}) + 1"
    return found


def value_of(text: str, constants: Mapping[str, str], depth: int = 0) -> int | None:
    """Return the number that an expression of constants is, or None where it is none, or negative."""
    plain = _NUMBER.sub(
        lambda m: str(int(m[1], 0) if m[1][:2].lower() == "0x" else int(m[1])), _CAST.sub("", text)
    )
    tokens, at = [], 0
    plain = plain.strip()
    while at < len(plain):
        match = _TOKEN.match(plain, at)
        if not match:
            return None
        token, at = match[1], match.end()
        if token[0].isalpha() or token[0] == "_":
            inner = constants.get(token)
            value = value_of(inner, constants, depth + 1) if inner is not None and depth < _DEEPEST else None
            if value is None:
                return None
            token = str(value)
        tokens.append(token)
    try:
        value = _sum(tokens)
    except (IndexError, ValueError, ZeroDivisionError):
        return None
    return value if value >= 0 and not tokens else None


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
