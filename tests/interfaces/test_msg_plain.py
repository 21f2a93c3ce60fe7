# SPDX-License-Identifier: Apache-2.0
"""Plain declarations are read without the grammar; it is the oracle for every line of which both know the tree."""

from __future__ import annotations

import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.interfaces.msg import grammar
from microros_gen.interfaces.msg.syntax import Node, Word, plain_declaration
from tests.support.examples import examples
from tests.support.interfaces.msg_corpus import BAD, GOOD
from tests.support.paths import ROOT

SHIPPED = sorted((ROOT / "microros_gen" / "idl").rglob("*.msg"))
PARTS = (
    *("bool", "byte", "char", "float64", "int8", "uint16", "string", "wstring", "int8x", "strings", "float"),
    *("Header", "std_msgs", "_A", "a_", "é", "1", "0", "-1", "10", "<=", "<", "[", "]", "[]", "[<=3]", "[4]"),
    *(" ", "  ", "\t", "\x0b", "=", " = ", "'", '"', "/", "x", "NAME", "value", "#", ".", ",", "\\"),
)


def places(node: object) -> object:
    """Return a tree as tuples, with the columns of its words."""
    if isinstance(node, Node):
        return (node.data, *map(places, node.children))
    assert isinstance(node, Word)
    return (str(node), node.column)


def agree(line: str) -> bool:
    """Check a line against the grammar; return whether it is plain."""
    plain = plain_declaration(line)
    if plain is not None:
        parsed = grammar.parse(line)
        assert parsed is not None, line
        assert places(plain) == places(parsed), line
    return plain is not None


def declarations(text: str) -> list[str]:
    lines = (line.replace("\t", " ").rstrip().partition("#")[0].rstrip() for line in text.splitlines())
    return [line for line in lines if line]


def test_most_lines_of_real_packages_are_plain() -> None:
    lines = [line for path in SHIPPED for line in declarations(path.read_text(encoding="utf-8"))]
    assert len(lines) > 500
    assert sum(map(agree, lines)) > 0.98 * len(lines)


def test_lines_of_the_corpus() -> None:
    texts = [text for case in (*GOOD, *BAD) for text in (case if isinstance(case, tuple) else (case,))]
    assert sum(agree(line) for text in texts if isinstance(text, str) for line in declarations(text)) > 20


@pytest.mark.parametrize(
    ("line", "plain"),
    [
        ("std_msgs/Header header", True),
        ("wstring<=10[<=3]  name", True),
        ("uint8  OK = 1", True),
        ("string WORDS=a = b", True),
        ("int8 x 5", True),
        ("string x  'a = b'", True),
        ("int8[] x [5]", False),
        ("int8[2] x 5", False),
        (" int8 x", False),
        ("int8 X=", False),
        ("int8[<=] x", False),
        ("a/b/C x", False),
        ("int8 x\n", False),
    ],
)
def test_what_is_plain(line: str, plain: bool) -> None:
    assert agree(line) is plain


@settings(max_examples=examples(600), deadline=None)
@given(st.lists(st.sampled_from(PARTS), max_size=9).map("".join).map(str.rstrip))
def test_any_line(line: str) -> None:
    agree(line)


WORDS = st.sampled_from(("int8", "string", "Header", "std_msgs/Header", "wstring<=5", "Xé", "float64"))
EXTENTS = st.sampled_from(("", "[]", "[3]", "[<=3]", "[03]", "[<=]", "[ 3]"))
GAPS = st.sampled_from((" ", "   ", " \x0b", "\u00a0", ""))
ENDS = st.sampled_from(
    ("", "=1", " = 'a'", "= -2.5e3 ", " 7", " = = 3", "  '=x'", " [1]", "=", "==", "=\u00a07")
)


@settings(max_examples=examples(400), deadline=None)
@given(
    st.tuples(WORDS, EXTENTS, GAPS, st.sampled_from(("x", "MAX", "x1é", "_x")), ENDS)
    .map("".join)
    .map(str.rstrip)
)
def test_any_line_that_is_nearly_plain(line: str) -> None:
    agree(line)


@pytest.mark.builds
def test_the_grammar_is_not_loaded_for_plain_files() -> None:
    script = (
        "import sys\n"
        "from microros_gen.diagnostics import Diagnostics, Source\n"
        "from microros_gen.interfaces.msg.parser import parse_msg\n"
        "from microros_gen.interfaces.types import TypeName\n"
        "found = Diagnostics()\n"
        "assert parse_msg(Source('A.msg', sys.argv[1]), TypeName('a', 'msg', 'A'), found) is not None\n"
        "print('lark' in sys.modules)\n"
    )
    for text, loaded in (("int8 X=1\nstring name\n", "False"), ("int8[] x [5]\n", "True")):
        done = subprocess.run(
            [sys.executable, "-c", script, text], capture_output=True, text=True, check=True
        )
        assert done.stdout.strip() == loaded
