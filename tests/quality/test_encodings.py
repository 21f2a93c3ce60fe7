# SPDX-License-Identifier: Apache-2.0
"""Every place that opens a text says its encoding, and every one that writes a text its line ends.

Without them Python takes those of the system, which on Windows are neither UTF-8 nor \\n.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import microros_gen
from tests.support.paths import ROOT

PACKAGE = Path(microros_gen.__file__).parent
FILES = sorted(
    [*PACKAGE.rglob("*.py"), *(ROOT / "docs").rglob("*.py"), *(ROOT / "tests/tools").rglob("*.py")]
)
_OF_FILES = ("write_text", "read_text", "open")


def _text_mode(call: ast.Call) -> str | None:
    """Return the mode of a call that opens a text; None: it opens none."""
    function = call.func
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    if name not in _OF_FILES:
        return None
    if name == "write_text":
        return "w"
    owner = ast.unparse(function.value) if isinstance(function, ast.Attribute) else ""
    if name == "read_text":
        return "r" if owner else None  # documents.files.read_text is UTF-8
    if owner in ("os", "Lark", "tarfile", "zipfile", "webbrowser"):
        return None
    arguments = [*call.args, *(k.value for k in call.keywords if k.arg == "mode")]
    values = [str(node.value) for node in arguments if isinstance(node, ast.Constant)]
    modes = [value for value in values if set(value) <= set("rwxabt+")]
    if not modes and not owner:
        return "r"
    return None if any("b" in m for m in modes) or not (modes or call.keywords) else (modes or ["r"])[0]


def faults(text: str) -> Iterator[tuple[int, str]]:
    """Yield the line of each call in `text` that leaves something to the system, and what."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.Call) or (mode := _text_mode(node)) is None:
            continue
        stated = {keyword.arg for keyword in node.keywords}
        if "encoding" not in stated:
            yield node.lineno, "encoding"
        if set(mode) & set("wxa+") and "newline" not in stated:
            yield node.lineno, "newline"


def test_the_check_finds_what_it_looks_for() -> None:
    bad = {
        "p.read_text()": ["encoding"],
        "p.write_text(x)": ["encoding", "newline"],
        "p.write_text(x, encoding='utf-8')": ["newline"],
        "open(p)": ["encoding"],
        "p.open('w', encoding='utf-8')": ["newline"],
        "open(p, 'a', newline='')": ["encoding"],
    }
    for text, expected in bad.items():
        assert [what for _, what in faults(text)] == expected, text
    good = ["read_text(p)", "p.read_text(encoding='utf-8')", "open(p, 'rb')", "p.open('ab', buffering=0)"]
    good += ["os.open(p, os.O_RDWR)", "self.open()", "p.write_text(x, encoding='u', newline='\\n')"]
    for text in good:
        assert list(faults(text)) == [], text


@pytest.mark.parametrize("folder", sorted({path.parent for path in FILES}), ids=lambda p: str(p.name))
def test_encodings_and_line_ends_are_stated(folder: Path) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {what}"
        for path in FILES
        if path.parent == folder
        for line, what in faults(path.read_text(encoding="utf-8"))
    ]
    assert found == []
