# SPDX-License-Identifier: Apache-2.0
"""What follows from a model, targets and what is known of leaves: statuses, and the values that they should have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from microros_gen.mode_manager.calls import Kind, Link, Values
from microros_gen.mode_manager.leaf import Leaf, has_values
from microros_gen.modes.inference import Inference
from microros_gen.modes.model import ACTIVE, DEFAULT, UNKNOWN, Model, Part, Status, Value
from microros_gen.modes.templates import parent_value, resolve
from microros_gen.modes.values import type_of


class Knowledge:
    """A view of the targets, which others change."""

    def __init__(self, model: Model, targets: Mapping[str, Status]) -> None:
        self.model = self._origin = model
        self.targets = targets
        self._inference = Inference(model)

    def set_parent_values(self, name: str, values: Values) -> None:
        """Take values of the parent of a system: they replace `$(parent …)` in its modes."""
        system = self._origin.parts[name]
        modes = {
            mode.name: replace(mode, parameters={n: _set(v, values) for n, v in mode.parameters.items()})
            for mode in system.modes.values()
        }
        parts = {**self.model.parts, name: replace(system, modes=modes)}
        self.model = replace(self.model, parts=parts)
        self._inference = Inference(self.model)

    def infer_system(self, system: Part, actual: Mapping[str, Status]) -> Status:
        """Return the status of a system; `actual` has the status of each of its parts."""
        return self._inference.infer_system(system, self.targets.get(system.name), actual)

    def status(self, leaf: Leaf, targets: Mapping[str, Status] | None = None) -> Status:
        """Return the status of a leaf as it was last known; `targets` None: the present ones.

        One that reports its mode is in none while its parameters have other values than those of this mode.
        """
        known = self.targets if targets is None else targets
        if leaf.state != ACTIVE:
            return Status(leaf.state)
        if leaf.link is Link.SYSTEM:
            return Status(ACTIVE, leaf.mode)
        if leaf.link is Link.MODES:
            return Status(ACTIVE, leaf.mode if self._fits(leaf, known) else "")
        if Kind.GET_PARAMETERS in leaf.stale and not leaf.values:
            return Status(UNKNOWN) if leaf.parameters else Status(ACTIVE, DEFAULT)
        return self._inference.infer_node(leaf.part, leaf.values, known)

    def wanted(self, leaf: Leaf) -> Values:
        """Return the values of the mode that is the leaf's target; of a system only those that its parent gives."""
        target = leaf.target
        if target is None or target.state != ACTIVE:
            return {}
        if leaf.part.is_system:
            return {n: parent_value(self.model, leaf.part, n, self.targets) for n in leaf.parameters}
        return self._values(leaf, target.mode, self.targets)

    def lacks_values(self, leaf: Leaf) -> bool:
        """Return whether a system of another manager has not got the values of its parent."""
        return (
            leaf.link is Link.SYSTEM
            and leaf.reports_values
            and not has_values(leaf.values, self.wanted(leaf))
        )

    def _fits(self, leaf: Leaf, targets: Mapping[str, Status]) -> bool:
        if not leaf.has_known_values or leaf.mode not in leaf.part.modes:
            return True
        return has_values(leaf.values, self._values(leaf, leaf.mode, targets))

    def _values(self, leaf: Leaf, mode: str, targets: Mapping[str, Status]) -> Values:
        return resolve(self.model, leaf.part, leaf.part.modes[mode], targets)


def _set(value: Value, values: Values) -> Value:
    known = values.get(value.parent)
    return value if known is None else replace(value, value=known, type=type_of(known), parent="")
