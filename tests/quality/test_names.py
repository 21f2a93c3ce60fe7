# SPDX-License-Identifier: Apache-2.0
"""Functions, classes, tests and identifiers of C have names in standard English: no word of names.yaml."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from tests.support.paths import ROOT

_ENTRIES = yaml.safe_load(Path(__file__).with_name("names.yaml").read_text(encoding="utf-8"))
REFUSED: dict[str, str] = {entry["word"]: entry["write"] for entry in _ENTRIES if "in" not in entry}
REFUSED_IN_C: dict[str, str] = {
    entry["word"]: entry["write"] for entry in _ENTRIES if entry.get("in", "c") == "c"
}
REFUSED_VARIABLES: dict[str, str] = {
    entry["word"]: entry["write"] for entry in _ENTRIES if entry.get("in") == "variables"
}
REFUSED_NAMES: dict[str, str] = {
    entry["word"]: entry["write"] for entry in _ENTRIES if entry.get("in") == "names"
}
C_NAMES_THAT_STAY = {
    "given_up": "a member of rmw_uros_client_statistics_t, which applications read",
    "microros_memory_give_back": "called by generated type support, which stays byte for byte",
}
_DEFINED = re.compile(r"^[ \t]*(?:async[ \t]+)?(?:def|class)[ \t]+(\w+)", re.M)
_C_FILE = re.compile(r"\.[chS](\.j2)?$")
_NOT_CODE = re.compile(r"/\*.*?\*/|//[^\n]*|\{[#%].*?[#%]\}|\"(?:\\.|[^\"\\\n])*\"", re.S)


def _pattern(words: dict[str, str]) -> re.Pattern[str]:
    return re.compile(rf"(?<![a-z])(?:{'|'.join(words)})(?![a-z])")


_WORDS = _pattern(REFUSED)
_C_WORDS = _pattern(REFUSED_IN_C)
_VARIABLE_WORDS = _pattern(REFUSED_VARIABLES)
_MAYBE_ASSIGNED = re.compile(rf"\b_*(?:{'|'.join(REFUSED_NAMES)})\s*(?:in\b|[^\s\w.\"'])")
"""A whole name before what can follow where it is assigned: `=`, `:`, a comma, a bracket, `in`, `\\`, a comment."""


def refused(text: str) -> Iterator[str]:
    """Yield each name that a Python file defines and that has a refused word, with what to write instead."""
    for name in _DEFINED.findall(text):
        found = _WORDS.search(re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", name).lower())
        if found:
            yield f"{name}: write {REFUSED[found[0]]} for {found[0]}"


@pytest.mark.parametrize("folder", ["microros_gen", "tests", "docs", "cmake"])
def test_no_name_has_a_refused_word(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}: {hit}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        for hit in refused(path.read_text(encoding="utf-8"))
    ]
    assert found == []


def variables(text: str) -> Iterator[str]:
    """Yield the name of each variable, parameter and attribute that a Python file assigns."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.arg):
            yield node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr


def refused_variables(text: str) -> Iterator[str]:
    """Yield each variable of a Python file that has a refused word, with what to write instead."""
    if _VARIABLE_WORDS.search(text.lower()) is None:
        return
    for name in sorted(set(variables(text))):
        found = _VARIABLE_WORDS.search(name.lower())
        if found:
            yield f"{name}: write {REFUSED_VARIABLES[found[0]]} for {found[0]}"


@pytest.mark.parametrize("folder", ["microros_gen", "tests", "docs", "cmake"])
def test_no_variable_has_a_refused_word(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}: {hit}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        for hit in refused_variables(path.read_text(encoding="utf-8"))
    ]
    assert found == []


def refused_whole(text: str) -> Iterator[str]:
    """Yield each variable of a Python file whose whole name is a refused word, with what to write."""
    if _MAYBE_ASSIGNED.search(text) is None:
        return
    for name in sorted({name.lstrip("_") for name in variables(text)} & REFUSED_NAMES.keys()):
        yield f"{name}: write {REFUSED_NAMES[name]}"


@pytest.mark.parametrize("folder", ["microros_gen", "tests", "docs", "cmake"])
def test_no_variable_is_a_refused_word(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}: {hit}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        for hit in refused_whole(path.read_text(encoding="utf-8"))
    ]
    assert found == []


@pytest.mark.parametrize(
    "text", ["[one for one in x]", "def f(made): ...", "self._asked = 1", "there: int = 0"]
)
def test_a_variable_that_is_a_refused_word_is_found(text: str) -> None:
    assert len(list(refused_whole(text))) == 1


def test_a_part_of_a_variable_is_no_whole_word() -> None:
    assert list(refused_whole("one_of = made_from = 1\nx.one(y.made)")) == []


@pytest.mark.parametrize("text", ["said = 1", "def f(piece): ...", "self._pieces = []", "f = lambda told: 0"])
def test_a_refused_variable_is_found(text: str) -> None:
    assert len(list(refused_variables(text))) == 1


def test_words_in_texts_are_no_variables() -> None:
    assert list(refused_variables('x = "said"  # told\ny = x.pieces')) == []


def refused_in_c(text: str) -> Iterator[str]:
    """Yield each identifier of a C file or template that has a refused word, with what to write instead."""
    for name in sorted(set(re.findall(r"[A-Za-z_]\w*", _NOT_CODE.sub(" ", text))) - set(C_NAMES_THAT_STAY)):
        found = _C_WORDS.search(name.lower())
        if found:
            yield f"{name}: write {REFUSED_IN_C[found[0]]} for {found[0]}"


@pytest.mark.parametrize("folder", ["components", "platform", "templates"])
def test_no_identifier_of_c_has_a_refused_word(folder: str) -> None:
    paths = [p for p in sorted((ROOT / "microros_gen" / folder).rglob("*")) if _C_FILE.search(p.name)]
    found = [f"{p.relative_to(ROOT)}: {hit}" for p in paths for hit in refused_in_c(p.read_text("utf-8"))]
    assert paths
    assert found == []


@pytest.mark.parametrize("name", C_NAMES_THAT_STAY)
def test_a_c_name_that_stays_exists(name: str) -> None:
    paths = [p for p in (ROOT / "microros_gen").rglob("*") if _C_FILE.search(p.name)]
    assert any(re.search(rf"\b{name}\b", p.read_text("utf-8")) for p in paths)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("static bool told;", "told"),
        ("void stream_send_piece(int PIECES_MAX);", "PIECES_MAX"),
        ('{% if x %}bool is_gone; /* gone */{% endif %} f("told");', "is_gone"),
    ],
)
def test_a_refused_word_in_c_is_found(text: str, name: str) -> None:
    assert next(refused_in_c(text)).startswith(f"{name}: write ")


@pytest.mark.parametrize(
    "text", ["/* told */ int a;", 'f("told");', "{# told #}int came_from_x1;", "// told\n"]
)
def test_comments_and_texts_of_c_are_no_identifiers(text: str) -> None:
    assert [hit for hit in refused_in_c(text) if "told" in hit] == []


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("def test_a_fault_is_told() -> None: ...", "test_a_fault_is_told"),
        ("    async def _given_up(self): ...", "_given_up"),
        ("class LobbyMember:", "LobbyMember"),
    ],
)
def test_a_refused_word_is_found(text: str, name: str) -> None:
    (found,) = refused(text)
    assert found.startswith(f"{name}: write ")


@pytest.mark.parametrize("text", ["def outcome(): ...", "class Become: ...", "x = told"])
def test_a_part_of_a_word_is_not_one(text: str) -> None:
    assert list(refused(text)) == []
