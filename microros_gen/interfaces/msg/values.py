# SPDX-License-Identifier: Apache-2.0
"""Values of constants and defaults in .msg files: from their text to Python values, as ROS 2 Jazzy takes
them.

A string passes two readers there. rosidl_adapter takes off the quotes and writes the text into an .idl file,
where Python's escapes are resolved; rosidl_parser reads that file and resolves the escapes of IDL (OMG IDL
4.2, table 7-9). `\\t` is a tab after both, `\\\\n` a line feed, and `\\n` is refused, since an IDL string
ends with its line.
"""

from __future__ import annotations

import codecs
import math
import re
import struct

from microros_gen.documents.python_literal import python_literal
from microros_gen.interfaces.types import Primitive, ScalarValue, StringType

_INTEGER_RANGES = {
    Primitive.BYTE: (0, 255),
    Primitive.CHAR: (0, 255),
    Primitive.INT8: (-(2**7), 2**7 - 1),
    Primitive.UINT8: (0, 2**8 - 1),
    Primitive.INT16: (-(2**15), 2**15 - 1),
    Primitive.UINT16: (0, 2**16 - 1),
    Primitive.INT32: (-(2**31), 2**31 - 1),
    Primitive.UINT32: (0, 2**32 - 1),
    Primitive.INT64: (-(2**63), 2**63 - 1),
    Primitive.UINT64: (0, 2**64 - 1),
}
_BOOLEANS = {"true": True, "1": True, "false": False, "0": False}
# The escapes of Python's text literals; the last group is whatever else follows a backslash.
_PYTHON_ESCAPE = re.compile(
    r"\\(?:([abfnrtv\\'\"])|([0-7]{1,3})|x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|(.?))",
    re.DOTALL,
)
_SIMPLE = dict(zip("abfnrtv\\'\"", "\a\b\f\n\r\t\v\\'\"", strict=True))
_IDL_ESCAPE = re.compile(r"\\[ntvbrfa\\'\"]|\\[0-7]{1,3}|\\x[0-9a-fA-F]{1,2}")
_FOUR = "A backslash is written four times"
_IDL_SECOND = re.compile(r'\\(["\\])')


class InvalidValueError(Exception):
    """A text that is no value of its type: what is wrong, and a hint."""

    def __init__(self, message: str, hint: str | None = None, *, id: str) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.id = id


def scalar_value(kind: Primitive | StringType, text: str) -> ScalarValue:
    """Return the value of `text`, which has no space around it. Raises InvalidValueError."""
    if isinstance(kind, StringType):
        return _through_idl(_checked_string(kind, text), kind)
    return primitive_value(kind, text)


def primitive_value(kind: Primitive, text: str) -> bool | int | float:
    """Return the number or truth value of `text`. Raises InvalidValueError."""
    if not text:
        raise InvalidValueError("a value is missing", id="MG-2140")
    if kind is Primitive.BOOL:
        if text.lower() not in _BOOLEANS:
            raise InvalidValueError(f"'{text}' is not a bool", "Write true, false, 1 or 0", id="MG-2141")
        return _BOOLEANS[text.lower()]
    if kind in (Primitive.FLOAT32, Primitive.FLOAT64):
        return _float_value(kind, text)
    return _integer_value(kind, text)


def string_elements(kind: StringType, texts: list[str]) -> tuple[str, ...]:
    """Return the elements of the default of a string array; each text stands as in the file.

    rosidl hands the whole array on as the text of a Python tuple, so an element's backslashes are read once
    more than those of a single string, and letters beyond ASCII do not survive: they are refused. Raises
    InvalidValueError.
    """
    values = tuple(_checked_string(kind, _bare_element(text)) for text in texts)
    literal = repr(values).replace("\\", "\\\\")
    try:
        literal = literal.encode("latin-1").decode("utf-8")
    except UnicodeError:
        raise InvalidValueError(
            "letters beyond ASCII are not allowed in the default of a string array",
            "ROS 2 Jazzy refuses it too; set the value in the program",
            id="MG-2142",
        ) from None
    try:
        elements: tuple[str, ...] = python_literal(_resolve_idl_escapes(literal))
    except ValueError:
        raise InvalidValueError(
            "a backslash in a string array is not a complete escape", _FOUR, id="MG-2143"
        ) from None
    for element in elements:
        _check_characters(element, kind)
    return elements


def positive_integer(text: str) -> int | None:
    """Return the number that `text` gives as Python's int() reads it, or None when it is not above zero."""
    try:
        number = int(text)
    except ValueError:
        return None
    return number if number > 0 else None


def _integer_value(kind: Primitive, text: str) -> int:
    low, high = _INTEGER_RANGES[kind]
    try:
        number = _integer(text)
    except ValueError:
        raise InvalidValueError(
            f"'{text}' is not an integer",
            f"The type {kind.value} takes {low} to {high}, written in decimal or as 0x…, 0o… or 0b…",
            id="MG-2144",
        ) from None
    if not low <= number <= high:
        raise InvalidValueError(
            f"{text} does not fit {kind.value}", f"Its range is {low} to {high}", id="MG-2145"
        )
    return number


def _integer(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        return int(text, 0)


def _float_value(kind: Primitive, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        raise InvalidValueError(
            f"'{text}' is not a number", "A number is written like 1, -0.5 or 1.5e-3", id="MG-2146"
        ) from None
    if not math.isfinite(number):
        reason = "it is too large" if any(c.isdigit() for c in text) else "C has no literal for it"
        raise InvalidValueError(
            f"'{text}' cannot be a {kind.value}: {reason}", "Set the value in the program", id="MG-2147"
        )
    if kind is Primitive.FLOAT32:
        try:
            struct.pack("<f", number)
        except OverflowError:
            raise InvalidValueError(
                f"{text} does not fit float32",
                "Its largest value is 3.4028235e38; use float64",
                id="MG-2148",
            ) from None
    return number


def _checked_string(kind: StringType, text: str) -> str:
    """Return `text` without its outer quotes; its characters are counted as they are written."""
    value = _unquoted(text)
    if kind.bound is not None and len(value) > kind.bound:
        raise InvalidValueError(
            f"the string has {len(value)} characters, but its type takes at most {kind.bound}",
            f"Shorten it, or raise the bound to <={len(value)}",
            id="MG-2149",
        )
    return value


def _unquoted(text: str) -> str:
    for quote in ('"', "'"):
        if text.startswith(quote) and text.endswith(quote):
            inner = text[1:-1]
            if re.search(rf"(?<!\\){quote}", inner):
                raise InvalidValueError(
                    f"a quote inside of the string is not escaped: {text}", f"Write \\{quote}", id="MG-2150"
                )
            return inner.replace("\\" + quote, quote)
    return text


def _bare_element(text: str) -> str:
    """Return an element without its quotes and, as rosidl, without the space inside of them."""
    text = text.strip(" ")
    if text[0] in "\"'":
        text = text[1:-1].replace("\\" + text[0], text[0])
    return text.strip()


def _through_idl(value: str, kind: StringType) -> str:
    """Return the string that the .idl file between rosidl's two readers gives. Raises InvalidValueError."""
    octets = _PYTHON_ESCAPE.sub(_python_escape, value.encode("utf-8").decode("latin-1"))
    try:
        literal = octets.replace('"', '\\"').encode("latin-1").decode("utf-8")
    except UnicodeError:
        raise InvalidValueError(
            "an escape names a character beyond ASCII, which ROS 2 Jazzy refuses",
            "Write the character itself",
            id="MG-2151",
        ) from None
    if "\n" in literal or "\r" in literal:
        raise InvalidValueError(
            "a string cannot hold a line end here", "ROS 2 Jazzy takes \\\\n for a line feed", id="MG-2152"
        )
    if not _closes(literal):
        raise InvalidValueError("a backslash at the end of the string", _FOUR, id="MG-2153")
    result = _resolve_idl_escapes(literal)
    _check_characters(result, kind)
    return result


def _python_escape(match: re.Match[str]) -> str:
    simple, octal, x, u, long_u, other = match.groups()
    if simple is not None:
        return _SIMPLE[simple]
    if octal is not None:
        return chr(int(octal, 8))
    digits = x or u or long_u
    if digits is not None:
        code = int(digits, 16)
        if code > 0x10FFFF:
            raise InvalidValueError(
                f"'\\U{digits}' is not a character", "Unicode ends at 10FFFF", id="MG-2154"
            )
        return chr(code)
    if not other:
        raise InvalidValueError("the string ends with a single backslash", _FOUR, id="MG-2155")
    if other in "xuUN":
        raise InvalidValueError(f"'\\{other}' is not a complete escape", _FOUR, id="MG-2156")
    return match.group(0)


def _closes(literal: str) -> bool:
    """Return whether the IDL string literal around `literal` ends at its last quote."""
    run = 0
    for character in literal:
        if character == '"' and run % 2 == 0:
            return False
        run = run + 1 if character == "\\" else 0
    return run % 2 == 0


def _resolve_idl_escapes(literal: str) -> str:
    first = _IDL_ESCAPE.sub(lambda m: codecs.decode(m.group(0), "unicode-escape"), literal)
    return _IDL_SECOND.sub(r"\1", first)


def _check_characters(value: str, kind: StringType) -> None:
    if "\0" in value:
        raise InvalidValueError(
            "a string cannot hold the character NUL", "It ends the string in C", id="MG-2157"
        )
    octets = len(value) if kind.wide else len(value.encode("utf-8", "surrogatepass"))
    if kind.bound is not None and octets > kind.bound:
        raise InvalidValueError(
            f"the string takes {octets} bytes in UTF-8, but its type takes at most {kind.bound}",
            f"Shorten it, or raise the bound to <={octets}",
            id="MG-2158",
        )
