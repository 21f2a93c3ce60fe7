# SPDX-License-Identifier: Apache-2.0
"""Patterns of ROS names: `*` is any text within a part of a name, `**` any text, `?` one character other than `/`."""

from __future__ import annotations

import re
from functools import lru_cache

_TOKENS = re.compile(r"\*\*|\*|\?|[^*?]")
_PATTERN = re.compile(r"(/[A-Za-z0-9_*?]+)+", re.ASCII)
_EXPRESSIONS = {"**": ".*", "*": "[^/]*", "?": "[^/]"}
_SAMPLES = "aZ0_"
"""Characters that a wildcard is tried with, besides those of the patterns."""


def is_pattern(text: str) -> bool:
    """Return whether `text` is a pattern of absolute names."""
    return _PATTERN.fullmatch(text) is not None


def matches(pattern: str, name: str) -> bool:
    """Return whether a pattern fits an absolute name."""
    return _compiled(pattern).fullmatch(name) is not None


def covers(wide: str, narrow: str) -> bool:
    """Return whether each name that fits `narrow` also fits `wide`.

    Both are automata whose states are positions in the pattern. The names are covered if no word leads `narrow` to its
    end and `wide` not; the characters to look at are those in the patterns, `/`, and one that is in neither.
    """
    left, right = _tokens(narrow), _tokens(wide)
    unused = next(c for c in (*_SAMPLES, *map(chr, range(0x100, 0x400))) if c not in wide + narrow)
    alphabet = {"/", unused, *(token for token in (*left, *right) if len(token) == 1 and token not in "*?")}
    start = _closed(left, {0}), _closed(right, {0})
    seen, waiting = {start}, [start]
    while waiting:
        narrow_at, wide_at = waiting.pop()
        if len(left) in narrow_at and len(right) not in wide_at:
            return False
        for character in alphabet:
            following = _step(left, narrow_at, character), _step(right, wide_at, character)
            if following[0] and following not in seen:
                seen.add(following)
                waiting.append(following)
    return True


def _tokens(pattern: str) -> tuple[str, ...]:
    return tuple(_TOKENS.findall(pattern))


def _closed(tokens: tuple[str, ...], places: set[int]) -> frozenset[int]:
    """Return `places`, and those reached by a wildcard that fits an empty text."""
    found = set(places)
    for place in sorted(places):
        while place < len(tokens) and tokens[place] in ("*", "**"):
            place += 1
            found.add(place)
    return frozenset(found)


def _step(tokens: tuple[str, ...], places: frozenset[int], character: str) -> frozenset[int]:
    found = set()
    for place in places:
        token = tokens[place] if place < len(tokens) else ""
        if token == "**" or (token == "*" and character != "/"):
            found.add(place)
        elif token == character or (token == "?" and character != "/"):
            found.add(place + 1)
    return _closed(tokens, found)


@lru_cache(maxsize=4096)
def _compiled(pattern: str) -> re.Pattern[str]:
    return re.compile("".join(_EXPRESSIONS.get(token, re.escape(token)) for token in _tokens(pattern)))
