# SPDX-License-Identifier: Apache-2.0
"""The reader of .idl files: the model, every diagnostic with its place, recovery, structs made at random."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.omg_idl.parser import parse_idl, read_idl
from microros_gen.interfaces.omg_idl.text import idl_text
from microros_gen.interfaces.types import (
    Action,
    ArrayType,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    Service,
    StringType,
    TypeName,
)
from tests.support.examples import examples
from tests.support.ids import without_id
from tests.support.interfaces.idl_corpus import BAD, BAD_PARTS, GOOD, const, default, msg, parts
from tests.support.interfaces.idl_strategies import NAME, messages


def found(text: str, kind: str = "msg") -> list[str]:
    """Return every diagnostic as `line:column: message. hint`; nothing is returned for a text with an error."""
    diagnostics = Diagnostics()
    declarations = parse_idl(Source("F.idl", text), "pkg_a", kind, diagnostics)
    assert bool(declarations) is not diagnostics.has_errors()
    return [without_id(d.headline()).removeprefix("F.idl:") for d in diagnostics]


def message(text: str) -> Message:
    diagnostics = Diagnostics()
    (declaration,) = parse_idl(Source("F.idl", text), "pkg_a", "msg", diagnostics)
    assert isinstance(declaration, Message)
    return declaration


def test_a_message_with_all_that_belongs_to_it() -> None:
    text = """\
#include "std_msgs/msg/Header.idl"
module pkg_a { module msg {
  typedef double double__3[3];
  module Foo_Constants {
    @verbatim (language="comment", text="The most " "there are." "\\n" "Second line.")
    const uint8 MOST = 7;
  };
  @verbatim (language="comment", text="About Foo.")
  struct Foo {
    std_msgs::msg::Header header;
    @verbatim (language="comment", text="Where it is.") @unit (value="m") @key
    @default (value="(1.0, 2.5, -3.0)")
    double__3 place;
    sequence<string<5>, 4> names;
  };
}; };
"""
    declared = message(text)
    assert declared.name == NAME
    assert declared.comment == ("About Foo.",)
    (constant,) = declared.constants
    assert (constant.name, constant.type, constant.value) == ("MOST", Primitive.UINT8, 7)
    assert constant.comment == ("The most there are.", "Second line.")
    header, place, names = declared.fields
    assert header.type == NamedType(TypeName("std_msgs", "msg", "Header"))
    assert place.type == ArrayType(Primitive.FLOAT64, 3)
    assert place.default == (1.0, 2.5, -3.0)
    assert place.comment == ("Where it is. [m]",)
    assert place.span is not None
    assert (place.span.line, place.span.column, place.span.end_column) == (13, 15, 20)
    assert names.type == SequenceType(StringType(bound=5), 4)


def test_includes_are_recorded_and_not_read() -> None:
    text = msg("int32 a;", head='#include "no/such/File.idl"\n  #include <b/msg/C.idl>')
    includes = read_idl(Source("F.idl", text), "pkg_a", "msg", Diagnostics()).includes
    assert [(i.path, i.span.line, i.span.column) for i in includes] == [
        ("no/such/File.idl", 1, 1),
        ("b/msg/C.idl", 2, 3),
    ]


def test_services_and_actions_have_what_ros_derives() -> None:
    request, response = "struct Foo_Request { int32 a; };", "struct Foo_Response { int32 b; };"
    (service,) = parse_idl(Source("F.idl", parts("srv", request, response)), "pkg_a", "srv", Diagnostics())
    assert isinstance(service, Service)
    assert [m.name.name for m in service.messages] == ["Foo_Request", "Foo_Response", "Foo_Event"]
    structs = [f"struct Foo_{part} {{ int32 a; }};" for part in ("Goal", "Result", "Feedback")]
    (action,) = parse_idl(Source("F.idl", parts("action", *structs)), "pkg_a", "action", Diagnostics())
    assert isinstance(action, Action)
    assert action.name == TypeName("pkg_a", "action", "Foo")
    assert len(action.messages) == 10


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (msg("int32 a[2][3];"), "6:13: error: ROS 2 has arrays of one dimension only."),
        (msg("int32 a[2 + 3 * 2];"), "6:15: error: the size of an array is a decimal number: ROS 2 Jazzy evaluates "
         "no expressions here. Write 8"),
        (msg("int32 a[N];", "const short M = 0x10; const short N = (M >> 2) | 3;"), "Write 7"),
        (const("const short A = 1 << 4;"), "ROS 2 Jazzy does not accept an expression as a value. Write 16"),
        (const("const short A = 0x1F;"), "does not accept a number in hexadecimal. Write 31"),
        (const("const short A = -017;"), "does not accept a number in octal. Write -15"),
        (const("const short A = 'a';"), "Write its number"),
        (const("const uint8 A = 256;"), "256 does not fit uint8. Its range is 0 to 255"),
        (
            default("float", "1"),
            "6:23: error: for a whole number here, ROS 2 Jazzy generates C code that does not compile. Write 1.0",
        ),
        (msg("Kolor a;", "typedef int32 Color;"), "Did you mean 'Color'?"),
        (msg("Bar a;"), "Another interface is written 'pkg_a::msg::Bar'"),
        (msg("unknown_type a;"), "error: 'unknown_type' is neither a type nor a typedef of this file."),
        (msg("float64 a;"), "Write double"),
        (msg("long double a;"), "cannot describe a long double"),
        (msg("int32 a;", "union U { };"), "ROS 2 has no unions"),
        (msg("int32 a;", "struct B : C { int32 a; };"), "ROS 2 has no inheritance"),
        (msg("int32 a;", head="#define X"), "1:1: error: expected a declaration, found '#'. Of the preprocessor"),
        (msg("int32 _a;"), "A name begins with a letter"),
        (msg("int32 a; /* open"), "The comment is not closed"),
        (const('const string A = "x;'), "The quote is not closed in its line"),
        (msg("int32 register;"), "'register' is a keyword of C"),
        (msg("int32 a;", "const short A = 5;"), "4:17: warning: ROS 2 Jazzy ignores the constant 'A'"),
        (msg("sequence<wstring<5>> a;"), "6:16: warning: ROS 2 Jazzy reads this as a sequence of at most 5"),
        (msg("int32 a[3], b;"), "6:19: warning: ROS 2 Jazzy also makes 'b' an array of 3"),
        (const("const short EOF = 1;"), "4:40: warning: 'EOF' is a macro of C"),
        (msg("int32 errno;"), "6:13: warning: 'errno' is a macro of <errno.h>"),
        (msg("int32 lambda;"), "6:13: warning: 'lambda' is a keyword of Python"),
        (msg("int32 a\n      int32 b;"), "6:14: error: expected ';' at the end of the declaration. Add it"),
        (
            parts("msg", "module A_Constants { const short X = 1; };", "module Foo_Constants { const short X = 1; };",
                  "struct Foo { int32 a; };"),
            "ROS 2 Jazzy takes 'X' for a constant of 'A_Constants' too",
        ),
        (parts("msg", "struct A { int32 a; };", "struct B { int32 a; };"), "2 structs in a file of msg/"),
    ],
)  # fmt: skip
def test_diagnostics(text: str, expected: str) -> None:
    assert any(expected in line for line in found(text)), found(text)


def test_every_fault_is_reported_in_one_run() -> None:
    text = """\
#pragma once
module pkg_a { module msg {
  module Foo_Constants { const short A = 0x10; const short B = ; const octet C = 300; };
  typedef int32 D[2][2];
  union U switch (long) { case 1: int32 a; };
  struct Foo {
    int32 e
    Unknown f; string<0> g, h;
    sequence<int32 i;
    int32 j k; @default (value=1) float l;
    D m; int32 class;
  };
}; };
"""
    lines = [line.split(": ")[0] for line in found(text)]
    assert sorted(map(int, (line.split(":")[0] for line in lines))) == [
        1,
        3,
        3,
        3,
        4,
        5,
        7,
        8,
        8,
        9,
        10,
        10,
        11,
    ]
    assert found(text) == found(text.replace("\n", "\r\n"))


@pytest.mark.parametrize("end", ["", "};", "};\n}", "} } }", "}; }; }; };", "@", '"', "/*", "const", ";"])
@pytest.mark.parametrize("text", [GOOD[0], GOOD[-1]])
def test_a_file_that_ends_anywhere_has_a_place_for_its_error(text: str, end: str) -> None:
    cut = text[: text.index("struct Foo {") + 20] + end
    lines = found(cut)
    assert lines
    assert all(int(line.split(":")[0]) <= cut.count("\n") + 1 for line in lines)


@pytest.mark.parametrize("text", BAD + [text for _, text in BAD_PARTS])
def test_every_refusal_has_a_message(text: str) -> None:
    assert any("error:" in line for line in found(text))


@settings(max_examples=examples(300), deadline=None)
@given(
    text=st.sampled_from([*GOOD, *BAD]),
    place=st.floats(0, 1),
    cut=st.integers(0, 6),
    put=st.sampled_from(["", "{", "}", ";", '"', "'", "#", "/*", "@", "<", ">", "::", "\n", "\\", "ä", "\0"]),
)
def test_any_text_is_taken_or_refused_with_a_message(text: str, place: float, cut: int, put: str) -> None:
    start = int(place * len(text))
    found(text[:start] + put + text[start + cut :])


def test_a_deep_file_ends_in_a_diagnostic() -> None:
    assert found("module a {" * 3000)
    assert found(const(f"const short A = {'(' * 1500}1{')' * 1500};"))
    assert found(const(f"const short A = {'1 + ' * 1000}1;"))
    twice = f"const short A = {'1 + ' * 1000}1;"
    assert found(parts("msg", *(f"module {m}_Constants {{ {twice} }};" for m in ("A", "Foo"))))
    doubled = " ".join(f"const short A{i} = A{i + 1} + A{i + 1};" for i in range(40))
    assert found(const(f"{doubled} const short A40 = A0;"))


@pytest.mark.parametrize(
    "number", ["9" * 5000, "0" + "7" * 5000, "0x" + "f" * 5000, "9" * 350, "1e5000", ".5e-5000"]
)
def test_numbers_of_any_length_are_refused_or_taken(number: str) -> None:
    found(const(f"const double A = {number};"))
    found(default("double", number))
    found(default("sequence<double>", f'"({number},)"'))
    assert found(const(f"const short A = {number};"))
    assert found(msg(f"int32 a[{number}];"))


def without_places(declared: Message) -> Message:
    return replace(
        declared,
        fields=tuple(replace(f, span=None) for f in declared.fields),
        constants=tuple(replace(c, span=None) for c in declared.constants),
        span=None,
    )


@settings(max_examples=examples(200), deadline=None)
@given(declared=messages())
def test_a_struct_made_at_random_is_read_back_from_its_text(declared: Message) -> None:
    assert without_places(message(idl_text(declared))) == declared
