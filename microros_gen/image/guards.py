# SPDX-License-Identifier: Apache-2.0
"""How many elements of a text or sequence generated code handles at most: what it checks itself before it does so.

An encoder refuses what is above its limit: `if (!cdr_fits(text->data, text->size, 40U, …)) { return 0U; }`. What
follows in the same block, or within it, has at most 40 characters. A decoder takes no more elements than the message
has bytes: `cdr_get_size(in, &message->values, …)`; decoders.py says how few they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from microros_gen.records import dataclass

OF_BODY = "MICROROS_INPUT_BUFFER_SIZE + MICROROS_QUEUES_SIZE"
"""Constants of the output: bytes of what is decoded, at most."""
_CHECK = re.compile(r"\bif \(!cdr_fits(?:_bound)?\(")
_TAKE = re.compile(r"\bcdr_get_size\(")
_CALL = re.compile(r"\bcdr_(?:put_\w+|copy)\(")
_NUMBER = re.compile(r"^\(?(\d+)[uU]?\)?$")
_REFUSES = re.compile(r"\)\s*\{\s*return 0U?;\s*\}")
_UNCHANGED = ("->", ".")
_WIDTHS: Mapping[str, int] = {"1": 1, "2": 2, "4": 4, "8": 8, "bool": 1, "double": 8}


@dataclass(frozen=True)
class Written:
    """What one call of a function of microros/cdr.h writes at most: `count` elements, which have `bytes` in all."""

    function: str
    count: int
    bytes: int


class Guards:
    """The checks of a source file; comments and texts in it are blank."""

    def __init__(self, plain: str) -> None:
        """Take a source as `rounds.Source.plain` has it."""
        self._text = plain
        self._starts = [0, *(match.end() for match in re.finditer("\n", plain))]

    def limit(self, size: str, line: int) -> int | str | None:
        """Return what `size` is at most in a line, as a number or constants of the output; None: nothing checks it."""
        return self._limit(size.strip(), self._starts[line - 1])

    def written(self, line: int) -> Written | None:
        """Return what the call in a line writes, or None where it is none that is known."""
        if not 0 < line <= len(self._starts):
            return None
        begin = max(self._text.rfind(sign, 0, self._starts[line - 1]) for sign in ";{}") + 1
        end = self._text.find(";", self._starts[line - 1])
        found = list(self._calls(begin, end if end >= 0 else len(self._text)))
        return found[0] if len(found) == 1 else None

    def largest(self, function: str) -> Written | None:
        """Return what a call of `function` writes at most, whichever of this file; None: one of them is not known.

        Functions that others of microros/cdr.h call, too, write what any call of this file does. The most elements and
        the most bytes may be those of two calls.
        """
        calls = list(self._calls(0, len(self._text)))
        own = [call for call in calls if call is not None and call.function == function]
        is_outer = function.startswith(
            ("cdr_put_string", "cdr_put_wstring", "cdr_put_sequence", "cdr_put_packed")
        )
        chosen = [call for call in calls if call is None or not is_outer or call.function == function]
        if (not own and is_outer) or not chosen or any(call is None for call in chosen):
            return None
        known = [call for call in chosen if call is not None]
        return Written(function, max(call.count for call in known), max(call.bytes for call in known))

    def _calls(self, begin: int, end: int) -> Iterator[Written | None]:
        for match in _CALL.finditer(self._text, begin, end):
            name = match[0][:-1]
            arguments = _arguments(self._text, match.end())
            written = self._written(name, arguments, match.start())
            if written is not None or _varies(name):
                yield written

    def _written(self, name: str, arguments: list[str], at: int) -> Written | None:
        kind = name.rpartition("_")[2]
        if name.startswith("cdr_put_packed"):
            element = _NUMBER.match(arguments[-1])
            return self._counted(name, arguments[-2], int(element[1]), at) if element else None
        if name in ("cdr_put_string", "cdr_copy", "cdr_put_zeros"):
            return self._counted(name, arguments[-1], 1, at)
        if name == "cdr_put_wstring":
            return self._counted(name, arguments[-1], 4, at)
        if name.startswith(("cdr_put_sequence_", "cdr_put_array_")) and kind in _WIDTHS:
            return self._counted(name, arguments[-1], _WIDTHS[kind], at)
        return None

    def _counted(self, name: str, count: str, width: int, at: int) -> Written | None:
        limit = self._limit(count, at)
        return Written(name, limit, limit * width) if isinstance(limit, int) else None

    def _limit(self, size: str, at: int) -> int | str | None:
        number = _NUMBER.match(size)
        if number:
            return int(number[1])
        if not any(sign in size for sign in _UNCHANGED):
            return None
        around = self._blocks(at)
        begin, found = around[0] if around else 0, None
        for match in _CHECK.finditer(self._text, begin, at):
            arguments = _arguments(self._text, match.end())
            limit = _NUMBER.match(arguments[2]) if len(arguments) > 2 else None
            refuses = _REFUSES.match(self._text, _end(self._text, match.end()))
            if limit and refuses and arguments[1] == size and self._is_before(match.start(), around):
                found = int(limit[1])
        for match in _TAKE.finditer(self._text, begin, at):
            arguments = _arguments(self._text, match.end())
            taken = f"{arguments[1].removeprefix('&')}.size"
            if taken == size and arguments[0] == "in" and self._is_before(match.start(), around):
                return OF_BODY
        return found

    def _is_before(self, at: int, around: tuple[int, ...]) -> bool:
        """Return whether what is at a place was done before what is later in the blocks `around`."""
        blocks = self._blocks(at)
        return blocks == around[: len(blocks)]

    def _blocks(self, at: int) -> tuple[int, ...]:
        """Return where the blocks around a place begin, that of its function first."""
        first = self._text.rfind("\n{", 0, at) + 1
        found: list[int] = []
        for match in re.finditer(r"[{}]", self._text[first:at]):
            if match[0] == "{":
                found.append(first + match.start())
            elif found:
                found.pop()
        return tuple(found)


def _varies(name: str) -> bool:
    """Return whether a call of a function may write a number of bytes that its name does not have."""
    return not re.fullmatch(r"cdr_put_(?:[1248]|bool|double|length)", name)


def _end(text: str, begin: int) -> int:
    """Return where the parenthesis ends that was opened before `begin`."""
    depth, at = 1, begin
    while depth and at < len(text):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        at += 1
    return at


def _arguments(text: str, begin: int) -> list[str]:
    """Return the arguments of a call whose parenthesis was opened before `begin`."""
    found, depth, last = list[str](), 0, begin
    for at in range(begin, _end(text, begin)):
        sign = text[at]
        if depth == 0 and sign in ",)":
            found.append(" ".join(text[last:at].split()))
            last = at + 1
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(sign, 0)
    return found
