# SPDX-License-Identifier: Apache-2.0
"""`ros__parameters:` of a mode → parameter values, with the types that ROS 2 gives them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from microros_gen.diagnostics import Diagnostics, nearest
from microros_gen.documents.yaml_tree import Entry, MappingNode, ScalarNode, SequenceNode, YamlNode
from microros_gen.modes.model import DEFAULT, Scalar, Value

_TEMPLATE = re.compile(r"\$\(parent ([A-Za-z_][\w./]*)\)")
_LIKE_TEMPLATE = re.compile(r"\$\(\s*(\w+)\s*([\w./]*)\s*\)")
"""A template with a mistake, or what other files of ROS 2 have in this form: `$(var limit)`."""
_INTEGERS = range(-(2**63), 2**63)


def parse_values(node: YamlNode | None, diagnostics: Diagnostics) -> dict[str, Value]:
    """Return the parameters of a mapping; groups of parameters (`gains: {p: 1.0}`) become `gains.p`."""
    found: dict[str, Value] = {}
    if isinstance(node, MappingNode):
        for name, entry in _flat(node, ""):
            value = _value(name, entry, diagnostics)
            if value is not None:
                found[name] = value
    return found


def _flat(node: MappingNode, prefix: str) -> Iterator[tuple[str, Entry]]:
    for entry in node:
        name = f"{prefix}{entry.key}"
        if isinstance(entry.value, MappingNode):
            yield from _flat(entry.value, f"{name}.")
        else:
            yield name, entry


def _value(name: str, entry: Entry, diagnostics: Diagnostics) -> Value | None:
    node = entry.value
    if isinstance(node, ScalarNode):
        template = _TEMPLATE.fullmatch(node.text)
        if template:
            return Value(None, "", node.span, entry.key_span, template[1])
        kind = _type_of(node.value)
        if kind and node.value is not None and not _meant(node):
            return Value(node.value, kind, node.span, entry.key_span)
    elif isinstance(node, SequenceNode):
        values = [item.value if isinstance(item, ScalarNode) else None for item in node.items]
        scalars = tuple(value for value in values if value is not None)
        kinds = {_type_of(value) for value in values}
        if len(kinds) == 1 and "" not in kinds:
            return Value(scalars, f"{kinds.pop()}[]", node.span, entry.key_span)
    message = f"the parameter '{name}' has no value of a type of ROS 2"
    hint = "Write true, 1, 1.0, a text, or a list with values of one of these types"
    meant = _meant(node) if isinstance(node, ScalarNode) else ""
    if meant:
        message, hint = f"the parameter '{name}' has no value: this is no template", f"Write {meant}"
    diagnostics.error(message, node.span, hint, id="MG-8822")
    return None


def _meant(node: ScalarNode) -> str:
    """Return the template that a text is meant to be; empty: it is a text."""
    like = _LIKE_TEMPLATE.fullmatch(node.text)
    is_close = like is not None and nearest(like[1], ("parent",)) is not None
    if like is None or not is_close:
        return ""
    meant = f"$(parent {like[2]})"
    return meant if _TEMPLATE.fullmatch(meant) else "$(parent NAME)"


def type_of(value: Scalar | tuple[Scalar, ...] | None) -> str:
    """Return the type of ROS 2 of a value or a list of values; empty: it has none."""
    if isinstance(value, tuple):
        kinds = set(map(_type_of, value))
        return f"{kinds.pop()}[]" if len(kinds) == 1 else ""
    return _type_of(value)


def _type_of(value: Scalar | None) -> str:
    """Return the type of ROS 2; empty: it has none."""
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, int):
        return "integer" if value in _INTEGERS else ""
    return "double" if isinstance(value, float) else "string" if isinstance(value, str) else ""


def inherit(
    mode: str, own: Mapping[str, Value], default: Mapping[str, Value] | None, diagnostics: Diagnostics
) -> dict[str, Value]:
    """Return the values of a mode: those of `__DEFAULT__`, replaced by its own ones.

    A parameter that `__DEFAULT__` does not have, or has with another type, is an error. `default` None: the part has
    no `__DEFAULT__`.
    """
    if mode == DEFAULT or default is None:
        return dict(own)
    found = dict(default)
    for name, value in own.items():
        first = default.get(name)
        if first is None:
            message = f"the parameter '{name}' of the mode '{mode}' is not in {DEFAULT}"
            hint = nearest(name, default) or f"Add it to {DEFAULT}"
            diagnostics.error(message, value.name_span, hint, id="MG-8820")
        elif first.type and value.type and first.type != value.type:
            message = f"the parameter '{name}' is of type {value.type}, and in {DEFAULT} {first.type}"
            hint = "Write it with a decimal point" if _needs_point(first, value) else "Use one type"
            if isinstance(value.value, str) and _LIKE_TEMPLATE.fullmatch(value.value):
                hint = "Write a value, or $(parent NAME)"
            diagnostics.error(message, value.span, hint, id="MG-8821")
        else:
            found[name] = value
    return found


def _needs_point(first: Value, value: Value) -> bool:
    return first.type.startswith("double") and value.type.startswith("integer")
