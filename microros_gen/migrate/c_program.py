# SPDX-License-Identifier: Apache-2.0
"""The tokens of a program → its functions, calls, assignments and constants."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field

from microros_gen.diagnostics import Span
from microros_gen.migrate.c_tokens import CText, Macro, Token
from microros_gen.records import dataclass

Tokens = tuple[Token, ...]
_OPEN, _CLOSE = {"(": ")", "[": "]", "{": "}"}, (")", "]", "}")
_NO_CALLS = ("if", "for", "while", "switch", "return", "sizeof", "defined", "catch", "alignof", "typeof")


@dataclass(frozen=True)
class Function:
    """A function with a body; `parameters` are the names that its head has.

    `is_free`: it is no member of a class and in no namespace, so that a system can call it by its name.
    """

    name: str
    parameters: frozenset[str]
    first: int
    last: int
    span: Span
    is_free: bool = True


@dataclass(frozen=True)
class Loop:
    """`for (variable = 0; variable < limit; …)`: its body is from token `first` to `last`; `inclusive` is `<=`."""

    variable: str
    limit: Tokens
    inclusive: bool
    first: int
    last: int


@dataclass(frozen=True)
class Call:
    """`name(arguments)` in `function`; `index` orders the calls of one file.

    `loops` are the loops around it, the outermost first. `turn` has the count of each of them where the call is one
    of several that a loop creates; else it is empty.
    """

    name: str
    arguments: tuple[Tokens, ...]
    function: Function
    index: int
    token: Token
    loops: tuple[Loop, ...] = ()
    turn: tuple[int, ...] = ()

    @property
    def texts(self) -> tuple[str, ...]:
        """The strings among the arguments, as they are written."""
        return tuple(
            token.text for argument in self.arguments for token in argument if token.kind == "string"
        )

    @property
    def span(self) -> Span:
        """The place of its name."""
        return self.token.span


@dataclass(frozen=True)
class Assignment:
    """`target = value`, also of a declaration; `a->b` is `a.b` in `target`; `function` None: it stands in none."""

    target: str
    value: Tokens
    function: Function | None
    index: int
    span: Span


@dataclass(frozen=True)
class CFile:
    """What one file has."""

    text: CText
    functions: tuple[Function, ...]
    calls: tuple[Call, ...]
    assignments: tuple[Assignment, ...]
    arrays: Mapping[str, Tokens] = field(default_factory=dict)
    enumerators: Mapping[str, Tokens | int] = field(default_factory=dict)

    @property
    def macros(self) -> tuple[Macro, ...]:
        """Its macros."""
        return self.text.macros


def read_program(texts: Iterable[CText]) -> tuple[CFile, ...]:
    """Return what each file has."""
    return tuple(_read(text) for text in texts)


def _read(text: CText) -> CFile:
    tokens = text.tokens
    ends = matching(tokens)
    functions = tuple(_functions(tokens, ends))
    calls = tuple(_calls(tokens, ends, functions))
    return CFile(
        text,
        functions,
        calls,
        tuple(_assignments(tokens, functions)),
        dict(_arrays(tokens, ends)),
        dict(_enumerators(tokens, ends)),
    )


def matching(tokens: Sequence[Token]) -> dict[int, int]:
    """Return for the index of each opening bracket that of the closing one; the end if none exists."""
    found: dict[int, int] = {}
    stack: list[int] = []
    for index, token in enumerate(tokens):
        if token.kind != "punct":
            continue
        if token.text in _OPEN:
            stack.append(index)
        elif token.text in _CLOSE and any(_OPEN[tokens[i].text] == token.text for i in stack):
            while stack:
                opened = stack.pop()
                found[opened] = index
                if _OPEN[tokens[opened].text] == token.text:
                    break
    found.update((index, len(tokens) - 1) for index in stack)
    return found


def split_arguments(tokens: Tokens) -> tuple[Tokens, ...]:
    """Return the parts between commas that stand in no brackets; nothing for no tokens."""
    parts: list[list[Token]] = [[]]
    depth = 0
    for token in tokens:
        depth += (token.text in _OPEN) - (token.text in _CLOSE) if token.kind == "punct" else 0
        if token.text == "," and token.kind == "punct" and depth == 0:
            parts.append([])
        else:
            parts[-1].append(token)
    return tuple(tuple(part) for part in parts) if tokens else ()


def _functions(tokens: Sequence[Token], ends: Mapping[int, int]) -> Iterator[Function]:
    starts = {end: begin for begin, end in ends.items()}
    index = 0
    scope_ends = 0  # of the class or namespace around
    while index < len(tokens):
        if tokens[index].text == "{" and tokens[index].kind == "punct" and index:
            head = _head(tokens, starts, index)
            if head is not None:
                name, begin = head
                parameters = tokens[begin + 1 : ends[begin]]
                names = frozenset(token.text for token in parameters if token.kind == "name")
                is_free = index >= scope_ends and tokens[name - 1].text != "::"
                yield Function(tokens[name].text, names, index, ends[index], tokens[name].span, is_free)
                index = ends[index]
            elif tokens[index - 1].kind != "string":  # extern "C" { … } is no scope
                scope_ends = max(scope_ends, ends[index])
        index += 1


def _head(tokens: Sequence[Token], starts: Mapping[int, int], body: int) -> tuple[int, int] | None:
    """Return the indices of a function's name and of the bracket of its parameters, for the `{` at `body`."""
    before = body - 1
    while before > 0 and tokens[before].text in ("const", "noexcept", "override", "final"):
        before -= 1
    if tokens[before].text != ")" or before not in starts:
        return None
    begin = starts[before]
    if begin == 0 or tokens[begin - 1].kind != "name" or tokens[begin - 1].text in _NO_CALLS:
        return None
    return begin - 1, begin


def _loops(tokens: Sequence[Token], ends: Mapping[int, int]) -> Iterator[Loop]:
    """Yield the loops that count from 0 to a limit."""
    for index, token in enumerate(tokens[:-2]):
        if token.kind != "name" or token.text != "for" or index + 1 not in ends:
            continue
        end = ends[index + 1]
        head = tokens[index + 2 : end]
        stops = [at for at, inside in enumerate(head) if inside.text == ";" and inside.kind == "punct"]
        if len(stops) != 2 or end + 1 >= len(tokens):
            continue
        start, test = head[: stops[0]], tuple(head[stops[0] + 1 : stops[1]])
        counts = len(test) > 2 and len(start) > 2 and start[-2].text == "=" and _is_zero(start[-1])
        if counts and test[0].text == start[-3].text and test[1].text in ("<", "<=", "!="):
            last = ends.get(end + 1) if tokens[end + 1].text == "{" else _end_of_statement(tokens, end + 1)
            yield Loop(test[0].text, test[2:], test[1].text == "<=", end + 1, last or end + 1)


def _is_zero(token: Token) -> bool:
    return token.text.rstrip("uUlL") == "0"


def _end_of_statement(tokens: Sequence[Token], begin: int) -> int:
    return next((at for at in range(begin, len(tokens)) if tokens[at].text == ";"), len(tokens) - 1)


def _calls(tokens: Sequence[Token], ends: Mapping[int, int], functions: Sequence[Function]) -> Iterator[Call]:
    loops = tuple(_loops(tokens, ends))
    for function in functions:
        for index in range(function.first, function.last):
            token, after = tokens[index], tokens[index + 1]
            if token.kind == "name" and after.text == "(" and token.text not in _NO_CALLS:
                inside = tuple(tokens[index + 2 : ends[index + 1]])
                around = tuple(loop for loop in loops if loop.first <= index <= loop.last)
                yield Call(token.text, split_arguments(inside), function, index, token, around)


def _assignments(tokens: Sequence[Token], functions: Sequence[Function]) -> Iterator[Assignment]:
    bodies = [function.first for function in functions]
    for index, token in enumerate(tokens):
        if token.text != "=" or token.kind != "punct" or not index:
            continue
        target, begin = _target(tokens, index)
        if target:
            before = bisect_left(bodies, index) - 1
            function = functions[before] if before >= 0 and index < functions[before].last else None
            value = tuple(_value(tokens, index + 1))
            yield Assignment(target, value, function, index, tokens[begin].span)


def _target(tokens: Sequence[Token], equals: int) -> tuple[str, int]:
    """Return what stands before `=`: `a.b.c`, `a->b`, `a[]` as `a`, `a[i].b` as `a[].b`, and where it begins."""
    parts: list[str] = []
    index = equals - 1
    while index >= 0:
        token = tokens[index]
        if token.text == "]":
            depth = 0
            while index >= 0:
                depth += (tokens[index].text == "]") - (tokens[index].text == "[")
                if depth == 0:
                    break
                index -= 1
            parts.append("[]" if parts else "")
        elif token.kind == "name":
            parts.append(token.text)
            if index == 0 or tokens[index - 1].text not in (".", "->"):
                return "".join(reversed(parts)), index
        elif token.text in (".", "->"):
            parts.append(".")
        else:
            break
        index -= 1
    text = "".join(reversed(parts))
    return (text, index + 1) if text.startswith(".") else ("", equals)


def _value(tokens: Sequence[Token], begin: int) -> Iterator[Token]:
    """Yield the tokens of a value: up to what ends it outside of brackets."""
    depth = 0
    for token in tokens[begin:]:
        if token.kind == "punct":
            if depth == 0 and token.text in (";", ",", ")", "}", "]"):
                return
            depth += (token.text in _OPEN) - (token.text in _CLOSE)
        yield token


def _arrays(tokens: Sequence[Token], ends: Mapping[int, int]) -> Iterator[tuple[str, Tokens]]:
    """Yield arrays of char and their sizes: `char name[size]`."""
    for index, token in enumerate(tokens[:-2]):
        is_char = token.text in ("char", "uint8_t") and token.kind == "name"
        if is_char and tokens[index + 1].kind == "name" and tokens[index + 2].text == "[":
            yield tokens[index + 1].text, tuple(tokens[index + 3 : ends[index + 2]])


def _enumerators(tokens: Sequence[Token], ends: Mapping[int, int]) -> Iterator[tuple[str, Tokens | int]]:
    """Yield the names of enumerations with their values; those without one count from the start."""
    for index, token in enumerate(tokens):
        if token.text != "enum" or token.kind != "name":
            continue
        begin = next((i for i in range(index, min(index + 6, len(tokens))) if tokens[i].text == "{"), None)
        if begin is None:
            continue
        for count, entry in enumerate(split_arguments(tuple(tokens[begin + 1 : ends[begin]]))):
            if len(entry) > 2 and entry[1].text == "=":
                yield entry[0].text, entry[2:]
            elif len(entry) == 1:
                yield entry[0].text, count
