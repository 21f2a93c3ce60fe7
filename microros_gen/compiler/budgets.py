# SPDX-License-Identifier: Apache-2.0
"""Budgets of an application file against what was built, by `build` and by a user's own builds."""

from __future__ import annotations

from collections.abc import Callable

from microros_gen.compiler.advice import plan_advice
from microros_gen.compiler.pipeline import Planned
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.image.budget import store_advice
from microros_gen.image.folder import Folder
from microros_gen.image.report import SizeReport, check_budgets, measure_folder


def check_plan(planned: Planned, read: Callable[[], Folder], warnings: Diagnostics) -> None:
    """Check the budgets of a plan against the folder that `read` returns, which is read only if there are any.

    Where nothing limits the stack (`stack_meets_variables`), it must have room besides the variables of the image.

    Raises UserError with status 1 when one is exceeded; what cannot be checked is added to `warnings` before.
    """
    memory = planned.project.application.memory
    places = {"ram_budget": memory.ram_span, "flash_budget": memory.flash_span, "stack": memory.stack_span}
    if not memory.has_budget and not planned.project.stack_meets_variables:
        return
    try:
        folder = read()
        report = measure_folder(folder)
    except UserError as error:
        warnings.warning(f"budgets are not checked: {error.diagnostics[0].message}", id="MG-8601")
        return
    if memory.stack is not None and not report.stack.known:
        warnings.warning(f"memory.stack is not checked: {report.stack.why}", memory.stack_span, id="MG-8602")
    if any(line.exceeded and line.key == "ram_budget" for line in report.budgets):
        store_advice(folder, plan_advice(planned, folder))
        report = measure_folder(folder)
    keys = {key: span.line for key, span in planned.project.application.spans.items()}
    check_budgets(report.budgets, places, keys)
    if planned.project.stack_meets_variables:
        _check_room(planned, report)


def _check_room(planned: Planned, report: SizeReport) -> None:
    """Raise UserError where the variables of the image and its worst stack are more than the RAM of the target."""
    target = planned.project.target
    if target.ram is None or report.folder.image is None or not report.stack.known:
        return
    variables, stack = report.variables, report.stack.total
    excess = variables + stack - target.ram.size
    if excess <= 0:
        return
    allowed = report.library_variables - excess
    raise UserError(
        [
            Diagnostic(
                f"{report.folder.image_name} has {variables} bytes of variables and needs up to {stack} of stack, and "
                f"{target.name} has {target.ram.size} bytes of RAM: the stack would overwrite variables",
                planned.project.application.target.span,
                f"Write `memory: {{ram_budget: {allowed}}}`: the next build then lists what helps"
                if allowed > 0
                else "Choose a target with more RAM",
                id="MG-8608",
            )
        ],
        status=1,
    )


def check_manifest(folder: Folder, warnings: Diagnostics) -> None:
    """Check the budgets that the manifest of a folder names; raises and warns as `check_plan`."""
    report = measure_folder(folder)
    if "stack" in folder.manifest["memory"] and not report.stack.known:
        warnings.warning(f"memory.stack is not checked: {report.stack.why}", id="MG-8603")
    check_budgets(report.budgets, {}, {})
