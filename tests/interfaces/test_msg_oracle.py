# SPDX-License-Identifier: Apache-2.0
"""The reader of .msg files against ROS 2's: what is taken, what is refused, values, comments."""

from __future__ import annotations

import ast
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.type_description import individual_type_description
from microros_gen.interfaces.types import Message, TypeName
from tests.support.examples import examples
from tests.support.ids import without_id
from tests.support.interfaces.msg_corpus import BAD, DIFFERENCES, GOOD, RIGHT_NAMES, WRONG_NAMES, Difference
from tests.support.interfaces.rosidl_pipeline import adapter_message, ros_message
from tests.support.slices import spread

pytestmark = pytest.mark.ros
NAME = TypeName("pkg_a", "msg", "Foo")
INSTALLED = sorted((Path(sys.prefix) / "share").glob("*/msg/*.msg"))


def read(text: str, name: TypeName = NAME) -> Message | None:
    return parse_msg(Source("Foo.msg", text), name, Diagnostics())


def meaning(description: dict[str, Any]) -> dict[str, Any]:
    """Return a description with the defaults of arrays as values: Python spells some escapes in two ways."""
    fields = [dict(field) for field in description["fields"]]
    for field in fields:
        if field["default_value"] and field["type"]["type_id"] > 48:
            field["default_value"] = ast.literal_eval(field["default_value"])
    return {**description, "fields": fields}


@pytest.mark.parametrize("text", spread(GOOD))
def test_good_text_is_read_as_ros_reads_it(text: str, tmp_path: Path) -> None:
    ours, theirs = read(text), ros_message(text, tmp_path)
    assert theirs is not None, "the corpus is wrong: Jazzy refuses this text"
    assert ours is not None
    assert meaning(individual_type_description(ours)) == meaning(theirs.description)
    assert [(c.name, c.value) for c in ours.constants] == [(c.name, c.value) for c in theirs.constants]


@pytest.mark.parametrize("text", BAD)
def test_bad_text_is_refused_as_ros_refuses_it(text: str, tmp_path: Path) -> None:
    assert ros_message(text, tmp_path) is None, "the corpus is wrong: Jazzy takes this text"
    assert read(text) is None


@pytest.mark.parametrize("difference", DIFFERENCES, ids=lambda d: d.text)
def test_differences_from_ros_are_the_known_ones(difference: Difference, tmp_path: Path) -> None:
    assert (ros_message(difference.text, tmp_path) is not None) is difference.ros_takes
    assert (read(difference.text) is not None) is difference.we_take


@pytest.mark.parametrize(("names", "taken"), [(RIGHT_NAMES, True), (WRONG_NAMES, False)])
def test_names_of_types(names: list[str], taken: bool, tmp_path: Path) -> None:
    for name in names:
        assert (ros_message("int32 a", tmp_path, name=name) is not None) is taken, name
        assert (read("int32 a", TypeName("pkg_a", "msg", name)) is not None) is taken, name


@pytest.mark.parametrize("package", ["Pkg", "pkg_", "_pkg", "pkg__a", "1pkg", "pkg-a", "p", "pkg2_3"])
def test_names_of_packages(package: str, tmp_path: Path) -> None:
    theirs = ros_message("int32 a", tmp_path, package=package)
    assert (read("int32 a", TypeName(package, "msg", "Foo")) is not None) is (theirs is not None)


# Pieces that make lines near to right ones; known differences (inf, nan, keywords) are not among them.
TYPES = [
    "int32",
    "uint8",
    "bool",
    "float32",
    "string",
    "wstring",
    "string<=4",
    "Bar",
    "p/Bar",
    "char",
    "",
    "int",
]
EXTENTS = ["", "", "", "[]", "[2]", "[<=2]", "[0]", "[", "]", "[<2]", "<=2"]
GAPS = [" ", " ", "  ", "\t", "", "\xa0 ", " \xa0"]
NAMES = ["a", "b_1", "A", "A_B", "a_", "1", "", "a b", "ä"]
EQUALS = ["", "", " ", "=", " = ", "  ", " ="]
VALUES = [
    "",
    "1",
    "-1",
    "0x10",
    "1.5",
    "TRUE",
    "300",
    "abc",
    "'x'",
    '"x',
    "'it\\'s'",
    '"a\'b"',
    "\\\\",
    "\\t",
    "é",
    "''",
]
LISTS = ["[]", "[1]", "[1, 2]", "[1,2,3]", "['x', \"y\"]", "[x,]", "[ ]", "[1", "['a' b]", "[true]", "[,]"]
TAILS = ["", "", " # c", "#", " ", "=", "]"]
lines = st.tuples(*map(st.sampled_from, (TYPES, EXTENTS, GAPS, NAMES, EQUALS, VALUES + LISTS, TAILS))).map(
    "".join
)


@settings(
    max_examples=examples(1500), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(line=lines)
def test_lines_made_at_random_are_taken_or_refused_as_by_ros(line: str, tmp_path: Path) -> None:
    ours, theirs = read(line), ros_message(line, tmp_path)
    assert (ours is None) == (theirs is None)
    if ours is not None and theirs is not None:
        assert meaning(individual_type_description(ours)) == meaning(theirs.description)
        assert [(c.name, c.value) for c in ours.constants] == [(c.name, c.value) for c in theirs.constants]


def _documented(message: Any) -> list[Any]:
    """Return a message, its constants and its fields: what has comments."""
    return [message, *message.constants, *message.fields]


def comments(text: str, package: str, name: str) -> list[list[str]]:
    """Return the comments of message, constants and fields that the adapter has."""
    theirs = adapter_message(text, package, name)
    return [e.annotations.get("comment", []) for e in _documented(theirs)]


def our_comments(message: Message) -> list[list[str]]:
    return [list(e.comment) for e in _documented(message)]


@pytest.mark.parametrize("text", [t for t in GOOD if "#" in t and "[m/s]" not in t])
def test_comments_belong_where_ros_puts_them(text: str) -> None:
    ours = read(text)
    assert ours is not None
    assert our_comments(ours) == comments(text, "pkg_a", "Foo")


def test_every_installed_file_has_the_same_comments() -> None:
    assert len(INSTALLED) >= 181
    for path in INSTALLED:
        text = path.read_text(encoding="utf-8")
        name = TypeName(path.parent.parent.name, "msg", path.stem)
        ours = read(text, name)
        assert ours is not None, path
        theirs = adapter_message(text, name.package, name.name)
        for our_message, other in zip(_documented(ours)[1:], _documented(theirs)[1:], strict=True):
            assert our_message.name == other.name
            unit = other.annotations.get("unit")
            expected = other.annotations.get("comment", [])
            if unit is None:
                assert list(our_message.comment) == expected, (path, our_message.name)
            else:
                assert f"[{unit}]" in "\n".join(our_message.comment), (path, our_message.name)


BACKSLASHES = [f"int32 a # x\\{c}{rest}" for c in "abnrtuxNU01\\ '\"[" for rest in ("y", "")]
BACKSLASHES += [
    "# \\\nint32 a",
    "int32 a # \\x41 \\u0041",
    "int32 a # \\12",
    "int32 a # \\15",
    "int32 a # \\13",
]
BACKSLASHES += [f"int32 a # a{count * chr(92)}" for count in range(1, 7)]


def test_a_comment_that_stops_the_adapter_is_reported(tmp_path: Path) -> None:
    """It takes a backslash in a comment for that of a Python string."""
    refused = 0
    for text in BACKSLASHES:
        diagnostics = Diagnostics()
        assert parse_msg(Source("F", text), TypeName("pkg_a", "msg", "Foo"), diagnostics) is not None
        messages = [without_id(d.headline()) for d in diagnostics]
        assert (ros_message(text, tmp_path) is None) is bool(messages), text
        assert all("cannot read this comment" in line for line in messages)
        refused += bool(messages)
    assert 15 < refused < 30
