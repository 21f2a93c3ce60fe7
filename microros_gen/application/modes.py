# SPDX-License-Identifier: Apache-2.0
"""`modes:` of a node → modes with values of its parameters, each of which the parameter accepts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from microros_gen.application.mode_decl import DEFAULT_MODE, ModeDecl, ModeValue, Value
from microros_gen.application.model import NodeDecl, ParameterDecl
from microros_gen.application.parameter_validation import check_rules
from microros_gen.application.parameters import check_value, value_of
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, YamlNode

MOST_MODES = 250
_TEMPLATE = re.compile(r"\$\(parent ([A-Za-z_][\w./]*)\)")


def parse_modes(tree: YamlNode | None, diagnostics: Diagnostics) -> tuple[ModeDecl, ...]:
    """Return the modes of a node, `__DEFAULT__` first, also if it is not written; without modes nothing.

    Values without a text are errors at their places; whether parameters exist and accept them is `check_modes`.
    """
    if not isinstance(tree, MappingNode):
        return ()
    modes = [ModeDecl(e.key, tuple(_values(e.value, "", diagnostics)), e.key_span) for e in tree]
    if len(modes) > MOST_MODES:
        message = f"a node has {len(modes)} modes, {MOST_MODES} at most"
        diagnostics.error(message, tree.span, "Remove some", id="MG-3101")
    if not any(mode.name == DEFAULT_MODE for mode in modes):
        modes.insert(0, ModeDecl(DEFAULT_MODE, (), tree.span))
    return tuple(sorted(modes, key=lambda mode: mode.name != DEFAULT_MODE))


def _values(node: YamlNode, group: str, diagnostics: Diagnostics) -> Iterator[ModeValue]:
    for entry in node if isinstance(node, MappingNode) else ():
        name = f"{group}{entry.key}"
        if isinstance(entry.value, MappingNode):
            yield from _values(entry.value, f"{name}.", diagnostics)
        else:
            yield _value(name, entry, diagnostics)


def _value(name: str, entry: Entry, diagnostics: Diagnostics) -> ModeValue:
    node = entry.value
    template = _TEMPLATE.fullmatch(node.text) if isinstance(node, ScalarNode) else None
    if template:
        return ModeValue(name, None, node.span, entry.key_span, template[1])
    value = value_of(node)
    if value is None:
        message = f"the parameter '{name}' has no value"
        diagnostics.error(message, node.span, "Write a value, or remove it", id="MG-3102")
    return ModeValue(name, value, node.span, entry.key_span)


def set_parameters(node: NodeDecl) -> tuple[ParameterDecl, ...]:
    """Return the parameters that a mode of the node sets, in the order of their declarations."""
    named = {value.parameter for mode in node.modes for value in mode.values}
    return tuple(parameter for parameter in node.parameters if parameter.name in named)


def value_in(node: NodeDecl, mode: ModeDecl, parameter: ParameterDecl) -> ModeValue | None:
    """Return what a mode says of a parameter, else `__DEFAULT__`; None: neither, it is the parameter's default."""
    own = mode.value(parameter.name)
    return own if own is not None else node.modes[0].value(parameter.name)


def start_value(parameter: ParameterDecl) -> Value:
    """Return the value of a parameter when its node starts: 0 or empty without a default."""
    if parameter.default is not None:
        return parameter.default
    if parameter.is_array:
        return ()
    return {"bool": False, "integer": 0, "double": 0.0}.get(parameter.type, "")


def check_modes(node: NodeDecl, diagnostics: Diagnostics) -> None:
    """Report values in modes that the node's parameters do not accept; its parameter file has been read."""
    declared = {parameter.name: parameter for parameter in node.parameters}
    unknown: set[str] = set()
    for mode in node.modes:
        for value in mode.values:
            parameter = declared.get(value.parameter)
            if parameter is not None:
                _check_value(mode, parameter, value, diagnostics)
            elif value.parameter not in unknown:
                unknown.add(value.parameter)
                _report_unknown(node, value, declared, diagnostics)
    if node.modes and not any(mode.values for mode in node.modes):
        message = f"the modes of '{node.name}' set no parameter"
        diagnostics.error(message, node.modes[0].span, "Write a value of a parameter", id="MG-3103")


def _report_unknown(
    node: NodeDecl, value: ModeValue, declared: Mapping[str, ParameterDecl], diagnostics: Diagnostics
) -> None:
    message = f"the node '{node.name}' has no parameter '{value.parameter}'"
    hint = nearest(value.parameter, declared) or "Declare it below `parameters:`"
    diagnostics.error(message, value.name_span, hint, id="MG-3104")


def _check_value(
    mode: ModeDecl, parameter: ParameterDecl, value: ModeValue, diagnostics: Diagnostics
) -> None:
    if parameter.read_only:
        message = f"the parameter '{parameter.name}' is read-only, and the mode '{mode.name}' sets it"
        hint = "Remove it from the modes, or `read_only`"
        diagnostics.error(message, value.name_span, hint, id="MG-3105")
        return
    if value.value is None:
        return
    found = Diagnostics()
    what = f"the value of the parameter '{parameter.name}'"
    check_value(parameter, value.value, value.span, what, found)
    if not found.has_errors():
        check_rules(parameter, value.value, value.span, what, found)
    diagnostics.extend(found)
    if mode.name == DEFAULT_MODE and not found.has_errors():
        _check_default(parameter, value.value, value.span, diagnostics)


def _check_default(parameter: ParameterDecl, value: Value, span: Span, diagnostics: Diagnostics) -> None:
    """Report a value of `__DEFAULT__`, in which a node begins, that is not the one the parameter begins with."""
    start = start_value(parameter)
    if value != start:
        shown = list(start) if isinstance(start, tuple) else start
        message = (
            f"the parameter '{parameter.name}' begins with {shown!r}, and has another value in {DEFAULT_MODE}"
        )
        hint = "Write this value as its `default`, or remove it here"
        diagnostics.error(message, span, hint, id="MG-3106")
