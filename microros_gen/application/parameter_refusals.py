# SPDX-License-Identifier: Apache-2.0
"""Why a parameter refuses a value of its type: range, steps, storage and choice, with a hint of what it accepts."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping
from enum import Enum

from microros_gen.application.model import ParameterDecl, Scalar
from microros_gen.records import dataclass

RANGE_ENDS: Mapping[str, tuple[int | float, int | float]] = {
    "integer": (-(2**63), 2**63 - 1),
    "double": (-sys.float_info.max, sys.float_info.max),
}
"""Smallest and largest number of a range, for an end that nobody has set."""
_CLOSE = 1e-9
"""How far from a whole number of steps a floating-point value may be."""


class Cause(Enum):
    """What a value is in conflict with."""

    RANGE = "its range"
    STEP = "the steps of its range"
    SIZE = "its storage"
    CHOICE = "its values"


@dataclass(frozen=True)
class Refusal:
    """`hint` says which values are accepted."""

    cause: Cause
    hint: str


def refusals(parameter: ParameterDecl, value: Scalar | tuple[Scalar, ...]) -> Iterator[Refusal]:
    """Yield why a node would refuse a value, whose type is that of the parameter."""
    low, high = parameter.minimum, parameter.maximum
    if isinstance(value, (int, float)) and low is not None and high is not None:
        if not low <= value <= high:
            yield Refusal(Cause.RANGE, _range_words(parameter, low if value < low else high))
        elif parameter.step and value != high and not _is_step(value - low, parameter.step):
            closest = min(low + round((value - low) / parameter.step) * parameter.step, high)
            shown = closest if isinstance(closest, int) else f"{closest:.12g}"
            yield Refusal(Cause.STEP, f"Write {shown}: its values are {parameter.step} apart, from {low}")
    size = size_of_value(value)
    if parameter.size is not None and size > parameter.size:
        yield Refusal(Cause.SIZE, f"Set size: {size}")
    if parameter.one_of and value not in parameter.one_of:
        yield Refusal(Cause.CHOICE, f"Available: {', '.join(map(str, parameter.one_of))}")


def size_of_value(value: Scalar | tuple[Scalar, ...]) -> int:
    """Return bytes of a text, elements of a list; 0 of everything else."""
    if isinstance(value, str):
        return len(value.encode())
    return len(value) if isinstance(value, tuple) else 0


def _range_words(parameter: ParameterDecl, closest: int | float) -> str:
    """Return a hint with the ends of a range, of which `closest` is the nearer one.

    Rules of a parameter file may set one end, or exclude it.
    """
    excluded = {rule.name: rule.values[0] for rule in parameter.rules if rule.name in ("gt", "lt")}
    first, last = RANGE_ENDS[parameter.type]
    low = f"above {excluded['gt']}" if "gt" in excluded else f"from {parameter.minimum} on"
    high = f"below {excluded['lt']}" if "lt" in excluded else f"up to {parameter.maximum}"
    if "gt" not in excluded and parameter.minimum == first:
        return f"Write a number {high}"
    if "lt" not in excluded and parameter.maximum == last:
        return f"Write a number {low}"
    if excluded:
        return f"Write a number {low} and {high}{_example(parameter.minimum, parameter.maximum)}"
    return f"Write {closest}: it goes from {parameter.minimum} to {parameter.maximum}"


def _is_step(distance: int | float, step: int | float) -> bool:
    if isinstance(distance, int) and isinstance(step, int):
        return distance % step == 0
    steps = distance / step
    return math.isclose(steps, round(steps), rel_tol=_CLOSE, abs_tol=_CLOSE)


def _example(low: int | float | None, high: int | float | None) -> str:
    """Return words with a short number from `low` to `high`; none where no short one lies in between."""
    if not isinstance(low, float) or not isinstance(high, float):
        return f", such as {low}"
    middle = float(f"{(low + high) / 2:.3g}")
    return f", such as {middle}" if low <= middle <= high else ""
