# SPDX-License-Identifier: Apache-2.0
"""Attributes of a plan by their path, as component.yaml names them, and the conditions over them."""

from __future__ import annotations

from operator import attrgetter

from microros_gen.client.plan.board import BoardPlan
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.contribution import Conditions
from microros_gen.selection.model import Selection


@dataclass(frozen=True)
class Values:
    """What paths begin at: a slice of the runtime's plan, `board`, `target`, or `component` for what is selected."""

    runtime: RuntimePlan
    selection: Selection
    board: BoardPlan | None = None
    target: Target | None = None

    def value(self, path: str) -> object:
        """Return the value at `path`: `streams.on_full`, `board.stdio`, `component.executor`."""
        first, _, rest = path.partition(".")
        if first == "component":
            return self.selection.has(rest)
        if first in ("board", "target"):
            return attrgetter(rest)(getattr(self, first))
        return attrgetter(path)(self.runtime)

    def holds(self, when: Conditions) -> bool:
        """Return whether each attribute has the value that `when` gives for it."""
        return all(self._is(self.value(path), wanted) for path, wanted in when)

    @staticmethod
    def _is(value: object, wanted: str | int | bool) -> bool:
        return bool(value) is wanted if isinstance(wanted, bool) else value == wanted
