# SPDX-License-Identifier: Apache-2.0
"""The definitions that ship with the tool are those of ROS 2 Jazzy."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import Interface, InterfaceSet, resolve_interfaces
from microros_gen.interfaces.derived import parts_of
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.interfaces.msg.text import declaration_text, message_text
from microros_gen.interfaces.types import Constant, Field, Message, TypeName

SHARE = Path(sys.prefix) / "share"
# Not in the wheels of ROS 2 on PyPI: written from what is publicly known of them, or of this project.
ELSEWHERE = {
    "example_interfaces",
    "micro_ros_msgs",
    "microros_agent_msgs",
    "microros_graph_msgs",
    "microros_parameter_msgs",
    "system_modes_msgs",
    "tf2_msgs",
}
# With comments of this project: its own ones, and two whose definitions only are those of micro-ROS.
OWN = {
    "micro_ros_msgs",
    "microros_agent_msgs",
    "microros_graph_msgs",
    "microros_parameter_msgs",
    "system_modes_msgs",
}
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
        name = interface.name
        if name.package in ELSEWHERE:
            continue
        path = SHARE / name.package / name.kind / f"{name.name}.json"
        described = json.loads(path.read_text(encoding="utf-8"))
        for entry in described["type_hashes"]:
            assert shipped.type_hash(TypeName(*entry["type_name"].split("/"))) == entry["hash_string"]
        assert shipped.type_description(name) == described["type_description_msg"]
        compared += 1
    assert compared >= 156 + 25


def bare(entry: Constant | Field) -> Constant | Field:
    return replace(entry, comment=(), span=None)


@pytest.mark.ros
def test_constants_and_defaults_are_those_of_ros(shipped: InterfaceSet) -> None:
    diagnostics = Diagnostics()
    finder = InterfaceFinder(pip=(Path(sys.prefix),))
    own = [interface for interface in shipped if interface.name.package not in ELSEWHERE]
    theirs = resolve_interfaces(tuple(Named(str(i.name)) for i in own), finder, diagnostics)
    diagnostics.check()
    for message in (message for interface in own for message in interface.messages):
        original = theirs.message(message.name)
        assert [bare(c) for c in message.constants] == [bare(c) for c in original.constants], message.name
        assert [bare(f) for f in message.fields] == [bare(f) for f in original.fields], message.name


@pytest.mark.ros
def test_constants_are_those_of_the_python_classes_of_ros(shipped: InterfaceSet) -> None:
    compared = 0
    for interface in shipped:
        name = interface.name
        for message in interface.messages:
            if name.package in ELSEWHERE or not message.constants:
                continue
            cls = getattr(import_module(f"{name.package}.{name.kind}"), name.name)
            part = cls if message.name == name else getattr(cls, message.name.name.split("_")[-1])
            for constant in message.constants:
                value = getattr(part, constant.name)
                expected = ord(value) if isinstance(value, bytes) else value
                assert constant.value == expected, (message.name, constant.name)
                compared += name.kind == "srv"
    assert compared > 5


def written(interface: Interface) -> list[Message]:
    """Return the messages that the file itself has."""
    declaration = interface.declaration
    if isinstance(declaration, Message):
        return [declaration]
    return [message for _, message in parts_of(declaration)]


def test_no_comment_of_others_and_no_licence_line_becomes_documentation(shipped: InterfaceSet) -> None:
    restated = [interface for interface in shipped if interface.name.package not in OWN]
    for message in (message for interface in restated for message in written(interface)):
        assert message.comment == ()
        assert all(constant.comment == () for constant in message.constants)
        for field in message.fields:
            assert len(field.comment) <= 1
            assert all(len(line) <= 60 for line in field.comment), field.comment


@pytest.mark.ros
def test_no_note_repeats_the_words_of_ros(shipped: InterfaceSet) -> None:
    for interface in shipped:
        name = interface.name
        path = SHARE / name.package / name.kind / f"{name.name}.{name.kind}"
        if not path.exists():
            continue
        words = re.sub(r"\W+", " ", path.read_text(encoding="utf-8"))
        for field in (field for message in written(interface) for field in message.fields):
            for line in field.comment:
                note = re.sub(r"\W+", " ", line).strip()
                long = [word for word in note.split() if len(word) > 3]
                assert len(long) < 3 or note not in words, (interface.name, field.name)


def test_files_are_printed_in_one_way(shipped: InterfaceSet) -> None:
    for interface in shipped:
        assert declaration_text(interface.declaration) == interface.source.text, interface.source.name


def renamed(description: dict[str, Any], old: str, new: str) -> tuple[Any, Any]:
    """Return both parts of a description with another package; what is referenced is sorted by name."""
    text = json.loads(json.dumps(description).replace(f'"{old}/', f'"{new}/'))
    return text["type_description"], sorted(
        text["referenced_type_descriptions"], key=lambda d: d["type_name"]
    )


def test_example_interfaces_repeat_std_msgs(shipped: InterfaceSet) -> None:
    for name in FINDER.types("example_interfaces"):
        if name.kind != "msg":
            continue
        if name.name == "WString":  # which std_msgs lacks
            assert message_text(shipped.message(name)) == "wstring data\n"
            continue
        other = shipped.type_description(TypeName("std_msgs", "msg", name.name))
        ours = shipped.type_description(name)
        assert renamed(ours, "", "") == renamed(other, "std_msgs", "example_interfaces")


def test_services_of_example_interfaces(shipped: InterfaceSet) -> None:
    for service in ("SetBool", "Trigger"):
        name = TypeName("example_interfaces", "srv", service)
        other = shipped.type_description(TypeName("std_srvs", "srv", service))
        ours = shipped.type_description(name)
        assert renamed(ours, "", "") == renamed(other, "std_srvs", "example_interfaces")
    # The hash that the design document of rmw_zenoh shows for the service of ROS 2's tutorial.
    known = "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"
    assert shipped.type_hash(TypeName("example_interfaces", "srv", "AddTwoInts")) == known


@pytest.mark.ros
def test_the_action_of_example_interfaces_is_that_of_test_msgs(shipped: InterfaceSet) -> None:
    described = json.loads((SHARE / "test_msgs/action/Fibonacci.json").read_text(encoding="utf-8"))
    ours = shipped.type_description(TypeName("example_interfaces", "action", "Fibonacci"))
    theirs = renamed(described["type_description_msg"], "test_msgs", "example_interfaces")
    assert renamed(ours, "", "") == theirs


def test_tf2_messages(shipped: InterfaceSet) -> None:
    message = shipped.message(TypeName("tf2_msgs", "msg", "TFMessage"))
    assert message_text(message) == "geometry_msgs/TransformStamped[] transforms\n"
    error = shipped.message(TypeName("tf2_msgs", "msg", "TF2Error"))
    assert [c.value for c in error.constants] == list(range(7))
    assert [f.name for f in error.fields] == ["error", "error_string"]


def test_tf2_services_and_actions(shipped: InterfaceSet) -> None:
    assert (
        declaration_text(shipped.services[TypeName("tf2_msgs", "srv", "FrameGraph")])
        == "---\nstring frame_yaml\n"
    )
    action = shipped.actions[TypeName("tf2_msgs", "action", "LookupTransform")]
    assert [f.name for f in action.goal.fields][-2:] == ["fixed_frame", "advanced"]
    assert [f.name for f in action.result.fields] == ["transform", "error"]
    assert action.feedback.fields == ()
