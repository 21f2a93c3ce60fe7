# SPDX-License-Identifier: Apache-2.0
"""Nodes of application files that have modes there → parts of a model, whose file need not repeat them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.application.mode_decl import ModeDecl
from microros_gen.application.model import Application, NodeDecl, ParameterDecl
from microros_gen.application.modes import set_parameters, start_value, value_in
from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.modes.model import Mode, Part, Scalar, Value
from microros_gen.modes.published import published_of

_NOWHERE = Span(Source("", ""), 1, 1)


def parts_of(applications: Iterable[Application]) -> dict[str, Part]:
    """Return a part for each node with modes, by its name in model files.

    Each of its modes has every parameter that one of them sets, as on the device. Modes that a check of the diagnosis
    requests are contingencies.
    """
    return {
        part.name: part
        for application in applications
        for index, node in enumerate(application.nodes)
        if node.modes
        for part in (_part(node, _contingencies(application, index), published_of(application, index)),)
    }


def _part(node: NodeDecl, contingencies: tuple[str, ...], published: tuple[str, ...] | None) -> Part:
    name = f"{node.namespace}/{node.name}".strip("/")
    modes = {mode.name: _mode(node, mode) for mode in node.modes}
    span = node.name_span or node.span or _NOWHERE
    return Part(name, False, span, modes, contingencies=contingencies, published=published)


def _contingencies(application: Application, node: int) -> tuple[str, ...]:
    checks = application.diagnosis.checks if application.diagnosis is not None else ()
    return tuple(dict.fromkeys(check.mode for check in checks if check.mode and check.node == node))


def _mode(node: NodeDecl, mode: ModeDecl) -> Mode:
    values = {p.name: _value(node, mode, p) for p in set_parameters(node)}
    return Mode(mode.name, mode.span or _NOWHERE, values)


def _value(node: NodeDecl, mode: ModeDecl, parameter: ParameterDecl) -> Value:
    kind = parameter.type.replace("byte", "integer")  # as YAML has it
    written = value_in(node, mode, parameter)
    if written is None:
        span = parameter.span or _NOWHERE
        return Value(_typed(start_value(parameter), kind), kind, span, span)
    if written.parent or written.value is None:
        return Value(None, "", written.span, written.name_span, written.parent)
    return Value(_typed(written.value, kind), kind, written.span, written.name_span)


def _typed(value: Scalar | tuple[Scalar, ...], kind: str) -> Scalar | tuple[Scalar, ...]:
    """Return a value in which whole numbers of a floating-point parameter are floating-point numbers."""
    if isinstance(value, tuple):
        return tuple(_scalar(element, kind) for element in value)
    return _scalar(value, kind)


def _scalar(value: Scalar, kind: str) -> Scalar:
    return float(value) if kind.startswith("double") and not isinstance(value, str) else value


def check_twins(parts: Mapping[str, Part], leaflets: Mapping[str, Part], diagnostics: Diagnostics) -> None:
    """Report nodes whose modes are in the model and in an application file, where the two differ."""
    for name, part in parts.items():
        leaflet = leaflets.get(name)
        if leaflet is not None and (part.is_system or _values(part) != _values(leaflet)):
            message = f"the modes of '{name}' are not those of the node in its application file"
            hint = "Remove them here: those of the application file are on the device"
            diagnostics.error(message, part.span, hint, id="MG-8859")


def _values(part: Part) -> dict[str, dict[str, tuple[object, str]]]:
    return {
        mode.name: {name: (value.value, value.parent) for name, value in mode.parameters.items()}
        for mode in part.modes.values()
    }
