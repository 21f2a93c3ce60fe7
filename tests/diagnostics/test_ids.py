# SPDX-License-Identifier: Apache-2.0
"""Ids of diagnostics: every error and warning has one, and it keeps it from version to version."""

from __future__ import annotations

import ast
import re
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import microros_gen
from docs.generators.diagnostics import diagnostics as documented
from microros_gen.diagnostics import Diagnostic, Diagnostics

PACKAGE = Path(microros_gen.__file__).parent
RECORDED = Path(__file__).with_name("ids.txt")
"""Every id that was ever given, one a line; those no longer used are marked `retired`."""
PASSED_ON = {
    "MG-0002": "an unexpected exception of Python",
    "MG-5013": "a list of members without a limit",
    "MG-8203": "the output of a compiler",
    "MG-8411": "a path and one of two sentences",
    "MG-8415": "a budget with its numbers",
    "MG-9099": "a remark of init, as in the file that it writes",
    "MG-9416": "an exception of the check of DDS names",
    "MG-9421": "an error of the XML parser",
    "MG-9423": "an error of an XML element",
    "MG-9810": "a reason of ROS 2, or of a node",
    "MG-9707": "a message about an agent file, for --limit",
}.keys()
"""Ids whose text comes from elsewhere as a whole, with its source; no further ones."""
_CLASSES = {
    "Diagnostic",
    "IdlError",
    "InvalidValueError",
    "_DeclarationError",
    "NameFault",
    "Fault",
    "Caveat",
}
"""Classes of diagnostics, and of faults that become one at their place."""
_METHODS = {"error", "warning", "too_large"}
_MAYBE_CALL = re.compile(rf"\b(?:{'|'.join((*_CLASSES, *_METHODS, '_error'))})\s*\(")


@cache
def calls() -> list[tuple[str, ast.Call]]:
    """Return every call that makes a diagnostic, with its place; the modules are read once."""
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        if path.name == "diagnostic.py":
            continue
        text = path.read_text(encoding="utf-8")
        if _MAYBE_CALL.search(text) is None:
            continue  # parsing takes most of the time
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and _makes_diagnostic(node):
                found.append((f"{path.relative_to(PACKAGE)}:{node.lineno}", node))
    return found


def _makes_diagnostic(node: ast.Call) -> bool:
    function = node.func
    if isinstance(function, ast.Name):
        return function.id in _CLASSES
    if not isinstance(function, ast.Attribute):
        return False
    if function.attr == "_error" and ast.unparse(function) == "self._error" and len(node.args) == 3:
        return True
    return (
        function.attr in _METHODS
        and re.search(r"diagnostics|found|warnings", ast.unparse(function.value)) is not None
        and bool(node.args)
    )


def identity(node: ast.Call) -> str:
    """Return the id of a call; empty: it has none, or none that is written there."""
    value = next((k.value for k in node.keywords if k.arg == "id"), None)
    if isinstance(value, ast.Constant):
        return str(value.value)
    return "handed on" if value is not None else ""


def test_every_diagnostic_has_an_id() -> None:
    assert [place for place, node in calls() if not re.fullmatch(r"MG-\d{4}|handed on", identity(node))] == []


def test_an_id_is_given_at_one_place() -> None:
    counted = Counter(identity(node) for _, node in calls())
    assert [name for name, count in counted.items() if count > 1 and name != "handed on"] == []


def test_an_id_is_never_used_again_for_something_else() -> None:
    """A diagnostic that goes leaves its id in the list as `retired`."""
    lines = [line.split() for line in RECORDED.read_text(encoding="utf-8").splitlines()]
    used = {identity(node) for _, node in calls()} - {"handed on"}
    assert used == {words[0] for words in lines if len(words) == 1}
    assert len({words[0] for words in lines}) == len(lines)


def test_every_id_has_a_text() -> None:
    """One id is one message: an entry of the page that is a placeholder alone would explain nothing."""
    empty = {
        reported.id
        for reported in documented()
        if not re.search(r"[a-z]{2}", re.sub(r"\{[^}]*\}", "", reported.message))
    }
    assert empty == PASSED_ON


@pytest.mark.parametrize("hint", [None, "Do it"])
def test_the_id_ends_the_first_line(hint: str | None) -> None:
    diagnostics = Diagnostics()
    diagnostics.error("it is wrong", None, hint, id="MG-0002")
    (found,) = diagnostics
    assert found.headline().endswith(" [MG-0002]")
    assert Diagnostic("it is wrong", hint=hint, id="MG-0002") == found
