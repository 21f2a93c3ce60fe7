# SPDX-License-Identifier: Apache-2.0
"""A file of generate_parameter_library → declarations of parameters.

https://github.com/PickNikRobotics/generate_parameter_library describes the format. What a device does not check is an
error at its place, so that no file is accepted with less than it says.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from microros_gen.application.model import ParameterDecl
from microros_gen.application.parameters import Places, check_declaration, scalar_of, value_of
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.tree_values import bool_of, child, entries, items, number_of, span_of, text_of
from microros_gen.documents.yaml_tree import Entry, MappingNode, YamlNode, parse_yaml

_TYPES: Mapping[str, str] = {
    "bool": "bool",
    "int": "integer",
    "double": "double",
    "string": "string",
    "bool_array": "bool[]",
    "int_array": "integer[]",
    "double_array": "double[]",
    "string_array": "string[]",
}
_ONLY_DOCUMENTED = "none"
_FIXED = re.compile(r"(string|(?:bool|int|double|string)_array)_fixed_([0-9]{1,6})")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_KEYS = ("type", "default_value", "description", "read_only", "validation", "additional_constraints")
_NUMBERS = ("integer", "double")
_ENDS = {"integer": (-(2**63), 2**63 - 1), "double": (-sys.float_info.max, sys.float_info.max)}
"""Ends of a range that is open at the other one."""


@reads
def parse_parameter_file(source: Source, diagnostics: Diagnostics) -> tuple[ParameterDecl, ...]:
    """Return what the file declares, in its order; groups are names with dots."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    roots = entries(tree)
    if not found.has_errors() and (len(roots) != 1 or not isinstance(roots[0].value, MappingNode)):
        found.error(
            "a file of generate_parameter_library has one key, with the parameters below it",
            span_of(tree) or Span(source, 1, 1),
            "Write `motor:` above them, and indent them",
            id="MG-3064",
        )
    else:
        declared = tuple(p for root in roots for p in _group(root.value, "", found))
    diagnostics.extend(found)
    return () if found.has_errors() else declared


def _group(node: YamlNode, prefix: str, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
    for entry in entries(node):
        name = f"{prefix}{entry.key}"
        if not _NAME.fullmatch(entry.key) or entry.key.startswith("__map_"):
            message = (
                f"'{entry.key}' is no name of a parameter: one for each value of another is not supported"
            )
            if not entry.key.startswith("__map_"):
                message = f"'{entry.key}' is no name of a parameter"
            diagnostics.error(message, entry.key_span, "Write each name out, such as motor_1", id="MG-3065")
        elif text_of(child(entry.value, "type")) is not None:
            yield from _leaf(entry, name, diagnostics)
        elif isinstance(entry.value, MappingNode):
            yield from _group(entry.value, f"{name}.", diagnostics)
        else:
            message = f"'{name}' has no type"
            diagnostics.error(message, entry.key_span, f"Write {entry.key}: {{type: int}}", id="MG-3066")


def _leaf(entry: Entry, name: str, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
    node = entry.value
    _check_keys(node, diagnostics)
    kind_node, default = child(node, "type"), child(node, "default_value")
    type_text = text_of(kind_node) or ""
    fixed = _FIXED.fullmatch(type_text)
    kind = _TYPES.get(fixed.group(1) if fixed else type_text)
    if type_text == _ONLY_DOCUMENTED:
        return
    if kind is None:
        hint = f"Available: {', '.join(_TYPES)}, with _fixed_8 behind strings and arrays"
        message = f"the type '{type_text}' of '{name}' is not supported"
        diagnostics.error(message, span_of(kind_node), hint, id="MG-3067")
        return
    if default is None:
        message = f"'{name}' has no default_value, and nothing sets parameters when a device starts"
        diagnostics.error(message, entry.key_span, "Write default_value:", id="MG-3068")
        return
    parameter = ParameterDecl(
        name=name,
        type=kind,
        default=value_of(default),
        description=text_of(child(node, "description")) or "",
        read_only=bool_of(child(node, "read_only")) or False,
        span=entry.key_span,
        size=int(fixed.group(2)) if fixed else None,
        constraints=text_of(child(node, "additional_constraints")) or "",
    )
    validation = child(node, "validation")
    for rule in entries(validation):
        parameter = _ruled(parameter, rule, diagnostics)
    if parameter.is_array and not parameter.size:
        message = f"the array '{name}' has no largest size"
        hint = f"Write type: {type_text}_fixed_8, or validation: {{size_lt<>: [9]}}"
        diagnostics.error(message, entry.key_span, hint, id="MG-3069")
        return
    bounds = span_of(validation) if parameter.minimum is not None else None
    choices = items(child(validation, "one_of<>"))
    check_declaration(parameter, Places(default, bounds, choices[0] if choices else None), diagnostics)
    yield parameter


def _check_keys(node: YamlNode, diagnostics: Diagnostics) -> None:
    for entry in entries(node):
        if entry.key not in _KEYS:
            hint = f"Remove it; available: {', '.join(_KEYS)}"
            message = f"'{entry.key}' of a parameter is not supported"
            diagnostics.error(message, entry.key_span, hint, id="MG-3070")
    for key in ("description", "additional_constraints"):
        _check_kind(child(node, key), text_of, "a text", diagnostics)
    _check_kind(child(node, "read_only"), bool_of, "true or false", diagnostics)
    validation = child(node, "validation")
    if validation is not None and not isinstance(validation, MappingNode):
        message = "'validation' must be a mapping of rules"
        diagnostics.error(message, validation.span, "Write {bounds<>: [0, 10]}", id="MG-3074")


def _check_kind(
    node: YamlNode | None, read: Callable[[YamlNode], object], what: str, diagnostics: Diagnostics
) -> None:
    if node is not None and read(node) is None:
        diagnostics.error(f"this value must be {what}", node.span, f"Write {what}", id="MG-3075")


def _ruled(parameter: ParameterDecl, rule: Entry, diagnostics: Diagnostics) -> ParameterDecl:
    """Return the parameter with a rule of its validation."""
    name = rule.key.removesuffix("<>")
    apply = _RULES.get(name)
    if apply is None or not rule.key.endswith("<>"):
        known = ", ".join(f"{known}<>" for known in _RULES)
        message = f"a device does not check '{rule.key}'"
        diagnostics.error(
            message, rule.key_span, f"Check it in the callback; available: {known}", id="MG-3071"
        )
        return parameter
    ruled = apply(parameter, rule.value)
    if ruled is None:
        message = f"'{rule.key}' does not fit '{parameter.name}' of type {parameter.type}"
        diagnostics.error(message, rule.value.span, _hint(name), id="MG-3072")
    return ruled or parameter


def _hint(name: str) -> str:
    if name in ("gt", "lt"):
        return f"Write {name}_eq<>: a range of floating-point numbers has its ends"
    return "Write bounds<>: [0, 10], gt_eq<>: [0], one_of<>: [[1, 2]] or size_lt<>: [9]"


def _numbers(parameter: ParameterDecl, node: YamlNode, count: int) -> list[int | float] | None:
    """Return the arguments of a rule for numbers; None where they are others."""
    found = [number_of(item) for item in items(node)]
    numbers = [n for n in found if n is not None]
    return numbers if parameter.type in _NUMBERS and len(numbers) == len(found) == count else None


def _within(
    parameter: ParameterDecl, low: int | float | None = None, high: int | float | None = None
) -> ParameterDecl:
    """Return the parameter with a range that these ends make narrower."""
    first, last = _ENDS[parameter.type]
    lows = [n for n in (parameter.minimum, low) if n is not None]
    highs = [n for n in (parameter.maximum, high) if n is not None]
    return replace(parameter, minimum=max(lows, default=first), maximum=min(highs, default=last))


def _bounds(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 2)
    return None if numbers is None else _within(parameter, *numbers)


def _low(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return None if numbers is None else _within(parameter, low=numbers[0])


def _high(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return None if numbers is None else _within(parameter, high=numbers[0])


def _above(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return (
        None
        if numbers is None or parameter.type != "integer"
        else _within(parameter, low=int(numbers[0]) + 1)
    )


def _below(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = _numbers(parameter, node, 1)
    return (
        None
        if numbers is None or parameter.type != "integer"
        else _within(parameter, high=int(numbers[0]) - 1)
    )


def _one_of(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    lists = items(node)
    values = [v for v in map(scalar_of, items(lists[0]) if len(lists) == 1 else ()) if v is not None]
    return replace(parameter, one_of=tuple(values)) if values else None


def _size_lt(parameter: ParameterDecl, node: YamlNode) -> ParameterDecl | None:
    numbers = [number_of(item) for item in items(node)]
    if len(numbers) != 1 or not isinstance(numbers[0], int) or numbers[0] < 2:
        return None
    if not (parameter.is_array or parameter.type == "string"):
        return None
    sizes = [n for n in (parameter.size, numbers[0] - 1) if n is not None]
    return replace(parameter, size=min(sizes))


_RULES: Mapping[str, Callable[[ParameterDecl, YamlNode], ParameterDecl | None]] = {
    "bounds": _bounds,
    "gt": _above,
    "lt": _below,
    "gt_eq": _low,
    "lt_eq": _high,
    "lower_bounds": _low,
    "upper_bounds": _high,
    "one_of": _one_of,
    "size_lt": _size_lt,
}
"""What a device checks: the rule without its `<>`; None: the arguments do not fit the parameter."""
