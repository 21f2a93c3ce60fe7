# SPDX-License-Identifier: Apache-2.0
"""YAML with places: what scalars mean, what is refused where, and the same with and without libyaml."""

from __future__ import annotations

import math
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, parse_yaml, to_data
from tests.support.ids import without_id

LOADERS = [True, False]


def read(text: str, c_loader: bool = True) -> tuple[Any, list[str]]:
    found = Diagnostics()
    tree = parse_yaml(Source("f", text), found, c_loader)
    return (to_data(tree) if tree is not None else None), [without_id(d.headline()) for d in found]


SCALARS = {
    "true": True,
    "False": False,
    "yes": "yes",
    "no": "no",
    "on": "on",
    "off": "off",
    "y": "y",
    "null": None,
    "~": None,
    "": None,
    "12": 12,
    "-3": -3,
    "+3": 3,
    "0": 0,
    "0x1F": 31,
    "0o17": 15,
    "0b11": "0b11",
    "1_000": "1_000",
    "10:30": "10:30",
    "1.5": 1.5,
    "1e3": 1000.0,
    ".5": 0.5,
    "-.inf": -math.inf,
    "2026-01-01": "2026-01-01",
    "1.2.3": "1.2.3",
    "'12'": "12",
    '"true"': "true",
    '"\\x41"': "A",
    "a b": "a b",
    "=": "=",
}


@pytest.mark.parametrize("c_loader", LOADERS)
@pytest.mark.parametrize("text", SCALARS)
def test_scalars_follow_yaml_1_2(text: str, c_loader: bool) -> None:
    value, lines = read(f"a: {text}\n", c_loader)
    assert lines == []
    assert value == {"a": SCALARS[text]}
    assert type(value["a"]) is type(SCALARS[text])


def test_not_a_number_is_one() -> None:
    assert math.isnan(read("a: .nan")[0]["a"])


FAULTS = {
    "tab": ("a:\n\t- 1\n", "f:2:1: error: not valid YAML: a tab. YAML is indented with spaces only; replace"),
    "quote": ("a: 'x\n", "f:1:4: error: not valid YAML: a quoted text does not end. Close it with the quote"),
    "list": ("a: [1, 2\n", "f:1:4: error: not valid YAML: a list in [ ] is not closed or lacks a comma. Add"),
    "mapping": (
        "a: {b: 1\n",
        "f:1:4: error: not valid YAML: a mapping in { } is not closed or lacks a comma",
    ),
    "colon": ("a: b: c\n", "f:1:5: error: not valid YAML: a ':' where no key can be. Quote a text that has"),
    "no colon": (
        "a: 1\nb\nc: 2\n",
        "f:2:1: error: not valid YAML: a line without ':'. Write `key: value`, with",
    ),
    "list before a key": (
        "a: [1, 2\nb: 3\n",
        "f:1:4: error: not valid YAML: a list in [ ] is not closed or lacks a comma. Add",
    ),
    "comma": ("a: {\n  b: 1\n  c: 2}\n", "f:3:4: error: not valid YAML: a mapping in { } is not closed or"),
    "no space after a colon": (
        "a: 1\nb:[c]\nd: 2\n",
        "f:2:1: error: not valid YAML: a line without ':'. Write `key: value`, with",
    ),
    "no-break space": (
        "a:\n\u00a0 - b: 1\n   c: 2\n",
        "f:2:1: error: not valid YAML: a character that looks like a space and is none. Replace",
    ),
    "no-break space after one in a text": (
        "t: |\n  x\n  \u00a0y\na:\n\u00a0 - b: 1\n   c: 2\n",
        "f:5:1: error: not valid YAML: a character that looks like a space and is none. Replace",
    ),
    "byte order mark": (
        "\ufeffnodes: [a\n",
        "f:1:8: error: not valid YAML: a list in [ ] is not closed or lacks a comma. Add",
    ),
    "no-break space in a text": (
        "t: |\n  x\n  \u00a0y\nnodes: [a\n",
        "f:4:8: error: not valid YAML: a list in [ ] is not closed or lacks a comma. Add",
    ),
    "no-break space in a text of the same mapping": (
        "t: |\n  \u00a0y\n- b\n",
        "f:3:1: error: not valid YAML: a list item where a key was expected. Indent",
    ),
    "alias": (
        "a: *x\n",
        "f:1:4: error: not valid YAML: an alias (*) to a name that no anchor (&) gives. Quote",
    ),
    "itself": (
        "&a [*a]\n",
        "f:1:1: error: this anchor contains an alias to itself. Write the inner value out",
    ),
    "tag": ("a: !foo 1\n", "f:1:4: error: tags (!foo) are not supported. Remove it"),
    "tag of a key": ("!k a: 1\n", "f:1:1: error: tags (!k) are not supported. Remove it"),
    "tag behind an anchor": ("a: &x !!str 1\n", "f:1:4: error: tags (!!str) are not supported. Remove it"),
    "merge": (
        "<<: {a: 1}\n",
        "f:1:1: error: merge keys (<<) are not part of YAML 1.2. Write the merged keys out",
    ),
    "twice": (
        "a: 1\nb: 2\na: 3\n",
        "f:3:1: error: duplicate key 'a'; first in line 1. Remove one of them",
    ),
    "key": ("? [a]\n: 1\n", "f:1:3: error: a key must be a word. Write `key: value`"),
    "octal": (
        "a: 010\n",
        "f:1:4: error: '010' is octal to some readers of YAML and decimal to others. Write 10",
    ),
    "documents": (
        "a: 1\n---\nb: 2\n",
        "f:2:1: error: not valid YAML: a second document begins here. Remove the",
    ),
    "indent": ("- a\nb: 1\n", "f:2:1: error: not valid YAML: the indentation does not fit the lines above"),
    "dash": (
        "a: - b\n",
        "f:1:4: error: not valid YAML: a '-' where no list can begin. Put the list on its own lines",
    ),
    "at": ("a: @x\n", "f:1:4: error: not valid YAML: a text cannot begin with this character. Put it into"),
    "escape": (
        'a: "\\q"\n',
        "f:1:6: error: not valid YAML: an unknown escape in a text. Use '…' quotes, which",
    ),
    "control": (
        "a: 1\nb: \x01\n",
        "f:2:4: error: not valid YAML: the character U+0001 is not allowed in a text.",
    ),
    "depth": ("[" * 70 + "]" * 70, "f:1:65: error: nested more than 64 levels deep. Flatten it"),
}


@pytest.mark.parametrize("c_loader", LOADERS)
@pytest.mark.parametrize("case", FAULTS)
def test_faults_are_reported_at_their_place(case: str, c_loader: bool) -> None:
    text, expected = FAULTS[case]
    _, lines = read(text, c_loader)
    assert len(lines) == 1
    assert lines[0].startswith(expected), lines[0]


@pytest.mark.parametrize(("c_loader", "depth"), [(True, 20000), (False, 4000)])
def test_very_deep_nesting_is_no_crash(c_loader: bool, depth: int) -> None:
    """The C stack takes more levels than Python, whose limit is a thousand; its time grows with their square."""
    _, lines = read("[" * depth, c_loader)
    assert len(lines) == 1


def test_aliases_of_aliases_are_bounded() -> None:
    rows = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    rows += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 9)]
    for c_loader in LOADERS:
        value, lines = read("\n".join(rows), c_loader)
        assert value is None
        assert [line.split(". ")[-1] for line in lines] == ["Use fewer aliases of aliases"]
        assert lines[0].startswith(
            "f:5:5: error: contains 111111 values with its aliases written out; at most 100000 are"
        )


def test_places_count_from_one_and_end_after_the_last_column() -> None:
    tree = parse_yaml(Source("f", "ä: 1\nb:\n  - [x, 'y z']\n"), Diagnostics())
    assert isinstance(tree, MappingNode)
    entry = tree.entries["b"]
    assert (entry.key_span.line, entry.key_span.column, entry.key_span.end_column) == (2, 1, 2)
    last = entry.value.items[0].items[1]  # type: ignore[union-attr]
    assert isinstance(last, ScalarNode)
    assert (last.span.line, last.span.column, last.span.end_column, last.plain) == (3, 9, 14, False)
    first = tree.entries["ä"].value
    assert (first.span.line, first.span.column) == (1, 4)


def test_empty_texts_are_nothing() -> None:
    for text in ("", "\n", "# comment\n", "---\n"):
        value, lines = read(text)
        assert (value, lines) == (None, [])


def test_a_byte_order_mark_is_skipped() -> None:
    for c_loader in LOADERS:
        assert read("\ufeffa: 1\n", c_loader) == ({"a": 1}, [])


def test_without_libyaml_the_loader_in_python_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(yaml, "CBaseLoader", raising=False)
    assert read("a: [1, x]\n") == ({"a": [1, "x"]}, [])


def spans(node: Any) -> Any:
    if isinstance(node, ScalarNode):
        return (node.value, node.plain, node.span.line, node.span.column)
    if isinstance(node, MappingNode):
        return [(e.key, e.key_span.line, e.key_span.column, spans(e.value)) for e in node]
    return [spans(item) for item in node.items]


SCALAR = st.one_of(
    st.booleans(), st.integers(-99, 99), st.none(), st.text("abcxyzäß_ :#-'\"", max_size=8), st.floats(-9, 9)
)
TREES = st.recursive(
    SCALAR,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text("abc", min_size=1), inner, max_size=3)
    ),
)


@given(TREES, st.booleans())
def test_both_loaders_give_the_same_tree(data: Any, flow: bool) -> None:
    text = yaml.safe_dump({"a": data}, default_flow_style=flow, allow_unicode=True)
    trees = [parse_yaml(Source("f", text), Diagnostics(), c_loader) for c_loader in LOADERS]
    assert None not in trees
    assert spans(trees[0]) == spans(trees[1])


FRAGMENTS_PER_SAMPLE = [
    "a: ",
    "- ",
    "b",
    "\n",
    "  ",
    "[",
    "]",
    "{",
    "}",
    "#",
    "|",
    ">",
    "? ",
    "'",
    '"',
    "&a ",
    "*a",
    "!x ",
    "---",
]


@given(
    st.text("ab:-[]{}&*!'\"# \n\t|>?,%@`~01", max_size=40)
    | st.lists(st.sampled_from(FRAGMENTS_PER_SAMPLE), max_size=16).map("".join)
)
def test_any_text_gives_the_same_words_and_no_crash(text: str) -> None:
    assert repr(read(text, True)) == repr(read(text, False))


@given(TREES)
def test_what_was_written_is_read(data: Any) -> None:
    text = yaml.safe_dump({"a": data}, allow_unicode=True)
    value, lines = read(text)
    if not lines:
        assert yaml.safe_dump(value, allow_unicode=True) == text
