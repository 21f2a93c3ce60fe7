# SPDX-License-Identifier: Apache-2.0
"""Which part of the platform provides what a plan asks for, and what only the application can define."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.client.plan.board import BoardPlan
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.values import Values
from microros_gen.diagnostics import Diagnostic, Diagnostics, Severity
from microros_gen.platform.capabilities import declarations
from microros_gen.platform.provide import Provisions, provide
from microros_gen.platform.target import Target
from microros_gen.selection.model import Selection


def plan_provisions(
    application: Application,
    selection: Selection,
    runtime: RuntimePlan,
    board: BoardPlan,
    target: Target,
    diagnostics: Diagnostics,
) -> Provisions:
    """Choose who provides each capability, and warn of what only the application can define."""
    found = provide(
        (chosen.component for chosen in selection.components),
        tuple(part.component.name for part in target.parts),
        target.own_capabilities,
        Values(runtime, selection, board, target).holds,
    )
    for clash in found.clashes:
        diagnostics.error(
            f"{clash.file} of {clash.part} implements '{clash.kept}' and '{clash.taken}', "
            f"but only '{clash.taken}' is provided elsewhere",
            application.target.span,
            f"Provide both, or neither: `provides: [{clash.taken}, {clash.kept}]`",
            id="MG-7014",
        )
    _report_missing(found, application, target, diagnostics)
    return found


def _report_missing(
    found: Provisions, application: Application, target: Target, diagnostics: Diagnostics
) -> None:
    """Warn of what no part of the platform has, with the declarations of the functions that the application defines."""
    if not found.missing:
        return
    names = ", ".join(row.capability.name for row in found.missing)
    askers = sorted({asker for row in found.missing for asker in row.asked_by})
    otherwise = f" and write `provides: [{names}]` into the target file, or add a part that has them"
    block = tuple(line for row in found.missing for line in declarations(row.capability))
    diagnostics.add(
        Diagnostic(
            f"the target {target.name} provides no {names} for {', '.join(askers)}",
            application.target.span,
            "Define the functions below in your application" + ("" if target.of_package else otherwise),
            Severity.WARNING,
            block,
            id="MG-7015",
        )
    )
