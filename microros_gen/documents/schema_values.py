# SPDX-License-Identifier: Apache-2.0
"""What somebody meant whose value is not what a schema asks for: numbers, and texts with a unit (`x-format`)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from microros_gen.diagnostics import nearest
from microros_gen.documents.yaml_tree import ScalarNode

_NUMBER = re.compile(r"0x[0-9a-fA-F]+|[-+]?[0-9]+([.][0-9]+)?")
_WITH_UNIT = re.compile(r"(?P<number>[0-9]{1,12}(?:[.][0-9]{1,12})?) *(?P<unit>[A-Za-zµ]*)")
_BYTES = {
    **dict.fromkeys(("b", "byte", "bytes"), "B"),
    **dict.fromkeys(("k", "kb"), "kB"),
    **dict.fromkeys(("ki", "kib"), "KiB"),
    **dict.fromkeys(("m", "mb"), "MB"),
    **dict.fromkeys(("mi", "mib"), "MiB"),
}
_FACTORS = {"B": 1, "kB": 1000, "KiB": 1024, "MB": 1_000_000, "MiB": 1 << 20}
_TIMES = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), "s"),
    **dict.fromkeys(("ms", "msec", "msecs", "millis", "millisecond", "milliseconds"), "ms"),
    **dict.fromkeys(("us", "µs", "usec", "usecs", "micros", "microsecond", "microseconds"), "us"),
}
_RATES = {**dict.fromkeys(("hz", "hertz"), "Hz"), **dict.fromkeys(("khz", "kilohertz"), "kHz")}
_FASTER = {**dict.fromkeys(("mhz", "megahertz"), 1_000), **dict.fromkeys(("ghz", "gigahertz"), 1_000_000)}
"""Units of a rate above kHz, in kHz."""
_PER_SECOND = {"s": 1, "ms": 1000, "us": 1_000_000}
_VOLTS = {"v": 1000, "mv": 1}
_NO_FACTORS: dict[str, int] = {}
_LONGEST_BLOCK_MS = 60_000
_LARGEST = 1e15
"""From here on a number is not written out."""
_MOST = 10**12
"""A time or rate has at most 12 digits before its point."""


def value_hint(node: ScalarNode, schema: dict[str, Any]) -> str | None:
    """Return what to write instead of a scalar; None if that is unknown."""
    form = schema.get("x-format")
    if form in _FORMS:
        return _FORMS[form](node.text)
    kinds = schema.get("type", [])
    numeric = {"integer", "number"} & {*([kinds] if isinstance(kinds, str) else kinds)}
    return _number(node, schema, is_whole="number" not in numeric) if numeric else None


def _number(node: ScalarNode, schema: dict[str, Any], *, is_whole: bool) -> str | None:
    """Return what to write instead of a scalar that is no number, or one out of the range of `schema`."""
    value = node.value
    factors = _VOLTS if schema.get("x-format") == "millivolts" else _NO_FACTORS
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        return None
    if isinstance(value, str):
        is_quoted = not node.plain and _NUMBER.fullmatch(node.text) is not None
        number = _value_of(node.text) if is_quoted else _with_unit(node.text, factors)
        if number is None:
            return None
    else:
        is_quoted, number = False, value
        if isinstance(value, float) and not value.is_integer() and factors:
            number = round(value * factors["v"]) if abs(value) < _LARGEST else value
    return _in_range(number, schema) or _as_number(number, value, is_quoted=is_quoted, is_whole=is_whole)


def _as_number(number: float, value: object, *, is_quoted: bool, is_whole: bool) -> str | None:
    """Return how a number is written that is in the range."""
    if not abs(number) < _LARGEST or (is_whole and isinstance(number, float) and not number.is_integer()):
        return "Write a whole number" if is_whole else None
    if is_quoted:
        return "Remove the quotes"
    return f"Write {int(number)}" if number != value and float(number).is_integer() else None


def _in_range(number: float, schema: dict[str, Any]) -> str | None:
    """Return the hint for a number that is out of the range of a schema."""
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and number < low:
        return f"Write {low} or more"
    return f"Write {high} or less" if high is not None and number > high else None


def _value_of(text: str) -> float:
    """Return the number that a text is."""
    if text.startswith("0x"):
        return int(text, 16)
    number = float(text)
    return int(number) if number.is_integer() else number


def _with_unit(text: str, factors: Mapping[str, int]) -> int | None:
    """Return the whole number that a text with a unit means; `factors`: other units than those of sizes."""
    found = _WITH_UNIT.fullmatch(text)
    if found is None:
        return None
    unit = found["unit"].lower()
    factor = factors.get(unit) if factors else _FACTORS.get(_BYTES.get(unit, ""))
    return round(float(found["number"]) * factor) if factor is not None else None


def _time(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text)
    if found is None:
        return None
    number, unit = found["number"], found["unit"].lower()
    if not float(number):
        return "Write a time above 0 such as 20 ms"
    if unit in _TIMES:
        return f"Write {number} {_TIMES[unit]}"
    if unit in _RATES:
        milliseconds = _decimal(1000 / float(number) / (1000 if _RATES[unit] == "kHz" else 1))
        return f"Write {milliseconds} ms, the period of {number} {_RATES[unit]}" if milliseconds else None
    return f"Add the unit: {number} ms or {number} s" if not unit else None


def _rate(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text.removeprefix("-"))
    if found is None or float(found["number"]) == 0:
        return "Remove the key" if found is not None else None
    number, unit = found["number"], found["unit"].lower()
    if unit in _TIMES:
        rate = _decimal(_PER_SECOND[_TIMES[unit]] / float(number))
        return f"Write {rate} Hz" if rate else None
    if unit in _FASTER:
        faster = _decimal(float(number) * _FASTER[unit])
        return f"Write {faster} kHz" if faster else None
    return f"Write {number} {_RATES[unit or 'hz']}" if unit in ("", *_RATES) else None


def _size(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text)
    unit = _BYTES.get(found["unit"].lower() or "b") if found else None
    if found is None or unit is None:
        return "Write a size such as 2 kB"
    size = round(float(found["number"]) * _FACTORS[unit])
    if not size:
        return "Write a size above 0 such as 2 kB"
    return f"Write {size}" if "." in found["number"] else f"Write {found['number']} {unit}"


def _on_full(text: str) -> str | None:
    first, _, time = text.partition(" ")
    if first != "block":
        return nearest(text, ["error", "drop_oldest", "block 20 ms"])
    found = _WITH_UNIT.fullmatch(time)
    unit = _TIMES.get(found["unit"].lower() or "ms") if found else None
    if found is None or unit is None:
        return "Write block 20 ms"
    milliseconds = round(float(found["number"]) * 1000 / _PER_SECOND[unit])
    milliseconds = min(max(milliseconds, 1), _LONGEST_BLOCK_MS)
    is_whole = milliseconds % 1000 == 0
    return f"Write block {milliseconds // 1000} s" if is_whole else f"Write block {milliseconds} ms"


def _decimal(value: float) -> str:
    """Return a number with six decimals at most; empty: it would be 0, or has too many digits."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return text if text != "0" and value < _MOST else ""


def _parameter_name(text: str) -> str:
    name = re.sub(r"[^A-Za-z0-9_.]+", "_", text).strip("_")
    return f"Write {name}" if re.match(r"[A-Za-z_]", name) else f"Write p_{name}" if name else "Write gain"


_FORMS = {"parameter_name": _parameter_name, "time": _time, "rate": _rate, "size": _size, "on_full": _on_full}
"""Values of `x-format` → what makes the hint for a text."""
