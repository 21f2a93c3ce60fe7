# SPDX-License-Identifier: Apache-2.0
"""Diagnostics as data, for programs that read the result of a check."""

from __future__ import annotations

from typing import Any

from microros_gen.diagnostics.diagnostic import Diagnostic


def diagnostic_data(diagnostic: Diagnostic) -> dict[str, Any]:
    """Return a diagnostic as data for JSON. Without a place, the file is empty and line and column are 0."""
    span = diagnostic.span
    return {
        "id": diagnostic.id,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "hint": diagnostic.hint or "",
        "file": span.source.name if span else "",
        "line": span.line if span else 0,
        "column": span.column if span else 0,
    }
