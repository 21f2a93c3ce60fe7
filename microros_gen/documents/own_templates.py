# SPDX-License-Identifier: Apache-2.0
"""Renders templates of components: what is wrong in one of the user's is a diagnostic with its place."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

from jinja2 import Environment, Template, TemplateError, TemplateSyntaxError
from jinja2.runtime import Macro

from microros_gen.diagnostics import Diagnostic, Source, Span, UserError, nearest
from microros_gen.documents.files import read_text, reason_of

_NAME = "<template>"
"""How Jinja names a template that is a text, in tracebacks."""
_Made = TypeVar("_Made")


def render_own(path: Path, environment: Environment, context: Mapping[str, object]) -> str:
    """Return the text that the template at `path` makes of `context`. Raises UserError with the line that is wrong."""
    return _made_of_own(path, environment, lambda template: template.render(context))


def render_macros(
    path: Path, name: str, environment: Environment, context: Mapping[str, object], known: tuple[str, ...]
) -> dict[str, str]:
    """Return the text of each macro of a template, all without arguments, by the macro's name.

    `name` is that of a template that ships with the tool, empty for one of the user's. Raises UserError with the
    line of the user's that is wrong, and for a macro that is none of those that are `known`.
    """

    def texts(template: Template) -> dict[str, str]:
        module = template.make_module(dict(context)).__dict__
        try:
            return {word: str(macro()) for word, macro in module.items() if isinstance(macro, Macro)}
        except (TemplateError, TypeError, ValueError, AttributeError, ArithmeticError):
            environment.handle_exception()  # raises it again, with the template's lines in the traceback

    found = texts(environment.get_template(name)) if name else _made_of_own(path, environment, texts)
    for word in sorted(found.keys() - set(known)):
        hint = nearest(word, known) or f"Name it {', '.join(known)}"
        raise UserError([Diagnostic(f"unknown macro '{word}' in {path}", hint=hint, id="MG-1022")])
    return found


def _made_of_own(path: Path, environment: Environment, make: Callable[[Template], _Made]) -> _Made:
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        raise UserError([Diagnostic(f"cannot read '{path}': {reason_of(error)}", id="MG-1060")]) from error
    try:
        return make(environment.from_string(source.text))
    except (TemplateError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        line = error.lineno if isinstance(error, TemplateSyntaxError) else _line(error)
        what = f"the template cannot be rendered: {error}"
        hint = "The views are `plan`, `selection`, `target`, `board`, `functions` and `headers`"
        raise UserError([Diagnostic(what, Span(source, line, 1), hint, id="MG-1061")]) from error


def _line(error: Exception) -> int:
    """Return the last line of the template on the way to an error."""
    frames = traceback.extract_tb(error.__traceback__)
    return next((f.lineno or 1 for f in reversed(frames) if f.filename == _NAME), 1)
