# SPDX-License-Identifier: Apache-2.0
"""The definitions that ship with the tool are those of ROS 2 Jazzy."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.model.application import Named
from microros_gen.model.msg_text import message_text
from microros_gen.model.types import Constant, Field, TypeName
from microros_gen.parse.msg import parse_msg
from microros_gen.resolve.interfaces import InterfaceSet, resolve_interfaces
from microros_gen.sources.interfaces import InterfaceFinder, shipped_folder

SHARE = Path(sys.prefix) / "share"
# Not in the wheels of ROS 2 on PyPI: written from what is publicly known of them.
ELSEWHERE = {"example_interfaces", "tf2_msgs"}
# For ROS 2's own tests, not for users.
TESTS_OF_ROS = {"test_msgs", "test_interface_files"}
FINDER = InterfaceFinder(shipped=shipped_folder())


@pytest.fixture(scope="module")
def shipped() -> InterfaceSet:
    diagnostics = Diagnostics()
    names = tuple(Named(place.name) for place in FINDER.packages())
    interfaces = resolve_interfaces(names, FINDER, diagnostics)
    assert not list(diagnostics)
    return interfaces


@pytest.mark.ros
def test_every_package_of_ros_is_there_with_every_type() -> None:
    theirs = InterfaceFinder(pip=(Path(sys.prefix),))
    names = {p.name for p in theirs.packages() if theirs.types(p.name)} - TESTS_OF_ROS
    assert names == {place.name for place in FINDER.packages()} - ELSEWHERE
    for name in names:
        assert FINDER.types(name) == theirs.types(name)


@pytest.mark.ros
def test_every_type_hash_is_that_of_ros(shipped: InterfaceSet) -> None:
    compared = 0
    for interface in shipped:
        if interface.name.package in ELSEWHERE:
            continue
        path = SHARE / interface.name.package / "msg" / f"{interface.name.name}.json"
        described = json.loads(path.read_text(encoding="utf-8"))
        assert shipped.type_hash(interface.name) == described["type_hashes"][0]["hash_string"]
        assert shipped.type_description(interface.name) == described["type_description_msg"]
        compared += 1
    assert compared >= 156


def bare(entry: Constant | Field) -> Constant | Field:
    return replace(entry, comment=(), span=None)


@pytest.mark.ros
def test_constants_and_defaults_are_those_of_ros(shipped: InterfaceSet) -> None:
    theirs = InterfaceFinder(pip=(Path(sys.prefix),))
    diagnostics = Diagnostics()
    for interface in shipped:
        if interface.name.package in ELSEWHERE:
            continue
        source = theirs.read(interface.name, diagnostics)
        assert source is not None
        original = parse_msg(source, interface.name, diagnostics)
        assert original is not None
        for ours, other in (
            (interface.message.constants, original.constants),
            (interface.message.fields, original.fields),
        ):
            assert [bare(entry) for entry in ours] == [bare(entry) for entry in other], interface.name


@pytest.mark.ros
def test_constants_are_those_of_the_python_classes_of_ros(shipped: InterfaceSet) -> None:
    for interface in shipped:
        if interface.name.package in ELSEWHERE or not interface.message.constants:
            continue
        cls = getattr(import_module(f"{interface.name.package}.msg"), interface.name.name)
        for constant in interface.message.constants:
            value = getattr(cls, constant.name)
            expected = ord(value) if isinstance(value, bytes) else value
            assert constant.value == expected, (interface.name, constant.name)


def test_no_comment_of_others_and_no_licence_line_becomes_documentation(shipped: InterfaceSet) -> None:
    for interface in shipped:
        message = interface.message
        assert message.comment == ()
        assert all(constant.comment == () for constant in message.constants)
        for field in message.fields:
            assert len(field.comment) <= 1
            assert all(len(line) <= 60 for line in field.comment), field.comment


@pytest.mark.ros
def test_no_note_repeats_the_words_of_ros(shipped: InterfaceSet) -> None:
    for interface in shipped:
        path = SHARE / interface.name.package / "msg" / f"{interface.name.name}.msg"
        if not path.exists():
            continue
        words = re.sub(r"\W+", " ", path.read_text(encoding="utf-8"))
        for field in interface.message.fields:
            for line in field.comment:
                note = re.sub(r"\W+", " ", line).strip()
                long = [word for word in note.split() if len(word) > 3]
                assert len(long) < 3 or note not in words, (interface.name, field.name)


def test_files_are_printed_in_one_way(shipped: InterfaceSet) -> None:
    for interface in shipped:
        assert message_text(interface.message) == interface.source.text, interface.source.name


def test_example_interfaces_repeat_std_msgs(shipped: InterfaceSet) -> None:
    for name in FINDER.types("example_interfaces"):
        if name.name == "WString":  # which std_msgs lacks
            assert message_text(shipped.message(name)) == "wstring data\n"
            continue
        twin = json.dumps(shipped.type_description(TypeName("std_msgs", "msg", name.name)))
        ours = json.dumps(shipped.type_description(name))
        assert ours == twin.replace("std_msgs/", "example_interfaces/")


def test_tf2_messages(shipped: InterfaceSet) -> None:
    message = shipped.message(TypeName("tf2_msgs", "msg", "TFMessage"))
    assert message_text(message) == "geometry_msgs/TransformStamped[] transforms\n"
    error = shipped.message(TypeName("tf2_msgs", "msg", "TF2Error"))
    assert [c.value for c in error.constants] == list(range(7))
    assert [f.name for f in error.fields] == ["error", "error_string"]
