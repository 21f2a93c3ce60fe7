# SPDX-License-Identifier: Apache-2.0
"""Which values a system takes from its parent, which another manager manages."""

from __future__ import annotations

from microros_gen.mode_manager.calls import Values
from microros_gen.mode_manager.scope import Scope
from microros_gen.modes.model import Model, Part
from microros_gen.modes.templates import parameter_type
from microros_gen.modes.values import type_of


def names_of(system: Part) -> frozenset[str]:
    """Return the names of the parameters of its parent that the modes of a system use."""
    return frozenset(v.parent for m in system.modes.values() for v in m.parameters.values() if v.parent)


def takers(model: Model, scope: Scope) -> tuple[str, ...]:
    """Return the systems of a scope whose parent is not in it, and gives them values."""
    inner = {system.name for system in scope.systems}
    return tuple(s.name for s in scope.systems if names_of(s) and model.parents[s.name] not in inner)


def refusal_of(model: Model, system: str, values: Values) -> str:
    """Return why a system does not take values of its parent; empty: it does."""
    known, parent = names_of(model.parts[system]), model.parts[model.parents[system]]
    for name, value in values.items():
        if name not in known:
            return f"{name}: no mode of {system} has a value $(parent {name})"
        wanted = parameter_type(model, parent, name)
        if wanted and type_of(value) != wanted:
            return f"{name}: it takes a value of type {wanted}"
    return ""
