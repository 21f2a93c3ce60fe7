# SPDX-License-Identifier: Apache-2.0
"""Attributes of a plan by their path, as component.yaml names them, and the conditions over them."""

from __future__ import annotations

import re
from operator import attrgetter

from microros_gen.client.plan.board import BoardPlan
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.contribution import Conditions
from microros_gen.selection.model import Selection

_PATH = re.compile(r"\{([a-z_][\w.]*)\}")


@dataclass(frozen=True)
class Values:
    """What paths begin at: a slice of the runtime's plan or of a component, `board`, `target`, or `component`.

    `component` is for what is selected.
    """

    runtime: RuntimePlan
    selection: Selection
    board: BoardPlan | None = None
    target: Target | None = None

    def value(self, path: str) -> object:
        """Return the value at `path`: `streams.on_full`, `board.stdio`, `component.executor`.

        Raises UserError if the plan has no such value.
        """
        first, _, rest = path.partition(".")
        if first == "component":
            return self.selection.has(rest)
        own = self.runtime.features.of(first)
        try:
            if own is not None:
                return attrgetter(rest)(own)
            if first in ("board", "target"):
                return attrgetter(rest)(getattr(self, first))
            return attrgetter(path)(self.runtime)
        except AttributeError as error:
            hint = "Write a path such as `streams.mtu`; docs/architecture.md says where paths begin"
            what = f"a component.yaml names '{path}', which is not a value of the plan"
            raise UserError([Diagnostic(what, hint=hint, id="MG-7031")]) from error

    def names(self, path: str) -> tuple[str, ...]:
        """Return the names of the elements of a tuple at `path`. Raises UserError if it is another value."""
        found = self.value(path)
        names = tuple(getattr(e, "name", None) for e in found) if isinstance(found, tuple) else (None,)
        if None in names:
            what = f"a component.yaml names '{path}', which is not a list of the plan with names"
            raise UserError([Diagnostic(what, hint="Write a path such as `tasks.tasks`", id="MG-7035")])
        return tuple(map(str, names))

    def holds(self, when: Conditions) -> bool:
        """Return whether each attribute has the value that `when` gives for it."""
        return all(self._is(self.value(path), wanted) for path, wanted in when)

    def text(self, text: str) -> str:
        """Return `text` with the value in place of each path in braces."""
        return _PATH.sub(lambda found: str(self.value(found[1])), text)

    @staticmethod
    def _is(value: object, wanted: str | int | bool) -> bool:
        return bool(value) is wanted if isinstance(wanted, bool) else value == wanted
