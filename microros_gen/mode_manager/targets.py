# SPDX-License-Identifier: Apache-2.0
"""What follows from the target of a system for its parts: their targets, and which parts wait for which."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.mode_manager.scope import Scope
from microros_gen.modes.model import ACTIVE, Model, Part, Status, start_sequence


def spread(model: Model, scope: Scope, part: Part, target: Status) -> Iterator[tuple[Part, Status]]:
    """Yield a part with its target, and all below it in the scope with theirs."""
    yield part, target
    if not part.is_system or scope.is_external(part.name):
        return
    for name in start_sequence(part.part_names, part.start_after):
        yield from spread(model, scope, model.parts[name], model.command(part, target, name))


def predecessors(system: Part, name: str, targets: Mapping[str, Status]) -> tuple[list[str], list[str]]:
    """Return the parts of its system that a part waits for, and those of them without which it is not started.

    Parts stop in the reverse of the start order, before others start.
    """
    stopping = [p for p in system.part_names if p in targets and targets[p].state != ACTIVE]
    if name in stopping:
        after = [p for p in stopping if any(a.name == name for a in system.start_after.get(p, ()))]
        return after, []
    needed = [a.name for a in system.start_after.get(name, ()) if a.name in targets]
    needed = [p for p in needed if p not in stopping]
    return [*stopping, *needed], needed
