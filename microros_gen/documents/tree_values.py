# SPDX-License-Identifier: Apache-2.0
"""Values of a tree that a schema has judged.

What does not fit was reported before, and reads as not there.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.named import Named, NameFault
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, SequenceNode, YamlNode

_SIZE = re.compile(r"([0-9]{1,12}) ?(B|kB|KiB|MB|MiB)")
_SIZE_UNITS = {"B": 1, "kB": 1000, "KiB": 1024, "MB": 1_000_000, "MiB": 1024 * 1024}
_TIME = re.compile(r"([0-9]{1,12}(?:[.][0-9]{1,12})?) ?(us|ms|s)")
_TIME_UNITS = {"us": 1, "ms": 1000, "s": 1_000_000}
_RATE = re.compile(r"([0-9]{1,12}(?:[.][0-9]{1,12})?) ?(Hz|kHz)")
_RATE_UNITS = {"Hz": 1, "kHz": 1000}


def child(node: YamlNode | None, key: str) -> YamlNode | None:
    """Return the value of `key` where `node` is a mapping that has it."""
    return node.get(key) if isinstance(node, MappingNode) else None


def entries(node: YamlNode | None) -> tuple[Entry, ...]:
    """Return the entries of a mapping; nothing of anything else."""
    return tuple(node) if isinstance(node, MappingNode) else ()


def items(node: YamlNode | None) -> tuple[YamlNode, ...]:
    """Return the items of a sequence; nothing of anything else."""
    return node.items if isinstance(node, SequenceNode) else ()


def span_of(node: YamlNode | None) -> Span | None:
    """Return the place of `node`."""
    return node.span if node is not None else None


def text_of(node: YamlNode | None) -> str | None:
    """Return the text of a scalar that is a text."""
    value = node.value if isinstance(node, ScalarNode) else None
    return value if isinstance(value, str) else None


def child_text(node: YamlNode | None, key: str) -> str:
    """Return the text of `key` where `node` is a mapping that has one, else an empty one."""
    return text_of(child(node, key)) or ""


def bool_of(node: YamlNode | None) -> bool | None:
    """Return the value of a scalar that is true or false."""
    value = node.value if isinstance(node, ScalarNode) else None
    return value if isinstance(value, bool) else None


def int_of(node: YamlNode | None) -> int | None:
    """Return the value of a scalar that is a whole number (2.0 is one, as in JSON Schema)."""
    value = number_of(node)
    return int(value) if value is not None and value == value // 1 and abs(value) < 2**63 else None


def number_of(node: YamlNode | None) -> int | float | None:
    """Return the value of a scalar that is a number."""
    value = node.value if isinstance(node, ScalarNode) else None
    return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def named_of(node: YamlNode | None) -> Named | None:
    """Return the text of a scalar with its place."""
    text = text_of(node)
    return Named(text, node.span) if text is not None and node is not None else None


def size_of(node: YamlNode | None) -> int | None:
    """Return bytes: a whole number, or `8 KiB`."""
    number = int_of(node)
    if number is not None:
        return number if number >= 0 else None
    match = _SIZE.fullmatch(text_of(node) or "")
    return int(match.group(1)) * _SIZE_UNITS[match.group(2)] if match else None


def time_of(node: YamlNode | None) -> int | None:
    """Return microseconds: `20 ms`; a part of one is rounded away."""
    match = _TIME.fullmatch(text_of(node) or "")
    return int(float(match.group(1)) * _TIME_UNITS[match.group(2)] + 0.5) if match else None


def rate_of(node: YamlNode | None) -> Fraction | None:
    """Return the period of a rate in microseconds: `100 Hz` is 10,000; None also for a rate of 0."""
    match = _RATE.fullmatch(text_of(node) or "")
    rate = Fraction(match.group(1)) * _RATE_UNITS[match.group(2)] if match else Fraction(0)
    return 1_000_000 / rate if rate else None


def report_name(
    node: YamlNode | None, what: str, judge: Callable[[str], NameFault | None], diagnostics: Diagnostics
) -> bool:
    """Report what `judge` finds wrong with the text of `node`, at the character.

    Return whether it is right.
    """
    text = text_of(node)
    if text is None or node is None:
        return False
    fault = judge(text)
    if fault is None:
        return True
    diagnostics.error(
        f"{what} '{text}' {fault.message}", _character_span(node, text, fault.index), fault.hint, id=fault.id
    )
    return False


def _character_span(node: YamlNode, text: str, index: int) -> Span:
    span = node.span
    line = span.source.line(span.line)
    start = span.column - 1
    start += 0 if isinstance(node, ScalarNode) and node.plain else 1
    if line[start : start + len(text)] != text or index >= len(text):
        return span
    return Span(span.source, span.line, start + index + 1)
