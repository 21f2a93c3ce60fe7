# SPDX-License-Identifier: Apache-2.0
"""Texts of .idl files: those that ROS 2 Jazzy takes, those that it refuses, and where this tool differs.

The lists are held against ROS 2's own pipeline in test_idl_oracle.py, so none of them can say what is not so.
"""

from __future__ import annotations

from dataclasses import dataclass


def msg(body: str, before: str = "", head: str = "", end: str = "") -> str:
    """Return a file of package pkg_a with the struct Foo of these members."""
    return (
        f"{head}\nmodule pkg_a {{\n  module msg {{\n    {before}\n    struct Foo {{\n      {body}\n    }};\n"
        f"  }};\n}};\n{end}"
    )


def const(text: str) -> str:
    """Return a file whose struct Foo has these constants."""
    return msg("int32 a;", f"module Foo_Constants {{ {text} }};")


def default(kind: str, value: str) -> str:
    """Return a file with one member that has this default."""
    return msg(f"@default (value={value}) {kind} a;")


def array_default(kind: str, value: str) -> str:
    """Return a file with one member of type A, a typedef, that has this default."""
    element, _, extent = kind.partition("[")
    return msg(f"@default (value={value}) A a;", f"typedef {element} A[{extent};")


def parts(kind: str, *structs: str) -> str:
    """Return a file of these structs in module `kind`."""
    return f"module pkg_a {{ module {kind} {{ {' '.join(structs)} }}; }};"


_BASES = [
    *(
        "boolean",
        "octet",
        "char",
        "wchar",
        "float",
        "double",
        "short",
        "unsigned short",
        "long",
        "unsigned long",
    ),
    *(
        "long long",
        "unsigned long long",
        "int8",
        "uint8",
        "int16",
        "uint16",
        "int32",
        "uint32",
        "int64",
        "uint64",
    ),
]
_ELEMENTS = [
    *_BASES,
    "string",
    "wstring",
    "string<7>",
    "wstring<7>",
    "other_pkg::msg::Bar",
    "::other_pkg::msg::Bar",
]

GOOD = [
    *(msg(f"{kind} a;") for kind in _ELEMENTS),
    *(msg(f"sequence<{kind}> a;") for kind in _ELEMENTS if kind not in ("wstring<7>", "wchar")),
    *(msg(f"sequence<{kind}, 3> a;") for kind in _ELEMENTS if kind != "wchar"),
    *(msg(f"{kind} a[3];") for kind in ("int32", "string", "string<7>", "wstring<7>", "other_pkg::msg::Bar")),
    *(
        msg("A a;", f"typedef {kind} A;")
        for kind in ("int32", "string<3>", "sequence<int32>", "sequence<string<2>, 3>")
    ),
    *(msg("A a;", f"typedef {kind} A[3];") for kind in ("int32", "wstring<3>", "other_pkg::msg::Bar")),
    # typedefs
    msg("A a;", "typedef other_pkg::msg::Bar B; typedef B A[3];"),
    msg("A a;", "typedef string<4> B; typedef sequence<B, 3> A;"),
    msg("A a[3];", "typedef int32 A;"),
    msg("sequence<A> a;", "typedef wstring<4> A;"),
    msg("sequence<A, 2> a;", "typedef other_pkg::msg::Bar A;"),
    msg("A a;", "typedef int32 A; typedef int32 A; typedef long A;"),
    msg("A a;", end="module pkg_a { typedef int32 A; };"),
    msg("int32 a;", "typedef Unknown A; typedef sequence<Unknown> B;"),
    # declarators
    msg("int32 a, b;\n int32 c, d[3];"),
    msg("int32 a[3], b;"),
    msg("@default (value=5) short a, b;"),
    # words of IDL as names
    *(
        msg(f"int32 {word};")
        for word in ("sequence", "string", "wstring", "module", "octet", "boolean", "any", "fixed")
    ),
    msg("sequence<int32> sequence; sequence<string<3>> string;"),
    msg("int32 int32;\n uint8 uint8;"),
    msg("pkg_b::msg::Bar sequence; A string; sequence<A> module; A struct_;", "typedef int32 A;"),
    msg("@key pkg_b::msg::Bar sequence; @a::b A boolean; @c sequence<A> octet;", "typedef int32 A;"),
    msg("int32 TRUE;"),
    msg("int32 fooBar;\n int32 FOO;\n int32 a_;\n int32 a__b;"),
    msg("uint8 structure_needs_at_least_one_member;"),
    msg("uint8 structure_needs_at_least_one_member;\n int32 a;"),
    # space, comments, includes
    msg("int32 a; // b\n /* c\n d */ int32 e; /* f */ int32\n\n g\n;"),
    msg("int32 a; /* ** / */ int32 b; /***/ // /* c\n int32 d;"),
    msg("unsigned /* a */ long // b\n long c; pkg_b :: msg\n:: Bar d;"),
    msg("int32 a;", head='#include "a/msg/B.idl"\n#include <c/msg/D.idl>'),
    msg("int32 a;", '#include "a/msg/B.idl"'),
    msg("int32 a;\r\n      int32 b;"),
    msg('@verbatim (language="comment", text="http://x // y /* z */") int32 a;'),
    # forward declarations, enumerations, modules
    msg("int32 a;", "struct Foo; struct Other;"),
    msg("int32 a;", "enum Color { RED, GREEN, @value(5) BLUE };"),
    msg("int32 a;", "@bit_bound(8) enum Color { RED };"),
    msg("int32 a;", "module m { enum E { A }; };"),
    "module pkg_a { module msg { module x { typedef int32 A; }; }; }; "
    "module pkg_a { module msg { struct Foo { A a; }; }; };",
    msg(
        "int32 a;",
        "module Foo_Constants { const short A = 1; }; module Foo_Constants { const short B = 2; };",
    ),
    # constants
    *(const(f"const {kind} A = 5;") for kind in _BASES if kind not in ("boolean", "float")),
    *(const(f"const {kind} A = 1.5;") for kind in ("float", "double")),
    *(const(f"const short A = {value};") for value in ("0", "-5", "+5", "- 5", "32767", "-32768")),
    const("const long A = -2147483648;"),
    const("const unsigned long long A = 18446744073709551615;"),
    const("const long long A = -9223372036854775808;"),
    *(
        const(f"const double A = {value};")
        for value in ("1.", ".5", "1e3", "1E-3", "-1.5e+3", "8.7d", "4.d", ".3D", "7d", "1e20")
    ),
    const("const double A = 3;"),
    const("const boolean A = TRUE; const boolean B = FALSE; const boolean C = 1; const boolean D = 0;"),
    const(
        'const string A = ""; const string B = "x" "y" "z"; const wstring C = L"x" L"y"; const string<9> D = "abc";'
    ),
    const('const wstring A = "x"; const string B = L"x"; const wstring<3> C = "abc";'),
    const('@verbatim (language="comment", text="c") @foo const short A = 1;'),
    const('const string A = "ä ハロー"; const wstring B = L"ä ハロー";'),
    const(r'const wstring A = L"\u00e9\u2122"; const string B = "\u00e9";'),
    const(r'const string A = "a\tb\\c\"d\x41\101\?\q\'e";'),
    const(r'const string A = "\\\\x"; const string B = "\\x41"; const string C = "\\\"";'),
    const("const short data = 5; const short a_b = 6;"),
    # defaults
    *(
        default(kind, value)
        for kind, value in [("boolean", "TRUE"), ("octet", "255"), ("char", "-128"), ("wchar", "65535")]
    ),
    *(
        default("float", value)
        for value in ("1.9e10", "1.9e+10", "1.1e-10", "0.00009", "1.", ".1", "9e05", "8.7d", "7d", "-1.5")
    ),
    *(default("int32", value) for value in ("5", "-5", "+5", "(5)", "((5))", "(-5)")),
    *(default("string", value) for value in ('"x"', '"x" " y"', '""', 'L"x"', '"a;b{c}"')),
    *(default("wstring", value) for value in ('"x"', 'L"x"', 'L"\\u00e9"')),
    default("string<3>", '"abc"'),
    default("double", "1e300"),
    *(array_default("int32[3]", value) for value in ('"(1, 2, 3)"', '"[1, -2, 3]"')),
    default("sequence<int32>", '"()"'),
    default("sequence<int32, 3>", '"(1,)"'),
    default("sequence<double>", '"(1.5, 2.0)"'),
    default("sequence<boolean>", '"(True, False)"'),
    default("sequence<string>", '"(\'x\', \\"y\\")"'),
    array_default("boolean[2]", '"(True, False)"'),
    # annotations
    *(
        msg(f"{annotation} int32 a;")
        for annotation in [
            "@key",
            "@range (min=-10, max=10)",
            "@optional",
            "@foo (5)",
            '@foo ("x")',
            "@foo (A)",
            "@foo (a::b)",
            "@foo (a=1, a=2)",
            "@ns::foo (a=1)",
            '@unit (value="m/s")',
            '@unit ("m/s")',
            "@id(3) @must_understand",
            "@ key",
            "@struct_like",
        ]
    ),
    msg("int32 a;", "@transfer_mode(SHMEM_REF)"),
    msg("int32 a;", '@verbatim (language="comment", text="one" "\n" "two")'.replace("\n", "\\n")),
    msg('@verbatim (language="comment", text="") int32 a;'),
    msg('@verbatim (language="c", text="x") int32 a;'),
    msg('@verbatim (language="comment", text="a") @verbatim (language="comment", text="b") int32 a;'),
    msg('@verbatim (text="x", language="comment") int32 a;'),
    msg('@verbatim ("x") int32 a;'),
    msg('@verbatim (language="comment") int32 a;'),
]

GOOD_PARTS = [
    ("srv", parts("srv", "struct Foo_Request { int32 a; };", "struct Foo_Response { string b; };")),
    (
        "srv",
        parts(
            "srv",
            "module Foo_Request_Constants { const short A = 1; };",
            "struct Foo_Request { int32 a; };",
            "module Foo_Response_Constants { const short B = 1; };",
            "@foo('a') struct Foo_Response { uint8 structure_needs_at_least_one_member; };",
        ),
    ),
    (
        "srv",
        parts("srv", "struct Foo_Request { A a; };", "struct Foo_Response { A b; };", "typedef int32 A[3];"),
    ),
    (
        "action",
        parts(
            "action",
            "struct Foo_Goal { int32 a; };",
            "module Foo_Result_Constants { const short A = 1; };",
            "struct Foo_Result { int32 a; };",
            "struct Foo_Feedback { other_pkg::msg::Bar a; };",
        ),
    ),
]

BAD = [
    "",
    "// only a comment",
    "module pkg_a { };",
    "module pkg_a { module msg { }; };",
    msg(""),
    msg("int32 a"),
    msg("int32;"),
    msg("int32 a b;"),
    msg("int32 a;; int32 b;"),
    msg("int32 1a;"),
    msg("int32 _a;"),
    msg("int32 ä;"),
    msg("int32 a[];"),
    msg("int32 a[0];"),
    msg("int32 a[2][3];"),
    msg("int32 a[3], b[2];"),
    msg("int32 a[0x10];"),
    msg("int32 a[010];"),
    msg('int32 a["x"];'),
    msg("int32 a[N];", "const short N = 3;"),
    msg("sequence<int32, 0> a;"),
    msg("sequence<int32, N> a;", "const short N = 3;"),
    msg("sequence<> a;"),
    msg("sequence a;"),
    msg("sequence<sequence<int32>> a;"),
    msg("sequence<int32> a[3];"),
    msg("string<0> a;"),
    msg("string<N> a;", "const short N = 3;"),
    msg("string<> a;"),
    msg("fixed<5, 2> a;"),
    msg("fixed a;"),
    msg("long double a;"),
    msg("sequence<long double> a;"),
    msg("unsigned a;"),
    msg("unsigned int a;"),
    msg("unsigned int32 a;"),
    msg("any a;"),
    msg("bool a;"),
    msg("Bar a;"),
    msg("::Bar a;"),
    msg("map<int32, int32> a;"),
    msg("Color a;", "enum Color { RED };"),
    msg("int32 a;", "enum Color { };"),
    msg("int32 a;", "enum Color { RED, };"),
    msg("A a;", "typedef sequence<int32> A[3];"),
    msg("A a;", "typedef int32 A[3][3];"),
    msg("A a;", "typedef int32 A, B;"),
    msg("A a;", "typedef int32 A; typedef int64 A;"),
    msg("A a;", "typedef Unknown A[3];"),
    msg("A a;", "typedef struct B { int32 a; } A;"),
    msg("A a;", "typedef enum B { C } A;"),
    msg("int32 a;", "@foo typedef int32 A;"),
    msg("int32 a;", "typedef fixed<5, 2> A;"),
    msg("int32 a;", "union U switch (long) { case 1: int32 a; };"),
    msg("int32 a;", "bitmask M { A };"),
    msg("int32 a;", "native N;"),
    msg("int32 a;", "interface I { };"),
    msg("struct B { int32 a; } b;"),
    msg("int32 a;", "struct B : Foo { int32 a; };"),
    msg("int32 a;", "@foo struct B;"),
    msg("int32 a;", head="#define A 5"),
    msg("int32 a;", head="#pragma once"),
    msg("int32 a;", head='# include "a"'),
    msg("int32 a;", head="#include a"),
    msg("int32 a; /* open"),
    "module pkg_a { module msg { struct Foo { int32 a; };",
    "module pkg_a { module msg { struct Foo { int32 a; }; }; }",
    "module pkg_a { module msg { struct Foo { int32 a; } }; };",
    "module pkg_a { module msg { struct Foo { int32 a; }; }; }; };",
    "module pkg_a { module msg { struct A { int32 a; }; struct B { int32 a; }; }; };",
    "module pkg_a { module msg { typedef int32 A; }; };",
    # constants
    "const short A = 1; " + msg("int32 a;"),
    *(
        const(f"const short A = {value};")
        for value in (
            "1 + 2",
            "(5)",
            "1 << 3",
            "0x10",
            "010",
            "'a'",
            "--5",
            "-(5)",
            "",
            "3 * (2 - 1)",
            "L'a'",
            "08",
        )
    ),
    const("const short = 5;"),
    const("const short A;"),
    const("const fixed A = 5d;"),
    const("const T A = 5;"),
    const("const string A = 5;"),
    const("const string A = TRUE;"),
    const('const string A = -"x";'),
    const('const string A = "x" L"y";'),
    const('const string A = "x\ny";'),
    const('const string A = "x;'),
    const(r'const string A = "\x4";'),
    const(r'const wstring A = L"\u41";'),
    const("const sequence<int32> A = 5;"),
    # defaults and annotations
    default("int32", "0x10"),
    default("int32", "1 + 2"),
    default("int32", "'a'"),
    msg("@default (5) int32 a;"),
    msg("@default int32 a;"),
    msg("@default (max=5) int32 a;"),
    msg("@foo () int32 a;"),
    msg("@foo (1 + 2) int32 a;"),
    msg("@foo ('a') int32 a;"),
    msg("@foo (a=1, 2) int32 a;"),
    msg("@foo (a=0x10) int32 a;"),
    msg("int32 a;", "@foo ('a')"),
    msg("@ int32 a;"),
]

BAD_PARTS = [
    ("srv", parts("srv", "struct Foo_Request { int32 a; };", "struct Foo_Answer { string b; };")),
    ("srv", parts("srv", "struct Foo_Response { int32 a; };", "struct Foo_Request { string b; };")),
    ("srv", parts("srv", "struct Foo_Request { int32 a; };", "struct Bar_Response { string b; };")),
    (
        "srv",
        parts("srv", "struct Foo_Request { int32 a; };", "module m { struct Foo_Response { int32 b; }; };"),
    ),
    (
        "action",
        parts("action", *(f"struct Foo_{part} {{ int32 a; }};" for part in ("Goal", "Feedback", "Result"))),
    ),
    (
        "action",
        parts(
            "action", *(f"struct Foo_{part} {{ int32 a; }};" for part in ("Goal", "Result", "Feedback", "X"))
        ),
    ),
]

NO_C = [
    msg("wchar a[3];"),
    msg("wchar a, b[2];"),
    msg("sequence<wchar> a;"),
    msg("sequence<wchar, 3> a;"),
    msg("A a;", "typedef wchar A[3];"),
    msg("A a[3];", "typedef wchar A;"),
    msg("sequence<A> a;", "typedef wchar A;"),
    msg("wstring<N> a;", "const short N = 3;"),
    msg("B b;", "typedef int32 A; typedef A B;"),
    msg("sequence<A> b;", "typedef int32 A[3];"),
    msg("A b[3];", "typedef sequence<int32> A;"),
    msg("B b;", "typedef sequence<int32> A; typedef A B[3];"),
    msg("int32 a; int32 a;"),
    msg("int32 register;"),
    msg("pkg_a::msg::Color a;", "enum Color { RED };"),
    msg("pkg_a::msg::A a;", "typedef int32 A;"),
    msg("pkg_b::Bar a;"),
    default("float", "1"),
    default("int32", "TRUE"),
    default("int32", "A"),
    default("int32", '"x"'),
    default("string", "5"),
    default("string", "TRUE"),
    default("sequence<int32>", "5"),
    default("sequence<int32>", '"x"'),
    default("sequence<float>", '"(1, 2)"'),
    default("sequence<string>", '"(1, 2)"'),
    array_default("int32[3]", '"x"'),
    const("const float A = 1;"),
    const("const long A = TRUE;"),
    const("const short A = 1.5;"),
    const("const short A = B;"),
    const('const long A = "x";'),
    const("const short A = 1; const short A = 2;"),
    msg("@verbatim int32 a;"),
    msg('@verbatim (language="comment", text=5) int32 a;'),
]


NO_PYTHON = [
    const("const wchar A = 5;"),
    const("const char A = -1;"),
    default("wchar", "65535"),
    default("char", "-128"),
    default("sequence<int32>", '"()"'),
    default("sequence<double, 3>", '"()"'),
]
"""What C and C++ come out of, and no Python that can be imported."""


@dataclass(frozen=True)
class Difference:
    """A text that one side takes and the other refuses, or that both take differently; and why."""

    text: str
    ros_takes: bool
    we_take: bool
    why: str


_SPACE = "words of the language have space between them in IDL"
_WRONG = "Jazzy reads another number than IDL means"
_RANGE = "the value does not fit, and C changes it"

DIFFERENCES = [
    Difference(
        "\ufeff" + msg("int32 a;"), False, True, "a byte order mark is an editor's doing: a warning is enough"
    ),
    Difference(msg("int32 a; /**/ int32 b;"), False, True, "an empty comment is one"),
    Difference(msg("int32a;"), True, False, _SPACE),
    Difference(msg("longlong a;"), True, False, _SPACE),
    Difference(const("const short A = 1 0;"), True, False, _SPACE),
    Difference(msg("int32 a[2 + 3];"), True, False, _WRONG),
    Difference(msg("int32 a[-3];"), True, False, _WRONG),
    Difference(msg("sequence<int32, 1 << 4> a;"), True, False, _WRONG),
    Difference(const("const short A = ~5;"), True, False, _WRONG),
    Difference(const("const boolean A = -TRUE;"), True, False, "Jazzy drops the sign"),
    Difference(default("int32", "-(5)"), True, False, _WRONG),
    Difference(
        const("const string A = B;"), True, False, "Jazzy takes the name of the constant for its text"
    ),
    Difference(const("const short A = 32768;"), True, False, _RANGE),
    Difference(default("uint8", "256"), True, False, _RANGE),
    Difference(default("int8", "1.5"), True, False, _RANGE),
    Difference(default("sequence<int32, 2>", '"(1, 2, 3)"'), True, False, _RANGE),
    Difference(array_default("int32[3]", '"(1, 2)"'), True, False, "an array has as many values as elements"),
    Difference(default("string<3>", '"abcd"'), True, False, "the bound holds for the default too"),
    Difference(const('const string<3> A = "abcd";'), True, False, "the bound holds for the value too"),
    Difference(default("float", "1e39"), True, False, "C makes infinity of it, with a warning"),
    Difference(default("double", "1e400"), True, False, "Jazzy writes `inf` into C, which does not compile"),
    Difference(default("other_pkg::msg::Bar", "5"), True, False, "C has no default for a struct"),
    Difference(msg("@default (value=1) @default (value=2) int32 a;"), True, False, "Jazzy drops both"),
    Difference(default("string", r'"a\0b"'), True, False, "NUL ends the string in C"),
    Difference(msg("wstring<0> a;"), True, False, "a string without room for a character"),
    Difference(msg("string<4294967296> a;"), True, False, "CDR counts with 32 bits"),
    Difference(
        "@foo module pkg_a { module msg { struct Foo { int32 a; }; }; };", True, False, "Jazzy calls it foo"
    ),
    Difference(msg("int32 class;"), True, False, "Jazzy takes the name and then fails to compile C++"),
    Difference(
        const("const short a = 5;"), True, False, "a member and a constant of one name: C++ does not compile"
    ),
    Difference(
        msg("int32 a;").replace("pkg_a", "pkg_b"), True, False, "type support is found by the package's name"
    ),
    Difference(
        msg("int32 a;").replace("module msg", "module foo"), True, False, "type support is found by msg"
    ),
    Difference("struct Foo { int32 a; };", True, False, "type support is found by package and msg"),
    Difference(
        parts("srv", "struct Foo { int32 a; };"),
        True,
        False,
        "a message in a module srv: nothing looks for it",
    ),
]
