# SPDX-License-Identifier: Apache-2.0
"""Which targets a manager takes over when it starts: those of the modes that systems are in, inferred from nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.mode_manager.knowledge import Knowledge
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.targets import spread
from microros_gen.modes.inference import fulfills
from microros_gen.modes.model import ACTIVE, Model, Status


def adopted(
    model: Model, scope: Scope, leaves: Mapping[str, Leaf], knowledge: Knowledge
) -> Iterator[Mapping[str, Status]]:
    """Yield the targets of each topmost system that is in a mode, and of all below it.

    It is in a mode if all leaves below it are what this mode commands, and one of them is active. The first one by
    name is taken. Where no mode fits, the systems below are looked at. The mode of a leaf may
    depend on the targets of systems: they give values.
    """
    taken: set[str] = set()

    def fits(targets: Mapping[str, Status]) -> bool:
        found = [knowledge.status(leaves[name], targets) for name in targets if name in leaves]
        wanted = [target for name, target in targets.items() if name in leaves]
        return all(map(fulfills, found, wanted)) and any(status.state == ACTIVE for status in found)

    for system in reversed(scope.systems):
        for mode in sorted(system.modes) if system.name not in taken else ():
            targets = {part.name: goal for part, goal in spread(model, scope, system, Status(ACTIVE, mode))}
            if fits(targets):
                taken |= targets.keys()
                yield targets
                break
