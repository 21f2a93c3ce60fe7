# SPDX-License-Identifier: Apache-2.0
"""Template values: `$(parent NAME)` is the value of the parameter NAME in the mode of the system that a part is in."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.modes.model import DEFAULT, Mode, Model, Part, Scalar, Status, Value, active


def check_templates(model: Model, diagnostics: Diagnostics) -> None:
    """Report templates whose system has no such parameter, or has it with another type."""
    for part in model.parts.values():
        for mode in part.modes.values():
            for name, value in mode.parameters.items():
                if value.parent:
                    _check(model, part, name, value, diagnostics)


def _check(model: Model, part: Part, name: str, value: Value, diagnostics: Diagnostics) -> None:
    if part.name not in model.parents:
        message = f"the parameter '{name}' is the one of a parent, and '{part.name}' is in no system"
        diagnostics.error(message, value.span, "Write its value", id="MG-8827")
        return
    parent = model.parts[model.parents[part.name]]
    known = _defaults(parent)
    if DEFAULT not in parent.modes:
        return  # reported where the modes are read
    if value.parent not in known:
        message = f"the system '{parent.name}' has no parameter '{value.parent}'"
        hint = nearest(value.parent, known) or f"Add it to {DEFAULT} of the system"
        diagnostics.error(message, value.span, hint, id="MG-8828")
        return
    own, parent_type = parameter_type(model, part, name), value_type(model, part, value)
    if own and parent_type and own != parent_type:
        message = (
            f"the parameter '{name}' is of type {own}, and '{value.parent}' of the parent is {parent_type}"
        )
        diagnostics.error(message, value.span, "Use one type", id="MG-8829")


def _defaults(part: Part) -> Mapping[str, Value]:
    return part.modes[DEFAULT].parameters if DEFAULT in part.modes else {}


def parameter_type(model: Model, part: Part, name: str) -> str:
    """Return the type that `__DEFAULT__` gives a parameter; empty: it does not have it."""
    value = _defaults(part).get(name)
    return value_type(model, part, value) if value is not None else ""


def value_type(model: Model, part: Part, value: Value) -> str:
    """Return the type of a value; of a template that of the parent's parameter."""
    if not value.parent:
        return value.type
    parent = model.parents.get(part.name)
    return parameter_type(model, model.parts[parent], value.parent) if parent is not None else ""


def resolve(
    model: Model, part: Part, mode: Mode, targets: Mapping[str, Status]
) -> dict[str, Scalar | tuple[Scalar, ...] | None]:
    """Return the parameter values of a mode while the systems have `targets`.

    A system without a target counts as one in `__DEFAULT__`.
    """
    return {name: _resolved(model, part, value, targets) for name, value in mode.parameters.items()}


def parent_value(
    model: Model, part: Part, name: str, targets: Mapping[str, Status]
) -> Scalar | tuple[Scalar, ...] | None:
    """Return the value of the parameter `name` of the system that a part is in, while the systems have `targets`."""
    return _resolved(model, part, Value(None, "", part.span, part.span, name), targets)


def _resolved(
    model: Model, part: Part, value: Value, targets: Mapping[str, Status]
) -> Scalar | tuple[Scalar, ...] | None:
    while value.parent:
        part = model.parts[model.parents[part.name]]
        mode = targets.get(part.name, active()).mode or DEFAULT
        value = part.modes[mode].parameters[value.parent]
    return value.value


def possible_values(model: Model, part: Part, mode: str, name: str) -> Iterator[Value]:
    """Yield each concrete value that a parameter can have in a mode: one for each mode of the parent that commands it.

    Where no mode of the parent commands the part to be in `mode`, the parent is in `__DEFAULT__`.
    """
    value = part.modes[mode].parameters[name]
    if not value.parent:
        yield value
        return
    parent = model.parts[model.parents[part.name]]
    commanding = [m.name for m in parent.modes.values() if m.commands[part.name].target == active(mode)]
    for parent_mode in commanding or [DEFAULT]:
        yield from possible_values(model, parent, parent_mode, value.parent)
