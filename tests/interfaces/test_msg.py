# SPDX-License-Identifier: Apache-2.0
"""The reader of .msg files: model, places and words of its diagnostics, round trip through the printer."""

from __future__ import annotations

import shutil
import subprocess
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Severity, Source
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.msg.names import C_KEYWORDS, CPP_KEYWORDS
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.msg.text import message_text
from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from tests.support.examples import examples
from tests.support.ids import without_id
from tests.support.interfaces.msg_corpus import BAD, GOOD
from tests.support.interfaces.msg_model import (
    NAME,
    messages,
    without_places,
)


def read(text: str) -> tuple[Message | None, list[str]]:
    """Return the message and each diagnostic's headline."""
    diagnostics = Diagnostics()
    message = parse_msg(Source("Foo.msg", text), NAME, diagnostics)
    return message, [without_id(d.headline()) for d in diagnostics]


def good(text: str) -> Message:
    message, messages = read(text)
    assert message is not None, messages
    return without_places(message)


def test_model_of_a_whole_file() -> None:
    text = """\
# What it is.
#   indented

# Above the constant.
uint8 MODE = 0x2   # after it
string<=8[<=4] names ['a', "b"]  # [m/s]
  # and below

float64[9] covariance
Bar bar
other/Baz[] more
"""
    assert good(text) == Message(
        NAME,
        (
            Field("names", SequenceType(StringType(bound=8), 4), ("a", "b"), ("[m/s]", "and below")),
            Field("covariance", ArrayType(Primitive.FLOAT64, 9)),
            Field("bar", NamedType(TypeName("pkg_a", "msg", "Bar"))),
            Field("more", SequenceType(NamedType(TypeName("other", "msg", "Baz")))),
        ),
        (Constant("MODE", Primitive.UINT8, 2, ("Above the constant.", "after it")),),
        ("What it is.", "  indented"),
    )


def test_values_have_the_type_of_their_field() -> None:
    message = good("bool a 1\nfloat32 b 1\nint32 c 0b11\nfloat64[] d [1]\nwstring e 5")
    assert [f.default for f in message.fields] == [True, 1.0, 3, (1.0,), "5"]
    assert [type(f.default) for f in message.fields] == [bool, float, int, tuple, str]


def test_places_of_declarations() -> None:
    message, _ = read("\n\nint32 speed 5 # x\nint32   MAX=7")
    assert message is not None
    spans = [e.span for e in message.fields] + [e.span for e in message.constants]
    assert [(s.line, s.column, s.end_column) for s in spans if s] == [(3, 1, 12), (4, 1, 12)]


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("int32", "1:6: error: expected '[' or a space, found the end of the line"),
        ("int32[3 a", "1:8: error: expected ']', found a space"),
        ("int32[2][3] a", "1:9: error: expected a space, found '['. An array has one dimension"),
        ("int32[] a 5", "1:11: error: expected '[', found '5'. The default of an array is written '[1, 2]'"),
        ("string[] a ['x]", "1:13: error: expected ']' or a string, found '''. The quote is not closed"),
        ("string<5 a", "1:7: error: expected '<=' or '[' or a space, found '<'"),
        ("  int32 a", "1:1: error: a declaration begins in the first column"),
        ("double a", "1:1: error: 'double' is not a message type: CamelCase"),
        ("double a", "Write 'float64'"),
        ("Int32 a\nunit8 a", "2:1: error: 'unit8' is not a message type"),
        ("unit8 a", "Did you mean 'uint8'?"),
        ("time a", "1:1: error: 'time' is not a type of ROS 2. Write 'builtin_interfaces/Time'"),
        ("a/msg/B a", "1:1: error: 'a/msg/B' is not a type. Write 'a/B'"),
        ("int32 imuTemp", "1:7: error: 'imuTemp' is not a field name"),
        ("int32 imuTemp", "For example 'imu_temp'"),
        ("int32 maxSpeed=5", "For example 'MAX_SPEED'"),
        ("int32 class", "1:7: error: 'class' is a keyword of C++"),
        ("int32 a\nbool b\nint32 a", "3:7: error: the name 'a' is declared twice. Line 1 has it first"),
        ("uint8 a  256 # x", "1:10: error: 256 does not fit uint8. Its range is 0 to 255"),
        ("uint8[] a [1,  256]", "1:16: error: 256 does not fit uint8"),
        ("string<=3 a 'abcd'", "1:13: error: the string has 4 characters, but its type takes at most 3"),
        ("int32[2] a [1]", "1:14: error: the default has 1 elements, but the array has 2"),
        ("string a x=y", "1:11: error: a default cannot hold '='"),
        ("int32 a 1e3", "1:9: error: '1e3' is not an integer"),
        ("float32 a 1e39", "1:11: error: 1e39 does not fit float32"),
        ("string[0] a", "1:8: error: the size of an array is a whole number above zero, not '0'"),
    ],
)
def test_errors_say_where_what_and_what_to_do(text: str, messages: str) -> None:
    message, found = read(text)
    assert message is None
    assert any(messages in line for line in found), found
    assert all(line.startswith("Foo.msg:") for line in found)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("string<= a", "For example 'string<=10 a'"),
        ("uint8[<=] a", "For example 'uint8[<=10] a'"),
        ("string<=", "For example 'string<=10 name'"),
        ("uint8[ a", "Write 'uint8[] a'"),
        ("uint8[ 3] a", "Write 'uint8[3] a'"),
        ("uint8[ 3 ] a", "Write 'uint8[3] a'"),
        ("uint8[3 ] a", "Write 'uint8[3] a'"),
        ("uint8[<= 3] a", "Write 'uint8[<=3] a'"),
        ("uint8[ <= 3 ] a", "Write 'uint8[<=3] a'"),
        ("string<=5[ 3] a", "Write 'string<=5[3] a'"),
        ("string<10 a", "Write 'string<=10 a'"),
        ("string< 10 a", "Write 'string<=10 a'"),
        ("string<= 10 a", "Write 'string<=10 a'"),
        ("wstring<10> a", "Write 'wstring<=10 a'"),
        ("sequence<int32> a", "A sequence is written 'type[]', one of at most 10 elements 'type[<=10]'"),
        ("std::list<int> a", "A sequence is written 'type[]', one of at most 10 elements 'type[<=10]'"),
        ("Other<int> a", "expected '/' or '[' or a space, found '<'"),
        ("int32[3]a", "Write 'int32[3] a'"),
        ("// a comment", "write '# a comment'"),
        ("---", "Remove the line: only services (.srv) and actions (.action) have parts"),
        ("vector<int> a", "A sequence is written 'type[]', one of at most 10 elements 'type[<=10]'"),
        ("uint8[-1] a", "Leave it out: '[]' takes any number of elements"),
        ("string<=0 a", "Leave it out: 'string' takes any length"),
        ("uint8[99999999999] a", "Write 4294967295, or leave it out: '[]' takes any number of elements"),
        ("std_msgs::msg::String a", "Write 'std_msgs/String'"),
        ("std_msgs.msg.String a", "Write 'std_msgs/String'"),
        ("a int32", "Write 'int32 a'"),
        ("enum E", "Write a constant for each value: 'uint8 FIRST=0'"),
        ("struct a", "Write its fields into a separate .msg file"),
        ("@optional int32 a", "a sequence 'type[<=1]' can be empty"),
        ("int32[3] a [1, 2]", "Write 3 values, or '[2]' after the type"),
        ("int32[<=1] a [1, 2]", "Write fewer, or '[<=2]' after the type"),
    ],
)
def test_the_hint_can_be_pasted(text: str, hint: str) -> None:
    message, found = read(text)
    assert message is None
    assert any(line.endswith(hint) for line in found), found


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("unsigned char a", "uint8 a"),
        ("unsigned short a 5", "uint16 a 5"),
        ("unsigned int a", "uint32 a"),
        ("unsigned long a", "uint64 a"),
        ("unsigned long long a", "uint64 a"),
        ("unsigned short int a", "uint16 a"),
        ("unsigned int A=5", "uint32 A=5"),
        ("unsigned a", "uint32"),
    ],
)
def test_an_unsigned_type_of_c_is_one_mistake(text: str, hint: str) -> None:
    message, found = read(text)
    assert message is None
    assert len(found) == 1, found
    assert found[0].endswith(f"Write '{hint}'"), found
    assert read(hint if " " in hint else f"{hint} a")[0] is not None


def test_every_faulty_line_is_reported_in_one_run() -> None:
    text = "int32 a\nint32 B\nint32[ c\nuint8 d 300\nint32 e\nfloat F\nint32 a"
    _, found = read(text)
    assert [line.split(":")[1] for line in found] == ["2", "3", "4", "6", "6", "7"]


def test_each_error_has_a_caret_below_its_text() -> None:
    diagnostics = Diagnostics()
    parse_msg(Source("Foo.msg", "# x\r\nuint8\tspeed\t300\r\n"), NAME, diagnostics)
    assert next(iter(diagnostics)).render().splitlines()[1:] == ["  uint8\tspeed\t300", "       \t     \t^~~"]


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("\ufeffint32 a", "1:1: warning: the file begins with a byte order mark"),
        (
            "wstring<=5[] a",
            "1:1: warning: ROS 2 Jazzy reads wstring<=5[] as a sequence of at most 5 elements",
        ),
        ("int32 EINVAL=1", "1:7: warning: 'EINVAL' is a macro of C"),
        ("uint8 UINT8_MAX=255", "1:7: warning: 'UINT8_MAX' is a macro of C"),
        ("int32 errno", "1:7: warning: 'errno' is a macro of <errno.h>"),
        ("int32 linux", "1:7: warning: 'linux' is a macro of compilers on Linux"),
        ("int32 from", "1:7: warning: 'from' is a keyword of Python"),
        (
            "string a 'b#c'",
            "1:10: warning: the quote is not closed: the text is \"'b\". The '#' begins a comment",
        ),
        ('string A="b', "1:10: warning: the quote is not closed"),
    ],
)
def test_warnings_do_not_stop(text: str, messages: str) -> None:
    message, found = read(text)
    assert message is not None
    assert len(found) == 1
    assert messages in found[0]


def test_columns_after_a_byte_order_mark_are_those_of_an_editor() -> None:
    _, found = read("\ufeffint32 A")
    assert any(line.startswith("Foo.msg:1:7: error") for line in found), found


def test_what_is_taken_has_no_error_and_what_is_refused_has_one() -> None:
    for text in [*GOOD, *BAD]:
        diagnostics = Diagnostics()
        message = parse_msg(Source("Foo.msg", text), NAME, diagnostics)
        errors = [d for d in diagnostics if d.severity is Severity.ERROR]
        assert (message is None) == bool(errors), text
        lines = text.replace("\ufeff", "").splitlines()
        for error in errors:
            assert error.span is not None
            assert error.span.column <= len(lines[error.span.line - 1]) + 1, text


# --- round trip: model → text → the same model


@settings(max_examples=examples(300), deadline=None)
@given(messages())
def test_a_printed_message_reads_as_the_same_message(message: Message) -> None:
    text = message_text(message)
    again, messages = read(text)
    assert again is not None, messages
    assert without_places(again) == message


@settings(max_examples=examples(300), deadline=None)
@given(st.text(st.sampled_from("int8 strg<=[]#\"'\\,=\n\taAB/_5é.-"), max_size=60))
def test_no_text_makes_the_reader_fail(text: str) -> None:
    message, messages = read(text)
    assert (message is None) == any(": error: " in line for line in messages)


# --- other oracles


def compiles(compiler: list[str], word: str) -> bool:
    text = f"struct s {{ int {word}; }};\nint f(struct s * p) {{ return p->{word}; }}\n"
    command = [*compiler, "-fsyntax-only", "-"]
    run = subprocess.run(command, input=text.encode(), capture_output=True, check=False)
    return run.returncode == 0


@pytest.mark.builds
@pytest.mark.parametrize(
    ("compiler", "words"),
    [
        (["gcc", "-x", "c", "-std=c99", "-pedantic-errors"], C_KEYWORDS),
        (["g++", "-x", "c++", "-std=c++17", "-pedantic-errors"], C_KEYWORDS | CPP_KEYWORDS),
    ],
    ids=["C99", "C++17"],
)
def test_keywords_are_those_of_the_compilers(compiler: list[str], words: frozenset[str]) -> None:
    if shutil.which(compiler[0]) is None:
        pytest.skip(f"needs {compiler[0]}")
    if "c++" in compiler:
        words = words - {"restrict"}
    for word in sorted(words):
        assert not compiles(compiler, word), word
    for word in ["data", "concept", "module", "final", "override", "main", "size_t"]:
        assert compiles(compiler, word), word


def test_reading_the_standard_interfaces_takes_a_fraction_of_a_second() -> None:
    paths = sorted(shipped_folder().glob("*/msg/*.msg"))
    sources = [(Source(str(p), p.read_text(encoding="utf-8")), p) for p in paths]
    assert len(sources) > 150
    best = 1.0
    for _ in range(3):
        start = time.process_time()
        for source, path in sources:
            assert (
                parse_msg(source, TypeName(path.parent.parent.name, "msg", path.stem), Diagnostics())
                is not None
            )
        best = min(best, time.process_time() - start)
    assert best < 0.25, f"{best:.3f} s"
