# SPDX-License-Identifier: Apache-2.0
"""Modes of a node with the same values, and what a node that is stuck in one of them is taken for.

A node whose mode is inferred from its parameters is seen in the mode that is its target if the values fit, otherwise in
`__DEFAULT__`, otherwise in the first one by name. One that says its mode itself is seen in this one. A model file does
not say which kind a node is.
"""

from __future__ import annotations

from microros_gen.modes.behavior import every_failure, targets_of
from microros_gen.modes.machines import Behaviors, Origin, constant
from microros_gen.modes.model import ACTIVE, DEFAULT, Model, Part, active


def alike_modes(node: Part) -> tuple[tuple[str, ...], ...]:
    """Return the groups of modes of a node that have the same values, those that come first in inference first."""
    groups: dict[object, list[str]] = {}
    for name in sorted(node.modes, key=lambda name: (name != DEFAULT, name)):
        values = sorted(node.modes[name].parameters.items(), key=lambda item: item[0])
        groups.setdefault(tuple((n, v.value, v.type, v.parent) for n, v in values), []).append(name)
    return tuple(tuple(names) for names in groups.values() if len(names) > 1)


def with_inferred(model: Model, node: Part) -> Behaviors:
    """Return every failure, and what is inferred of a node that keeps values of several modes."""
    found = every_failure(model, node)
    for names in alike_modes(node):
        seen = (
            goal if goal.state == ACTIVE and goal.mode in names else active(names[0])
            for goal in targets_of(model, node)
        )
        found.setdefault(constant(tuple(seen)), Origin(((node.name, active(names[0])),)))
    return found


def without_alike(model: Model, node: Part) -> Behaviors:
    """Return the failures that are seen as they are however the mode of the node is known."""
    alike = {((node.name, active(name)),) for names in alike_modes(node) for name in names}
    return {b: origin for b, origin in every_failure(model, node).items() if origin.failures not in alike}
