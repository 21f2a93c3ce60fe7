# SPDX-License-Identifier: Apache-2.0
"""The pages are written in standard English: no phrase of wording.yaml, and the glossary has each term once."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from tests.support.paths import ROOT

PHRASES = yaml.safe_load(Path(__file__).with_name("wording.yaml").read_text(encoding="utf-8"))
PAGES = {
    str(path.relative_to(ROOT)): path
    for path in (ROOT / "README.md", ROOT / "examples/README.md", *sorted((ROOT / "docs").rglob("*.md")))
}
_CODE = re.compile(r"^( *)```.*?^\1```|`[^`\n]+`|\]\([^)]*\)|<!-- misra: begin.*?misra: end -->", re.M | re.S)


def prose(text: str) -> str:
    """Return a page with its code and links blanked out, lines kept."""
    return _CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def refused(text: str) -> list[str]:
    """Return each phrase that `text` should not have, with its line and what to write instead."""
    found = []
    for entry in PHRASES:
        for match in re.finditer(entry["phrase"].replace(" ", r"\s+"), text, re.IGNORECASE):
            line = text.count("\n", 0, match.start()) + 1
            found.append(f"{line}: {' '.join(match[0].split())!r}: write {entry['write']}")
    return found


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_no_phrase_of_the_list(name: str) -> None:
    assert refused(prose(PAGES[name].read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    "text",
    [
        "The house, and where to add things",
        "the key stands twice",
        "stack, painted",
        "given\nup by the agent",
    ],
)
def test_the_list_finds_a_phrase_across_lines(text: str) -> None:
    assert refused(text)


def test_code_is_no_prose() -> None:
    assert not refused(prose("`painted`\n\n```c\nint painted;\n```\n"))


def test_each_term_is_explained_once_and_in_order() -> None:
    text = PAGES["docs/glossary.md"].read_text(encoding="utf-8")
    terms = [row[0].lower() for row in re.findall(r"(?m)^\| ([^|]+) \| ([^|]+) \|$", text)][1:]
    assert len(terms) > 40
    assert terms == sorted(set(terms), key=lambda term: re.sub(r"[^a-z ]", "", term))
