# SPDX-License-Identifier: Apache-2.0
"""What to write instead of a value or a type that a parameter does not have, in the words of the file that it is in."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping

from microros_gen.application.model import ParameterDecl, ParameterRule, Scalar
from microros_gen.application.parameter_rules import refusal
from microros_gen.documents.tree_values import items
from microros_gen.documents.yaml_tree import ScalarNode, SequenceNode, YamlNode, to_data

_LISTS: Mapping[str, str] = {
    "bool": "[true, false]",
    "byte": "[0, 255]",
    "integer": "[1, 2]",
    "double": "[0.5, 1.0]",
    "string": "[a, b]",
}
_SIZES: Mapping[str, int] = {"fixed_size": 0, "size_gt": 1, "size_lt": -1, "not_empty": 0}
"""What is added to the number of a rule for the size closest to it."""
_LARGEST_INTEGER = 2**63 - 1
_LIBRARY_NAMES = {bool: "bool", int: "int", float: "double", str: "string"}
_MEANT = {
    r"bool(ean)?s?": "bool",
    r"u?int(eger)?s?[0-9]*|(unsigned_?)?(short|long|char|byte)s?": "int",
    r"(float|double|real)s?[0-9]*|number": "double",
    r"str(ing)?s?|text": "string",
}
_LIST = re.compile(r"(.*?)(_array|_list|\[\])?(?:_fixed_([0-9]+))?")


def type_hint(parameter: ParameterDecl, value: Scalar | tuple[Scalar, ...], library: bool) -> str:
    """Return what to do about a value of another type; `library`: in a file of generate_parameter_library."""
    kind = parameter.type.removesuffix("[]")
    if parameter.is_array:
        return f"Write a list of values of type {kind}, such as {_LISTS.get(kind, '[]')}"
    if kind == "bool":
        return "Write true or false"
    if isinstance(value, tuple):
        return f"Write {_list_of(kind, max(len(value), 1), library)}, or a single value"
    return _scalar_hint(kind, value)


def rule_hint(parameter: ParameterDecl, value: Scalar | tuple[Scalar, ...], reason: str) -> str:
    """Return a value close to `value` that follows all rules, and the reason why this one does not."""
    found: Scalar | tuple[Scalar, ...] = value
    for rule in parameter.rules:
        if refusal(rule, parameter.name, found):
            found = _following(rule, found)
    if any(refusal(rule, parameter.name, found) for rule in parameter.rules):
        return f"Write another value: {reason}"
    return f"Write {json.dumps(found, ensure_ascii=False)}: {reason}"


def _following(rule: ParameterRule, value: Scalar | tuple[Scalar, ...]) -> Scalar | tuple[Scalar, ...]:
    """Return a value that follows a rule, where there is one close to `value`."""
    if rule.name in ("gt", "lt") and not isinstance(value, (str, tuple)):
        (end,) = rule.values
        return end if isinstance(end, str) else end + (1 if rule.name == "gt" else -1)
    if rule.name == "unique" and isinstance(value, tuple):
        return tuple(dict.fromkeys(value))
    if rule.name in ("fixed_size", "size_gt", "size_lt", "not_empty"):
        return _resized(value, _SIZES[rule.name] + int(rule.values[0] if rule.values else 1))
    if isinstance(value, tuple):
        return tuple(_element(rule, element) for element in value)
    return _element(rule, value)


def _resized(value: Scalar | tuple[Scalar, ...], size: int) -> Scalar | tuple[Scalar, ...]:
    if isinstance(value, str):
        return value[:size].ljust(size, value[-1:] or "x")
    if isinstance(value, tuple) and value:
        return (*value[:size], *[value[-1]] * (size - len(value)))
    return value


def _element(rule: ParameterRule, element: Scalar) -> Scalar:
    """Return what an element is to be that follows a rule."""
    if rule.name in ("one_of", "subset_of"):
        return element if element in rule.values else rule.values[0]
    bounds = [bound for bound in rule.values if not isinstance(bound, str)]
    if isinstance(element, str) or not bounds:
        return element
    if rule.name != "upper_element_bounds":
        element = max(element, bounds[0])
    return element if rule.name == "lower_element_bounds" else min(element, bounds[-1])


def scalar_hint(kind: str, value: Scalar | None) -> str:
    """Return what to write instead of a value that is not of the type `kind`."""
    return "Write a value" if value is None else _scalar_hint(kind, value)


def _scalar_hint(kind: str, value: Scalar) -> str:
    if kind == "string":
        return f"Put it into quotes: {json.dumps(_yaml(value))}"
    if isinstance(value, bool):
        return f"Write {int(value)}, or type: bool"
    if isinstance(value, str):
        number = re.fullmatch(r"[-+]?[0-9]+" if kind == "integer" else r"[-+]?[0-9]+([.][0-9]*)?", value)
        return f"Remove the quotes: {value}" if number else "Write a number such as 1, or type: string"
    if isinstance(value, int):
        nearest = _LARGEST_INTEGER if value > 0 else -_LARGEST_INTEGER - 1
        return f"Write {nearest}, or type: double"
    whole = abs(value) < _LARGEST_INTEGER
    return f"Write {round(value)}, or type: double" if whole else "Write type: double"


def _yaml(value: Scalar) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _list_of(kind: str, size: int, library: bool) -> str:
    """Return the keys that make a parameter an array of a type."""
    if library:
        return f"type: {_LIBRARY_NAMES[int] if kind == 'integer' else kind}_array_fixed_{size}"
    return f'type: "{kind}[]", size: {size}'


def size_hint(parameter: ParameterDecl, size: int) -> str:
    """Return which part of a declaration in a file of generate_parameter_library makes room for `size`."""
    for rule in parameter.rules:
        if rule.name == "size_lt" and isinstance(rule.values[0], int) and rule.values[0] <= size:
            return f"Write size_lt<>: [{size + 1}]"
        if rule.name == "fixed_size" and isinstance(rule.values[0], int) and rule.values[0] < size:
            return f"Write fixed_size<>: [{size}]"
    kind = parameter.type.removesuffix("[]")
    name = _LIBRARY_NAMES[int] if kind == "integer" else kind
    return f"Write type: {name}{'_array' if parameter.is_array else ''}_fixed_{size}"


def library_type(text: str) -> str | None:
    """Return the type of generate_parameter_library that somebody meant who wrote another one; None: unknown."""
    found = _LIST.fullmatch(text)
    if found is None:
        return None
    base = next((kind for pattern, kind in _MEANT.items() if re.fullmatch(pattern, found[1].lower())), None)
    if base is None:
        return None
    return (
        f"{base}_array_fixed_{found[3] or 8}"
        if found[2]
        else f"{base}_fixed_{found[3]}"
        if found[3]
        else base
    )


def library_type_of(value: YamlNode) -> str:
    """Return the type that a value has in such a file."""
    if isinstance(value, SequenceNode):
        kinds = {type(part.value) for part in items(value) if isinstance(part, ScalarNode)}
        kind = float if kinds == {int, float} else next(iter(kinds)) if len(kinds) == 1 else str
        return f"{_LIBRARY_NAMES.get(kind, 'string')}_array_fixed_{max(len(value.items), 1)}"
    return _LIBRARY_NAMES.get(type(value.value), "int") if isinstance(value, ScalarNode) else "int"


def library_declaration(name: str, value: YamlNode | None) -> str:
    """Return the declaration of a parameter of which there is only a value."""
    empty = value is None or (isinstance(value, ScalarNode) and value.value is None)
    if value is None or empty:
        return f"{name}: {{type: int, default_value: 0}}"
    shown = json.dumps(to_data(value), ensure_ascii=False)
    return f"{name}: {{type: {library_type_of(value)}, default_value: {shown}}}"
