# SPDX-License-Identifier: Apache-2.0
"""Pages, comments, docstrings and messages are in standard English: no phrase of wording.yaml, American spelling."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.support.examples import examples
from tests.support.paths import ROOT
from tests.support.quality.wording import (
    TYPE_SUPPORT,
    files,
    phrases,
    prose,
    quick_patterns,
    refused,
    refused_in,
)

FOLDERS = sorted({name.rsplit("/", 1)[0] if "/" in name else "" for name in files()})


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_file_of_a_folder_has_a_phrase_of_the_list(folder: str) -> None:
    found = []
    for name, path in files().items():
        if (name.rsplit("/", 1)[0] if "/" in name else "") == folder:
            found += [f"{name}:{hit}" for hit in refused_in(path)]
    assert found == []


@pytest.mark.builds
def test_spelling_is_american() -> None:
    run = subprocess.run(
        [
            sys.executable,
            "-m",
            "codespell_lib",
            "--builtin",
            "clear,en-GB_to_en-US",
            "-I",
            "tests/quality/spelling.txt",
            *(name for name in files() if not name.startswith(TYPE_SUPPORT)),
        ],
        cwd=ROOT,
        text=True,
        capture_output=True,
        check=False,
    )
    assert run.stdout + run.stderr == ""
    assert run.returncode == 0


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


@settings(max_examples=examples(300), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.data())
def test_the_quick_patterns_find_every_match(data: st.DataObject) -> None:
    number = data.draw(st.integers(0, len(phrases()) - 1))
    pattern, (word, quick) = phrases()[number][0], quick_patterns()[number]
    match = data.draw(st.from_regex(re.compile(pattern.pattern, re.ASCII), fullmatch=True))
    assert word in match
    assert quick.search(match)


def test_most_phrases_have_a_word_that_all_matches_share() -> None:
    assert sum(not word for word, _ in quick_patterns()) < len(phrases()) / 4


def test_code_of_a_page_is_not_prose(tmp_path: Path) -> None:
    assert not refused(prose(tmp_path / "a.md", "`painted`\n\n```c\nint painted;\n```\n"))


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.py", 'x = 1\n"""A file\nof its own."""\nthe_house = 2\n', 3),
        ("a.py", "painted = 1  # a painted stack\n", 1),
        ("a.py", 'painted = f"stands twice: {painted}"\n', 1),
        ("a.c", "int painted;\n/* Has a file of\n * its own. */\n", 2),
        ("a.h.j2", "{# A file of its own. #}\nint painted;\n", 1),
        ("microros_gen/templates/types/a.c.j2", "{# A file of its own. #}\n/* initialised */", 1),
        ("a.yaml", "# The key stands twice\nkey: 1\n", 1),
    ],
)
def test_the_list_reads_comments_and_strings_of_code(tmp_path: Path, name: str, text: str, line: int) -> None:
    found = refused(prose(tmp_path / name, text))
    assert {hit.split(":")[0] for hit in found} == {str(line)}


def test_each_term_is_explained_once_and_in_order() -> None:
    text = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
    terms = [row[0].lower() for row in re.findall(r"(?m)^\| ([^|]+) \| ([^|]+) \|$", text)][1:]
    assert len(terms) > 40
    assert terms == sorted(set(terms), key=lambda term: re.sub(r"[^a-z ]", "", term))


def test_every_item_of_a_list_is_on_its_own_line() -> None:
    """A hyphen that a reflow moved into a paragraph is printed as a hyphen, and the item is lost."""
    code = re.compile(r"^ *```.*?^ *```$|`[^`\n]*`", re.M | re.S)
    item = re.compile(r"[.:;)] - [\w*]")
    lost = [
        f"{name}: {found.group()}"
        for name, path in files().items()
        if name.endswith(".md")
        for found in item.finditer(code.sub("code", path.read_text(encoding="utf-8")))
    ]
    assert lost == []
