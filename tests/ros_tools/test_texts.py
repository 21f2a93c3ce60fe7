# SPDX-License-Identifier: Apache-2.0
"""Messages as text: rclpy's own text of the same bytes is the oracle; what is printed is read back the same."""

from __future__ import annotations

import importlib
import random
from typing import Any

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.interfaces.types import NamedType, Primitive, TypeName, element_of
from microros_gen.ros.known_types import KnownType, KnownTypes
from microros_gen.ros_tools.filling import fill
from microros_gen.ros_tools.texts import Messages, Style, Texts
from tests.support.ros.values import random_value

TYPES = (
    "std_msgs/msg/Int32",
    "std_msgs/msg/Empty",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/PointCloud2",
    "nav_msgs/msg/Odometry",
    "diagnostic_msgs/msg/DiagnosticArray",
    "trajectory_msgs/msg/JointTrajectory",
    "test_msgs/msg/Arrays",
    "test_msgs/msg/BoundedSequences",
    "test_msgs/msg/UnboundedSequences",
    "test_msgs/msg/WStrings",
    "test_msgs/msg/Nested",
)
WITH_FIXED_ARRAYS = ("sensor_msgs/msg/Imu", "nav_msgs/msg/Odometry", "test_msgs/msg/Arrays")
"""rclpy prints their fixed arrays of numbers as numpy does; here they are lists."""


@pytest.fixture(scope="module")
def known_types() -> KnownTypes:
    return KnownTypes()


def known(types: KnownTypes, name: str) -> KnownType:
    try:
        return types.message(name)
    except UserError:
        pytest.skip(f"{name} is not installed: the ROS wheels are missing")


def value_of(found: KnownType, seed: int) -> dict[str, Any]:
    """Return a random message as decoding gives it."""
    value = random_value(found.interfaces.messages, found.name, random.Random(seed))
    return found.codec.decode(found.name, found.codec.encode(found.name, value))


@pytest.mark.ros
@pytest.mark.parametrize("name", [name for name in TYPES if name not in WITH_FIXED_ARRAYS])
def test_one_line_is_what_rclpy_prints(name: str, known_types: KnownTypes) -> None:
    found = known(known_types, name)
    package, kind, stem = name.split("/")
    message_class = getattr(importlib.import_module(f"{package}.{kind}"), stem)
    deserialize = importlib.import_module("rclpy.serialization").deserialize_message
    texts = Texts(found.interfaces.messages)
    for seed in range(5):
        value = value_of(found, seed)
        theirs = deserialize(found.codec.encode(found.name, value), message_class)
        assert texts.line(found.name, value) == repr(theirs)


@pytest.mark.parametrize("flow", [False, True])
@pytest.mark.parametrize("name", TYPES)
def test_yaml_that_is_printed_is_read_as_the_same_message(
    name: str, flow: bool, known_types: KnownTypes
) -> None:
    found = known(known_types, name)
    texts = Texts(found.interfaces.messages)
    for seed in range(10):
        value = value_of(found, seed)
        _replace_zero_octets(value, found.name, found.interfaces.messages)
        filled = fill(texts.yaml(found.name, value, flow), found.name, found.interfaces.messages)
        encoded = found.codec.encode(found.name, filled.value)
        assert encoded == found.codec.encode(found.name, value)


def _replace_zero_octets(value: dict[str, Any], name: TypeName, messages: Messages) -> None:
    """Octets are printed as characters, as ROS 2 does, and YAML here refuses the character 0."""
    for field in messages[name].fields:
        element, found = element_of(field.type), value[field.name]
        if isinstance(element, NamedType):
            for part in found if isinstance(found, list) else [found]:
                _replace_zero_octets(part, element.name, messages)
        elif element is Primitive.BYTE:
            value[field.name] = bytes(b or 1 for b in found) if isinstance(found, bytes) else found or 1


LONG = {"header": {}, "height": 1, "data": bytes(range(5)), "is_dense": True}


@pytest.mark.parametrize(
    ("style", "expected"),
    [
        (Style(length=2), "data:\n- 0\n- 1\n- '...'\n"),
        (Style(length=5), "data:\n- 0\n- 1\n- 2\n- 3\n- 4\n"),
        (Style(arrays=False), "data: '<sequence type: uint8, length: 5>'\n"),
    ],
)
def test_long_arrays_are_cut_or_summed_up(style: Style, expected: str, known_types: KnownTypes) -> None:
    found = known(known_types, "sensor_msgs/msg/PointCloud2")
    value = found.codec.decode(found.name, found.codec.encode(found.name, LONG))
    assert expected in Texts(found.interfaces.messages, style).yaml(found.name, value)


def test_texts_are_cut_or_summed_up(known_types: KnownTypes) -> None:
    found = known(known_types, "std_msgs/msg/String")
    messages = found.interfaces.messages
    assert Texts(messages, Style(length=3)).yaml(found.name, {"data": "abcde"}) == "data: abc...\n"
    assert Texts(messages, Style(strings=False)).csv(found.name, {"data": "abcde"}) == "<string length: <5>>"


def test_comma_separated_values_are_those_of_all_members(known_types: KnownTypes) -> None:
    found = known(known_types, "geometry_msgs/msg/PointStamped")
    value = {
        "header": {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "map"},
        "point": {"x": 0.5, "y": 1.0, "z": -1.0},
    }
    assert Texts(found.interfaces.messages).csv(found.name, value) == "1,2,map,0.5,1.0,-1.0"


INT32 = TypeName("std_msgs", "msg", "Int32")


@pytest.mark.parametrize(
    ("type_name", "text", "identity", "place"),
    [
        ("std_msgs/msg/Int32", "7", "MG-9801", "1:1"),
        ("std_msgs/msg/Int32", "{dat: 7}", "MG-9802", "1:2"),
        ("std_msgs/msg/Int32", "data: seven", "MG-9805", "1:7"),
        ("std_msgs/msg/Int32", "data: 2147483648", "MG-9805", "1:7"),
        ("std_msgs/msg/Int32", "data: true", "MG-9805", "1:7"),
        ("std_msgs/msg/Int32", "data:", "MG-9805", "1:6"),
        ("std_msgs/msg/Bool", "data: 'false'", "MG-9805", "1:7"),
        ("std_msgs/msg/UInt8", "data: -1", "MG-9805", "1:7"),
        ("sensor_msgs/msg/Imu", "orientation_covariance: [1, 2]", "MG-9804", "1:25"),
        ("sensor_msgs/msg/PointCloud2", "data: 7", "MG-9803", "1:7"),
        ("sensor_msgs/msg/Imu", "{orientation: {x: 1,\n  q: 2}}", "MG-9802", "2:3"),
    ],
)
def test_each_mistake_has_its_place(
    type_name: str, text: str, identity: str, place: str, known_types: KnownTypes
) -> None:
    found = known(known_types, type_name)
    with pytest.raises(UserError) as error:
        fill(text, found.name, found.interfaces.messages)
    (diagnostic,) = error.value.diagnostics
    assert (diagnostic.id, str(diagnostic.span)) == (identity, f"<values>:{place}")


def test_all_mistakes_are_found_at_once(known_types: KnownTypes) -> None:
    found = known(known_types, "geometry_msgs/msg/Twist")
    with pytest.raises(UserError) as error:
        fill("{linear: {x: fast, w: 1}, angular: 3}", found.name, found.interfaces.messages)
    assert [d.id for d in error.value.diagnostics] == ["MG-9805", "MG-9802", "MG-9801"]


@pytest.mark.parametrize(
    ("type_name", "text", "expected"),
    [
        ("std_msgs/msg/Float64", "data: 3", {"data": 3.0}),
        ("std_msgs/msg/Int32", "data: 3.0", {"data": 3}),
        ("std_msgs/msg/Int32", "data: '3'", {"data": 3}),
        ("std_msgs/msg/String", "data: 1.50", {"data": "1.50"}),
        ("std_msgs/msg/Bool", "data: 1", {"data": True}),
        ("std_msgs/msg/Int32", "", {}),
    ],
)
def test_values_are_converted_where_nothing_is_lost(
    type_name: str, text: str, expected: dict[str, Any], known_types: KnownTypes
) -> None:
    found = known(known_types, type_name)
    assert fill(text, found.name, found.interfaces.messages).value == expected


def test_stamps_are_set_when_a_message_is_published(known_types: KnownTypes) -> None:
    found = known(known_types, "geometry_msgs/msg/PointStamped")
    filled = fill("{header: auto, point: {x: 1}}", found.name, found.interfaces.messages)
    for seconds in (5, 6):
        filled.stamp({"sec": seconds, "nanosec": 9})
        assert filled.value == {"header": {"stamp": {"sec": seconds, "nanosec": 9}}, "point": {"x": 1.0}}
