# SPDX-License-Identifier: Apache-2.0
"""The stack that each task of an image needs: the heaviest chain of calls from its entry, and what the system adds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.image.callgraph import CallGraph
from microros_gen.image.stack import Bound, bound_of
from microros_gen.records import dataclass

ALIGNMENT = 8
"""Bytes that a stack is a multiple of."""
MARGIN_PERCENT = 10
"""What is added to the chain: later versions of functions that the tool does not compile may need more."""


@dataclass(frozen=True)
class TaskStack:
    """The stack of the task `name`, which has `size` bytes. `bound` None: the image does not contain its entry.

    `context` is what the operating system puts on it, and the frames of the port around the entry. `automatic`: the
    application file wants the size to follow from the image.
    """

    name: str
    bound: Bound | None
    context: int
    size: int
    automatic: bool

    @property
    def open(self) -> tuple[str, ...]:
        """What keeps the need from being known; empty: it is a bound."""
        return ("its entry is not in the image",) if self.bound is None else self.bound.open

    @property
    def needs(self) -> int | None:
        """Bytes that are enough, margin included; None: nobody can say."""
        if self.bound is None or self.bound.open:
            return None
        whole = self.bound.bytes + -(-self.bound.bytes * MARGIN_PERCENT // 100) + self.context
        return (whole + ALIGNMENT - 1) // ALIGNMENT * ALIGNMENT

    @property
    def fits(self) -> bool:
        """Whether the stack is proven to be large enough without the margin."""
        return self.bound is not None and not self.bound.open and self.bound.bytes + self.context <= self.size


def has_automatic(manifest: Mapping[str, Any]) -> bool:
    """Return whether the size of a task's stack is to follow from the image."""
    return any(task["stack_auto"] for task in _values(manifest).get("tasks", ()))


def _values(manifest: Mapping[str, Any]) -> Mapping[str, Any]:
    found: Mapping[str, Any] = manifest.get("features", {}).get("tasks", {}).get("values", {})
    return found


def task_stacks(manifest: Mapping[str, Any], graph: CallGraph) -> tuple[TaskStack, ...]:
    """Return the stacks of the tasks that `manifest` has, in its order; none without tasks.

    Callbacks of every executor count for each task: what a handle calls is found by the type of the function alone.
    """
    values = _values(manifest)
    context = int(values.get("stack_context", 0))
    return tuple(
        TaskStack(
            task["name"],
            bound_of(graph, task["entry"]),
            context,
            int(task["stack"]),
            bool(task["stack_auto"]),
        )
        for task in values.get("tasks", ())
    )
