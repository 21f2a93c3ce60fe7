# SPDX-License-Identifier: Apache-2.0
"""Functions, classes and tests have names in standard English: no word of names.yaml."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from tests.support.paths import ROOT

REFUSED: dict[str, str] = {
    entry["word"]: entry["write"]
    for entry in yaml.safe_load(Path(__file__).with_name("names.yaml").read_text(encoding="utf-8"))
}
_DEFINED = re.compile(r"^[ \t]*(?:async[ \t]+)?(?:def|class)[ \t]+(\w+)", re.M)
_WORDS = re.compile(rf"(?<![a-z])(?:{'|'.join(REFUSED)})(?![a-z])")


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
