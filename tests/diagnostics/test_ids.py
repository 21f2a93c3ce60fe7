# SPDX-License-Identifier: Apache-2.0
"""Ids of diagnostics: every error and warning has one, and it keeps it from version to version."""

from __future__ import annotations

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

import microros_gen
from microros_gen.diagnostics import Diagnostic, Diagnostics

PACKAGE = Path(microros_gen.__file__).parent
RECORDED = Path(__file__).with_name("ids.txt")
"""Every id that was ever given, one a line; those no longer used are marked `retired`."""
_METHODS = {"error", "warning", "too_large"}


def calls() -> list[tuple[str, ast.Call]]:
    """Return every call that makes a diagnostic, with its place."""
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        if path.name == "diagnostic.py":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and _makes_diagnostic(node):
                found.append((f"{path.relative_to(PACKAGE)}:{node.lineno}", node))
    return found


def _makes_diagnostic(node: ast.Call) -> bool:
    function = node.func
    if isinstance(function, ast.Name):
        return function.id == "Diagnostic"
    return (
        isinstance(function, ast.Attribute)
        and function.attr in _METHODS
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


@pytest.mark.parametrize("hint", [None, "Do it"])
def test_the_id_ends_the_first_line(hint: str | None) -> None:
    diagnostics = Diagnostics()
    diagnostics.error("it is wrong", None, hint, id="MG-0002")
    (found,) = diagnostics
    assert found.headline().endswith(" [MG-0002]")
    assert Diagnostic("it is wrong", hint=hint, id="MG-0002") == found
