# SPDX-License-Identifier: Apache-2.0
"""Warnings that are kept in the manifest: commands that read it say them again, with their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any

from microros_gen.diagnostics.diagnostic import Diagnostic, Severity
from microros_gen.diagnostics.source import Source, Span

KEY = "notes"
"""Their key in the manifest and in what `schedule --format json` prints."""


def note_data(note: Diagnostic) -> dict[str, object]:
    """Return a warning as data. The file is named without its folder: no path goes into the manifest."""
    place = _place(note.span) if note.span is not None else None
    return {"id": note.id, "message": note.message, "hint": note.hint, "place": place}


def _place(span: Span) -> dict[str, object]:
    return {
        "file": PurePath(span.source.name).name,
        "line": span.line,
        "column": span.column,
        "end_column": span.end_column,
        "text": span.source.line(span.line),
    }


def note_of(data: Mapping[str, Any]) -> Diagnostic:
    """Return the warning whose note_data is `data`. KeyError or TypeError: it is that of none."""
    place = data["place"]
    span = None
    if place is not None:
        source = Source(place["file"], "\n" * (place["line"] - 1) + place["text"])
        span = Span(source, place["line"], place["column"], place["end_column"])
    return Diagnostic(data["message"], span, data["hint"], Severity.WARNING, id=data["id"])


def notes_of(values: Mapping[str, Any]) -> Sequence[Diagnostic]:
    """Return the warnings that are among what a component says in a manifest. KeyError or TypeError as note_of."""
    return [note_of(data) for data in values.get(KEY, ())]
