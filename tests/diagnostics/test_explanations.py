# SPDX-License-Identifier: Apache-2.0
"""Every diagnostic has an explanation that adds to its message and hint."""

from __future__ import annotations

import json
import re

import pytest

from docs.generators.diagnostics import Documented, page
from docs.generators.diagnostics import diagnostics as documented
from microros_gen.diagnostics.explanations import explanations
from tests.support.command_line import Runner

TEXTS = explanations()


@pytest.fixture(scope="module")
def reported_ones() -> tuple[Documented, ...]:
    return documented()


def test_every_diagnostic_is_explained(reported_ones: tuple[Documented, ...]) -> None:
    assert set(TEXTS) == {reported.id for reported in reported_ones}


def test_the_texts_are_short_sentences() -> None:
    wrong = [
        identity
        for identity, text in TEXTS.items()
        if not 40 <= len(text) <= 400
        or not re.fullmatch(r"\S.*[.]", text)
        or not 1 <= len(_sentences(text)) <= 3
    ]
    assert wrong == []


def _sentences(text: str) -> list[str]:
    return [part for part in re.split(r"(?<=[.:;])\s+(?=[A-Z`])", text) if part]


def _words(text: str) -> set[str]:
    return set(re.findall(r"[a-z]{3,}", re.sub(r"\{[^}]*\}", "", text).lower()))


def test_none_repeats_its_message(reported_ones: tuple[Documented, ...]) -> None:
    """At most seven of ten words of an explanation are in the message and hint."""
    repeated = [
        reported.id
        for reported in reported_ones
        if len(_words(TEXTS[reported.id]) & _words(f"{reported.message} {reported.hint}"))
        > 0.7 * len(_words(TEXTS[reported.id]))
        or (len(reported.message) > 20 and reported.message in TEXTS[reported.id])
    ]
    assert repeated == []


def test_each_is_said_once() -> None:
    """One text for several diagnostics would not say when which of them occurs."""
    assert len(set(TEXTS.values())) == len(TEXTS)


def test_the_page_has_all_of_them() -> None:
    text = page()
    assert [identity for identity in TEXTS if f'<span id="{identity.lower()}">' not in text] == []
    assert "Strings or sequences without a bound need a limit" in text


@pytest.mark.parametrize("argument", ["MG-5013", "mg-5013", "[MG-5013]"])
def test_explain_prints_it(run: Runner, argument: str) -> None:
    result = run("explain", argument)
    assert (result.status, result.out) == (0, f"MG-5013: {TEXTS['MG-5013']}\n")


def test_explain_prints_it_as_json(run: Runner) -> None:
    assert json.loads(run("explain", "MG-5013", "--format", "json").out) == {
        "version": 1,
        "kind": "diagnostic",
        "name": "MG-5013",
        "explanation": TEXTS["MG-5013"],
    }


def test_explain_refuses_an_unknown_id(run: Runner) -> None:
    result = run("explain", "MG-5999")
    assert (result.status, result.out) == (2, "")
    assert "unknown diagnostic id 'MG-5999'. It ends the first line of an error" in result.err


def test_explain_of_a_folder_needs_a_name(run: Runner) -> None:
    result = run("explain", "build")
    assert result.status == 2
    assert "Missing argument 'SYMBOL|FILE|COMPONENT'" in result.err
