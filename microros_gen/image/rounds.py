# SPDX-License-Identifier: Apache-2.0
"""The largest number of rounds of a loop, and of bytes of a copy, as the source says it.

A loop says it itself, as in `for (i = 0; i < MICROROS_TASKS; ++i)`, or a comment does, at its line or on a separate
one before it: `/* at most MICROROS_TASKS rounds */`, and for a call `/* at most MICROROS_MTU bytes */`. Numbers are
constants of the output, with `+ - * /` and parentheses; of `A or B` the first that the output has. `size of NAME` is
the third argument of that function, where its caller has a constant. Where few of the rounds of a loop reach a call, a
comment at it says so: `/* at most MICROROS_MTU / 12 calls */`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache

from microros_gen.image.guards import Guards, Written
from microros_gen.records import dataclass

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_TEXT = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'')
_LOOP = re.compile(r"\b(for|while|do)\b")
_COUNTED = re.compile(r"^[^;]*\b(\w+) = 0[uU]?;\s*(\w+) < ((?:[^;&|?<>]|->)+);\s*(?:\+\+(\w+)|(\w+)\+\+)\s*$")
_DEFINED = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+([^\n]+?)[ \t]*$", re.MULTILINE)
_ENUM = re.compile(r"\benum\b[^{;()]*\{([^}]*)\}")
_CAST = re.compile(r"\(\s*(?:u?int(?:8|16|32|64)_t|size_t|int)\s*\)")
_NUMBER = re.compile(r"\b(0[xX][0-9a-fA-F]+|\d+)[uUlL]*\b")
_TOKEN = re.compile(r"\s*(\d+|\w+|[-+*/()])")
_FUNCTION = re.compile(r"^\w[^;{}=()]*?\b(\w+)\([^;{}]*\)\s*\{", re.MULTILINE)
_ENDLESS = (";;", "true", "1")
_DEEPEST = 16

Place = tuple[str, int]
"""A source file and a line of it; of a loop, its first one."""
Function = tuple[str, int | None]
"""A function of the code, and its third argument where that is known."""
SIZE_OF = re.compile(r"\bsize of (\w+)")


@dataclass(frozen=True)
class Loop:
    """A loop of a source: its first and last line, and its head as the source has it, without comments."""

    first: int
    last: int
    head: str
    body: str


class Source:
    """A source file: its loops, and what its comments say."""

    def __init__(self, text: str) -> None:
        """Take the text of a C file."""
        self._lines = text.splitlines()
        blank = _TEXT.sub(lambda m: " " * len(m[0]), _blanked(text))
        self.plain = blank
        self.loops = tuple(_loops(blank))
        self.constants = read_constants(blank)
        self.guards = Guards(blank)
        self._functions = tuple(
            (blank.count("\n", 0, found.start()) + 1, found[1]) for found in _FUNCTION.finditer(blank)
        )

    def function(self, line: int) -> str:
        """Return the function that a line is in, the one before it outside of all; empty: before the first one."""
        return next((name for first, name in reversed(self._functions) if first <= line), "")

    def innermost(self, line: int) -> Loop | None:
        """Return the innermost loop that a line is in, or None."""
        within = [loop for loop in self.loops if loop.first <= line <= loop.last]
        return min(within, key=lambda loop: loop.last - loop.first, default=None)

    def stated(self, line: int, what: str) -> str | None:
        """Return the number of `what` that a comment has at a line, or on a separate line before it."""
        for at in (line, line - 1):
            text = self._lines[at - 1] if 0 < at <= len(self._lines) else ""
            if at != line and not text.lstrip().startswith("/* at most"):
                continue
            match = re.search(rf"/\* at most ([^*]+?(?:\*[^*/]+)*) {what}\b", text)
            if match:
                return match[1]
        return None


def _blanked(text: str) -> str:
    return _COMMENT.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def _loops(text: str) -> Iterator[Loop]:
    closing: list[int] = []  # ends of `do` bodies, whose `while` is no further loop
    for match in _LOOP.finditer(text):
        first = text.count("\n", 0, match.start()) + 1
        if match[1] == "do":
            begin, end = text.find("{", match.end()), 0
            end = _closing(text, begin, "{}")
            closing.append(end)
            yield Loop(first, text.count("\n", 0, text.find(";", end)) + 1, "", text[begin:end])
            continue
        if any(text[end + 1 : match.start()].strip() == "" and end < match.start() for end in closing):
            continue
        begin = text.find("(", match.end())
        end = _closing(text, begin, "()")
        after = end + 1
        while after < len(text) and text[after].isspace():
            after += 1
        last = _closing(text, after, "{}") if text[after : after + 1] == "{" else text.find(";", after)
        yield Loop(first, text.count("\n", 0, last) + 1, text[begin + 1 : end], text[after:last])


def _closing(text: str, begin: int, pair: str) -> int:
    depth = 0
    for at in range(begin, len(text)):
        if text[at] == pair[0]:
            depth += 1
        elif text[at] == pair[1]:
            depth -= 1
            if depth == 0:
                return at
    return len(text) - 1


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


class Sources:
    """The sources of an image, read once."""

    def __init__(self, read: Callable[[str], str], headers: Iterable[str]) -> None:
        """Take what reads a file by the name that the line table has; `headers` have the constants of the output."""
        self._source = cache(lambda name: Source(read(name)))
        self._constants: dict[str, str] = {}
        for text in headers:
            self._constants.update(read_constants(_blanked(text)))

    def rounds(
        self,
        ends: Iterable[Place],
        own: Iterable[Place] = (),
        inner: Iterable[Place] = (),
        function: Function = ("", None),
    ) -> int | str:
        """Return the most rounds of a loop of the code of `function`, or why nobody knows.

        `ends` are the lines where it is left, `own` its lines but those of loops within it, and `inner` the lines where
        these are left; each may be of a function that was inlined. The compiler makes one loop of two where the outer
        one begins with the inner one: then the numbers of both are multiplied.
        """
        left, within = self._loops_of(ends), self._loops_of(inner)
        if not left:
            return "no line of a source"
        merged = {
            place: loop
            for place, loop in self._loops_of(own).items()
            if place not in within and self._is_part((place, loop), left, function[0])
        }
        merged.update(
            (place, loop)
            for place, loop in left.items()
            if not any(_encloses(other, (place, loop)) for other in merged.items())
        )
        most = 1
        for place, loop in sorted({**left, **merged}.items(), key=lambda item: item[0]):
            rounds = self._of(place[0], loop, function)
            if rounds is None:
                return f"{_short(place[0])}:{loop.first}"
            most = most * rounds if place in merged else max(most, rounds)
        return most

    def _is_part(self, found: tuple[Place, Loop], left: Mapping[Place, Loop], function: str) -> bool:
        """Return whether a loop may be one with those of `left`: those also have instructions of outer loops."""
        (name, first), loop = found
        if (name, first) in left or " ".join(loop.head.split()) in _ENDLESS:
            return True
        if any(_encloses(other, found) for other in left.items()):
            return True
        if any(_encloses(found, other) for other in left.items()):
            return False
        return self._source(name).function(first) != function.partition(".")[0]

    def _loops_of(self, places: Iterable[Place]) -> dict[Place, Loop]:
        loops = ((name, self._source(name).innermost(line)) for name, line in set(places))
        return {(name, loop.first): loop for name, loop in loops if loop is not None}

    def size(self, place: tuple[str, int]) -> int | None:
        """Return the most bytes that a call handles, or None."""
        statement = self._source(place[0]).stated(place[1], "bytes")
        return self._value(place[0], statement) if statement is not None else None

    def written(self, calls: Iterable[Place], function: str, file: str) -> Written | None:
        """Return what a function of microros/cdr.h writes, or None where nobody knows.

        `calls` are those of inlined functions around its instruction, the innermost one first; without one of a source
        the code is that of `function` of microros/cdr.h itself, as the compiler made it of the source `file`.
        """
        outside = [place for place in calls if not is_of_cdr(place[0])]
        if outside:
            return self._source(outside[0][0]).guards.written(outside[0][1])
        return self._source(file).guards.largest(function.partition(".")[0])

    def calls(self, place: tuple[str, int]) -> int | None:
        """Return in how many rounds of its loop a call is reached at most, or None: in all of them."""
        statement = self._source(place[0]).stated(place[1], "calls")
        return self._value(place[0], statement) if statement is not None else None

    def _value(self, name: str, statement: str, function: Function = ("", None)) -> int | None:
        """Return the first of alternatives that this output has."""
        if function[1] is not None:
            statement = re.sub(rf"\bsize of {re.escape(function[0])}\b", str(function[1]), statement)
        values = (value_of(part, self._all(name)) for part in statement.split(" or "))
        return next((value for value in values if value is not None), None)

    def _of(self, file: str, loop: Loop, function: Function = ("", None)) -> int | None:
        statement = self._source(file).stated(loop.first, "rounds")
        if statement is not None:
            return self._value(file, statement, function)
        match = _COUNTED.match(" ".join(loop.head.split()))
        if not match or not match[1] == match[2] == (match[4] or match[5]):
            return None
        name = rf"\b{match[1]}\b"
        changed = rf"{name}\s*(?:[-+*/|&^]|<<|>>)?=(?!=)|(?:\+\+|--|&)\s*{name}|{name}\s*(?:\+\+|--)"
        if re.search(changed, loop.body):
            return None
        checked = self._source(file).guards.limit(match[3], loop.first)
        return checked if isinstance(checked, int) else value_of(checked or match[3], self._all(file))

    def _all(self, name: str) -> Mapping[str, str]:
        return {**self._constants, **self._source(name).constants}


def _encloses(outer: tuple[Place, Loop], inner: tuple[Place, Loop]) -> bool:
    """Return whether a loop is within another one of the same source."""
    ((name, _), around), ((other, _), within) = outer, inner
    return (
        name == other and around is not within and around.first <= within.first and within.last <= around.last
    )


def is_of_cdr(name: str) -> bool:
    """Return whether a file has the functions with which encoders write, which the compiler makes part of them."""
    return name.endswith(("microros/cdr.h", "microros/cdr_double.h"))


def _short(name: str) -> str:
    """Return a file as people know it: from the `src` or `include` of the output on."""
    match = re.search(r"(?:^|/)((?:src|include)/.*)$", name)
    return match[1] if match else name
