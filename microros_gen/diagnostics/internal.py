# SPDX-License-Identifier: Apache-2.0
"""What is a mistake of this tool: a diagnostic like any other, with the text that was being read."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar

from microros_gen.diagnostics.diagnostic import Diagnostic, UserError
from microros_gen.diagnostics.source import Source, Span

TRACEBACK = "MICROROS_GEN_TRACEBACK"
"""The environment variable that asks for the traceback of an internal error."""

_Rest = ParamSpec("_Rest")
_Result = TypeVar("_Result")


def reads(
    function: Callable[Concatenate[Source, _Rest], _Result],
) -> Callable[Concatenate[Source, _Rest], _Result]:
    """Make what a function that reads a text raises by mistake a UserError that names the text."""

    @wraps(function)
    def guarded(source: Source, /, *rest: _Rest.args, **named: _Rest.kwargs) -> _Result:
        try:
            return function(source, *rest, **named)
        except UserError:
            raise
        except RecursionError as error:
            span = Span(source, 1, 1)
            raise UserError([Diagnostic("nested too deeply", span, "Flatten it", id="MG-0001")]) from error
        except Exception as error:
            raise UserError([internal_error(error, Span(source, 1, 1))]) from error

    return guarded


def internal_error(error: BaseException, span: Span | None = None) -> Diagnostic:
    """Return what a user is told about an exception that nobody expected."""
    what = f"internal error: {type(error).__name__}: {str(error)[:200]}".rstrip(": ")
    return Diagnostic(what, span, f"Please report it with what `{TRACEBACK}=1` adds", id="MG-0002")
