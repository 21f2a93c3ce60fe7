# SPDX-License-Identifier: Apache-2.0
"""init, fini, copy, are_equal, create and sequences: default values as in rclpy, every block of memory."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from typing import Any

import pytest

from microros_gen.typesupport.plan.types import TypePlan
from tests.support.examples import some
from tests.support.typesupport.build import Generated
from tests.support.typesupport.memory import (
    Allocator,
    Memory,
)
from tests.support.typesupport.values import CString, CStructs, Randomizer, from_ros, ros_class

pytestmark = [pytest.mark.ros, pytest.mark.builds]
pytest.importorskip("rclpy")


@pytest.fixture
def memory(functions_library: ctypes.CDLL) -> Iterator[Memory]:
    """A default allocator that counts and fails on demand."""
    own = Memory()
    functions_library.test_set_allocator(ctypes.byref(own.allocator))
    yield own
    functions_library.test_set_allocator(ctypes.byref(Allocator()))


class Functions:
    """The functions of one type."""

    def __init__(self, library: ctypes.CDLL, plan: TypePlan) -> None:
        self._library = library
        self._name = plan.c_name

    def __call__(self, function: str, *arguments: object, result: Any = ctypes.c_bool) -> Any:
        symbol = self._library[f"{self._name}__{function}"]
        symbol.restype = result
        return symbol(*(ctypes.byref(a) if isinstance(a, ctypes.Structure) else a for a in arguments))


@pytest.mark.examples
def test_init_sets_the_default_values(
    everything: Generated, functions_library: ctypes.CDLL, memory: Memory
) -> None:
    structs = CStructs(everything.messages)
    for plan in some(everything.plans):
        call = Functions(functions_library, plan)
        value = structs.structure(plan.name)()
        ctypes.memset(ctypes.byref(value), 0xA5, ctypes.sizeof(value))
        assert call("init", value)
        if plan.name.package != "test_interface_files":
            expected = from_ros(everything.messages, plan.name, ros_class(plan.name)())
            assert structs.read(plan.name, value) == expected, plan.name
        call("fini", value, result=None)
        assert not memory.live, plan.name


@pytest.mark.examples
def test_copy_is_deep_and_equal(
    everything: Generated, functions_library: ctypes.CDLL, memory: Memory
) -> None:
    structs = CStructs(everything.messages)
    for seed, plan in enumerate(some(everything.plans)):
        call = Functions(functions_library, plan)
        tree = Randomizer(everything.messages, seed).tree(plan.name, plan.limits, "random")
        source = structs.fill(plan.name, tree)
        copy = structs.structure(plan.name)()
        assert call("init", copy)
        assert call("copy", source, copy)
        assert structs.read(plan.name, copy) == tree, plan.name
        assert call("are_equal", source, copy)
        own = {s.data for _, s, _ in structs.strings(plan.name, source) if s.size}
        for _, member, is_string in structs.strings(plan.name, copy):
            assert member.size == 0 or member.data not in own
            assert not is_string or member.data
        call("fini", copy, result=None)
        assert not memory.live, plan.name


@pytest.mark.examples
def test_any_other_content_is_not_equal(everything: Generated, functions_library: ctypes.CDLL) -> None:
    structs = CStructs(everything.messages)
    for seed, plan in enumerate(some(everything.plans)):
        source = Randomizer(everything.messages, seed)
        first, second = (source.tree(plan.name, plan.limits, "random") for _ in range(2))
        values = (structs.fill(plan.name, tree) for tree in (first, second))
        equal = Functions(functions_library, plan)("are_equal", *values)
        assert equal == (first == second), plan.name


def test_each_failing_allocation_leaves_nothing(
    everything: Generated, functions_library: ctypes.CDLL, memory: Memory
) -> None:
    """Fail the first, second, … allocation of create and of Sequence__init: no block is left."""
    for name in ("test_msgs/msg/MultiNested", "test_msgs/msg/WStrings", "sensor_msgs/msg/JointState"):
        plan = everything.plan(name)
        call = Functions(functions_library, plan)
        for allowed in range(400):
            memory.left = allowed
            message = call("create", result=ctypes.c_void_p)
            if message:
                call("destroy", ctypes.c_void_p(message), result=None)
            assert not memory.live, (name, allowed)
            if message:
                break
        assert 0 < allowed < 399, name
        sequence = CString()
        for allowed in range(1200):
            memory.left = allowed
            done = call("Sequence__init", sequence, ctypes.c_size_t(3))
            if done:
                call("Sequence__fini", sequence, result=None)
            assert not memory.live, (name, allowed)
            if done:
                break
        assert 0 < allowed < 1199, name


@pytest.mark.examples
def test_sequences_grow_and_compare(
    everything: Generated, functions_library: ctypes.CDLL, memory: Memory
) -> None:
    structs = CStructs(everything.messages)
    for plan in some(everything.plans):
        call = Functions(functions_library, plan)
        source, copy = CString(), CString()
        assert call("Sequence__init", source, ctypes.c_size_t(3))
        assert call("Sequence__init", copy, ctypes.c_size_t(1))
        assert not call("Sequence__are_equal", source, copy)
        assert call("Sequence__copy", source, copy)
        assert (copy.size, copy.capacity) == (3, 3)
        assert call("Sequence__are_equal", source, copy)
        items = (structs.structure(plan.name) * 3).from_address(copy.data)
        first = structs.read(plan.name, items[0])
        assert all(structs.read(plan.name, item) == first for item in items)
        call("Sequence__fini", source, result=None)
        call("Sequence__fini", copy, result=None)
        assert (copy.data, copy.size, copy.capacity) == (None, 0, 0)
        sequence = call("Sequence__create", ctypes.c_size_t(2), result=ctypes.c_void_p)
        assert sequence
        call("Sequence__destroy", ctypes.c_void_p(sequence), result=None)
        assert not memory.live, plan.name


def test_a_sequence_in_static_storage_grows_into_the_arena(
    everything: Generated, functions_library: ctypes.CDLL, memory: Memory
) -> None:
    """The arena cannot tell how large a block of the application is: growing asks for a new one and copies; where it
    fails, the sequence is as it was."""
    structs = CStructs(everything.messages)
    memory.grows = False
    for name in ("test_msgs/msg/MultiNested", "test_msgs/msg/WStrings", "sensor_msgs/msg/JointState"):
        plan = everything.plan(name)
        call = Functions(functions_library, plan)
        source, copy = CString(), CString()
        assert call("Sequence__init", source, ctypes.c_size_t(3))
        own = structs.structure(plan.name)()
        assert call("init", own)
        before = structs.read(plan.name, own)
        place = ctypes.addressof(own)
        copy.data, copy.size, copy.capacity = place, 1, 1
        memory.foreign.add(place)
        memory.left = 0
        assert not call("Sequence__copy", source, copy)
        assert (copy.data, copy.size, copy.capacity) == (place, 1, 1)
        assert structs.read(plan.name, own) == before
        memory.left = 1 << 30
        assert call("Sequence__copy", source, copy)
        assert copy.data in memory.live
        assert (copy.size, copy.capacity) == (3, 3)
        assert call("Sequence__are_equal", source, copy)
        call("Sequence__fini", source, result=None)
        call("Sequence__fini", copy, result=None)
        assert not memory.live, name


def test_null_is_refused_or_ignored(everything: Generated, functions_library: ctypes.CDLL) -> None:
    plan = everything.plan("sensor_msgs/msg/JointState")
    call = Functions(functions_library, plan)
    value = CStructs(everything.messages).structure(plan.name)()
    for function, *arguments in (
        ("init", None),
        ("are_equal", None, value),
        ("are_equal", value, None),
        ("copy", None, value),
        ("copy", value, None),
        ("Sequence__init", None, 1),
        ("Sequence__copy", None, None),
        ("Sequence__are_equal", None, None),
    ):
        assert call(str(function), *arguments) is False
    for function in ("fini", "destroy", "Sequence__fini", "Sequence__destroy"):
        call(function, None, result=None)


def test_no_allocator_of_libc_is_referenced(everything: Generated) -> None:
    for path in everything.files:
        text = everything.files[path].decode()
        assert not any(f"{name}(" in text for name in ("malloc", "calloc", "realloc", "free")), path
        assert "stdlib.h" not in text, path
