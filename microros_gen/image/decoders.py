# SPDX-License-Identifier: Apache-2.0
"""How few bytes of a message generated decoders read: each round of a loop reads that many, so few rounds are enough.

After `cdr_get_size(in, &message->values, …)` a loop over `message->values.size` goes round at most once for each
element that the bytes have room for. A round in which an element is refused does not come back.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

_DECODER = re.compile(
    r"^void (\w+__decode)\(cdr_in_t \* in, void \* untyped\)\s*\{(.*?)^\}", re.MULTILINE | re.DOTALL
)
_CALL = re.compile(r"\b(cdr_get_\w+|\w+__decode)\(\s*in,")
_COUNT = re.compile(r"^\s*\d+[uU]?\s*$")
_FIXED = re.compile(r"\bfor \(size_t i = 0U; i < (\d+)U; \+\+i\) ")
_BLOCK = re.compile(r"\b(?:for|while|if|else|switch|do)\b")
_STOPS = re.compile(r"\bif \(in->failed\) \{[^{}]*\breturn;\s*\}")
_LENGTH = 4
"""Bytes of the length of a string or sequence (OMG CDR, 9.3.2.7)."""
_WIDTHS = {"1": 1, "2": 2, "4": 4, "8": 8, "bool": 1, "double": 8, "strings": _LENGTH, "wstrings": _LENGTH}
_DEEPEST = 64


def least_of(function: str) -> int:
    """Return how many bytes a function of microros/cdr_decode.h reads at least, whatever its arguments; 0: unknown.

    For these bytes it does the same, however long the rest is.
    """
    kind = function.removeprefix("cdr_get_")
    return _LENGTH if kind in ("size", "string", "wstring") or kind.startswith("sequence_") else 0


class Decoders:
    """The generated decoders of an output."""

    def __init__(self, sources: Iterable[str] = ()) -> None:
        """Take the texts of their sources, without comments."""
        self._bodies: Mapping[str, str] = {m[1]: m[2] for text in sources for m in _DECODER.finditer(text)}

    def least(self, body: str, depth: int = 0) -> int:
        """Return how many bytes the statements of a block read at least, if none of them is refused; 0: unknown.

        Calls in branches and in loops over sequences count as nothing.
        """
        total, at = 0, 0
        while at < len(body) and depth < _DEEPEST:
            call, block = _CALL.search(body, at), _BLOCK.search(body, at)
            if block is not None and (call is None or block.start() < call.start()):
                fixed = _FIXED.match(body, block.start())
                begin, end = _braces(body, block.end())
                if fixed is not None:
                    total += int(fixed[1]) * self.least(body[begin:end], depth + 1)
                at = end
            elif call is not None:
                total += self._of_call(call[1], body, call.end(), depth)
                at = call.end()
            else:
                break
        return total

    @staticmethod
    def stops(body: str) -> bool:
        """Return whether the round of a loop in which an element is refused is its last one."""
        calls = [match.end() for match in _CALL.finditer(body)]
        return bool(calls) and _STOPS.search(body, calls[-1]) is not None

    def _of_call(self, name: str, body: str, at: int, depth: int) -> int:
        if name.endswith("__decode"):
            inner = self._bodies.get(name)
            return self.least(inner, depth + 1) if inner is not None else 0
        kind = name.removeprefix("cdr_get_")
        if least_of(name):
            return least_of(name)
        arguments = _rest(body, at).split(",")
        place = -3 if kind in ("strings", "wstrings") else -2  # before the bound of each, or before the field
        counted = len(arguments) >= -place and _COUNT.match(arguments[place])
        return _WIDTHS.get(kind, 0) * int(arguments[place].strip(" \n\tuU")) if counted else 0


def _rest(body: str, at: int) -> str:
    """Return the arguments of a call from a place on; those of generated calls after `to` have no parentheses."""
    depth, end = 1, at
    while depth and end < len(body):
        depth += {"(": 1, ")": -1}.get(body[end], 0)
        end += 1
    return body[at : end - 1]


def _braces(body: str, at: int) -> tuple[int, int]:
    """Return the block after a place, without its braces; a statement without any ends where the text does."""
    begin = body.find("{", at)
    if begin < 0:
        return len(body), len(body)
    depth = 0
    for end in range(begin, len(body)):
        depth += {"{": 1, "}": -1}.get(body[end], 0)
        if depth == 0:
            return begin + 1, end
    return len(body), len(body)
