# SPDX-License-Identifier: Apache-2.0
"""The C that adds the declared parameters and says what is declared of them."""

from __future__ import annotations

import json
from collections.abc import Iterator

from microros_gen.application.model import ParameterDecl

LONGEST_TEXT = 49
"""Bytes of a name or description without its NUL, as in rclc."""
KINDS = {
    "bool": "bool",
    "integer": "int",
    "double": "double",
    "string": "string",
    "byte[]": "byte_array",
    "bool[]": "bool_array",
    "integer[]": "int_array",
    "double[]": "double_array",
    "string[]": "string_array",
}
"""Type in the application file → as functions and constants of rclc call it."""
C_TYPES = {
    "byte": "uint8_t ",
    "bool": "bool ",
    "integer": "int64_t ",
    "double": "double ",
    "string": "char * ",
}


def string_limit(parameter: ParameterDecl) -> int:
    """Return the most bytes of a string, without the NUL."""
    texts = [parameter.default or "", *parameter.one_of]
    return parameter.size or max(LONGEST_TEXT, *(len(str(text).encode()) for text in texts))


def texts_of(parameter: ParameterDecl) -> tuple[str, str]:
    """Return the description and the constraints that other nodes read; a range is not among them."""
    values = ", ".join(str(value) for value in parameter.one_of)
    return parameter.shown, f"one of: {values}" if values else ""


def tables(parameters: tuple[ParameterDecl, ...], symbol: str) -> Iterator[str]:
    """Yield the constants that `one_of` needs, each with the symbol of the server and the number of its parameter."""
    for index, parameter in enumerate(parameters):
        if parameter.one_of:
            values = ", ".join(_literal(value, parameter.type) for value in parameter.one_of)
            star = "const " if parameter.type == "string" else ""
            yield f"static const {C_TYPES[parameter.type]}{star}{symbol}_values_{index}[] = {{{values}}};"


def calls(parameters: tuple[ParameterDecl, ...], symbol: str) -> Iterator[str]:
    """Yield the calls in their order."""
    for index, parameter in enumerate(parameters):
        kind, name = KINDS[parameter.type], _text(parameter.name)
        yield f"rclc_add_parameter(parameter_server, {name}, RCLC_PARAMETER_{kind.upper()})"
        if parameter.type == "string":
            yield f"rclc_add_parameter_constraint_string(parameter_server, {name}, {string_limit(parameter)})"
        if parameter.is_array:
            yield f"rclc_add_parameter_constraint_array(parameter_server, {name}, {parameter.size})"
        if parameter.default not in (None, ()):
            yield f"rclc_parameter_set_{kind}(parameter_server, {name}, {_value(parameter)})"
        if parameter.one_of:
            values = f"{symbol}_values_{index}, {len(parameter.one_of)}"
            yield f"rclc_add_parameter_constraint_one_of_{kind}(parameter_server, {name}, {values})"
        yield from _descriptions(parameter, name)


def _descriptions(parameter: ParameterDecl, name: str) -> Iterator[str]:
    description, constraints = texts_of(parameter)
    if description or constraints:
        yield f"rclc_add_parameter_description(parameter_server, {name}, {_text(description)}, {_text(constraints)})"
    if parameter.minimum is not None and parameter.maximum is not None:
        ends = (parameter.minimum, parameter.maximum, parameter.step or 0)
        numbers = ", ".join(_literal(end, parameter.type) for end in ends)
        yield f"rclc_add_parameter_constraint_{parameter.type}(parameter_server, {name}, {numbers})"
    if parameter.read_only:
        yield f"rclc_set_parameter_read_only(parameter_server, {name}, true)"


def _value(parameter: ParameterDecl) -> str:
    value = parameter.default
    if isinstance(value, tuple):
        kind = parameter.type.removesuffix("[]")
        elements = ", ".join(_literal(element, kind) for element in value)
        return f"(const {C_TYPES[kind].strip()}[]){{{elements}}}, {len(value)}"
    assert value is not None
    return _literal(value, parameter.type)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _literal(value: bool | int | float | str, kind: str) -> str:
    if isinstance(value, str):
        return _text(value)
    if kind == "bool":
        return "true" if value else "false"
    if kind == "byte":
        return f"{int(value)}u"
    if kind == "integer":
        return "INT64_MIN" if value == -(2**63) else str(value)
    return repr(float(value))
