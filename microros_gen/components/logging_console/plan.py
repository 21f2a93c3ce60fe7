# SPDX-License-Identifier: Apache-2.0
"""The bytes of the lines that wait for the UART of the console, and a warning where logging waits for the line."""

from __future__ import annotations

from microros_gen.application.log_decl import LogWriter
from microros_gen.client.plan.console import console_size, console_waits
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.logging.plan import TEXT_SIZE, writer_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True, kw_only=True)
class ConsolePlan:
    """`size`: bytes of the lines that wait to be sent; 0: lines do not wait in memory of the library."""

    size: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> ConsolePlan:
    """Return the size; one line has room at least."""
    writer = writer_of(context.application, "console") or LogWriter("console")
    size = console_size(context.application, context.target)
    if size == 0:
        _check_without_ring(writer, context, diagnostics)
    elif size < TEXT_SIZE:
        diagnostics.error(
            f"the log writer 'console' has {writer.size} bytes, and a line takes up to {TEXT_SIZE}",
            writer.span,
            f"Write `size: {TEXT_SIZE}` or more",
            id="MG-7046",
        )
    return ConsolePlan(size=size)


def _check_without_ring(writer: LogWriter, context: PlanContext, diagnostics: Diagnostics) -> None:
    target = context.target
    if writer.size is not None:
        diagnostics.warning(
            f"'size' of the log writer 'console' has no effect: {target.name} keeps no lines for it",
            writer.span,
            "Remove it",
            id="MG-7045",
        )
    if console_waits(target) and not (target.stdio is not None and target.stdio.to == "none"):
        diagnostics.warning(
            f"the log writer 'console' waits until {target.name} has output each byte",
            writer.span or context.application.target.span,
            _never_waiting(context),
            id="MG-7044",
        )


def _never_waiting(context: PlanContext) -> str:
    """Return the keys of a target file with which no line waits."""
    stdio = context.target.stdio
    if stdio is not None and stdio.to == "uart":
        return "Add the interrupt of its UART to the target file: `stdio: {to: uart, irq: N, …}`"
    return (
        "Name a UART and its interrupt in the target file: `stdio: {to: uart, irq: N, …}`, or drive one yourself: "
        "`provides: [console_send]`"
    )


def record(part: ConsolePlan) -> object:
    """Return what the plan id is made of."""
    return part.size
