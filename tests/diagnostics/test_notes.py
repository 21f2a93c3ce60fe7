# SPDX-License-Identifier: Apache-2.0
"""Warnings in the manifest: they are the same when they are read again, but for the folder of their file."""

from __future__ import annotations

import json

import pytest

from microros_gen.diagnostics import Diagnostic, Severity, Source, Span
from microros_gen.diagnostics.notes import note_data, note_of, notes_of

TEXT = "version: 1\n\ttasks: [{name: a, lock: auto}]\n"


def warning(name: str) -> Diagnostic:
    span = Span(Source(name, TEXT), 2, 28, 32)
    return Diagnostic("it has no bound", span, "Write `lock: 40 us`", Severity.WARNING, id="MG-9874")


@pytest.mark.parametrize("name", ["microros.yaml", "/home/somebody/robot/microros.yaml"])
def test_one_that_is_read_again_shows_the_same_line(name: str) -> None:
    text = json.dumps(note_data(warning(name)))
    assert "somebody" not in text
    assert note_of(json.loads(text)).render() == warning("microros.yaml").render()


def test_one_without_a_place_has_none_afterwards() -> None:
    placeless = Diagnostic("it has no bound", None, "Write it", Severity.WARNING, id="MG-9874")
    assert note_of(note_data(placeless)) == placeless


def test_what_is_no_note_is_refused() -> None:
    assert notes_of({}) == []
    wrong: list[dict[str, object]] = [{}, {"place": {}}, {"place": 7}]
    for data in wrong:
        with pytest.raises((KeyError, TypeError)):
            note_of(data)
