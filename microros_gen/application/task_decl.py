# SPDX-License-Identifier: Apache-2.0
"""The tasks of the operating system that run executors and the session, as the application file declares them."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.documents.named import Named
from microros_gen.records import dataclass

KEY = "tasks"
"""Its key in the application file."""

CRITICALITIES = ("high", "middle", "low")
"""Bands of priority, the highest first."""

AUTO = "auto"
"""In place of the size of a stack, and of the time that a lock is held, that follow from the image."""

OVERRUNS = ("skip", "catch_up", "call")
"""What happens to releases that a task has missed."""


@dataclass(frozen=True)
class TaskDecl:
    """A task, which runs `executor` (`node/name`), or the session where that is None. Times are microseconds.

    `node` is the position of the executor's node. `period_us` 0: its handles release it, at most once in
    `interval_us`. `instructions` is the longest run where no time is said, `lock_us` (or `lock_instructions`) the
    longest that it holds the library's lock. Numbers that are 0, `stack` None and `criticality` empty: not said.
    `priority` 1 is the highest. `stack_auto`: an image says how large the stack is; `lock_auto`: and how many
    instructions the lock is held.
    """

    name: str
    executor: Named | None = None
    node: int = 0
    period_us: int = 0
    interval_us: int = 0
    deadline_us: int = 0
    criticality: str = ""
    time_us: int = 0
    instructions: int = 0
    lock_us: int = 0
    lock_instructions: int = 0
    lock_auto: bool = False
    overrun: str = "skip"
    stack: int | None = None
    stack_auto: bool = False
    priority: int = 0
    span: Span | None = None
    stack_span: Span | None = None
    lock_span: Span | None = None
    priority_span: Span | None = None

    @property
    def is_session(self) -> bool:
        """Whether it runs the session."""
        return self.executor is None
