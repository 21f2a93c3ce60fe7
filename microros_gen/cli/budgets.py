# SPDX-License-Identifier: Apache-2.0
"""Checks the budgets of an application file against what was built, for `build` and for builds of a user's."""

from __future__ import annotations

from collections.abc import Callable

import click

from microros_gen.compiler.advice import plan_advice
from microros_gen.compiler.options import SelectionOptions
from microros_gen.compiler.pipeline import Planned, plan_request, resolve_request
from microros_gen.compiler.request import read_request
from microros_gen.diagnostics import Diagnostic, Diagnostics, Span, UserError
from microros_gen.diagnostics.diagnostic import Severity
from microros_gen.image.budget import store_advice
from microros_gen.image.folder import Folder
from microros_gen.image.report import check_budgets, measure_folder


def check_planned(planned: Planned, read: Callable[[], Folder], options: SelectionOptions) -> None:
    """Check the budgets of a plan against the folder that `read` returns, which is read only if there are any.

    UserError with status 1 when one is exceeded; a warning where one cannot be checked.
    """
    memory = planned.project.application.memory
    places = {"ram_budget": memory.ram_span, "flash_budget": memory.flash_span, "stack": memory.stack_span}
    if memory.ram_budget is None and memory.flash_budget is None and memory.stack is None:
        return
    try:
        folder = read()
        report = measure_folder(folder)
    except UserError as error:
        _warn(f"budgets are not checked: {error.diagnostics[0].message}", None)
        return
    if memory.stack is not None and not report.stack.known:
        _warn(f"memory.stack is not checked: {report.stack.why}", memory.stack_span)
    if any(line.exceeded and line.key == "ram_budget" for line in report.budgets):
        store_advice(folder, plan_advice(planned, folder, options))
        report = measure_folder(folder)
    check_budgets(report.budgets, places)


def check_recorded(folder: Folder) -> None:
    """Check the budgets of what a build of a user's made; the plan is made again where it says from what."""
    from microros_gen.cli.generate import command as generate

    arguments = folder.library.arguments if folder.library is not None else ()
    if arguments:
        given = generate.make_context("generate", list(arguments)).params
        options = SelectionOptions(**{k: v for k, v in given.items() if k not in ("output", "depfile")})
        try:
            diagnostics = Diagnostics()
            resolved = resolve_request(read_request(options, diagnostics), diagnostics)
            planned = plan_request(resolved, options, diagnostics)
        except UserError:
            pass  # of interfaces that are gone since: the manifest has the budgets
        else:
            check_planned(planned, lambda: folder, options)
            return
    report = measure_folder(folder)
    if "stack" in folder.manifest["memory"] and not report.stack.known:
        _warn(f"memory.stack is not checked: {report.stack.why}", None)
    check_budgets(report.budgets, {})


def _warn(message: str, span: Span | None) -> None:
    click.echo(Diagnostic(message, span, severity=Severity.WARNING).render(), err=True)
