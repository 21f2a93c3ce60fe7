# SPDX-License-Identifier: Apache-2.0
"""The clock of the time server over a made one, and its parameters."""

from __future__ import annotations

from typing import Any

import pytest

from microros_gen.time_server.clock import FASTEST, LATEST_S, NS_PER_S, SimulatedClock
from microros_gen.time_server.parameters import BOOL, DOUBLE, INTEGER, NOT_SET, ClockParameters


class Wall:
    """A clock that the test sets."""

    ns = 77

    def __call__(self) -> int:
        return self.ns


def test_it_pauses_changes_its_speed_and_is_set() -> None:
    wall = Wall()
    clock = SimulatedClock(wall, 5 * NS_PER_S)
    wall.ns += 3 * NS_PER_S + 1
    assert clock.now_ns() == 8 * NS_PER_S + 1
    clock.change(paused=True)
    wall.ns += NS_PER_S
    assert clock.now_ns() == 8 * NS_PER_S + 1
    clock.change(speed=0.25)
    wall.ns += NS_PER_S
    assert clock.now_ns() == 8 * NS_PER_S + 1
    clock.change(paused=False)
    wall.ns += 4 * NS_PER_S
    assert clock.now_ns() == 9 * NS_PER_S + 1
    clock.change(time_ns=2, speed=1.0)
    assert clock.now_ns() == 2
    wall.ns += 1
    assert clock.now_ns() == 3


def test_the_end_of_time() -> None:
    wall = Wall()
    clock = SimulatedClock(wall, (LATEST_S - 1) * NS_PER_S)
    clock.change(speed=FASTEST)
    wall.ns += 1000 * NS_PER_S
    assert clock.now_ns() == LATEST_S * NS_PER_S


def parameter(name: str, kind: int, value: Any) -> dict[str, Any]:
    empty = {"bool_value": False, "integer_value": 0, "double_value": 0.0}
    member = {BOOL: "bool_value", INTEGER: "integer_value", DOUBLE: "double_value"}.get(kind)
    return {
        "name": name,
        "value": {"type": kind, **empty, **({member: value} if member else {})},
    }


@pytest.mark.parametrize(
    ("name", "kind", "value", "reason"),
    [
        ("paused", BOOL, True, ""),
        ("speed", DOUBLE, 1000.0, ""),
        ("speed", INTEGER, 2, ""),
        ("time", DOUBLE, 0.0, ""),
        ("time", INTEGER, LATEST_S, ""),
        ("paused", INTEGER, 1, "'paused' must be a bool"),
        ("speed", BOOL, True, "'speed' must be a number"),
        ("speed", NOT_SET, None, "'speed' must be a number"),
        ("speed", DOUBLE, 0.0, "'speed' must be 0.001 to 1000"),
        ("speed", DOUBLE, float("nan"), "'speed' must be 0.001 to 1000"),
        ("time", DOUBLE, -0.5, "'time' must be 0 to 2147483647"),
        ("time", DOUBLE, float("inf"), "'time' must be 0 to 2147483647"),
        ("tim", DOUBLE, 1.0, "no parameter 'tim': there are paused, speed and time"),
    ],
)
def test_values_are_taken_or_refused(name: str, kind: int, value: Any, reason: str) -> None:
    clock = SimulatedClock(Wall(), NS_PER_S)
    parameters = ClockParameters(clock)
    results = parameters.set_each({"parameters": [parameter(name, kind, value)]})["results"]
    assert results == [{"successful": not reason, "reason": reason}]
    assert parameters.changed == (not reason)
    if not reason:
        (read,) = parameters.get({"names": [name]})["values"]
        assert next(v for k, v in read.items() if k != "type") == value


def test_all_or_none() -> None:
    clock = SimulatedClock(Wall(), NS_PER_S)
    parameters = ClockParameters(clock)
    wrong = [parameter("time", DOUBLE, 9.0), parameter("speed", DOUBLE, -1.0)]
    assert not parameters.set_all({"parameters": wrong})["result"]["successful"]
    assert (clock.now_ns(), clock.speed) == (NS_PER_S, 1.0)
    right = [parameter("time", DOUBLE, 9.0), parameter("paused", BOOL, True)]
    assert parameters.set_all({"parameters": right})["result"]["successful"]
    assert (clock.now_ns(), clock.paused) == (9 * NS_PER_S, True)


def test_lists_and_descriptions() -> None:
    parameters = ClockParameters(SimulatedClock(Wall()))
    assert parameters.names({"prefixes": [], "depth": 0})["result"]["names"] == ["paused", "speed", "time"]
    assert parameters.names({"prefixes": ["a"], "depth": 0})["result"]["names"] == []
    assert parameters.types({"names": ["paused", "x", "time"]})["types"] == [BOOL, NOT_SET, DOUBLE]
    assert parameters.get({"names": ["x"]})["values"] == [{"type": NOT_SET}]
    (speed, unknown) = parameters.describe({"names": ["speed", "x"]})["descriptors"]
    assert speed["floating_point_range"] == [{"from_value": 0.001, "to_value": 1000.0}]
    assert unknown == {"name": "x"}
