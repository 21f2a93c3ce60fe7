# SPDX-License-Identifier: Apache-2.0
"""`watchdog:` of the application file → how late a task may be before the watchdog of the device is not fed."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.application.task_decl import TaskDecl
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.tree_values import child, span_of, text_of, time_of
from microros_gen.documents.yaml_tree import YamlNode
from microros_gen.records import dataclass

KEY = "watchdog"
"""Its key in the application file."""
LEAST_US, MOST_US = 100, 60_000_000
"""Shortest and longest margin, microseconds. With deadline and wait of a task it is below half of a 32-bit count."""


@dataclass(frozen=True)
class WatchdogDecl:
    """A task is late `margin_us` after its deadline."""

    margin_us: int
    span: Span | None = None


def parse_watchdog(
    tree: YamlNode | None, tasks: Sequence[TaskDecl], diagnostics: Diagnostics
) -> WatchdogDecl | None:
    """Return what is below `watchdog:`; None: the file has no such key. Faults are errors at their places."""
    if tree is None:
        return None
    if not tasks:
        diagnostics.error(
            "the watchdog is fed while all tasks are in time, and the application file declares none",
            tree.span,
            "Add `tasks:`, or feed the watchdog in the program; without an operating system, "
            "`hooks: {watchdog: NAME}` of the target file is called while the library waits",
            id="MG-3216",
        )
    node = child(tree, "margin")
    margin = time_of(node)
    if margin is not None and not LEAST_US <= margin <= MOST_US:
        message = f"'margin' of the watchdog is {text_of(node)}; it must be {LEAST_US} us to {MOST_US // 1_000_000} s"
        diagnostics.error(message, span_of(node), "Write margin: 50 ms", id="MG-3217")
        margin = None
    return WatchdogDecl(margin or LEAST_US, tree.span)
