# SPDX-License-Identifier: Apache-2.0
"""Which parts of a model one manager commands: whole systems, without the subsystems of other managers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.modes.model import Model, Part
from microros_gen.modes.outline import plain_name
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Scope:
    """`systems`: bottom up; `leaves`: nodes, and subsystems that other managers manage; `roots`: the topmost parts."""

    systems: tuple[Part, ...]
    leaves: tuple[Part, ...]
    roots: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of all parts, those of systems first."""
        return tuple(part.name for part in (*reversed(self.systems), *self.leaves))

    def is_external(self, name: str) -> bool:
        """Return whether the part is a system of another manager."""
        return any(leaf.name == name and leaf.is_system for leaf in self.leaves)


def select_scope(model: Model, roots: Sequence[str] = (), without: Sequence[str] = ()) -> Scope:
    """Return what is at `roots` (none: all topmost parts) and below, without what is below `without`.

    Raises UserError for an unknown name, one of `without` that is no subsystem in the scope, and overlapping `roots`.
    """
    chosen = tuple(_known(model, name) for name in roots) or tuple(part.name for part in model.roots)
    excluded = {_known(model, name) for name in without}
    found = [part for name in chosen for part in _walk(model, model.parts[name], excluded)]
    names = [part.name for part in found]
    twice = next((name for name in chosen if names.count(name) > 1), None)
    if twice is not None:
        hint = "Name only the upper one"
        raise UserError([Diagnostic(f"'{twice}' is twice in the scope", hint=hint, id="MG-8871")])
    for name in excluded:
        if name not in names or not model.parts[name].is_system or name in chosen:
            hint = "Name a subsystem that is below a system of this manager"
            raise UserError([Diagnostic(f"'{name}' is no subsystem of the scope", hint=hint, id="MG-8872")])
    inner = [part for part in found if part.is_system and part.name not in excluded]
    leaves = [part for part in found if not part.is_system or part.name in excluded]
    return Scope(tuple(inner), tuple(leaves), chosen)


def _known(model: Model, name: str) -> str:
    plain = plain_name(name)
    if plain in model.parts:
        return plain
    hint = nearest(plain, model.parts) or f"Known: {', '.join(model.parts)}"
    raise UserError([Diagnostic(f"unknown part '{name}'", hint=hint, id="MG-8870")])


def _walk(model: Model, part: Part, excluded: set[str]) -> Iterator[Part]:
    """Yield a part after all below it; what is below an excluded one is left out."""
    if part.name not in excluded:
        for name in part.part_names:
            yield from _walk(model, model.parts[name], excluded)
    yield part


def select_nodes(model: Model, scope: Scope, names: Sequence[str]) -> frozenset[str]:
    """Return the names of nodes of the scope. Raises UserError for others."""
    found = frozenset(_known(model, name) for name in names)
    nodes = [leaf.name for leaf in scope.leaves if not leaf.is_system]
    for name in found:
        if name not in nodes:
            hint = f"Nodes: {', '.join(nodes)}"
            raise UserError([Diagnostic(f"'{name}' is no node of the scope", hint=hint, id="MG-8873")])
    return found
