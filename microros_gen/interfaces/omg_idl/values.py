# SPDX-License-Identifier: Apache-2.0
"""Literals and expressions of .idl files: what they are (OMG IDL 4.2, 7.2.6 and 7.4.1.3), and what ROS 2 Jazzy
makes of them.

rosidl_parser computes no expressions: as a value it takes one literal with a sign, as a size one decimal number.
It refuses most of what is more, and reads the rest wrongly; here all of it is refused, with the computed value
in the hint.
"""

from __future__ import annotations

import math
import operator
import re
import struct
from collections.abc import Callable, Mapping

from lark import Token

from microros_gen.diagnostics import Source, Span
from microros_gen.documents.python_literal import python_literal
from microros_gen.interfaces.msg.declarations import LARGEST_BOUND
from microros_gen.interfaces.msg.syntax import SyntaxNode
from microros_gen.interfaces.types import (
    ArrayType,
    FieldType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    Value,
)

_SIGNED = (Primitive.INT8, Primitive.INT16, Primitive.INT32, Primitive.INT64, Primitive.IDL_CHAR)
_FLOATS = (Primitive.FLOAT32, Primitive.FLOAT64)
_OPERATORS: Mapping[str, Callable[[int, int], int]] = {
    "|": operator.or_,
    "^": operator.xor,
    "&": operator.and_,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.floordiv,
    "%": operator.mod,
}
_LARGEST_SHIFT = 64
_LARGEST = 2**64
_MOST_STEPS = 1000
_DEEPEST = 50
_MOST_DIGITS = 400
# OMG IDL 4.2, table 7-9, as rosidl_parser resolves it; \u in wide strings alone.
_ESCAPE = re.compile(r"\\([ntvbrfa\\'\"])|\\([0-7]{1,3})|\\x([0-9a-fA-F]{1,2})|\\u([0-9a-fA-F]{1,4})")
_SIMPLE = dict(zip("ntvbrfa\\'\"", "\n\t\v\b\r\f\a\\'\"", strict=True))
_SECOND_ESCAPE = re.compile(r'\\(["\\])')


class IdlError(Exception):
    """One error in a declaration: its place, what is wrong and a hint."""

    def __init__(self, span: Span, message: str, hint: str | None = None, *, id: str) -> None:
        super().__init__(message)
        self.span, self.message, self.hint, self.id = span, message, hint, id


def span_of(node: SyntaxNode | Token, source: Source) -> Span:
    """Return the place of the first token below `node`; it has at least one."""
    first = first_token(node)
    column = first.column or 1
    return Span(source, first.line or 1, column, column + len(first))


def tokens_of(node: SyntaxNode) -> list[Token]:
    """Return all tokens below `node` in their order."""
    found: list[Token] = []
    pending: list[SyntaxNode | Token] = [node]
    while pending:
        last = pending.pop()
        if isinstance(last, Token):
            found.append(last)
        else:
            pending.extend(reversed(last.children))
    return found


def first_token(node: SyntaxNode | Token) -> Token:
    """Return the first token below `node`; it has at least one."""
    while not isinstance(node, Token):
        node = node.children[0]
    return node


def computed(node: SyntaxNode, constants: Mapping[str, SyntaxNode]) -> int | None:
    """Return the integer that an expression gives by IDL, or None where it is long or none: for hints alone."""
    return _Computation(constants).value(node, 0)


class _Computation:
    """One computation; constants can refer to each other in circles, so its steps are counted."""

    def __init__(self, constants: Mapping[str, SyntaxNode]) -> None:
        self._constants = constants
        self._steps = _MOST_STEPS

    def value(self, node: SyntaxNode, depth: int) -> int | None:
        """Return the integer that `node` gives, or None."""
        self._steps -= 1
        if self._steps < 0 or depth > _DEEPEST:
            return None
        result = self._value(node, depth + 1)
        return None if result is None or abs(result) >= _LARGEST else result

    def _value(self, node: SyntaxNode, depth: int) -> int | None:
        if node.data == "group":
            return self.value(node.children[0], depth)
        if node.data == "name":
            known = self._constants.get(str(node.children[-1]))
            return None if known is None else self.value(known, depth)
        if node.data == "literal":
            return _integer(node.children[0])
        if node.data == "signed":
            value = self.value(node.children[1], depth)
            sign = node.children[0]
            return None if value is None else -value if sign == "-" else ~value if sign == "~" else value
        if node.data in ("binary", "shift_right"):
            left, right = (self.value(n, depth) for n in (node.children[0], node.children[-1]))
            return None if left is None or right is None else _binary(node, left, right)
        return None


def positive_bound(node: SyntaxNode, what: str, constants: Mapping[str, SyntaxNode], source: Source) -> int:
    """Return the size that Jazzy reads: one decimal number above zero. Raises IdlError."""
    inner = node
    while inner.data == "group" or (inner.data == "signed" and inner.children[0] == "+"):
        inner = inner.children[-1]
    span = span_of(node, source)
    if inner.data != "literal" or inner.children[0].type != "DECIMAL":
        value = computed(node, constants)
        hint = f"Write {value}" if value is not None and value > 0 else "Write a number above zero"
        reason = "ROS 2 Jazzy evaluates no expressions here" if value is not None else "this is not one"
        raise IdlError(span, f"{what} is a decimal number: {reason}", hint, id="MG-2080")
    number = _decimal(inner.children[0], source)
    if not 0 < number <= LARGEST_BOUND:
        raise IdlError(span, f"{what} is 1 to {LARGEST_BOUND}, not {number}", id="MG-2081")
    return number


def literal_value(
    node: SyntaxNode, constants: Mapping[str, SyntaxNode], source: Source, *, parameter: bool = False
) -> ScalarValue:
    """Return the value that Jazzy reads: one literal with a sign. Raises IdlError.

    `parameter` says that it is one of an annotation, where parentheses may stand around it.
    """
    while parameter and node.data == "group":
        node = node.children[0]
    sign, literal = (node.children[0], node.children[1]) if node.data == "signed" else ("+", node)
    if sign == "~" or literal.data not in ("literal", "strings"):
        raise _no_literal(node, constants, source)
    if literal.data == "strings":
        if node is not literal and sign == "-":
            raise IdlError(span_of(node, source), "a string has no sign", "Remove it", id="MG-2082")
        return "".join(_string(token, source) for token in literal.children)
    token = literal.children[0]
    if token.type in ("TRUE", "FALSE"):
        if node is not literal:
            raise IdlError(span_of(node, source), "a boolean has no sign", "Remove it", id="MG-2083")
        return bool(token.type == "TRUE")
    number = _number(token, node, constants, source)
    return -number if sign == "-" else number


def checked_scalar(kind: Primitive | StringType, value: ScalarValue, span: Span) -> ScalarValue:
    """Return `value` as one of `kind`, when it is one and C can be made of it. Raises IdlError."""
    if isinstance(kind, StringType):
        return _checked_string(kind, value, span)
    if isinstance(value, str):
        raise IdlError(
            span,
            f"a string is not a value of type {_idl_name(kind)}",
            "Write it without quotes",
            id="MG-2084",
        )
    if kind is Primitive.BOOL:
        if value not in (0, 1):
            raise IdlError(span, f"{value} is not a boolean", "Write TRUE or FALSE", id="MG-2085")
        return bool(value)
    if isinstance(value, bool):
        raise IdlError(
            span, f"a boolean is not a value of type {_idl_name(kind)}", "Write a number", id="MG-2086"
        )
    if kind in _FLOATS:
        return _checked_float(kind, value, span)
    return _checked_integer(kind, value, span)


def checked_default(field_type: FieldType, value: ScalarValue, span: Span) -> Value:
    """Return the default that `value` of an annotation gives a member of that type. Raises IdlError."""
    if isinstance(field_type, (Primitive, StringType)):
        return checked_scalar(field_type, value, span)
    if not isinstance(field_type, (ArrayType, SequenceType)) or not isinstance(
        field_type.element, (Primitive, StringType)
    ):
        raise IdlError(span, "a member of a struct type cannot have a default", "Remove it", id="MG-2087")
    elements = _elements(value, span)
    _check_count(field_type, len(elements), span)
    return tuple(checked_scalar(field_type.element, element, span) for element in elements)


def _integer(token: Token) -> int | None:
    bases = {"DECIMAL": 10, "OCTAL": 8, "HEXADECIMAL": 16}
    return int(token, bases[token.type]) if token.type in bases and len(token) <= _MOST_DIGITS else None


def _decimal(token: Token, source: Source) -> int:
    if len(token) > _MOST_DIGITS:
        raise IdlError(
            span_of(token, source), f"the number has {len(token)} digits", "Write a smaller one", id="MG-2088"
        )
    return int(token)


def _binary(node: SyntaxNode, left: int, right: int) -> int | None:
    symbol = ">>" if node.data == "shift_right" else str(node.children[1])
    if symbol in ("<<", ">>"):
        if not 0 <= right < _LARGEST_SHIFT:
            return None
        return left << right if symbol == "<<" else left >> right
    if symbol in ("/", "%") and right == 0:
        return None
    return _OPERATORS[symbol](left, right)


def _no_literal(node: SyntaxNode, constants: Mapping[str, SyntaxNode], source: Source) -> IdlError:
    value = computed(node, constants)
    what = "the name of a constant" if node.data == "name" else "an expression"
    hint = "Write its value" if value is None else f"Write {value}"
    return IdlError(
        span_of(node, source), f"ROS 2 Jazzy does not accept {what} as a value", hint, id="MG-2089"
    )


def _number(
    token: Token, node: SyntaxNode, constants: Mapping[str, SyntaxNode], source: Source
) -> int | float:
    if token.type == "DECIMAL":
        return _decimal(token, source)
    if token.type in ("FLOAT", "FIXED"):
        return float(token.rstrip("dD"))
    if token.type == "CHARACTER":
        raise IdlError(
            span_of(token, source),
            "ROS 2 Jazzy does not accept a character as a value",
            "Write its number, such as 65 for 'A'",
            id="MG-2090",
        )
    base = "octal" if token.type == "OCTAL" else "hexadecimal"
    value = computed(node, constants)
    hint = "Write it in decimal" if value is None else f"Write {value}"
    raise IdlError(
        span_of(token, source), f"ROS 2 Jazzy does not accept a number in {base}", hint, id="MG-2091"
    )


def _string(token: Token, source: Source) -> str:
    wide = token.type == "WIDE_STRING"

    def resolve(match: re.Match[str]) -> str:
        simple, octal, hexadecimal, code = match.groups()
        if simple is not None:
            return _SIMPLE[simple]
        if octal is not None:
            return chr(int(octal, 8))
        digits = hexadecimal or code
        if code is not None and not wide:
            return match.group()
        if len(digits) != (2 if hexadecimal else 4):
            message = f"'{match.group()}' is not a complete escape"
            raise IdlError(
                span_of(token, source), message, "Write \\x and two digits, or \\u and four", id="MG-2092"
            )
        return chr(int(digits, 16))

    text = token[2:-1] if wide else token[1:-1]
    return _SECOND_ESCAPE.sub(r"\1", _ESCAPE.sub(resolve, text))


def _checked_string(kind: StringType, value: ScalarValue, span: Span) -> str:
    if not isinstance(value, str):
        written = str(value).upper() if isinstance(value, bool) else value
        raise IdlError(span, f"{written} is not a string", "Write it in quotes", id="MG-2093")
    if "\0" in value:
        raise IdlError(
            span, "a string cannot hold the character NUL", "It ends the string in C", id="MG-2094"
        )
    if any("\ud800" <= character <= "\udfff" for character in value):
        raise IdlError(
            span, "an escape names half of a character", "Write the character itself", id="MG-2095"
        )
    length = len(value.encode("utf-16-le")) // 2 if kind.wide else len(value.encode("utf-8"))
    if kind.bound is not None and length > kind.bound:
        unit = "characters" if kind.wide else "bytes in UTF-8"
        raise IdlError(
            span,
            f"the string takes {length} {unit}, but its type takes at most {kind.bound}",
            "Shorten it",
            id="MG-2096",
        )
    return value


def _checked_float(kind: Primitive, value: int | float, span: Span) -> float:
    if isinstance(value, int) and kind is Primitive.FLOAT32:
        raise IdlError(
            span,
            "for a whole number here, ROS 2 Jazzy generates C code that does not compile",
            f"Write {value}.0",
            id="MG-2097",
        )
    try:
        number = float(value)
        struct.pack("<f" if kind is Primitive.FLOAT32 else "<d", number)
    except OverflowError:
        raise IdlError(
            span, f"{value} does not fit {_idl_name(kind)}", "Use a smaller value", id="MG-2098"
        ) from None
    if not math.isfinite(number):
        raise IdlError(
            span, f"the value is too large for {_idl_name(kind)}", "Use a smaller value", id="MG-2099"
        )
    return number


def _checked_integer(kind: Primitive, value: int | float, span: Span) -> int:
    if isinstance(value, float):
        raise IdlError(
            span, f"{value} is not an integer", "Write it without a point and an exponent", id="MG-2100"
        )
    bits = 8 * kind.size
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if kind in _SIGNED else (0, 2**bits - 1)
    if not low <= value <= high:
        raise IdlError(
            span, f"{value} does not fit {_idl_name(kind)}", f"Its range is {low} to {high}", id="MG-2101"
        )
    return value


def _elements(value: ScalarValue, span: Span) -> tuple[ScalarValue, ...]:
    """Return the elements of the default of an array: rosidl writes it as the text of a Python tuple."""
    hint = 'Write @default (value="(1, 2)"), for one element "(1,)"'
    try:
        found = python_literal(value) if isinstance(value, str) else None
    except ValueError:
        found = None
    if not isinstance(found, (tuple, list)):
        raise IdlError(span, "the default of an array or sequence is a list in a string", hint, id="MG-2102")
    if not all(isinstance(element, (bool, int, float, str)) for element in found):
        raise IdlError(span, "an element of the default is not a literal", hint, id="MG-2103")
    if any(isinstance(element, int) and abs(element) >= 10**_MOST_DIGITS for element in found):
        raise IdlError(span, "a number of the default is too long", "Write a smaller one", id="MG-2104")
    return tuple(found)


def _check_count(field_type: ArrayType | SequenceType, count: int, span: Span) -> None:
    if isinstance(field_type, ArrayType):
        if count != field_type.size:
            raise IdlError(
                span, f"the default has {count} elements, but the array has {field_type.size}", id="MG-2105"
            )
    elif field_type.bound is not None and count > field_type.bound:
        raise IdlError(
            span,
            f"the default has {count} elements, but the sequence takes at most {field_type.bound}",
            id="MG-2106",
        )


def _idl_name(kind: Primitive) -> str:
    names = {
        Primitive.BOOL: "boolean",
        Primitive.BYTE: "octet",
        Primitive.FLOAT32: "float",
        Primitive.FLOAT64: "double",
        Primitive.IDL_CHAR: "char",
    }
    return names.get(kind, kind.value)
