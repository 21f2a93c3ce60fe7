# SPDX-License-Identifier: Apache-2.0
"""Services and actions among the requests: names of every kind, what they bring, ambiguity, cycles."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.interfaces.closure import split_type_name
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.interfaces.types import TypeName
from tests.support.interfaces.resolving import names, package, resolve

SHIPPED = InterfaceFinder(shipped=shipped_folder())
SET_BOOL = TypeName("std_srvs", "srv", "SetBool")
FIBONACCI = TypeName("example_interfaces", "action", "Fibonacci")


@pytest.mark.parametrize("request_", ["std_srvs/SetBool", "std_srvs/srv/SetBool"])
def test_a_service_brings_its_messages_and_what_they_need(request_: str) -> None:
    interfaces, messages = resolve(SHIPPED, request_)
    assert messages == []
    assert names(interfaces) == [
        "builtin_interfaces/msg/Time",
        "service_msgs/msg/ServiceEventInfo",
        "std_srvs/srv/SetBool",
    ]
    assert interfaces.roots == (SET_BOOL,)
    assert [str(name) for name in interfaces.messages][2:] == [
        f"std_srvs/srv/SetBool_{part}" for part in ("Request", "Response", "Event")
    ]
    assert [name.name for name in interfaces.message_roots] == [
        "SetBool_Event",
        "SetBool_Request",
        "SetBool_Response",
    ]
    assert interfaces.services[SET_BOOL].request == interfaces.message(
        TypeName("std_srvs", "srv", "SetBool_Request")
    )


def test_an_action_brings_its_services() -> None:
    interfaces, messages = resolve(SHIPPED, "example_interfaces/Fibonacci")
    assert messages == []
    action = interfaces.actions[FIBONACCI]
    assert list(interfaces.services.values()) == [action.send_goal, action.get_result]
    assert set(action.messages) == {interfaces.message(name) for name in interfaces.message_roots}
    assert len(action.messages) == 10
    assert TypeName("unique_identifier_msgs", "msg", "UUID") in interfaces.interfaces


def test_a_derived_message_can_be_requested() -> None:
    interfaces, messages = resolve(SHIPPED, "std_srvs/srv/SetBool_Response")
    assert messages == []
    assert interfaces.message_roots == interfaces.roots == (TypeName("std_srvs", "srv", "SetBool_Response"),)
    assert SET_BOOL in interfaces.interfaces


def test_a_service_of_an_action_can_be_requested() -> None:
    interfaces, messages = resolve(SHIPPED, "example_interfaces/action/Fibonacci_SendGoal")
    assert messages == []
    assert [name.name for name in interfaces.message_roots] == [
        f"Fibonacci_SendGoal_{part}" for part in ("Event", "Request", "Response")
    ]


@pytest.mark.parametrize(
    "name", ["std_srvs/srv/SetBool_Goal", "example_interfaces/action/Fibonacci_Event", "std_msgs/Int32_Event"]
)
def test_what_ros_does_not_derive_is_unknown(name: str) -> None:
    interfaces, messages = resolve(SHIPPED, name)
    assert len(interfaces) == 0
    assert len(messages) == 1
    assert "has no type" in messages[0]


def test_a_package_means_all_its_kinds(tmp_path: Path) -> None:
    package(tmp_path, "a", A="int8 a")
    package(tmp_path, "a", "srv", B="---")
    package(tmp_path, "a", "action", C="---\n---")
    finder = InterfaceFinder((tmp_path,), shipped=shipped_folder())
    interfaces, messages = resolve(finder, "a")
    assert messages == []
    assert [str(root) for root in interfaces.roots] == ["a/action/C", "a/msg/A", "a/srv/B"]


def test_one_name_in_two_kinds_is_ambiguous(tmp_path: Path) -> None:
    package(tmp_path, "a", Same="int8 a")
    package(tmp_path, "a", "srv", Same="---")
    finder = InterfaceFinder((tmp_path,), shipped=shipped_folder())
    interfaces, messages = resolve(finder, "a/Same")
    assert len(interfaces) == 0
    assert messages == [
        "microros-gen: error: 'a/Same' is ambiguous: a has a/msg/Same and a/srv/Same. Write a/msg/Same or"
        " a/srv/Same"
    ]
    for full in ("a/msg/Same", "a/srv/Same"):
        interfaces, messages = resolve(finder, full)
        assert (messages, [str(root) for root in interfaces.roots]) == ([], [full])


def test_a_kind_can_be_given_for_short_names() -> None:
    assert split_type_name("std_srvs/SetBool", "srv") == SET_BOOL
    assert split_type_name("std_srvs/srv/SetBool") == SET_BOOL
    assert split_type_name("std_msgs/Int32") == TypeName("std_msgs", "msg", "Int32")


def test_a_package_twice_in_one_path_is_ambiguous(tmp_path: Path) -> None:
    for folder in ("one", "two"):
        folder_of_a = package(tmp_path / "src", folder, A="int8 a")
        (folder_of_a / "package.xml").write_text("<package><name>twice</name></package>", encoding="utf-8")
    _, messages = resolve(InterfaceFinder((tmp_path / "src",)), "twice/A")
    assert len(messages) == 1
    assert f"found 2 packages named 'twice': '{tmp_path}/src/one' and '{tmp_path}/src/two'" in messages[0]
    # A path before it decides.
    _, messages = resolve(InterfaceFinder((tmp_path / "src/two", tmp_path / "src")), "twice/A")
    assert messages == []


def test_what_ros_adds_is_missed_by_name(tmp_path: Path) -> None:
    package(tmp_path, "a", "srv", Do="int8 a\n---")
    _, messages = resolve(InterfaceFinder((tmp_path,)), "a")
    assert len(messages) == 1
    assert messages[0].startswith(
        f"{tmp_path}/a/srv/Do.srv:1:1: error: unknown interface package 'service_msgs'"
    )
    assert "which the field 'info' of a/srv/Do_Event needs" in messages[0]


def test_faults_of_all_kinds_are_reported_in_one_run(tmp_path: Path) -> None:
    package(tmp_path, "a", A="int32 X")
    package(tmp_path, "a", "srv", B="int8 a\n---\nint8 a\nnope/X x\nB_Request b")
    package(tmp_path, "a", "action", C="---\nint9 a")
    finder = InterfaceFinder((tmp_path,), shipped=shipped_folder())
    _, messages = resolve(finder, "a")
    places = sorted(line.removeprefix(f"{tmp_path}/a/").split(" ")[0] for line in messages)
    assert places == [
        "action/C.action:2:1:",
        "action/C.action:2:1:",
        "msg/A.msg:1:7:",
        "srv/B.srv:4:1:",
        "srv/B.srv:5:1:",
    ]


def test_a_service_is_no_cycle_and_a_message_may_not_name_it(tmp_path: Path) -> None:
    package(tmp_path, "a", A="Do_Request request")
    package(tmp_path, "a", "srv", Do="A a\n---\nA[] a")
    finder = InterfaceFinder((tmp_path,), shipped=shipped_folder())
    _, messages = resolve(finder, "a/srv/Do")
    assert len(messages) == 1
    assert messages[0].startswith(f"{tmp_path}/a/msg/A.msg:1:1: error: package 'a'")
    assert "has no type 'Do_Request', which the field 'request' needs. It has a/srv/Do_Request" in messages[0]
