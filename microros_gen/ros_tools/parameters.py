# SPDX-License-Identifier: Apache-2.0
"""Parameters of one node over its services (rcl_interfaces), and parameter files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.yaml_tree import (
    MappingNode,
    ScalarNode,
    SequenceNode,
    YamlNode,
    parse_yaml,
    to_data,
)
from microros_gen.parameter_server.values import (
    BOOL,
    BOOL_ARRAY,
    DOUBLE,
    DOUBLE_ARRAY,
    INTEGER,
    INTEGER_ARRAY,
    NOTHING,
    STRING,
    STRING_ARRAY,
    ParameterValue,
    value_of,
)
from microros_gen.ros.peer import Peer
from microros_gen.ros_tools.calls import ask

TYPE_TEXTS = (
    "not set",
    "boolean",
    "integer",
    "double",
    "string",
    "byte array",
    "boolean array",
    "integer array",
    "double array",
    "string array",
)
"""As the ros2 command line calls the types, by rcl_interfaces/msg/ParameterType."""
_LABELS = ("Boolean", "Integer", "Double", "String", "Byte", "Boolean", "Integer", "Double", "String")
_PARAMETERS = "ros__parameters"
_ANY_NODE = "/**"
_ARRAYS = ((bool, BOOL_ARRAY), (int, INTEGER_ARRAY), (float, DOUBLE_ARRAY), (str, STRING_ARRAY))
_SCALARS = {bool: BOOL, int: INTEGER, float: DOUBLE, str: STRING}
Named = tuple[str, ParameterValue]


class NodeParameters:
    """The parameter services of a node. Calls raise RosError if the node does not answer in time (`calls`)."""

    def __init__(self, peer: Peer, node: str) -> None:
        """Use the services of `node`, a fully qualified name. Clients are created when they are used."""
        self._peer = peer
        self.node = node

    def names(self, prefixes: Sequence[str] = ()) -> list[str]:
        """Return the names of all parameters, or of those with one of the prefixes, sorted."""
        response = self._call("list_parameters", "ListParameters", {"prefixes": list(prefixes), "depth": 0})
        return sorted(response["result"]["names"])

    def values(self, names: Sequence[str]) -> list[ParameterValue]:
        """Return the values in the order of the names: fewer than names if a name is unknown."""
        response = self._call("get_parameters", "GetParameters", {"names": list(names)})
        return [value_of(value) for value in response["values"]]

    def set(self, parameters: Iterable[Named]) -> list[tuple[bool, str]]:
        """Set values, each by itself; return success and reason of each."""
        request = [{"name": name, "value": value.message()} for name, value in parameters]
        response = self._call("set_parameters", "SetParameters", {"parameters": request})
        return [(result["successful"], result["reason"]) for result in response["results"]]

    def describe(self, names: Sequence[str]) -> list[dict[str, Any]]:
        """Return the descriptors (rcl_interfaces/msg/ParameterDescriptor) in the order of the names."""
        response = self._call("describe_parameters", "DescribeParameters", {"names": list(names)})
        return list(response["descriptors"])

    def _call(self, service: str, type_name: str, request: Mapping[str, Any]) -> dict[str, Any]:
        return ask(self._peer, self.node, service, f"rcl_interfaces/srv/{type_name}", request)


def value_from_text(text: str, what: str = "value") -> ParameterValue:
    """Return the value that a YAML text means, as `param set` takes it: what is no other type is a string.

    Raises UserError for YAML that cannot be read, or that is no value of a parameter.
    """
    diagnostics = Diagnostics()
    source = Source(f"<{what}>", text)
    node = parse_yaml(source, diagnostics)
    value = NOTHING if node is None else _value(node, diagnostics)
    diagnostics.check()
    return ParameterValue(STRING, text) if node is None else value


def parameters_of_file(source: Source, node: str, wildcard: bool) -> list[Named]:
    """Return the parameters that a file has for a node; with `wildcard` also those of `/**`, which its own replace.

    Raises UserError for a file of another form, or without parameters for the node.
    """
    diagnostics = Diagnostics()
    root = parse_yaml(source, diagnostics)
    diagnostics.check()
    found: dict[str, ParameterValue] = {}
    names = (*((_ANY_NODE,) if wildcard else ()), node, node.lstrip("/"))
    sections = root.entries if isinstance(root, MappingNode) else {}
    for entry in (sections[name] for name in names if name in sections):
        held = entry.value.get(_PARAMETERS) if isinstance(entry.value, MappingNode) else None
        if not isinstance(held, MappingNode):
            hint = f"Write '{entry.key}: {{{_PARAMETERS}: {{name: value}}}}'"
            diagnostics.error(f"missing key '{_PARAMETERS}'", entry.key_span, hint, id="MG-9814")
        else:
            _collect(held, "", found, diagnostics)
    if not found and not diagnostics.has_errors():
        span = Span(source, 1, 1)
        hint = f"Write '{node}: {{{_PARAMETERS}: {{name: value}}}}'"
        diagnostics.error(f"no parameters for {node}", span, hint, id="MG-9815")
    diagnostics.check()
    return list(found.items())


def dumped(node: str, values: Iterable[Named]) -> dict[str, Any]:
    """Return parameters as data of a parameter file; dots in names separate levels."""
    top: dict[str, Any] = {}
    for name, value in values:
        level, rest = top, name
        while "." in rest:
            part, _, below = rest.partition(".")
            if not isinstance(level.setdefault(part, {}), dict):
                break  # the group has the name of a parameter: the rest keeps its dots
            level, rest = level[part], below
        level[rest] = value.to_json()
    return {node: {_PARAMETERS: top}}


def value_label(value: ParameterValue) -> str:
    """Return what `param get` writes before a value."""
    if not 0 < value.type < len(TYPE_TEXTS):
        return "Parameter not set."
    return f"{_LABELS[value.type - 1]} {'values are' if value.is_array else 'value is'}:"


def descriptor_lines(descriptor: Mapping[str, Any]) -> list[str]:
    """Return the lines of `param describe`."""
    kind = descriptor["type"]
    lines = [f"Parameter name: {descriptor['name']}", f"  Type: {type_text(kind)}"]
    if descriptor["description"]:
        lines.append(f"  Description: {descriptor['description']}")
    lines.append("  Constraints:")
    if descriptor["read_only"]:
        lines.append("    Read only: true")
    for limits in [*descriptor["floating_point_range"], *descriptor["integer_range"]][:1]:
        lines += [f"    Min value: {limits['from_value']}", f"    Max value: {limits['to_value']}"]
        if limits["step"]:
            lines.append(f"    Step: {limits['step']}")
    if descriptor["additional_constraints"]:
        lines.append(f"    Additional constraints: {descriptor['additional_constraints']}")
    return lines


def type_text(kind: int) -> str:
    """Return what the ros2 command line calls a type."""
    return TYPE_TEXTS[kind] if 0 <= kind < len(TYPE_TEXTS) else f"unknown type {kind}"


def _collect(
    node: MappingNode, prefix: str, found: dict[str, ParameterValue], diagnostics: Diagnostics
) -> None:
    for entry in node:
        if isinstance(entry.value, MappingNode):
            _collect(entry.value, f"{prefix}{entry.key}.", found, diagnostics)
        else:
            found[f"{prefix}{entry.key}"] = _value(entry.value, diagnostics)


def _value(node: YamlNode, diagnostics: Diagnostics) -> ParameterValue:
    if isinstance(node, ScalarNode):
        if node.value is None:
            return ParameterValue(STRING, node.text)
        return ParameterValue(_SCALARS[type(node.value)], node.value)
    if isinstance(node, SequenceNode):
        values = [item.value for item in node.items if isinstance(item, ScalarNode)]
        if len(values) == len(node.items):
            kinds = {type(value) for value in values}
            if kinds == {int, float}:
                kinds, values = {float}, [float(value) for value in values]  # type: ignore[arg-type]
            for kind, number in _ARRAYS:
                if kinds == {kind}:
                    return ParameterValue(number, values)
    what = "an empty list has no type" if to_data(node) == [] else "no value of a parameter"
    diagnostics.error(
        what, node.span, "Write a number, true, false, a text, or a list of one of them", id="MG-9816"
    )
    return NOTHING
