# SPDX-License-Identifier: Apache-2.0
"""The state and mode of systems, inferred from their parts, and the mode of nodes, inferred from their parameters.

The rules are those of the package system_modes (its README, "Mode Inference"):

- A part in error processing puts its system into error processing.
- A system whose target is inactive is inactive when all parts are inactive or unconfigured, else deactivating.
- A system whose target is a mode is in it when each part is what that mode commands; unconfigured parts count as
  inactive. Otherwise it is activating, in the first mode by name that its parts are in exactly, or in none.
- A system without a target has the state that all of its parts have, else it is unknown.
- A node is in its target mode if its parameters have the values of that, else in `__DEFAULT__` if they have those,
  else in the first other mode by name that fits, else in no known mode.
"""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.modes.model import (
    ACTIVATING,
    ACTIVE,
    DEACTIVATING,
    DEFAULT,
    ERROR,
    INACTIVE,
    UNCONFIGURED,
    UNKNOWN,
    Model,
    Part,
    Scalar,
    Status,
    active,
)
from microros_gen.modes.templates import resolve
from microros_gen.records import dataclass

RESTING = (INACTIVE, UNCONFIGURED)
"""States that look the same to whoever infers modes: an unconfigured part counts as inactive."""


def fulfills(actual: Status, command: Status) -> bool:
    """Return whether a part that is `actual` is what a mode commands; unconfigured counts as inactive."""
    return actual.is_same(command) or (command.state == INACTIVE and actual.state == UNCONFIGURED)


@dataclass(frozen=True)
class Inference:
    """Infers states and modes of the parts of `model`."""

    model: Model

    def infer_system(self, system: Part, target: Status | None, actual: Mapping[str, Status]) -> Status:
        """Return the status of a system with `target`; `actual` has the status of each of its parts."""
        states = [actual[name].state for name in system.part_names]
        if ERROR in states:
            return Status(ERROR)
        if target is None:
            return Status(states[0]) if len(set(states)) == 1 else Status(UNKNOWN)
        if target.state != ACTIVE:
            return Status(INACTIVE if all(state in RESTING for state in states) else DEACTIVATING)
        commands = system.modes[target.mode].commands
        if all(fulfills(actual[name], commands[name].target) for name in system.part_names):
            return target
        return Status(ACTIVATING, self.mode_of(system, actual))

    def mode_of(self, system: Part, actual: Mapping[str, Status]) -> str:
        """Return the first mode by name that the parts of a system are in exactly; empty: none."""
        for name, mode in sorted(system.modes.items()):
            if all(actual[p].is_same(mode.commands[p].target) for p in system.part_names):
                return name
        return ""

    def infer_all(self, targets: Mapping[str, Status], nodes: Mapping[str, Status]) -> Mapping[str, Status]:
        """Return the status of each part from those of the nodes."""
        found = dict(nodes)
        for system in self.model.systems:
            found[system.name] = self.infer_system(system, targets.get(system.name), found)
        return found

    def infer_node(
        self,
        node: Part,
        parameters: Mapping[str, Scalar | tuple[Scalar, ...]],
        targets: Mapping[str, Status],
    ) -> Status:
        """Return the status of an active node with these parameter values.

        A value must have the type of the mode's, too: 1 is not 1.0. `targets` are those of all parts: template values
        follow from the mode of the system.
        """
        target = targets.get(node.name)
        first = [target.mode] if target is not None and target.state == ACTIVE else []
        for name in [*first, DEFAULT, *sorted(node.modes)]:
            if name in node.modes and self._fits(node, name, parameters, targets):
                return active(name)
        return Status(ACTIVE, "")

    def _fits(
        self,
        node: Part,
        mode: str,
        parameters: Mapping[str, Scalar | tuple[Scalar, ...]],
        targets: Mapping[str, Status],
    ) -> bool:
        wanted = resolve(self.model, node, node.modes[mode], targets)
        return all(
            name in parameters and type(parameters[name]) is type(value) and parameters[name] == value
            for name, value in wanted.items()
        )
