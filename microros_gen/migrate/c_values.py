# SPDX-License-Identifier: Apache-2.0
"""What an expression of a C program is, where its text alone says so: strings, whole numbers, type supports."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Iterable
from itertools import pairwise

from microros_gen.migrate.c_program import Assignment, Call, CFile, Tokens, matching, split_arguments
from microros_gen.migrate.c_tokens import Token
from microros_gen.records import dataclass

_ACTION_SUPPORT = "ROSIDL_GET_ACTION_TYPE_SUPPORT"
"""It names a package and a type, without the kind."""
_TYPE_SUPPORT = re.compile(r"ROSIDL_GET_(MSG|SRV|ACTION)_TYPE_SUPPORT")
_SCALES = {"RCL_S_TO_NS": 1_000_000_000, "RCL_MS_TO_NS": 1_000_000, "RCL_US_TO_NS": 1_000}
_OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.FloorDiv: operator.floordiv,
    ast.LShift: operator.lshift,
}
_NUMBERS = ("int", "unsigned", "long", "short", "char", "float", "double")
_DEEPEST = 8
_LARGEST = 1 << 64


@dataclass(frozen=True)
class Unknown:
    """Why a value is not known."""

    reason: str


@dataclass(frozen=True)
class TypeSupport:
    """What ROSIDL_GET_MSG_TYPE_SUPPORT(package, kind, name) names."""

    package: str
    kind: str
    name: str

    def __str__(self) -> str:
        return f"{self.package}/{self.kind}/{self.name}"


def shown(tokens: Iterable[Token]) -> str:
    """Return tokens as text, for messages."""
    text = " ".join(token.text for token in tokens)
    return re.sub(r" ?(->|[.()\[\],]|::) ?", r"\1", text)


def handle_of(tokens: Tokens) -> str:
    """Return the variable that `&x`, `x`, `&a->b` or `(&x)` names, as assignments name it; empty for another thing."""
    inner = [token for token in tokens if token.text not in ("&", "(", ")", "*")]
    text = re.sub(r"\[[^\]]*\]", "[]", "".join("." if t.text == "->" else t.text for t in inner))
    return text if re.fullmatch(r"[A-Za-z_][\w.\[\]:]*", text) else ""


class Values:
    """Looks names up: macros, enumerators, and variables that have one value where they are used."""

    def __init__(self, files: Iterable[CFile]) -> None:
        self._files = tuple(files)
        self._macros = {m.name: m for f in self._files for m in f.macros if not m.has_arguments and m.body}
        self._empty = {
            m.name for f in self._files for m in f.macros if not m.has_arguments
        } - self._macros.keys()
        self._enumerators = {name: value for f in self._files for name, value in f.enumerators.items()}
        self._arrays = {name: size for f in self._files for name, size in f.arrays.items()}

    def text(self, tokens: Tokens, call: Call, depth: int = 0) -> str | Unknown:
        """Return the string that an expression is."""
        if depth > _DEEPEST or not tokens:
            return Unknown("it is empty" if not tokens else "its macros go round")
        parts: list[str] = []
        for token in tokens:
            if token.kind == "string":
                parts.append(token.string())
            elif token.kind == "name" and token.text in self._macros:
                part = self.text(self._macros[token.text].body, call, depth + 1)
                if isinstance(part, Unknown):
                    return part
                parts.append(part)
            elif token.text in ("(", ")") or (token.kind == "name" and token.text in self._empty):
                continue
            else:
                break
        else:
            return "".join(parts) if parts else Unknown("it is empty")
        return self._text_of_variable(tokens, call, depth)

    def _text_of_variable(self, tokens: Tokens, call: Call, depth: int) -> str | Unknown:
        if handle_of(tokens) in ("NULL", "nullptr"):
            return Unknown("it is NULL")
        found = self._variable(tokens, call)
        return found if isinstance(found, Unknown) else self.text(found, call, depth + 1)

    def number(self, tokens: Tokens, call: Call, depth: int = 0) -> int | Unknown:
        """Return the whole number that an expression is; the macros of rcl for times give nanoseconds."""
        expanded = self._expanded(tokens, call, depth)
        if isinstance(expanded, Unknown):
            return expanded
        try:
            value = _evaluate(ast.parse(expanded.strip(), mode="eval").body)
        except (SyntaxError, ValueError, TypeError, ArithmeticError, RecursionError, MemoryError):
            return Unknown(f"`{shown(tokens)}` is not a number that can be worked out here")
        return value

    def type_support(self, tokens: Tokens, call: Call, depth: int = 0) -> TypeSupport | Unknown:
        """Return the type that an expression of a type support names."""
        if depth > _DEEPEST:
            return Unknown("its macros go round")
        found = [index for index, token in enumerate(tokens) if _TYPE_SUPPORT.fullmatch(token.text)]
        if len(found) == 1:
            ends = matching(tokens)
            inside = tokens[found[0] + 2 : ends.get(found[0] + 1, len(tokens))]
            names = [part[0].text if len(part) == 1 else "" for part in split_arguments(tuple(inside))]
            names = [self._renamed(name) for name in names]
            if tokens[found[0]].text == _ACTION_SUPPORT and len(names) == 2:
                names.insert(1, "action")
            if len(names) == 3 and all(names):
                return TypeSupport(*names)
            return Unknown(f"`{shown(tokens)}` does not name a package, a kind and a type")
        if len(tokens) == 1 and tokens[0].text in self._macros:
            return self.type_support(self._macros[tokens[0].text].body, call, depth + 1)
        value = self._variable(tokens, call)
        return value if isinstance(value, Unknown) else self.type_support(value, call, depth + 1)

    def array_size(self, name: str, call: Call) -> int | Unknown:
        """Return the number of elements of an array of characters."""
        size = self._arrays.get(name)
        start = self.before(name, call) if size == () else None
        if start and all(token.kind == "string" for token in start.value):
            return 1 + sum(len(token.string().encode()) for token in start.value)
        return self.number(size, call, 1) if size else Unknown(f"the size of `{name}` is not known here")

    def before(self, target: str, call: Call) -> Assignment | None:
        """Return the last assignment to `target` before a call, in its function, else that of its file."""
        local, others = self._assigned(target, call)
        return local[-1] if local else (others[0] if len(others) == 1 else None)

    def changes(self, prefix: str, call: Call) -> list[Assignment]:
        """Return the assignments to members of `prefix` before a call in its function, in their order."""
        return [
            assignment
            for file in self._files
            for assignment in file.assignments
            if assignment.function == call.function
            and assignment.index < call.index
            and assignment.target.startswith(f"{prefix}.")
        ]

    def _element(self, tokens: Tokens, call: Call) -> Tokens | None:
        """Return the element that `name[3]` is of an array with a list of values; None for anything else."""
        if len(tokens) != 4 or tokens[1].text != "[" or tokens[2].kind != "number":
            return None
        start = self.before(tokens[0].text, call)
        listed = start.value if start is not None else ()
        if not listed or listed[0].text != "{" or not tokens[2].text.isdecimal():
            return None
        elements, index = split_arguments(listed[1:-1]), int(tokens[2].text)
        return elements[index] if index < len(elements) else None

    def _renamed(self, name: str) -> str:
        macro = self._macros.get(name)
        return macro.body[0].text if macro and len(macro.body) == 1 else name

    def _variable(self, tokens: Tokens, call: Call) -> Tokens | Unknown:
        element = self._element(tokens, call)
        if element is not None:
            return element
        name = handle_of(tokens)
        if not name or _is_worked_out(tokens):
            return Unknown(f"`{shown(tokens)}` is worked out when the program runs")
        local, others = self._assigned(name, call)
        if local:
            same = {shown(assignment.value) for assignment in local}
            return local[-1].value if len(same) == 1 or self._straight(local, call) else self._ambiguous(name)
        if name.split(".")[0].split("[")[0] in call.function.parameters:
            return Unknown(f"`{shown(tokens)}` is a parameter of {call.function.name}()")
        if len({shown(assignment.value) for assignment in others}) == 1:
            return others[0].value
        if others:
            return self._ambiguous(name)
        return Unknown(f"the value of `{shown(tokens)}` is not in these sources")

    def _ambiguous(self, name: str) -> Unknown:
        return Unknown(f"`{name}` gets more than one value")

    def _straight(self, local: list[Assignment], call: Call) -> bool:
        """Whether the last assignment is surely the one in force: no block ends between it and the call."""
        file = next(f for f in self._files if call.function in f.functions)
        between = file.text.tokens[local[-1].index : call.index]
        return all(t.text != "}" for t in between)

    def _assigned(self, name: str, call: Call) -> tuple[list[Assignment], list[Assignment]]:
        """Return assignments to `name` in the function before the call, and those outside of functions or in others."""
        everywhere = [a for f in self._files for a in f.assignments if a.target == name]
        local = [a for a in everywhere if a.function == call.function and a.index < call.index]
        outside = [a for a in everywhere if a.function is None]
        of_file = [a for a in outside if a.span.source == call.span.source]
        elsewhere = [a for a in everywhere if a.function is not None and a.function != call.function]
        return local, of_file or outside or elsewhere

    def _expanded(self, tokens: Tokens, call: Call, depth: int) -> str | Unknown:
        """Return an expression with numbers in place of its names."""
        if depth > _DEEPEST:
            return Unknown("its macros go round")
        tokens = _without_casts(tokens)
        if _is_worked_out(tokens):
            return Unknown(f"`{shown(tokens)}` is worked out when the program runs")
        parts: list[str] = []
        index = 0
        while index < len(tokens):
            token = tokens[index]
            part = self._number_of_token(tokens, index, call, depth)
            if isinstance(part, Unknown):
                return part
            parts.append(part)
            index += 4 if token.text == "sizeof" else 1
        return " ".join(parts)

    def _number_of_token(self, tokens: Tokens, index: int, call: Call, depth: int) -> str | Unknown:
        token = tokens[index]
        if token.kind == "number":
            digits = re.sub(r"[uUlL]+$", "", token.text.replace("'", ""))
            return str(int(digits, 8)) if re.fullmatch(r"0[0-7]{1,22}", digits) else digits
        if token.kind == "punct":
            return "//" if token.text == "/" else token.text
        if token.text in _SCALES:
            return f"{_SCALES[token.text]} *"
        if token.text == "sizeof" and len(tokens) >= index + 4:
            size = self.array_size(tokens[index + 2].text, call)
            return size if isinstance(size, Unknown) else str(size)
        if token.kind != "name":
            return Unknown(f"`{token.text}` is not a number")
        known = (
            self._macros[token.text].body if token.text in self._macros else self._enumerators.get(token.text)
        )
        if isinstance(known, int):
            return str(known)
        value = known or self._variable((token,), call)
        inner = value if isinstance(value, Unknown) else self._expanded(value, call, depth + 1)
        return inner if isinstance(inner, Unknown) else f"({inner})"


def _is_worked_out(tokens: Tokens) -> bool:
    """Whether an expression has a condition, an index that is not a number, or a call."""
    pairs = list(pairwise(tokens))
    return (
        any(token.text == "?" for token in tokens)
        or any(first.text == "[" and second.kind != "number" for first, second in pairs)
        or any(
            first.kind == "name" and second.text == "(" and first.text not in (*_SCALES, "sizeof")
            for first, second in pairs
        )
    )


def _without_casts(tokens: Tokens) -> Tokens:
    """Return tokens without `(size_t)` and its like."""
    kept: list[Token] = []
    for token in tokens:
        is_cast = token.text == ")" and len(kept) > 1 and kept[-2].text == "(" and _is_number_type(kept[-1])
        if is_cast:
            del kept[-2:]
        else:
            kept.append(token)
    return tuple(kept)


def _is_number_type(token: Token) -> bool:
    return token.kind == "name" and (token.text.endswith("_t") or token.text in _NUMBERS)


def _evaluate(node: ast.expr) -> int:
    """Return the value of an expression of whole numbers; ValueError for anything else."""
    if (
        isinstance(node, ast.Constant)
        and isinstance(node.value, (int, float))
        and node.value == int(node.value)
    ):
        return int(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_evaluate(node.operand)
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        left, right = _evaluate(node.left), _evaluate(node.right)
        if (
            abs(left) < _LARGEST
            and abs(right) < _LARGEST
            and not (isinstance(node.op, ast.LShift) and right > 63)
        ):
            return int(_OPERATORS[type(node.op)](left, right))
    raise ValueError("no whole number")
