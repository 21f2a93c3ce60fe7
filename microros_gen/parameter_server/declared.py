# SPDX-License-Identifier: Apache-2.0
"""What a node declares of a parameter, and whether a value complies with it: with the rules and words of rclcpp."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from typing import Any

from microros_gen.parameter_server.values import (
    DOUBLE,
    INTEGER,
    NOT_SET,
    STRING,
    ParameterValue,
    type_name,
)
from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value

_WHOLE_NUMBERS = 2.0**53
"""From here on a double has no fraction."""
_RANGES = {DOUBLE: "floating_point_range", INTEGER: "integer_range"}


@dataclass(frozen=True)
class Declared:
    """`range`: from, to and step, of an integer or double. `one_of`: the values that are accepted; empty: all.

    `size_max`: bytes of a string, elements of an array; 0: it is neither.
    """

    name: str
    type: int
    description: str = ""
    constraints: str = ""
    read_only: bool = False
    dynamic_typing: bool = False
    range: tuple[float, float, float] | None = None
    one_of: tuple[Any, ...] = ()
    size_max: int = 0

    @staticmethod
    def of(message: Mapping[str, Any]) -> Declared:
        """Return what a microros_parameter_msgs/msg/HeldParameter declares."""
        described = message["descriptor"]
        ranges = described.get(_RANGES.get(described["type"], ""), [])
        bounds = (ranges[0]["from_value"], ranges[0]["to_value"], ranges[0]["step"]) if ranges else None
        return Declared(
            described["name"],
            described["type"],
            described["description"],
            described["additional_constraints"],
            described["read_only"],
            described["dynamic_typing"],
            bounds,
            (*message["integers"], *message["doubles"], *message["strings"]),
            message["size_max"],
        )

    def descriptor(self) -> Value:
        """Return it as an rcl_interfaces/msg/ParameterDescriptor."""
        ranges: Value = {}
        if self.range is not None:
            low, high, step = self.range
            ranges[_RANGES[self.type]] = [{"from_value": low, "to_value": high, "step": step}]
        return {
            "name": self.name,
            "type": self.type,
            "description": self.description,
            "additional_constraints": self.constraints,
            "read_only": self.read_only,
            "dynamic_typing": self.dynamic_typing,
            **ranges,
        }

    def refusal_of_request(self, value: ParameterValue) -> str:
        """Return why another node may not set it to a value; empty: it may."""
        if self.read_only:
            return f"parameter '{self.name}' cannot be set because it is read-only"
        if value.type == NOT_SET:
            return "" if self.dynamic_typing else "cannot undeclare a statically typed parameter"
        return self.refusal(value)

    def refusal(self, value: ParameterValue) -> str:
        """Return why it cannot have a value; empty: it can."""
        if value.type != self.type:
            if self.dynamic_typing:
                return ""
            types = f"is of type {{{type_name(self.type)}}}, setting it to {{{type_name(value.type)}}}"
            return f"Wrong parameter type, parameter {{{self.name}}} {types} is not allowed."
        if self.size_max and (value.is_array or value.type == STRING):
            size = len(value.value) if value.is_array else len(value.value.encode())
            if size > self.size_max:
                kind = "array" if value.is_array else "string"
                return f"the {kind} for parameter '{self.name}' is too long"
        if self.one_of and value.value not in self.one_of:
            return f"Parameter {{{self.name}}} doesn't comply with its list of values."
        return self._refusal_of_range(value)

    def _refusal_of_range(self, value: ParameterValue) -> str:
        if self.range is None:
            return ""
        if value.type == INTEGER:
            complies, kind = _holds_integer(value.value, *map(int, self.range)), "integer"
        else:
            complies, kind = _holds_double(value.value, *self.range), "floating point"
        return "" if complies else f"Parameter {{{self.name}}} doesn't comply with {kind} range."


def _holds_integer(value: int, low: int, high: int, step: int) -> bool:
    if value == high:
        return True
    return low <= value <= high and (not step or (value - low) % step == 0)


def _holds_double(value: float, low: float, high: float, step: float) -> bool:
    if _equal(value, low) or _equal(value, high):
        return True
    if value < low or value > high:  # as rclcpp compares: NaN is neither
        return False
    if step == 0 or math.isnan(step):
        return True
    steps = abs((value - low) / step)
    if steps < _WHOLE_NUMBERS:
        steps = math.floor(steps + 0.5)
    return _equal(value, low + steps * abs(step))


def _equal(value: float, other: float) -> bool:
    """Compare as rclcpp does: 100 times the precision of the two together."""
    return abs(value - other) <= sys.float_info.epsilon * abs(value + other) * 100
