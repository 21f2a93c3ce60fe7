# SPDX-License-Identifier: Apache-2.0
"""The constants of C that say what is declared of parameters."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.model import ParameterDecl, ParameterRule
from microros_gen.application.parameter_rules import words_of
from microros_gen.typesupport.views.text import string

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

_RULES = {
    "element_bounds": "WITHIN",
    "fixed_size": "SIZE_IS",
    "gt": "ABOVE",
    "lower_element_bounds": "FROM",
    "lt": "BELOW",
    "not_empty": "SIZE_ABOVE",
    "one_of": "LISTED",
    "size_gt": "SIZE_ABOVE",
    "size_lt": "SIZE_BELOW",
    "subset_of": "LISTED",
    "unique": "UNIQUE",
    "upper_element_bounds": "TO",
}
"""Rule of generate_parameter_library → what the device checks."""


def string_limit(parameter: ParameterDecl) -> int:
    """Return the most bytes of a string, without the NUL."""
    texts = [parameter.default or "", *parameter.one_of]
    return parameter.size or max(LONGEST_TEXT, *(len(str(text).encode()) for text in texts))


def texts_of(parameter: ParameterDecl) -> tuple[str, str]:
    """Return the description and the constraints that other nodes read; a range is not among them."""
    values = ", ".join(str(value) for value in parameter.one_of)
    constraints = (f"one of: {values}" if values else "", parameter.constraints)
    return parameter.shown, "; ".join(text for text in constraints if text)


def tables(parameters: tuple[ParameterDecl, ...], symbol: str) -> Iterator[str]:
    """Yield the constants that `entries` point to, each with the number of its parameter."""
    for index, parameter in enumerate(parameters):
        if parameter.one_of:
            values = ", ".join(_literal(value, parameter.type) for value in parameter.one_of)
            star = "const " if parameter.type == "string" else ""
            yield f"static const {C_TYPES[parameter.type]}{star}{symbol}_values_{index}[] = {{{values}}};"
        if _has_range(parameter):
            ends = (parameter.minimum, parameter.maximum, parameter.step or 0)
            numbers = ", ".join(_literal(end, parameter.type) for end in ends if end is not None)
            member = "integer" if parameter.type == "integer" else "floating_point"
            yield f"static const rclc_parameter_range_t {symbol}_range_{index} = {{.{member} = {{{numbers}}}}};"
        yield from _rule_tables(parameter, symbol, index)
        yield from start_table(parameter, f"{symbol}_start_{index}")


def entries(parameters: tuple[ParameterDecl, ...], symbol: str) -> Iterator[str]:
    """Yield the initializers of `rclc_parameter_declared_t`, in their order."""
    for index, parameter in enumerate(parameters):
        about = ", ".join(_about(parameter, symbol, index))
        parts = [f".about = {{{about}}}", f".type = RCLC_PARAMETER_{KINDS[parameter.type].upper()}"]
        if parameter.default not in (None, ()):
            parts += [".has_value = true", start_value_of(parameter, f"{symbol}_start_{index}")]
        parts += [".read_only = true"] if parameter.read_only else []
        yield f"{{{', '.join(parts)}}}"


def has_floating_range(parameters: tuple[ParameterDecl, ...]) -> bool:
    """Return whether the code for ranges of doubles is needed."""
    return any(_has_range(parameter) and parameter.type == "double" for parameter in parameters)


def rules_of(parameters: tuple[ParameterDecl, ...]) -> int:
    """Return which rules are needed: 2 with those of doubles, 1 without, 0 none."""
    return max((1 + _compares_doubles(p, rule) for p in parameters for rule in p.rules), default=0)


def _compares_doubles(parameter: ParameterDecl, rule: ParameterRule) -> bool:
    return parameter.type.removesuffix("[]") == "double" and not _RULES[rule.name].startswith("SIZE")


def _rule_tables(parameter: ParameterDecl, symbol: str, index: int) -> Iterator[str]:
    """Yield the values of the rules of a parameter, then the rules."""
    kind = parameter.type.removesuffix("[]")
    rows = []
    for number, rule in enumerate(parameter.rules):
        name, count = f"{symbol}_rule_{index}_{number}", len(rule.values)
        if _RULES[rule.name].startswith("SIZE"):
            values, count = "", int(rule.values[0]) if rule.values else 0
        elif not rule.values:
            values = ""
        elif rule.values == parameter.one_of:
            values = f", .values = {symbol}_values_{index}"
        else:
            literals = ", ".join(_literal(value, kind) for value in rule.values)
            star = "const " if kind == "string" else ""
            yield f"static const {C_TYPES[kind]}{star}{name}[] = {{{literals}}};"
            values = f", .values = {name}"
        words = _texts(*words_of(rule))
        kind_name = f"(uint8_t)PARAMETER_RULE_{_RULES[rule.name]}"
        rows.append(f"{{.words = {words}{values}, .count = {count}u, .kind = {kind_name}}}")
    if rows:
        yield f"static const rclc_parameter_rule_t {symbol}_rules_{index}[] = {{{', '.join(rows)}}};"


def _has_range(parameter: ParameterDecl) -> bool:
    return parameter.minimum is not None and parameter.maximum is not None


def start_table(parameter: ParameterDecl, name: str) -> Iterator[str]:
    """Yield the constant `name` with the default of a parameter, if it is a text or an array with elements."""
    if _has_table(parameter):
        yield f"static const {_start(parameter, name)};"


def _has_table(parameter: ParameterDecl) -> bool:
    """Return whether the value at the start is no scalar."""
    return parameter.default not in (None, ()) and (parameter.is_array or parameter.type == "string")


def _about(parameter: ParameterDecl, symbol: str, index: int) -> Iterator[str]:
    yield f".name = {string(parameter.name)}"
    description, constraints = texts_of(parameter)
    if description or constraints:
        yield f".texts = {_texts(description, constraints)}"
    if _has_range(parameter):
        yield f".range = &{symbol}_range_{index}"
    if parameter.one_of:
        yield f".one_of = {symbol}_values_{index}, .one_of_count = {len(parameter.one_of)}u"
    if parameter.rules:
        yield f".rules = {symbol}_rules_{index}, .rules_count = {len(parameter.rules)}u"
    if parameter.type == "string":
        yield f".string_most = {string_limit(parameter)}u"
    if parameter.is_array:
        yield f".array_most = {parameter.size}u"


def _start(parameter: ParameterDecl, name: str) -> str:
    """Return the declaration of the value at the start; strings of an array follow each other, each with its NUL."""
    value, kind = parameter.default, parameter.type.removesuffix("[]")
    if not isinstance(value, tuple):
        return f"char {name}[] = {string(str(value))}"
    if kind == "string":
        return f"char {name}[] = {_texts(*map(str, value))}"
    return f"{C_TYPES[kind]}{name}[] = {{{', '.join(_literal(element, kind) for element in value)}}}"


def start_value_of(parameter: ParameterDecl, start: str) -> str:
    """Return the members of a value with its default, which must be there; `start` names the constant."""
    value = parameter.default
    if _has_table(parameter):
        count = f", .start_count = {len(value)}u" if isinstance(value, tuple) else ""
        return f".start = {start}, .start_bytes = (uint32_t)sizeof({start}){count}"
    assert value is not None
    assert not isinstance(value, tuple)
    return f".value = {{.{parameter.type}_value = {_literal(value, parameter.type)}}}"


def _texts(*texts: str) -> str:
    """Return one literal of several texts, each with its NUL: in parts, as no digit may follow that escape."""
    *before, last = map(string, texts)
    return " ".join((*(rf'{text[:-1]}\0"' for text in before), last))


def _literal(value: bool | int | float | str, kind: str) -> str:
    if isinstance(value, str):
        return string(value)
    if kind == "bool":
        return "true" if value else "false"
    if kind == "byte":
        return f"{int(value)}u"
    if kind == "integer":
        return "INT64_MIN" if value == -(2**63) else str(value)
    return repr(float(value))
