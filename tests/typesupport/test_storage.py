# SPDX-License-Identifier: Apache-2.0
"""Static storage: default values, capacities and sizes of a bound message."""

from __future__ import annotations

import ctypes

import pytest

from microros_gen.interfaces.types import ArrayType, NamedType, SequenceType, StringType, TypeName, element_of
from microros_gen.typesupport.plan.layout import LP64
from microros_gen.typesupport.plan.size import TypeLimits
from tests.support.typesupport.build import Generated
from tests.support.typesupport.values import CStructs, from_ros, ros_class

pytestmark = [pytest.mark.ros, pytest.mark.builds]
pytest.importorskip("rclpy")


def test_bound_messages_have_defaults_and_capacities(limits_case: Generated, library: ctypes.CDLL) -> None:
    structs = CStructs(limits_case.messages)
    bound = 0
    for plan in limits_case.plans:
        if not plan.storage:
            assert plan.fixed_size, plan.name
            continue
        size = plan.storage_size(LP64)
        assert size
        storage = ctypes.create_string_buffer(b"\xa5" * size + b"\x5a" * 8)
        value = structs.structure(plan.name)()
        ctypes.memset(ctypes.byref(value), 0xA5, ctypes.sizeof(value))
        bind = library[f"{plan.c_name}__bind"]
        bind.restype = None
        bind(ctypes.byref(value), storage)
        assert storage.raw[size : size + 8] == b"\x5a" * 8
        if plan.name.package != "test_interface_files":
            expected = from_ros(limits_case.messages, plan.name, ros_class(plan.name)())
            assert structs.read(plan.name, value) == expected, plan.name
        assert plan.limits
        start = ctypes.addressof(storage)
        check_capacities(limits_case, structs, plan.name, plan.limits, value, range(start, start + size))
        bound += 1
    assert bound > 100


def check_capacities(
    generated: Generated,
    structs: CStructs,
    name: TypeName,
    limits: TypeLimits,
    value: ctypes.Structure,
    storage: range,
) -> None:
    """Every string and sequence, elements after `size` too, has the capacity of its limit."""
    for field, entry in zip(generated.messages[name].fields, limits.fields, strict=True):
        if entry is None:
            continue
        member = getattr(value, field.name)
        element = element_of(field.type)
        items = list(member) if isinstance(field.type, ArrayType) else [member]
        if isinstance(field.type, SequenceType):
            assert member.capacity == entry.sequence, (name, field.name)
            assert member.data in storage or not entry.sequence
            element_type = structs._element_type(element)
            items = list((element_type * member.capacity).from_address(member.data)) if entry.sequence else []
        for item in items:
            if isinstance(element, StringType):
                assert entry.string is not None
                assert item.capacity == entry.string + 1, (name, field.name)
                width = 2 if element.wide else 1
                assert item.data in storage
                assert item.data + item.capacity * width - 1 in storage
                end = ctypes.string_at(item.data + item.size * width, width)
                assert end == bytes(width), "no terminator"
            elif isinstance(element, NamedType) and entry.nested is not None:
                check_capacities(generated, structs, element.name, entry.nested, item, storage)
