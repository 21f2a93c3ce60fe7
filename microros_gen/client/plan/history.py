# SPDX-License-Identifier: Apache-2.0
"""How many messages each stream keeps: what the application file says, otherwise by their sizes and writers."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics

DEFAULT_HISTORY = 4
LEAST_DEFAULT_HISTORY = 2
DEFAULT_HISTORY_BYTES = 1024
DEFAULT_INPUT_HISTORY = 1
# While one message is written a second can be stored.
LEAST_BEST_EFFORT_HISTORY = 2
MOST_BEST_EFFORT_HISTORY = 64


def default_history(slot_size: int) -> int:
    """Return how many reliable messages are kept unless the application file says it: of large ones fewer.

    While one is under way a second can be written; more of them are worth their memory where they are small.
    """
    return min(DEFAULT_HISTORY, max(LEAST_DEFAULT_HISTORY, DEFAULT_HISTORY_BYTES // slot_size))


def input_slots(application: Application, reliable_input: bool, diagnostics: Diagnostics) -> int:
    """Return how many messages of the agent's reliable stream are held; 0 without `reliable_input`."""
    requested = application.pools.get("input_history")
    if reliable_input:
        return requested or DEFAULT_INPUT_HISTORY
    if requested is not None:
        diagnostics.warning(
            "'pools.input_history' has no effect: no selected component receives on a reliable stream",
            application.spans.get("pools.input_history"),
            "Remove it",
            id="MG-7025",
        )
    return 0


def output_slots(application: Application, writers: int, size: int, diagnostics: Diagnostics) -> int:
    """Return how many best-effort messages wait for the task of the session; 0 where they are sent at once.

    `writers` is the number of best-effort writers and `size` that of a message, in bytes; 0: no such stream.
    """
    requested = application.pools.get("best_effort_history")
    if application.tasks and size:
        return requested or max(LEAST_BEST_EFFORT_HISTORY, min(writers, MOST_BEST_EFFORT_HISTORY))
    if requested is not None:
        diagnostics.warning(
            "'pools.best_effort_history' has no effect: best-effort messages wait only for a task of the session",
            application.spans.get("pools.best_effort_history"),
            "Remove it, or declare `tasks:` and a best-effort publisher",
            id="MG-7062",
        )
    return 0
