# SPDX-License-Identifier: Apache-2.0
"""What somebody meant whose value is not what a schema asks for: numbers, and texts with a unit (`x-format`)."""

from __future__ import annotations

import re
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
_PER_SECOND = {"s": 1, "ms": 1000, "us": 1_000_000}


def value_hint(node: ScalarNode, schema: dict[str, Any]) -> str | None:
    """Return what to write instead of a scalar; None if that is unknown."""
    form = schema.get("x-format")
    if form in _FORMS:
        return _FORMS[form](node.text)
    kinds = schema.get("type", [])
    numeric = {"integer", "number"} & {*([kinds] if isinstance(kinds, str) else kinds)}
    return _number(node, schema) if numeric else None


def _number(node: ScalarNode, schema: dict[str, Any]) -> str | None:
    """Return what to write instead of a scalar that is no number, or one out of the range of `schema`."""
    if isinstance(node.value, str):
        if not node.plain and _NUMBER.fullmatch(node.text):
            return "Remove the quotes"
        found = _WITH_UNIT.fullmatch(node.text)
        unit = _BYTES.get(found["unit"].lower()) if found else None
        return f"Write {round(float(found['number']) * _FACTORS[unit])}" if found and unit else None
    if isinstance(node.value, bool) or not isinstance(node.value, (int, float)):
        return None
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and node.value < low:
        return f"Write {low} or more"
    if high is not None and node.value > high:
        return f"Write {high} or less"
    whole = isinstance(node.value, float) and abs(node.value) < 1e15
    return f"Write {int(node.value)}" if whole else None


def _time(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text)
    if found is None:
        return None
    number, unit = found["number"], found["unit"].lower()
    if unit in _TIMES:
        return f"Write {number} {_TIMES[unit]}"
    if unit in _RATES and float(number) > 0:
        milliseconds = 1000 / float(number) / (1000 if _RATES[unit] == "kHz" else 1)
        return f"Write {_decimal(milliseconds)} ms, the period of {number} {_RATES[unit]}"
    return f"Add the unit: {number} ms or {number} s" if not unit else None


def _rate(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text)
    if found is None or float(found["number"]) == 0:
        return "Remove the key" if found is not None else None
    number, unit = found["number"], found["unit"].lower()
    if unit in _TIMES:
        return f"Write {_decimal(_PER_SECOND[_TIMES[unit]] / float(number))} Hz"
    return f"Write {number} {_RATES[unit or 'hz']}" if unit in ("", *_RATES) else None


def _size(text: str) -> str | None:
    found = _WITH_UNIT.fullmatch(text)
    unit = _BYTES.get(found["unit"].lower() or "b") if found else None
    if found is None or unit is None:
        return None
    if "." in found["number"]:
        return f"Write {round(float(found['number']) * _FACTORS[unit])}"
    return f"Write {found['number']} {unit}"


def _on_full(text: str) -> str | None:
    first, _, time = text.partition(" ")
    if first != "block":
        return nearest(text, ["error", "drop_oldest", "block 20 ms"])
    found = _WITH_UNIT.fullmatch(time)
    unit = _TIMES.get(found["unit"].lower() or "ms") if found else None
    if found is None or unit not in ("ms", "s"):
        return "Write block 20 ms"
    return f"Write block {round(float(found['number']))} {unit}"


def _decimal(value: float) -> str:
    return f"{value:.6f}".rstrip("0").rstrip(".")


_FORMS = {"time": _time, "rate": _rate, "size": _size, "on_full": _on_full}
"""Values of `x-format` → what makes the hint for a text."""
