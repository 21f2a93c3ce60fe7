# SPDX-License-Identifier: Apache-2.0
"""Values of parameters: as in messages, in the file and in texts."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from typing import Any

from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value

NOT_SET, BOOL, INTEGER, DOUBLE, STRING = range(5)
BYTE_ARRAY, BOOL_ARRAY, INTEGER_ARRAY, DOUBLE_ARRAY, STRING_ARRAY = range(5, 10)
"""Values of rcl_interfaces/msg/ParameterType."""
TYPE_NAMES = (
    "not set",
    "bool",
    "integer",
    "double",
    "string",
    "byte_array",
    "bool_array",
    "integer_array",
    "double_array",
    "string_array",
)
"""As rclcpp calls them."""
_LONGEST_TEXT = 60


@dataclass(frozen=True)
class ParameterValue:
    """`type` is one of rcl_interfaces/msg/ParameterType; a list or bytes for an array, None for `NOT_SET`."""

    type: int
    value: Any = None

    @property
    def is_array(self) -> bool:
        """Return whether it has elements."""
        return self.type >= BYTE_ARRAY

    def __str__(self) -> str:
        text = str(self.to_json())
        return text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…"

    def same(self, other: ParameterValue) -> bool:
        """Return whether the two are equal; not a number is equal to itself."""
        return self.type == other.type and _comparable(self.value) == _comparable(other.value)

    def message(self) -> Value:
        """Return it as an rcl_interfaces/msg/ParameterValue."""
        if self.type == NOT_SET:
            return {"type": NOT_SET}
        return {"type": self.type, _member(self.type): self.value}

    def to_json(self) -> Any:
        """Return the value without its type, as JSON has it."""
        return list(self.value) if self.type == BYTE_ARRAY else self.value


NOTHING = ParameterValue(NOT_SET)


def value_of(message: Mapping[str, Any]) -> ParameterValue:
    """Return the value of an rcl_interfaces/msg/ParameterValue; one of an unknown type has that type and no value."""
    kind = message["type"]
    if kind == NOT_SET or kind >= len(TYPE_NAMES):
        return ParameterValue(kind)
    return ParameterValue(kind, message[_member(kind)])


def value_from_json(kind: str, value: Any) -> ParameterValue:
    """Return the value of a type (one of `TYPE_NAMES`). Raises ValueError: it is none of that type."""
    number = TYPE_NAMES.index(kind)
    if number == NOT_SET:
        return NOTHING
    elements = value if isinstance(value, list) else [value]
    if isinstance(value, list) != (number >= BYTE_ARRAY) or not all(_is(number, e) for e in elements):
        raise ValueError(f"no value of type {kind}")
    return ParameterValue(number, bytes(value) if number == BYTE_ARRAY else value)


def type_name(kind: int) -> str:
    """Return what rclcpp calls a type."""
    return TYPE_NAMES[kind] if kind < len(TYPE_NAMES) else "unknown type"


def _member(kind: int) -> str:
    return f"{TYPE_NAMES[kind]}_value"


def _is(kind: int, value: Any) -> bool:
    """Return whether JSON's value can be that of a scalar, or of an element."""
    if kind in (BOOL, BOOL_ARRAY):
        return isinstance(value, bool)
    if kind in (STRING, STRING_ARRAY):
        return isinstance(value, str) and not any("\ud800" <= letter <= "\udfff" for letter in value)
    if isinstance(value, bool):
        return False
    if kind in (DOUBLE, DOUBLE_ARRAY):
        return isinstance(value, float) or (isinstance(value, int) and abs(value) <= sys.float_info.max)
    low, high = (0, 255) if kind == BYTE_ARRAY else (-(2**63), 2**63 - 1)
    return isinstance(value, int) and low <= value <= high


def _comparable(value: Any) -> Any:
    if isinstance(value, float) and math.isnan(value):
        return "nan"
    return [_comparable(element) for element in value] if isinstance(value, list) else value
