# SPDX-License-Identifier: Apache-2.0
"""C text of values, comments and members."""

from __future__ import annotations

import math

from microros_gen.interfaces.types import Primitive, ScalarValue

INT_MIN, INT_MAX = -(2**31), 2**31 - 1
"""`int` of every target that ROS message structs are used on."""

_SUFFIX = {Primitive.INT64: "INT64_C", Primitive.UINT64: "UINT64_C", Primitive.UINT32: "UINT32_C"}


def number(primitive: Primitive, value: ScalarValue) -> str:
    """Return the C literal of a number or bool; it needs no conversion to the type of `primitive`."""
    if primitive is Primitive.BOOL:
        return "true" if value else "false"
    if primitive in (Primitive.FLOAT32, Primitive.FLOAT64):
        return _floating(float(value), primitive is Primitive.FLOAT32)
    return _integer(primitive, int(value))


def _floating(value: float, single: bool) -> str:
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return repr(value) + ("f" if single else "")


def _integer(primitive: Primitive, value: int) -> str:
    if primitive is Primitive.INT32 and value == INT_MIN:
        return "INT32_MIN"
    if primitive is Primitive.INT64 and value == -(2**63):
        return "INT64_MIN"
    if primitive in (Primitive.INT64, Primitive.UINT64) or value > INT_MAX:
        sign = "-" if value < 0 else ""
        return f"{sign}{_SUFFIX[primitive]}({abs(value)})"
    return f"{value}U" if primitive is Primitive.UINT32 else str(value)


def string(text: str) -> str:
    """Return the C string literal of `text` in UTF-8; only characters of the basic set stay as they are."""
    return '"' + "".join(_character(byte) for byte in text.encode("utf-8")) + '"'


def _character(byte: int) -> str:
    if byte in b'"\\?':
        return "\\" + chr(byte)
    return chr(byte) if 0x20 <= byte < 0x7F else f"\\{byte:03o}"


def wide_units(text: str) -> tuple[str, ...]:
    """Return the UTF-16 units of `text` and a terminator, as C numbers."""
    raw = text.encode("utf-16-le")
    return (*(f"0x{raw[i] | raw[i + 1] << 8:04X}" for i in range(0, len(raw), 2)), "0")


def comment_lines(lines: tuple[str, ...]) -> tuple[str, ...]:
    """Return the lines of an interface file's comment so that nothing in them ends the C comment.

    Comment marks and trigraphs get a space; empty lines at both ends go.
    """
    safe = [line.rstrip().replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?") for line in lines]
    while safe and not safe[0]:
        safe.pop(0)
    while safe and not safe[-1]:
        safe.pop()
    return tuple(_no_splice(line) for line in safe)


def _no_splice(line: str) -> str:
    return line + "." if line.endswith("\\") else line
