# SPDX-License-Identifier: Apache-2.0
"""The readers of .srv and .action files: parts, places of faults, and ROS 2's own readers as the oracle."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Severity, Source
from microros_gen.interfaces.derived import derived_name, make_declaration, parts_of, structures_of
from microros_gen.interfaces.msg.action import parse_action
from microros_gen.interfaces.msg.srv import parse_srv
from microros_gen.interfaces.msg.text import declaration_text
from microros_gen.interfaces.type_description import type_description
from microros_gen.interfaces.types import Action, Message, NamedType, Primitive, Service, TypeName, element_of
from tests.support.examples import examples
from tests.support.ids import without_id
from tests.support.interfaces.msg_model import messages, without_places
from tests.support.interfaces.rosidl_pipeline import adapter_parts, ros_declaration
from tests.support.slices import spread

INSTALLED = sorted((Path(sys.prefix) / "share").glob("*/srv/*.srv"))
INSTALLED += sorted((Path(sys.prefix) / "share").glob("*/action/*.action"))


def read(text: str, kind: str = "srv", name: str = "Foo") -> tuple[Service | Action | None, list[str]]:
    """Return the declaration and the headlines of what was found, without the file's name."""
    diagnostics = Diagnostics()
    parse = parse_srv if kind == "srv" else parse_action
    found = parse(Source("F", text), TypeName("pkg_a", kind, name), diagnostics)
    return found, [without_id(d.headline()).removeprefix("F:") for d in diagnostics]


def errors(text: str, kind: str = "srv") -> list[str]:
    found, messages = read(text, kind)
    assert found is None
    return messages


def test_a_service_has_its_parts_and_the_event() -> None:
    text = "# What it does.\n# And how.\n\nint8 A=1\nbool data true # on\n---\n# Second.\n\nint8 A=2\nstring text"
    service, messages = read(text)
    assert messages == []
    assert isinstance(service, Service)
    assert service.comment == ("What it does.", "And how.") == service.request.comment
    assert [c.value for c in (*service.request.constants, *service.response.constants)] == [1, 2]
    assert service.request.fields[0].default is True
    assert service.request.fields[0].comment == ("on",)
    assert service.response.comment == ("Second.",)
    assert service.response.fields[0].span is not None
    assert service.response.fields[0].span.line == 10
    assert [str(f.name) for f in service.event.fields] == ["info", "request", "response"]


def test_an_action_has_its_parts_and_what_ros_adds() -> None:
    action, messages = read("int32 order\n---\n---\nint32[] part", "action", "Fib")
    assert messages == []
    assert isinstance(action, Action)
    assert action.result.fields == ()
    assert [m.name.name for m in action.messages] == [
        *("Fib_Goal", "Fib_Result", "Fib_Feedback"),
        *("Fib_SendGoal_Request", "Fib_SendGoal_Response", "Fib_SendGoal_Event"),
        *("Fib_GetResult_Request", "Fib_GetResult_Response", "Fib_GetResult_Event"),
        "Fib_FeedbackMessage",
    ]
    assert action.get_result.response.fields[0].type is Primitive.INT8
    assert element_of(action.send_goal.request.fields[1].type) == NamedType(action.goal.name)


@pytest.mark.parametrize("end", ["", "\n", "\r\n", "\n\n"])
def test_parts_may_be_empty(end: str) -> None:
    service, messages = read(f"---{end}")
    assert messages == []
    assert isinstance(service, Service)
    assert service.request.fields == service.response.fields == ()


@pytest.mark.parametrize(
    ("text", "kind", "messages"),
    [
        (
            "",
            "srv",
            ["1:1: error: the line '---' before the response is missing. Its parts are request, then"],
        ),
        ("int8 a\n", "srv", ["1:1: error: the line '---' before the response is missing."]),
        ("int8 a\n---\n", "action", ["2:1: error: the line '---' before the feedback is missing."]),
        ("int8 a\n", "action", ["1:1: error: the line '---' before the result is missing."]),
        ("---\n\n---\n", "srv", ["3:1: error: '---' number 2: a service has one. Its parts"]),
        (
            "---\n---\n---\n---",
            "action",
            ["3:1: error: '---' number 3: an", "4:1: error: '---' number 4: an"],
        ),
        (
            "int8 a\n--- \nint8 b",
            "srv",
            ["2:1: error: '---' is not a separator. ROS 2 takes a line of exactly"],
        ),
        ("--- # response\n", "srv", ["1:1: error: '--- # response' is not a separator."]),
        ("----\n", "srv", ["1:1: error: '----' is not a separator."]),
        (" ---\nint8 b\n", "srv", ["1:1: error: '---' is not a separator."]),
    ],
)
def test_separators(text: str, kind: str, messages: list[str]) -> None:
    found = [line for line in errors(text, kind) if "separator" in line or "---' " in line]
    assert len(found) == len(messages)
    for line, expected in zip(found, messages, strict=True):
        assert line.startswith(expected)


def test_every_fault_of_every_part_is_reported_at_its_line() -> None:
    text = "int8 X\n\tint8 a\n---\nint8 a\nint8 a\n--- \nint9 c\nuint8 d 300\n---\nfloat32 e = 1"
    assert [re.match(r"(\d+):(\d+): error", line).groups() for line in errors(text)] == [  # type: ignore[union-attr]
        ("6", "1"),
        ("9", "1"),
        ("1", "6"),
        ("2", "1"),
        ("5", "6"),
        ("7", "1"),
        ("8", "9"),
        ("10", "9"),
    ]


def test_names_are_distinguished_by_part() -> None:
    service, messages = read("int8 same\nint8 SAME=1\n---\nint16 same\nint16 SAME=2")
    assert service is not None
    assert messages == []


ALIKE = [
    ("int8 A=1\n---\nint8 A=1", "srv"),
    ("string A=\"x\"\nint8 b\n---\nint8 c\nstring A='x'", "srv"),
    ("int8 A=+1 # c\n---\nint8 b\n# c\nint8 A=1", "srv"),
    ("float32 A=1\n---\n---\nfloat32 A=1.0", "action"),
    ("---\nuint8 B=2\n---\nuint8 B=2", "action"),
]
UNLIKE = [
    ("int8 A=1\n---\nint8 A=2", "srv"),
    ("int8 A=1\n---\nint16 A=1", "srv"),
    ("int8 A=1 # c\n---\nint8 A=1", "srv"),
    ("int8 A=1\n---\n---\nint8 B=1", "action"),
]


@pytest.mark.parametrize(("text", "kind"), ALIKE)
def test_constants_declared_alike_in_two_parts_are_reported(text: str, kind: str) -> None:
    """Their C does not compile in ROS 2 Jazzy, which gives both to the first part."""
    (messages,) = errors(text, kind)
    line = max(i for i, written in enumerate(text.splitlines(), 1) if "=" in written)
    assert re.match(rf"{line}:\d+: error: ROS 2 Jazzy takes '[AB]' for a constant of Foo_\w+ too", messages)
    assert messages.endswith("Give one of them another name or comment")


@pytest.mark.ros
@pytest.mark.parametrize(("text", "kind"), [*ALIKE, *UNLIKE])
def test_ros_mixes_up_constants_declared_alike(text: str, kind: str, tmp_path: Path) -> None:
    theirs = ros_declaration(text, kind, tmp_path)
    assert theirs is not None
    names = [[name for name, _ in constants] for constants in theirs.constants]
    assert any(len(set(part)) < len(part) for part in names) is ((text, kind) in ALIKE)
    assert (read(text, kind)[0] is None) is ((text, kind) in ALIKE)


@pytest.mark.parametrize("name", ["foo", "Foo_Bar", "Foo_Request", "Foo_Response", "1Foo"])
def test_names_of_services(name: str) -> None:
    diagnostics = Diagnostics()
    assert parse_srv(Source("F", "---"), TypeName("pkg_a", "srv", name), diagnostics) is None
    assert all("is not a message type" in d.message for d in diagnostics)


@pytest.mark.parametrize(
    ("kind", "name"), [("srv", "Request"), ("srv", "Event"), ("action", "Goal"), ("action", "Feedback")]
)
def test_an_interface_with_the_name_of_a_part_has_a_warning(kind: str, name: str) -> None:
    """A C++ class cannot have a member with the name of the class."""
    found, messages = read("---\n---" if kind == "action" else "---", kind, name)
    assert found is not None
    assert messages == [
        f"1:1: warning: the C++ code that ROS 2 Jazzy generates for an interface named '{name}' does not compile. "
        "Rename it"
    ]
    assert not read("---\n---" if kind == "action" else "---", kind, f"{name}s")[1]


def test_a_byte_order_mark_is_reported_once() -> None:
    diagnostics = Diagnostics()
    assert parse_srv(Source("F", "\ufeff---\n"), TypeName("pkg_a", "srv", "Foo"), diagnostics) is not None
    assert [d.severity for d in diagnostics] == [Severity.WARNING]


def alike(messages: Sequence[Message]) -> bool:
    """Return whether two of them have the same constant, which ROS 2 mixes up."""
    constants = [{repr(replace(c, span=None)) for c in message.constants} for message in messages]
    return sum(map(len, constants)) > len(set().union(*constants))


@st.composite
def declarations(draw: st.DrawFn) -> Service | Action:
    kind = draw(st.sampled_from(["srv", "action"]))
    name = TypeName("pkg_a", kind, "Foo")
    parts = ("Request", "Response") if kind == "srv" else ("Goal", "Result", "Feedback")
    drawn = tuple(replace(draw(messages()), name=derived_name(name, part)) for part in parts)
    assume(not alike(drawn))
    return make_declaration(name, drawn, drawn[0].comment)


@settings(max_examples=examples(100), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(declarations())
def test_a_printed_declaration_reads_as_the_same(declaration: Service | Action) -> None:
    again, messages = read(declaration_text(declaration), declaration.name.kind)
    assert again is not None, messages
    for (_, ours), (_, read_again) in zip(parts_of(declaration), parts_of(again), strict=True):
        assert without_places(read_again) == ours


@settings(max_examples=examples(200), deadline=None)
@given(st.text(st.sampled_from("-----\n\n\nint8 ab=#"), max_size=60), st.sampled_from(["srv", "action"]))
def test_no_text_makes_the_reader_fail(text: str, kind: str) -> None:
    found, messages = read(text, kind)
    assert (found is None) == any(": error: " in line for line in messages)


# --- against ROS 2


def described(declaration: Service | Action) -> dict[str, Any]:
    """Return the own description of each structure; types of other files stand as empty ones."""
    structures = {structure.name: structure for structure in structures_of(declaration)}
    elements = [element_of(f.type) for s in structures.values() for f in s.fields]
    others = {e.name: Message(e.name, ()) for e in elements if isinstance(e, NamedType)}
    closure = {**others, **structures}
    return {str(n): type_description(s, closure)["type_description"] for n, s in structures.items()}


@pytest.mark.ros
@pytest.mark.parametrize("path", spread(INSTALLED), ids=lambda path: f"{path.parent.parent.name}-{path.stem}")
def test_installed_files_are_read_as_ros_reads_them(path: Path, tmp_path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    kind, package = path.suffix[1:], path.parent.parent.name
    parse = parse_srv if kind == "srv" else parse_action
    ours = parse(Source(path.name, text), TypeName(package, kind, path.stem), Diagnostics())
    theirs = ros_declaration(text, kind, tmp_path, package, path.stem)
    assert theirs is not None
    assert ours is not None
    assert described(ours) == theirs.descriptions
    constants = [[(c.name, c.value) for c in message.constants] for _, message in parts_of(ours)]
    assert constants == theirs.constants
    comments = [(m.comment, [f.comment for f in m.fields]) for _, m in parts_of(ours)]
    assert [(c, f) for c, f in comments] == adapter_parts(text, kind)


@pytest.mark.ros
@pytest.mark.parametrize(
    "text",
    [
        *("---", "---\n", "\n---\n\n", "int8 a\n---", "# c\n---\n# d", "int8 a # ---\n---\n", "#---\n---"),
        *(
            "--- ",
            "----",
            " ---",
            "---\t",
            "--- #",
            "",
            "int8 a",
            "---\n---",
            "---\r\n",
            "---\x0c",
            "\x0c---",
        ),
        *(
            "int8 A=1\n---\nint8 A=2",
            "int8 a\nint8 a\n---",
            "---\nPkg x",
            "Foo_Request a\n---",
            "---\nint8 a ---",
        ),
    ],
)
def test_good_and_bad_text_as_ros_takes_it(text: str, tmp_path: Path) -> None:
    theirs = ros_declaration(text, "srv", tmp_path)
    ours, messages = read(text)
    assert (ours is not None) == (theirs is not None), messages
    if ours is not None and theirs is not None:
        assert described(ours) == theirs.descriptions


@pytest.mark.ros
@pytest.mark.parametrize("text", ["---\n---", "---", "---\n---\n---", "int8 a\n---\nint8 b\n---\nint8 c # d"])
def test_actions_as_ros_takes_them(text: str, tmp_path: Path) -> None:
    theirs = ros_declaration(text, "action", tmp_path)
    ours, _ = read(text, "action")
    assert (ours is not None) == (theirs is not None)
    if ours is not None and theirs is not None:
        assert described(ours) == theirs.descriptions


@pytest.mark.ros
@pytest.mark.parametrize(
    "name", ["Foo", "foo", "Foo_Request", "Foo_Response", "Foo_Goal", "Sample_Foo", "F_o"]
)
def test_names_as_ros_takes_them(name: str, tmp_path: Path) -> None:
    for kind, text in (("srv", "---"), ("action", "---\n---")):
        theirs = ros_declaration(text, kind, tmp_path, name=name)
        assert (read(text, kind, name)[0] is not None) == (theirs is not None), (kind, name)
