# SPDX-License-Identifier: Apache-2.0
"""Targets where no number of instructions bounds a hold of the lock, whatever the image is: said once for all tasks."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.application.task_decl import TaskDecl
from microros_gen.diagnostics import Diagnostic, Severity
from microros_gen.platform.target import Target


def unbounded_locks(tasks: Sequence[TaskDecl], target: Target) -> Diagnostic | None:
    """Return why holds have no bound on `target`; None: those of its images have one.

    The place is the first `lock: auto`, which nothing will fill in there; without one the first task.
    """
    if not target.hosted or not tasks:
        return None
    waiting = [task for task in tasks if task.lock_auto]
    names = ", ".join(f"'{task.name}'" for task in waiting)
    counts = f"; until then all of the time of {names} counts" if waiting else ""
    message = (
        f"how long a task holds the lock has no bound on the target {target.name}: the C library is a shared one, and"
        f" no number of cycles bounds an instruction beside a kernel and caches{counts}"
    )
    hint = "Write what you measured, `lock: 40 us`, or build for a board: `target: {name: cortex-m4f, rtos: freertos}`"
    span = waiting[0].lock_span if waiting else tasks[0].span
    return Diagnostic(message, span, hint, Severity.WARNING, id="MG-9874")
