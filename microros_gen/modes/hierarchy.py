# SPDX-License-Identifier: Apache-2.0
"""Which system a part is in, and what contradicts a hierarchy: two systems of a part, cycles, circular start orders."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.modes.model import Part, start_sequence

DEEPEST = 32
"""Levels of systems that are taken."""


def find_parents(lists: Mapping[str, tuple[Named, ...]], diagnostics: Diagnostics) -> dict[str, str]:
    """Return the system of each part that is in one; a part in two systems, or below itself, is an error.

    `lists` has the parts of each system.
    """
    parents: dict[str, str] = {}
    for system, parts in lists.items():
        for part in parts:
            if part.name in parents:
                message = f"the part '{part.name}' is in two systems, '{parents[part.name]}' and '{system}'"
                hint = "Leave it in one of them; both would command it"
                diagnostics.error(message, part.span, hint, id="MG-8824")
            elif _is_below(system, part.name, parents):
                message = f"the system '{part.name}' contains itself: {_path(system, part.name, parents)}"
                diagnostics.error(message, part.span, "Remove this part", id="MG-8823")
            else:
                parents[part.name] = system
    for system, parts in lists.items():
        if _depth(system, parents) == DEEPEST:
            message = f"the hierarchy has more than {DEEPEST} levels of systems"
            diagnostics.error(message, parts[0].span if parts else None, "Flatten it", id="MG-8832")
    return parents


def _depth(name: str, parents: Mapping[str, str]) -> int:
    """Return how many systems are above a system; of a very deep one a number above DEEPEST."""
    depth = 0
    while name in parents and depth <= DEEPEST:
        name, depth = parents[name], depth + 1
    return depth


def _is_below(name: str, above: str, parents: Mapping[str, str]) -> bool:
    while name != above:
        if name not in parents:
            return False
        name = parents[name]
    return True


def _path(name: str, above: str, parents: Mapping[str, str]) -> str:
    """Return the way from `above` down to `name`, and to `above` again."""
    names = [name]
    while names[-1] != above:
        names.append(parents[names[-1]])
    return " > ".join([*reversed(names), above])


def check_start_order(system: Part, diagnostics: Diagnostics) -> None:
    """Report parts that start after each other."""
    sequence = start_sequence(system.part_names, system.start_after)
    left = {name for name in system.part_names if name not in sequence}
    if not left:
        return
    cycle, span = _cycle(left, system.start_after)
    message = f"the start order of '{system.name}' is circular: {' after '.join(cycle)}"
    diagnostics.error(message, span.span, "Remove one of these", id="MG-8825")


def _cycle(left: set[str], after: Mapping[str, tuple[Named, ...]]) -> tuple[list[str], Named]:
    """Return the parts of one cycle, its first one again at the end, and the name that closes it."""
    path = [min(left)]
    while True:
        name = next(a for a in after[path[-1]] if a.name in left)
        if name.name in path:
            return [*path[path.index(name.name) :], name.name], name
        path.append(name.name)
