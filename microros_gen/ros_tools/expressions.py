# SPDX-License-Identifier: Apache-2.0
"""Filters of messages: a subset of Python's expressions over `m`, the message.

The text is parsed by Python and translated, never handed to `eval`: there are members, elements, comparisons,
arithmetic whose results stay small, and a few functions. What the type says about a member is checked before any
message arrives.
"""

from __future__ import annotations

import ast
import operator
import re
import warnings
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any, NoReturn

from microros_gen.diagnostics import Diagnostic, Source, Span, UserError, nearest
from microros_gen.interfaces.types import ArrayType, FieldType, NamedType, SequenceType, TypeName
from microros_gen.records import dataclass
from microros_gen.ros_tools.texts import Messages

LONGEST = 4096
"""Characters of an expression."""
DEEPEST = 64
"""Levels of an expression."""
MESSAGE = "m"
_KINDS = "comparisons, and/or/not, + - * / // % & | ^, members, elements, any(… for x in …) and functions"
_EXAMPLE = "Example: 'm.data > 3 and m.header.frame_id == \"map\"'"
_FAULTS = (TypeError, ValueError, IndexError, KeyError, ArithmeticError)
"""What the operations of the subset raise for operands that do not fit."""
Kind = FieldType | TypeName | None
"""What is known of a value: its type, or nothing."""
Names = Mapping[str, Any]
_Value = Callable[[Names], Any]
_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.FloorDiv: operator.floordiv,
        ast.Mod: operator.mod,
        ast.BitAnd: operator.and_,
        ast.BitOr: operator.or_,
        ast.BitXor: operator.xor,
        ast.RShift: operator.rshift,
    }
)
_UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = MappingProxyType(
    {ast.Not: operator.not_, ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Invert: operator.invert}
)
_COMPARED: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = MappingProxyType(
    {
        ast.Eq: operator.eq,
        ast.NotEq: operator.ne,
        ast.Lt: operator.lt,
        ast.LtE: operator.le,
        ast.Gt: operator.gt,
        ast.GtE: operator.ge,
        ast.Is: operator.is_,
        ast.IsNot: operator.is_not,
        ast.In: lambda item, many: item in many,
        ast.NotIn: lambda item, many: item not in many,
    }
)
_MOST_DIGITS = 300
_MOST_BITS = 2048
"""Of a whole number; a float64 that is one has up to 1024."""
_MOST_LOOPS = 3
"""`for` within one another, in every place."""


def _rounded(value: float, digits: int = 0) -> float:
    """Round to a number of digits of sane size: those of a whole number are computed as a power of ten."""
    return round(value, max(-_MOST_DIGITS, min(_MOST_DIGITS, digits)))


_FUNCTIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {f.__name__: f for f in (abs, all, any, bool, float, int, len, max, min, str, sum)} | {"round": _rounded}
)
_OF_TEXTS = frozenset(("startswith", "endswith", "lower", "upper", "strip"))
"""Methods of texts."""


@dataclass(frozen=True)
class _Part:
    """A translated part: what computes its value, and what is known of this."""

    value: _Value
    kind: Kind = None


class Filter:
    """A condition on messages of one type."""

    def __init__(self, text: str, kind: Kind, messages: Messages) -> None:
        """Translate `text`, in which `m` has the type `kind`; `messages` has it with all nested types.

        Raises UserError for a text that is no expression, or is outside of the subset.
        """
        self._value = _Translator(text, kind, messages).whole()

    def __call__(self, message: Any) -> bool:
        """Return whether the condition holds. Raises UserError where it cannot be computed for this message."""
        return bool(self._value({MESSAGE: message}))


class _Translator:
    def __init__(self, text: str, kind: Kind, messages: Messages) -> None:
        self._text = text.lstrip(" \t")
        self._source = Source("<filter>", text)
        self._indent = len(text) - len(self._text)
        self._kinds: dict[str, Kind] = {MESSAGE: kind}
        self._messages = messages
        self._depth = self._loops = 0

    def whole(self) -> _Value:
        if len(self._text) > LONGEST:
            self._syntax(1, 1, f"the expression has more than {LONGEST} characters")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of escapes that are none
                tree = ast.parse(self._text, mode="eval")
        except SyntaxError as error:
            self._syntax(error.lineno or 1, error.offset or 1, error.msg)
        except (ValueError, RecursionError, MemoryError) as error:
            self._syntax(1, 1, str(error) or "nested too deeply")
        return self._part(tree.body).value

    def _syntax(self, line: int, column: int, why: str) -> NoReturn:
        moved = column + (self._indent if line == 1 else 0)
        span = Span(self._source, line, max(1, moved))
        raise UserError([Diagnostic(f"not an expression of Python: {why}", span, _EXAMPLE, id="MG-9806")])

    def _span(self, node: ast.expr) -> Span:
        """Return the place of a node: Python counts bytes of UTF-8."""
        line = re.split("\r\n|[\r\n]", self._text)[node.lineno - 1].encode()
        begin = len(line[: node.col_offset].decode()) + 1
        in_line = node.end_lineno == node.lineno and node.end_col_offset is not None
        end = len(line[: node.end_col_offset].decode()) + 1 if in_line else None
        moved = self._indent if node.lineno == 1 else 0
        return Span(self._source, node.lineno, begin + moved, None if end is None else end + moved)

    def _refuse(self, node: ast.expr, what: str, hint: str = "") -> NoReturn:
        text = hint or f"Available: {_KINDS}: {', '.join(sorted(_FUNCTIONS))}"
        message = f"not available in a filter: {what}"
        raise UserError([Diagnostic(message, self._span(node), text, id="MG-9807")])

    def _unknown(self, node: ast.expr, what: str, name: str, known: Iterable[str]) -> NoReturn:
        names = list(known)
        hint = nearest(name, names) or f"Available: {', '.join(names) or 'none'}"
        message = f"unknown in this filter: {what}"
        raise UserError([Diagnostic(message, self._span(node), hint, id="MG-9808")])

    def _checked(self, node: ast.expr, compute: _Value) -> _Value:
        """Return `compute`, whose faults have the place of `node`."""
        span = self._span(node)

        def value(names: Names) -> Any:
            try:
                return compute(names)
            except _FAULTS as error:
                hint = "Compare before: 'len(m.data) > 3 and m.data[3] > 0'"
                why = f"cannot be computed for a message: {error}"
                raise UserError([Diagnostic(why, span, hint, id="MG-9809")], status=1) from error

        return value

    def _part(self, node: ast.expr) -> _Part:
        translate = self._TRANSLATED.get(type(node))
        if translate is None:
            self._refuse(node, f"'{type(node).__name__}'")
        self._depth += 1
        if self._depth > DEEPEST:
            self._refuse(node, f"more than {DEEPEST} levels", "Split it up")
        part = translate(self, node)
        self._depth -= 1
        return part

    def _constant(self, node: ast.Constant) -> _Part:
        constant = node.value
        if constant is Ellipsis or isinstance(constant, complex):
            self._refuse(node, "this constant")
        return _Part(lambda _: constant)

    def _name(self, node: ast.Name) -> _Part:
        name = node.id
        if name not in self._kinds:
            self._unknown(node, f"name '{name}'", name, self._kinds)
        return _Part(lambda names: names[name], self._kinds[name])

    def _attribute(self, node: ast.Attribute) -> _Part:
        part, name = self._part(node.value), node.attr
        kind = part.kind.name if isinstance(part.kind, NamedType) else part.kind
        if not isinstance(kind, TypeName):
            what = f"members of '{ast.unparse(node.value)}'"
            self._refuse(node, what, "Members are those of messages: m.header.frame_id")
        message = self._messages[kind]
        constants = {constant.name: constant.value for constant in message.constants}
        if name in constants:
            return _Part(lambda _: constants[name])
        field = next((field for field in message.fields if field.name == name), None)
        if field is None:
            names = [field.name for field in message.fields]
            self._unknown(node, f"member '{name}' of {kind}", name, names)
        return _Part(lambda names: part.value(names)[name], field.type)

    def _subscript(self, node: ast.Subscript) -> _Part:
        part = self._part(node.value)
        if isinstance(node.slice, ast.Slice):
            ends = [self._part(e).value if e else _nothing for e in (node.slice.lower, node.slice.upper)]
            if node.slice.step is not None:
                self._refuse(node.slice.step, "steps of slices")
            return _Part(
                self._checked(node, lambda names: part.value(names)[ends[0](names) : ends[1](names)]),
                part.kind,
            )
        if isinstance(part.kind, TypeName | NamedType):
            self._refuse(node, "elements of a message", "Write its member: m.data")
        index = self._part(node.slice).value
        return _Part(
            self._checked(node, lambda names: part.value(names)[index(names)]), _element_of(part.kind)
        )

    def _boolean(self, node: ast.BoolOp) -> _Part:
        values = [self._part(value).value for value in node.values]
        stop = isinstance(node.op, ast.Or)

        def value(names: Names) -> Any:
            result: Any = None
            for each in values:
                result = each(names)
                if bool(result) is stop:
                    break
            return result

        return _Part(value)

    def _unary(self, node: ast.UnaryOp) -> _Part:
        apply, operand = _UNARY[type(node.op)], self._part(node.operand).value
        return _Part(self._checked(node, lambda names: apply(operand(names))))

    def _binary(self, node: ast.BinOp) -> _Part:
        apply = _BINARY.get(type(node.op))
        if apply is None:
            self._refuse(node, f"'{type(node.op).__name__}'")
        left, right = self._part(node.left).value, self._part(node.right).value

        def value(names: Names) -> Any:
            operands = left(names), right(names)
            if not all(isinstance(each, int | float) for each in operands):
                raise TypeError("arithmetic is that of numbers")
            result = apply(*operands)
            if isinstance(result, int) and result.bit_length() > _MOST_BITS:
                raise OverflowError("the number is too large")
            return result

        return _Part(self._checked(node, value))

    def _compare(self, node: ast.Compare) -> _Part:
        first = self._part(node.left).value
        steps = [
            (_COMPARED[type(op)], self._part(other).value)
            for op, other in zip(node.ops, node.comparators, strict=True)
        ]

        def value(names: Names) -> bool:
            left = first(names)
            for compare, other in steps:
                right = other(names)
                if not compare(left, right):
                    return False
                left = right
            return True

        return _Part(self._checked(node, value))

    def _choice(self, node: ast.IfExp) -> _Part:
        test, body, orelse = (self._part(each).value for each in (node.test, node.body, node.orelse))
        return _Part(lambda names: body(names) if test(names) else orelse(names))

    def _many(self, node: ast.List | ast.Tuple | ast.Set) -> _Part:
        values = [self._part(each).value for each in node.elts]
        return _Part(lambda names: [value(names) for value in values])

    def _call(self, node: ast.Call) -> _Part:
        if node.keywords:
            self._refuse(node, "arguments with names")
        if isinstance(node.func, ast.Attribute) and node.func.attr in _OF_TEXTS:
            return self._text_method(node, node.func)
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name not in _FUNCTIONS:
            what = f"function '{ast.unparse(node.func)}'"
            self._unknown(node.func, what, name, (*sorted(_FUNCTIONS), *sorted(_OF_TEXTS)))
        function, arguments = _FUNCTIONS[name], [self._part(each).value for each in node.args]
        return _Part(self._checked(node, lambda names: function(*(each(names) for each in arguments))))

    def _text_method(self, node: ast.Call, function: ast.Attribute) -> _Part:
        text, name = self._part(function.value).value, function.attr
        arguments = [self._part(each).value for each in node.args]

        def value(names: Names) -> Any:
            found = text(names)
            if not isinstance(found, str):
                raise TypeError(f"{name} is a function of texts")
            return getattr(found, name)(*(each(names) for each in arguments))

        return _Part(self._checked(node, value))

    def _comprehension(self, node: ast.GeneratorExp | ast.ListComp) -> _Part:
        loop = node.generators[0]
        if len(node.generators) > 1 or loop.is_async or not isinstance(loop.target, ast.Name):
            self._refuse(node, "more than one `for NAME in …`")
        if loop.target.id in self._kinds:
            self._refuse(loop.target, f"'{loop.target.id}' twice", "Choose another name")
        self._loops += 1
        if self._loops > _MOST_LOOPS:
            self._refuse(node, f"more than {_MOST_LOOPS} times `for`")
        many, name = self._part(loop.iter), loop.target.id
        self._kinds[name] = _element_of(many.kind)
        conditions = [self._part(each).value for each in loop.ifs]
        element = self._part(node.elt).value
        del self._kinds[name]

        def value(names: Names) -> list[Any]:
            inner = [{**names, name: each} for each in many.value(names)]
            return [element(each) for each in inner if all(holds(each) for holds in conditions)]

        return _Part(self._checked(node, value))

    _TRANSLATED: Mapping[type[ast.expr], Callable[[_Translator, Any], _Part]] = MappingProxyType(
        {
            ast.Constant: _constant,
            ast.Name: _name,
            ast.Attribute: _attribute,
            ast.Subscript: _subscript,
            ast.BoolOp: _boolean,
            ast.UnaryOp: _unary,
            ast.BinOp: _binary,
            ast.Compare: _compare,
            ast.IfExp: _choice,
            ast.List: _many,
            ast.Tuple: _many,
            ast.Set: _many,
            ast.Call: _call,
            ast.GeneratorExp: _comprehension,
            ast.ListComp: _comprehension,
        }
    )


def _nothing(_names: Names) -> None:
    """Return the end of a slice that has none."""


def _element_of(kind: Kind) -> Kind:
    return kind.element if isinstance(kind, ArrayType | SequenceType) else None
