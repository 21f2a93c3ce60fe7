# SPDX-License-Identifier: Apache-2.0
"""The parameters `paused`, `speed` and `time` of a clock, by the services that nodes of ROS 2 have for parameters."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value
from microros_gen.time_server.clock import FASTEST, LATEST_S, NS_PER_S, SLOWEST, SimulatedClock

NOT_SET, BOOL, INTEGER, DOUBLE = range(4)
"""Values of rcl_interfaces/msg/ParameterType."""


@dataclass(frozen=True)
class _Parameter:
    type: int
    description: str
    least: float = 0.0
    most: float = 0.0


PARAMETERS = {
    "paused": _Parameter(BOOL, "Whether the time stands still"),
    "speed": _Parameter(DOUBLE, "Seconds of the simulation in a second", SLOWEST, FASTEST),
    "time": _Parameter(DOUBLE, "The time in seconds; set it to jump, also back", 0.0, float(LATEST_S)),
}


class ClockParameters:
    """Answers requests of rcl_interfaces/srv about a clock; `changed` counts what was set."""

    def __init__(self, clock: SimulatedClock) -> None:
        self._clock = clock
        self.changed = 0

    def set_each(self, request: Value) -> Value:
        """Set one after another (SetParameters)."""
        return {"results": [self._set([parameter]) for parameter in request["parameters"]]}

    def set_all(self, request: Value) -> Value:
        """Set all at one moment, or none (SetParametersAtomically)."""
        return {"result": self._set(request["parameters"])}

    def get(self, request: Value) -> Value:
        """Return values (GetParameters)."""
        return {"values": [self._value(name) for name in request["names"]]}

    def types(self, request: Value) -> Value:
        """Return types (GetParameterTypes)."""
        return {
            "types": [PARAMETERS[name].type if name in PARAMETERS else NOT_SET for name in request["names"]]
        }

    def describe(self, request: Value) -> Value:
        """Return what they are for, and their ranges (DescribeParameters)."""
        return {"descriptors": [_descriptor(name) for name in request["names"]]}

    def names(self, request: Value) -> Value:
        """Return all names (ListParameters); none of them has a prefix."""
        return {"result": {"names": [] if request["prefixes"] else sorted(PARAMETERS), "prefixes": []}}

    def _value(self, name: str) -> Value:
        if name == "paused":
            return {"type": BOOL, "bool_value": self._clock.paused}
        if name == "speed":
            return {"type": DOUBLE, "double_value": self._clock.speed}
        if name == "time":
            return {"type": DOUBLE, "double_value": self._clock.now_ns() / NS_PER_S}
        return {"type": NOT_SET}

    def _set(self, parameters: Sequence[Value]) -> Value:
        found: dict[str, Any] = {}
        for parameter in parameters:
            name, value = parameter["name"], parameter["value"]
            reason = _refusal(name, value)
            if reason:
                return {"successful": False, "reason": reason}
            found[name] = value["bool_value"] if name == "paused" else _number(value)
        time_s = found.get("time")
        self._clock.change(
            time_ns=None if time_s is None else round(time_s * NS_PER_S),
            speed=found.get("speed"),
            paused=found.get("paused"),
        )
        self.changed += bool(found)
        return {"successful": True, "reason": ""}


def _number(value: Value) -> float:
    """Return an integer or a double: `ros2 param set NODE speed 2` sends an integer."""
    return float(value["integer_value"] if value["type"] == INTEGER else value["double_value"])


def _refusal(name: str, value: Value) -> str:
    """Return why a parameter cannot have a value; empty: it can."""
    parameter = PARAMETERS.get(name)
    if parameter is None:
        return f"no parameter '{name}': there are paused, speed and time"
    if parameter.type == BOOL:
        return "" if value["type"] == BOOL else f"'{name}' must be a bool"
    if value["type"] not in (INTEGER, DOUBLE):
        return f"'{name}' must be a number"
    number = _number(value)
    if not math.isfinite(number) or not parameter.least <= number <= parameter.most:
        return f"'{name}' must be {parameter.least:g} to {parameter.most:.10g}"
    return ""


def _descriptor(name: str) -> Value:
    parameter = PARAMETERS.get(name)
    if parameter is None:
        return {"name": name}
    limits = [{"from_value": parameter.least, "to_value": parameter.most}] if parameter.most else []
    return {
        "name": name,
        "type": parameter.type,
        "description": parameter.description,
        "dynamic_typing": False,
        "floating_point_range": limits,
    }
