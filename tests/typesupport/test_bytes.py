# SPDX-License-Identifier: Apache-2.0
"""Encoded bytes against Fast CDR through rclpy, for every message type of the wheels."""

from __future__ import annotations

import ctypes

import pytest

from tests.support.examples import examples
from tests.support.typesupport.build import Generated
from tests.support.typesupport.encoder import (
    Encoder,
    names_member,
    with_python,
)
from tests.support.typesupport.padding import padding
from tests.support.typesupport.values import CStructs, Randomizer, to_ros

pytestmark = [pytest.mark.ros, pytest.mark.builds]

rclpy_serialization = pytest.importorskip("rclpy.serialization")

SAMPLES = ("empty", "full", "random", "full", *("random",) * 7)


@pytest.mark.examples
def test_every_type_encodes_as_ros_does(limits_case: Generated, library: ctypes.CDLL) -> None:
    """Same bytes as rclpy's serialize_message, padding (zero here) and its surplus at the end aside."""
    structs, samples = CStructs(limits_case.messages), SAMPLES[: examples(len(SAMPLES), least=3)]
    compared = 0
    for seed, plan in enumerate(with_python(limits_case)):
        source = Randomizer(limits_case.messages, seed)
        encoder = Encoder(library, plan.c_name)
        assert encoder.type.max_encoded_size == plan.max_encoded_size
        for mode in samples:
            tree = source.tree(plan.name, plan.limits, mode)
            body = encoder.encode(structs.fill(plan.name, tree))
            length, gaps = padding(limits_case.messages, plan.name, tree)
            message = to_ros(limits_case.messages, plan.name, tree)
            expected = bytearray(rclpy_serialization.serialize_message(message)[4:][:length])
            for gap in gaps:
                expected[gap] = 0
            assert body == expected, (plan.name, mode)
            compared += 1
            if mode == "full":
                assert len(body) == plan.max_encoded_size, plan.name
            if mode == "empty":
                assert len(body) == plan.min_encoded_size, plan.name
    assert compared >= len(samples) * 140


def test_ros_reads_what_is_encoded(limits_case: Generated, library: ctypes.CDLL) -> None:
    """Fast CDR decodes the bytes to the same message: nothing is missing at the end either."""
    structs = CStructs(limits_case.messages)
    for seed, plan in enumerate(with_python(limits_case)):
        source = Randomizer(limits_case.messages, 1000 + seed)
        tree = source.tree(plan.name, plan.limits, "random")
        body = Encoder(library, plan.c_name).encode(structs.fill(plan.name, tree))
        message = to_ros(limits_case.messages, plan.name, tree)
        read = rclpy_serialization.deserialize_message(b"\0\1\0\0" + body, type(message))
        assert read == message, plan.name


LIMIT, END, VALUE, BOUND, CAPACITY, DATA = range(6)


def test_every_limit_is_checked(limits_case: Generated, library: ctypes.CDLL) -> None:
    """One more than a limit, and NULL data with a size, are refused: each member of each type, by its path."""
    structs = CStructs(limits_case.messages)
    checked = nested = 0
    for seed, plan in enumerate(limits_case.plans):
        encoder = Encoder(library, plan.c_name)
        tree = Randomizer(limits_case.messages, seed).tree(plan.name, plan.limits, "full")
        value = structs.fill(plan.name, tree)
        seen = set()
        for path, member, _ in structs.strings(plan.name, value):
            if path in seen:
                continue
            seen.add(path)
            full, data = member.size, member.data
            member.size = full + 1
            reported, found, fits, kind = encoder.refusal(value)
            assert names_member(reported, path), (plan.name, path, reported)
            assert (found, fits) == (full + 1, full), (plan.name, path)
            assert kind in (LIMIT, BOUND), (plan.name, path)
            member.size, member.data = max(full, 1), None
            again, found, _, kind = encoder.refusal(value)
            assert (again, found) == (reported, max(full, 1))
            assert kind == DATA or not full, (plan.name, path)
            member.size, member.data = full, data
            encoder.encode(value)
            checked += 2
            nested += "]." in reported
    assert checked > 1000
    assert nested > 100


def test_null_data_without_elements_is_empty(limits_case: Generated, library: ctypes.CDLL) -> None:
    structs = CStructs(limits_case.messages)
    plan = limits_case.plan("sensor_msgs/msg/JointState")
    zeros = structs.structure(plan.name)()
    body = Encoder(library, plan.c_name).encode(zeros)
    assert body == bytes(8) + b"\1\0\0\0" + bytes(20)


def test_huge_sizes_are_shown_saturated(limits_case: Generated, library: ctypes.CDLL) -> None:
    structs = CStructs(limits_case.messages)
    plan = limits_case.plan("std_msgs/msg/String")
    value = structs.fill(plan.name, {"data": "x"})
    assert plan.limits is not None
    limits = plan.limits.fields[0]
    assert limits is not None
    value_limit = limits.string
    value.data.size = 2**40
    assert Encoder(library, plan.c_name).refusal(value)[:3] == ("data", 2**32 - 1, value_limit)


def test_a_bool_is_written_as_0_or_1(limits_case: Generated, library: ctypes.CDLL) -> None:
    plan = limits_case.plan("std_msgs/msg/Bool")
    value = (ctypes.c_uint8 * 1)(1)
    assert Encoder(library, plan.c_name).encode(value) == b"\1"
