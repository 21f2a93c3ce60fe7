# SPDX-License-Identifier: Apache-2.0
"""The reader of .idl files against ROS 2's: what is taken, what is refused, values, comments, includes."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.derived import messages_of
from microros_gen.interfaces.omg_idl.parser import IdlFile, read_idl
from microros_gen.interfaces.omg_idl.text import idl_text
from microros_gen.interfaces.type_description import individual_type_description
from microros_gen.interfaces.types import Message
from tests.support.examples import examples
from tests.support.interfaces.idl_corpus import (
    BAD,
    BAD_PARTS,
    DIFFERENCES,
    GOOD,
    GOOD_PARTS,
    NO_C,
    NO_PYTHON,
    Difference,
    const,
    default,
    msg,
    parts,
)
from tests.support.interfaces.idl_strategies import messages
from tests.support.interfaces.rosidl_idl_pipeline import (
    RosMessage,
    ros_c_compiles,
    ros_cpp_compiles,
    ros_idl,
    ros_makes_python,
)
from tests.support.slices import first, spread, spread_rows

pytestmark = [pytest.mark.ros, pytest.mark.builds]


def read(text: str, kind: str = "msg") -> IdlFile:
    return read_idl(Source("Foo.idl", text), "pkg_a", kind, Diagnostics())


def meaning(description: dict[str, Any]) -> dict[str, Any]:
    """Return a description with defaults as values: rosidl has their text as the file writes it."""
    fields = [dict(field) for field in description["fields"]]
    for field in fields:
        if field["type"]["type_id"] in (15, 11) and field["default_value"]:
            field["default_value"] = float(ast.literal_eval(field["default_value"]))
        elif field["default_value"] and field["type"]["type_id"] > 48:
            field["default_value"] = tuple(ast.literal_eval(field["default_value"]))
    return {**description, "fields": fields}


def check_equal(ours: Message, theirs: RosMessage, *, documented: bool) -> None:
    assert meaning(individual_type_description(ours)) == meaning(theirs.description)
    assert tuple((c.name, c.value) for c in ours.constants) == theirs.constants
    if documented:
        comments = (
            ours.comment,
            *(constant.comment for constant in ours.constants),
            *(field.comment for field in ours.fields),
        )
        assert comments == theirs.comments[: len(comments)]


@pytest.mark.parametrize(("kind", "text"), spread_rows([*(("msg", text) for text in GOOD), *GOOD_PARTS]))
def test_good_text_is_read_as_ros_reads_it(kind: str, text: str, tmp_path: Path) -> None:
    ours, theirs = read(text, kind), ros_idl(text, tmp_path, kind)
    assert theirs is not None, "the corpus is wrong: Jazzy refuses this text"
    assert len(ours.declarations) == 1
    assert tuple(include.path for include in ours.includes) == theirs.includes
    messages = messages_of(ours.declarations[0])
    assert len(messages) == len(theirs.messages)
    # Unit and range stand with the comment here, and derived messages are documented, which they are not in ROS 2.
    documented = kind == "msg" and "@unit" not in text and "@range" not in text
    for our_message, other in zip(messages, theirs.messages, strict=True):
        check_equal(our_message, other, documented=documented)


@pytest.mark.parametrize(("kind", "text"), spread_rows([*(("msg", text) for text in BAD), *BAD_PARTS]))
def test_bad_text_is_refused_as_ros_refuses_it(kind: str, text: str, tmp_path: Path) -> None:
    assert ros_idl(text, tmp_path, kind) is None, "the corpus is wrong: Jazzy takes this text"
    assert not read(text, kind).declarations


@pytest.mark.parametrize("difference", DIFFERENCES, ids=lambda d: d.why)
def test_differences_from_ros_are_the_known_ones(difference: Difference, tmp_path: Path) -> None:
    kind = "srv" if "module srv" in difference.text else "msg"
    assert (ros_idl(difference.text, tmp_path, kind) is not None) is difference.ros_takes
    assert (len(read(difference.text, kind).declarations) == 1) is difference.we_take


@pytest.mark.parametrize("text", spread(NO_C, 6))
def test_what_rosidl_takes_and_makes_no_c_of_is_refused(text: str, tmp_path: Path) -> None:
    ros_idl(text, tmp_path)
    assert not ros_c_compiles(tmp_path, tmp_path / "c"), "the corpus is wrong: C comes out of it"
    assert not read(text).declarations


@pytest.mark.parametrize("text", first(NO_PYTHON))
def test_what_ros_makes_no_python_of_has_a_warning(text: str, tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    assert read_idl(Source("Foo.idl", text), "pkg_a", "msg", diagnostics).declarations
    (warning,) = diagnostics
    assert "Python" in warning.message
    assert ros_idl(text, tmp_path) is not None
    assert ros_c_compiles(tmp_path, tmp_path / "c"), "the corpus is wrong: no C comes out of it"
    assert not ros_makes_python(tmp_path, tmp_path / "py"), "the corpus is wrong: Python comes out of it"


@pytest.mark.parametrize(
    "text",
    [
        *(const("const char A = 65;"), const("const octet A = 255;"), default("char", "127")),
        *(msg("wchar a;"), msg("char a[3];"), default("sequence<char, 3>", '"()"')),
    ],
)
def test_what_ros_makes_python_of_has_no_warning(text: str, tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    assert read_idl(Source("Foo.idl", text), "pkg_a", "msg", diagnostics).declarations
    assert not list(diagnostics)
    assert ros_idl(text, tmp_path) is not None
    assert ros_makes_python(tmp_path, tmp_path / "py")


@pytest.mark.parametrize(
    ("text", "compiles"),
    [
        (const("const short EINVAL = 1;"), False),
        pytest.param(msg("int32 errno;"), False, marks=pytest.mark.variant),
        pytest.param(const("const short E_INVALID = 1;"), True, marks=pytest.mark.variant),
    ],
)
def test_names_that_only_cpp_cannot_compile_have_a_warning(text: str, compiles: bool, tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    assert read_idl(Source("Foo.idl", text), "pkg_a", "msg", diagnostics).declarations
    assert ros_idl(text, tmp_path) is not None
    assert ros_cpp_compiles(tmp_path, tmp_path / "cpp") is compiles
    assert bool(list(diagnostics)) is not compiles


@pytest.mark.parametrize("text", first([GOOD[0], GOOD[30], GOOD[60], GOOD[-1]]))
def test_the_oracle_of_c_takes_what_is_right(text: str, tmp_path: Path) -> None:
    assert ros_idl(text.replace("other_pkg::msg::Bar", "std_msgs::msg::Header"), tmp_path) is not None
    assert ros_c_compiles(tmp_path, tmp_path / "c")


@settings(
    max_examples=examples(40), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(declared=messages())
@pytest.mark.system
def test_a_struct_made_at_random_is_to_ros_what_it_is_here(declared: Message, tmp_path: Path) -> None:
    theirs = ros_idl(idl_text(declared), tmp_path)
    assert theirs is not None
    check_equal(declared, theirs.messages[0], documented=True)


# Pieces that make members near to right ones; known differences are not among them.
BEFORE = [
    "",
    "",
    "typedef int32 A;",
    "typedef int32 A[2];",
    "typedef B A; typedef string<3> B;",
    "enum A { X };",
]
ANNOTATIONS = [
    *("", "", "@key", "@default (value=1)", '@default (value="(1, 2)")', "@default (1)", '@unit (value="m")'),
    *(
        '@verbatim (language="comment", text="a" "b")',
        "@foo (1, 2)",
        "@foo (a=1, b=-2.5)",
        "@foo (bar)",
        "@foo ()",
    ),
]
TYPES = [
    *(
        "int32",
        "unsigned short",
        "long long",
        "long double",
        "octet",
        "char",
        "string<3>",
        "wstring",
        "string<0>",
    ),
    *(
        "sequence<int32>",
        "sequence<int32, 2>",
        "sequence<string<4>>",
        "sequence<A>",
        "sequence<sequence<int32>>",
    ),
    *("A", "pkg_b::msg::Bar", "::pkg_b::msg::Bar", "::A", "B", "fixed<3, 2>", "struct Bar", "unsigned", ""),
]
DECLARATORS = [
    "a",
    "a",
    "a, b",
    "a[2]",
    "a[2], b",
    "a[2], b[2]",
    "a[2][2]",
    "a[0]",
    "a[]",
    "1a",
    "",
    "sequence",
    "a b",
]
ENDS = [";", ";", "; // c", "; /* c */", "", ";;", "};"]
members = st.tuples(*map(st.sampled_from, (ANNOTATIONS, TYPES, DECLARATORS, ENDS))).map(" ".join)


@settings(
    max_examples=examples(120), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(before=st.sampled_from(BEFORE), member=members)
@pytest.mark.system
def test_members_made_at_random_are_taken_or_refused_as_by_ros(
    before: str, member: str, tmp_path: Path
) -> None:
    text = msg(f"{member}\nint32 z;", before)
    ours, theirs = read(text).declarations, ros_idl(text, tmp_path)
    if theirs is not None and not ours:
        # What the parser takes and the C generator does not, or has no meaning: each has a line in the corpus.
        # An annotation before `::` may be the beginning of a scoped name (OMG IDL 4.2, 7.4.15.3): here it is read so.
        # `long long ;` is for ROS a long of the name `long`, which is a keyword (7.2.3).
        assert "@default" in member or "A" in member or re.search(r"@\w+ ::|\blong +;", member)
        return
    assert bool(ours) == (theirs is not None)
    if ours and theirs is not None:
        assert isinstance(ours[0], Message)
        check_equal(ours[0], theirs.messages[0], documented="@unit" not in text)


def test_ros_gives_constants_declared_alike_to_one_struct(tmp_path: Path) -> None:
    modules = (f"module Foo_{part}_Constants {{ const short A = 1; }};" for part in ("Request", "Response"))
    structs = (f"struct Foo_{part} {{ int32 a; }};" for part in ("Request", "Response"))
    text = parts("srv", *modules, *structs)
    theirs = ros_idl(text, tmp_path, "srv")
    assert theirs is not None
    assert [message.constants for message in theirs.messages[:2]] == [(("A", 1), ("A", 1)), ()]
    assert not read(text, "srv").declarations
