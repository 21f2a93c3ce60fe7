# SPDX-License-Identifier: Apache-2.0
"""Every message of the wheels, with random contents, against ROS 2's own serialization and against rosbags."""

from __future__ import annotations

import random
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.interfaces.closure import InterfaceSet
from microros_gen.interfaces.types import TypeName
from microros_gen.ros.codec import Codec
from tests.support.examples import examples
from tests.support.ros.values import random_value, without_bytes
from tests.support.typesupport.padding import padding
from tests.support.typesupport.values import from_ros, ros_class, to_ros

pytestmark = pytest.mark.ros
WITHOUT_CODE = "test_interface_files"
"""A wheel of interface files alone; test_msgs has the same."""


def check_with_rclpy(interfaces: InterfaceSet, codec: Codec, name: TypeName, source: random.Random) -> None:
    from rclpy.serialization import deserialize_message, serialize_message

    value = random_value(interfaces.messages, name, source)
    message = to_ros(interfaces.messages, name, value)
    encoded, theirs = codec.encode(name, value), bytes(serialize_message(message))
    length, gaps = padding(interfaces.messages, name, value)
    expected = bytearray(theirs[: 4 + length])  # after it is a surplus
    for gap in gaps:
        expected[4 + gap] = 0  # ROS 2 leaves there what was
    assert encoded == expected, (name, value)
    assert codec.decode(name, theirs) == value
    read = deserialize_message(encoded, ros_class(name))
    assert from_ros(interfaces.messages, name, read) == without_bytes(value)


def test_every_type_as_rclpy_writes_and_reads_it(installed: InterfaceSet) -> None:
    codec = Codec(installed)
    names = [name for name in installed.messages if name.package != WITHOUT_CODE]
    assert len(names) > 250
    for seed, name in enumerate(names):
        check_with_rclpy(installed, codec, name, random.Random(seed))


def test_random_messages_as_rclpy_writes_and_reads_them(installed: InterfaceSet) -> None:
    codec = Codec(installed)
    names = [name for name in installed.messages if name.package in ("test_msgs", "rcl_interfaces")]

    @given(name=st.sampled_from(names), source=st.randoms(use_true_random=False))
    @settings(max_examples=examples(100), deadline=None, suppress_health_check=list(HealthCheck))
    def check(name: TypeName, source: random.Random) -> None:
        check_with_rclpy(installed, codec, name, source)

    check()


@pytest.mark.system
def test_every_type_as_rosbags_writes_and_reads_it(installed: InterfaceSet) -> None:
    """In both byte orders; rosbags has no wide strings."""
    pytest.importorskip("rosbags.typesys")
    from tests.support.typesupport.rosbags import Oracle

    oracle, codec, messages = Oracle(Path(sys.prefix) / "share"), Codec(installed), installed.messages
    checked = 0
    for seed, name in enumerate(messages):
        if not oracle.knows(messages, name):
            continue
        value = random_value(messages, name, random.Random(1000 + seed))
        message = oracle.message(messages, name, without_bytes(value))
        for big in (False, True):
            assert codec.decode(name, oracle.write(name, message, big)) == value, (name, big)
        encoded = codec.encode(name, value)
        assert encoded == oracle.write(name, message, False), name
        read = oracle.tree(messages, name, oracle.read(name, encoded))
        assert read == without_bytes(value), name
        checked += 1
    assert checked > 300
