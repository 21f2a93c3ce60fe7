# SPDX-License-Identifier: Apache-2.0
"""Checks budgets and prints what cannot be checked, for `build` and for a user's own builds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from microros_gen import compiler
from microros_gen.cli.generate import warnings_text
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.image.folder import Folder


def check_planned(planned: compiler.Planned, read: Callable[[], Folder]) -> None:
    """Check the budgets of a plan against the folder that `read` returns. Raises UserError with status 1."""
    with _reported() as warnings:
        compiler.check_plan(planned, read, warnings)


def check_recorded(folder: Folder) -> None:
    """Check the budgets of what a user's own build made; the plan is made again where it says from what."""
    from microros_gen.cli.generate import command as generate

    arguments = folder.library.arguments if folder.library is not None else ()
    if arguments:
        parameters = generate.make_context("generate", list(arguments)).params
        options = {key: value for key, value in parameters.items() if key not in ("output", "depfile")}
        try:
            planned = compiler.plan(compiler.resolve(compiler.read(compiler.Options(**options))))
        except UserError:
            pass  # of interfaces that are gone since: the manifest has the budgets
        else:
            check_planned(planned, lambda: folder)
            return
    with _reported() as warnings:
        compiler.check_manifest(folder, warnings)


@contextmanager
def _reported() -> Iterator[Diagnostics]:
    """Print the warnings, whatever else happens."""
    warnings = Diagnostics()
    try:
        yield warnings
    finally:
        echo_found(warnings_text(warnings))
