# SPDX-License-Identifier: Apache-2.0
"""Filters: what Python says of the same expression over the same message; what is refused, with its place."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.ros.known_types import KnownType, KnownTypes
from microros_gen.ros_tools.expressions import DEEPEST, LONGEST, Filter

SCAN = {
    "header": {"stamp": {"sec": 7, "nanosec": 5}, "frame_id": "laser"},
    "angle_min": -1.5,
    "range_max": 4.0,
    "ranges": [1.0, 2.5, 4.0],
}


def of(name: str, value: dict[str, Any]) -> tuple[KnownType, dict[str, Any]]:
    """Return a type, and a message of it with the defaults of what `value` omits."""
    known = KnownTypes().message(name)
    return known, known.codec.decode(known.name, known.codec.encode(known.name, value))


def scan(text: str) -> bool:
    known, message = of("sensor_msgs/msg/LaserScan", SCAN)
    return Filter(text, known.name, known.interfaces.messages)(message)


def refusal(text: str) -> str:
    with pytest.raises(UserError) as raised:
        scan(text)
    (diagnostic,) = raised.value.diagnostics
    return diagnostic.render()


def as_object(value: Any) -> Any:
    """Return a message as Python's own evaluation takes it: with attributes."""
    if isinstance(value, dict):
        return SimpleNamespace(**{name: as_object(member) for name, member in value.items()})
    return [as_object(item) for item in value] if isinstance(value, list) else value


@pytest.mark.parametrize(
    "text",
    [
        "m.header.stamp.sec > 6",
        "  m.header.frame_id == 'laser' and m.angle_min < 0 <= m.range_max",
        "not m.header.frame_id.startswith('map') or 1 / 0 > 1",
        "any(x > m.range_max / 2 for x in m.ranges if x != 4.0)",
        "m.ranges[-1] - m.ranges[0] == 3 and len(m.ranges[1:]) == 2",
        "max(m.ranges) in (4, 5) and m.header.frame_id.upper() not in ['MAP']",
        "(m.header.stamp.sec & 3 if m.ranges else 0) == 3",
        "m.header.stamp.sec >> 1 == 3 and -m.header.stamp.sec // 2 == -4 and m.header.stamp.sec % 4 == 3",
        "round(m.angle_min) == -2 and abs(m.angle_min) > 1 and sum(m.ranges) == 7.5",
        "m.header.stamp.sec ^ 7",
        "min([m.angle_min, 0]) is None",
        "all([x < 3 for x in m.ranges])",
    ],
)
def test_the_result_is_that_of_python(text: str) -> None:
    _, message = of("sensor_msgs/msg/LaserScan", SCAN)
    assert scan(text) is bool(eval(text.strip(), {"m": as_object(message)}))


def test_constants_of_the_type_and_elements_that_are_messages() -> None:
    known, message = of("diagnostic_msgs/msg/DiagnosticArray", {"status": [{"level": 2, "name": "arm"}]})
    messages = known.interfaces.messages
    assert Filter("any(s.level >= s.ERROR for s in m.status)", known.name, messages)(message)
    assert not Filter("m.status[0].level == m.status[0].STALE", known.name, messages)(message)


def test_a_part_of_a_message_is_filtered() -> None:
    known = KnownTypes().message("sensor_msgs/msg/LaserScan")
    frame = known.interfaces.messages[known.name].fields[1].type
    assert Filter("m > 1", frame, known.interfaces.messages)(2)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("m.header.", "<filter>:1:"),
        ("m.angle_min = 3", "<filter>:1:"),
        ("x" * (LONGEST + 1), "more than 4096 characters"),
        ("(" * 3000 + "m" + ")" * 3000, "not an expression of Python"),
        ("m\0", "not an expression of Python"),
        ("", "not an expression of Python"),
    ],
)
def test_a_text_that_is_no_expression(text: str, expected: str) -> None:
    found = refusal(text)
    assert expected in found
    assert "[MG-9806]" in found


@pytest.mark.parametrize(
    ("text", "column", "identity", "hint"),
    [
        ("m.header.fram_id == 'x'", 1, "MG-9808", "Did you mean 'frame_id'?"),
        ("m.angle_min > 0 and msg.data", 21, "MG-9808", "Available: m"),
        ("  'ä' == m.header.seq", 10, "MG-9808", "Available: stamp, frame_id"),
        ("open('x')", 1, "MG-9808", ""),
        ("__import__('os').system('true')", 1, "MG-9808", "Available: abs, all"),
        ("m.header.frame_id.format(m)", 1, "MG-9808", "startswith"),
        ("m.header.frame_id.__class__", 1, "MG-9807", "Members are those of messages"),
        ("m.angle_min ** 9", 1, "MG-9807", "Available: comparisons"),
        ("1 << 99", 1, "MG-9807", "Available: comparisons"),
        ("(lambda: 1)()", 2, "MG-9808", "Available"),
        ("[x for x in m.ranges for y in m.ranges]", 1, "MG-9807", "Available"),
        ("any(m for m in m.ranges)", 11, "MG-9807", "Choose another name"),
        ("m.ranges[::2]", 12, "MG-9807", "Available"),
        ("m[0]", 1, "MG-9807", "m.data"),
        ("f'{m}'", 1, "MG-9807", "Available"),
        ("3j", 1, "MG-9807", "Available"),
        ("max(m.ranges, key=len)", 1, "MG-9807", "Available"),
        ("-" * (DEEPEST + 1) + "1", DEEPEST + 1, "MG-9807", "Split it up"),
    ],
)
def test_what_is_outside_is_refused_at_its_place(text: str, column: int, identity: str, hint: str) -> None:
    found = refusal(text)
    assert found.startswith(f"<filter>:1:{column}: error: ")
    assert f"[{identity}]" in found
    assert hint in found


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("m.ranges[3] > 1", 1),
        ("1 < m.header.stamp.sec / 0", 5),
        ("m.header.frame_id > 3", 1),
        ("m.header.frame_id * 99", 1),
        ("3 .lower()", 1),
        ("int(m.header.frame_id)", 1),
        ("1 >> -1", 1),
        ("max([])", 1),
    ],
)
def test_a_message_that_does_not_fit(text: str, column: int) -> None:
    found = refusal(text)
    assert found.startswith(f"<filter>:1:{column}: error: cannot be computed for a message: ")
    assert "[MG-9809]" in found


def test_an_expression_in_lines_has_its_place_in_the_second() -> None:
    assert refusal("(m.angle_min\n  > m.angle)").startswith("<filter>:2:5: error: ")


def test_digits_are_limited() -> None:
    assert scan(f"round(m.header.stamp.sec, -{10**12}) == 0")


def test_a_filter_with_a_carriage_return_is_refused_at_its_place() -> None:
    assert "foo" in refusal("(m\r> 3 and foo)")


def test_loops_within_loops_are_refused() -> None:
    text = "m.ranges"
    for _ in range(3):
        text = f"[x for x in {text}]"
    assert scan(f"len({text}) == 3")
    assert "more than 3 times `for`" in refusal(f"len([x for x in {text}]) == 3")


def test_products_of_products_end() -> None:
    factor = "m.header.stamp.sec"
    for _ in range(8):
        factor = f"({factor} * {'9' * 100})"
    assert "the number is too large" in refusal(f"{factor} > 0")
