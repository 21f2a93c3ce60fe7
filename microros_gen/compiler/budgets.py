# SPDX-License-Identifier: Apache-2.0
"""Budgets of an application file against what was built, by `build` and by a user's own builds."""

from __future__ import annotations

from collections.abc import Callable

from microros_gen.compiler.advice import plan_advice
from microros_gen.compiler.pipeline import Planned
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.image.budget import store_advice
from microros_gen.image.folder import Folder
from microros_gen.image.report import check_budgets, measure_folder


def check_plan(planned: Planned, read: Callable[[], Folder], warnings: Diagnostics) -> None:
    """Check the budgets of a plan against the folder that `read` returns, which is read only if there are any.

    Raises UserError with status 1 when one is exceeded; what cannot be checked is added to `warnings` before.
    """
    memory = planned.project.application.memory
    places = {"ram_budget": memory.ram_span, "flash_budget": memory.flash_span, "stack": memory.stack_span}
    if not memory.has_budget:
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


def check_manifest(folder: Folder, warnings: Diagnostics) -> None:
    """Check the budgets that the manifest of a folder names; raises and warns as `check_plan`."""
    report = measure_folder(folder)
    if "stack" in folder.manifest["memory"] and not report.stack.known:
        warnings.warning(f"memory.stack is not checked: {report.stack.why}", id="MG-8603")
    check_budgets(report.budgets, {}, {})
