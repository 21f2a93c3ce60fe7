# SPDX-License-Identifier: Apache-2.0
"""Whether the nodes of application files declare the parameters that modes set, and accept their values."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from microros_gen.application.model import NodeDecl, ParameterDecl
from microros_gen.application.parameter_refusals import Cause, Refusal, refusals
from microros_gen.application.parameter_validation import check_rules
from microros_gen.diagnostics import Diagnostic, Diagnostics, Span, nearest
from microros_gen.modes.model import DEFAULT, Model, Part, Value
from microros_gen.modes.report import PROVEN, REFUTED, Property
from microros_gen.modes.templates import possible_values


def check_parameters(model: Model, nodes: Iterable[NodeDecl], diagnostics: Diagnostics) -> Property:
    """Report parameters and values that a node of `nodes` would refuse.

    Nodes of the model that are not among `nodes` have the types that `__DEFAULT__` gives, which was checked before.
    """
    declared = {f"{node.namespace}/{node.name}".strip("/"): node for node in nodes}
    found = Diagnostics()
    known = [part for part in model.nodes if part.name in declared]
    for part in known:
        parameters = {p.name: p for p in declared[part.name].parameters}
        for span, diagnostic in _node_faults(model, part, parameters):
            found.add(_placed(diagnostic, span))
    for name, node in declared.items():
        if not known:
            message = f"the node '/{name}' of the application is not in the model"
            hint = (
                nearest(name, (part.name for part in model.nodes)) or "Add it, or leave the application out"
            )
            found.error(message, node.name_span or node.span, hint, id="MG-8851")
    diagnostics.extend(sorted(found, key=lambda d: (d.span.line, d.span.column) if d.span else (0, 0)))
    others = len(model.nodes) - len(known)
    detail = f"nodes as in application files: {len(known)}, as in {DEFAULT}: {others}"
    return Property("parameters", REFUTED if found.has_errors() else PROVEN, detail)


def _placed(diagnostic: Diagnostic, span: Span) -> Diagnostic:
    return Diagnostic(diagnostic.message, span, diagnostic.hint, id=diagnostic.id)


def _node_faults(
    model: Model, part: Part, parameters: Mapping[str, ParameterDecl]
) -> Iterator[tuple[Span, Diagnostic]]:
    unknown: set[str] = set()
    for mode in part.modes.values():
        for name in mode.parameters:
            if name not in parameters:
                if name not in unknown:
                    message = f"the node '{part.name}' does not declare the parameter '{name}'"
                    hint = nearest(name, parameters) or "Declare it in the application file"
                    yield mode.parameters[name].name_span, Diagnostic(message, hint=hint, id="MG-8852")
                unknown.add(name)
                continue
            for value in possible_values(model, part, mode.name, name):
                fault = next(_refusals(parameters[name], value), None)
                if fault is not None:
                    yield value.span, fault


def _refusals(parameter: ParameterDecl, value: Value) -> Iterator[Diagnostic]:
    """Yield why a node refuses a value."""
    what = f"the value of the parameter '{parameter.name}'"
    if not _has_type(parameter.type, value):
        hint = f"Write a value of type {parameter.type}"
        yield Diagnostic(
            f"{what} is of type {value.type}, the node declares {parameter.type}", hint=hint, id="MG-8853"
        )
        return
    if parameter.read_only and value.value != parameter.default:
        message = f"the parameter '{parameter.name}' is read-only in the node, and a mode changes it"
        yield Diagnostic(message, hint="Leave it out of the modes", id="MG-8854")
    if value.value is None:
        return
    for refusal in refusals(parameter, value.value):
        yield _refused(refusal, what, value)
    found = Diagnostics()
    check_rules(parameter, value.value, value.span, what, found)
    yield from found


def _refused(refusal: Refusal, what: str, value: Value) -> Diagnostic:
    number, hint = value.value, refusal.hint
    if refusal.cause is Cause.RANGE:
        return Diagnostic(f"{what}, {number}, is out of the node's range", hint=hint, id="MG-8855")
    if refusal.cause is Cause.STEP:
        message = f"{what}, {number}, is between two steps of the node's range"
        return Diagnostic(message, hint=hint, id="MG-8856")
    if refusal.cause is Cause.SIZE:
        hint = f"{hint} in the application file"
        return Diagnostic(f"{what} is longer than its storage in the node", hint=hint, id="MG-8857")
    return Diagnostic(f"{what} is none of those that the node accepts", hint=hint, id="MG-8858")


def _has_type(declared: str, value: Value) -> bool:
    if declared in ("byte", "byte[]"):  # a list of small integers in YAML
        elements = value.value if isinstance(value.value, tuple) else (value.value,)
        return value.type == declared.replace("byte", "integer") and all(
            isinstance(e, int) and 0 <= e <= 255 for e in elements
        )
    return declared == value.type
