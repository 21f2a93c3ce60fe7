# SPDX-License-Identifier: Apache-2.0
"""Renders a template of the user's: what is wrong in it is a diagnostic with its place."""

from __future__ import annotations

import traceback
from collections.abc import Mapping
from pathlib import Path

from jinja2 import Environment, TemplateError, TemplateSyntaxError

from microros_gen.diagnostics import Diagnostic, Source, Span, UserError
from microros_gen.documents.files import read_text

_NAME = "<template>"
"""How Jinja names a template that is a text, in tracebacks."""


def render_own(path: Path, environment: Environment, context: Mapping[str, object]) -> str:
    """Return the text that the template at `path` makes of `context`. Raises UserError with the line that is wrong."""
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise UserError([Diagnostic(f"cannot read '{path}': {reason}", id="MG-1060")]) from error
    try:
        return environment.from_string(source.text).render(context)
    except (TemplateError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        line = error.lineno if isinstance(error, TemplateSyntaxError) else _line(error)
        what = f"the template cannot be rendered: {error}"
        hint = "The views are `plan`, `selection`, `target`, `board`, `functions` and `headers`"
        raise UserError([Diagnostic(what, Span(source, line, 1), hint, id="MG-1061")]) from error


def _line(error: Exception) -> int:
    """Return the last line of the template on the way to an error."""
    frames = traceback.extract_tb(error.__traceback__)
    return next((f.lineno or 1 for f in reversed(frames) if f.filename == _NAME), 1)
