# SPDX-License-Identifier: Apache-2.0
"""Which targets a manager takes over when it starts: those of the modes that systems are in, inferred from nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.targets import spread
from microros_gen.modes.inference import Inference, fulfills
from microros_gen.modes.model import ACTIVE, Model, Status


def adopted(
    model: Model, scope: Scope, leaves: Mapping[str, Leaf], status: Mapping[str, Status]
) -> Iterator[Mapping[str, Status]]:
    """Yield the targets of each topmost system that is in a mode, and of all below it.

    It is in a mode if all leaves below it are what this mode commands, and one of them is active. The first one by
    name is taken. Where no mode fits, the systems below are looked at. `status` is that of each leaf.
    """
    taken: set[str] = set()
    inference = Inference(model)

    def fits(targets: Mapping[str, Status]) -> bool:
        found = [
            _status(leaves[name], status[name], targets, inference) for name in targets if name in leaves
        ]
        wanted = [target for name, target in targets.items() if name in leaves]
        return all(map(fulfills, found, wanted)) and any(status.state == ACTIVE for status in found)

    for system in reversed(scope.systems):
        for mode in sorted(system.modes) if system.name not in taken else ():
            targets = {part.name: goal for part, goal in spread(model, scope, system, Status(ACTIVE, mode))}
            if fits(targets):
                taken |= targets.keys()
                yield targets
                break


def _status(leaf: Leaf, known: Status, targets: Mapping[str, Status], inference: Inference) -> Status:
    """Return the status of a leaf; its mode may depend on the targets of systems (template values)."""
    if known.state == ACTIVE and leaf.link in (Link.PARAMETERS, Link.PLAIN):
        return inference.infer_node(leaf.part, leaf.values, targets)
    return known
