# SPDX-License-Identifier: Apache-2.0
"""A file of generate_parameter_library → declarations of parameters.

https://github.com/PickNikRobotics/generate_parameter_library describes the format. What a device does not check is an
error at its place, so that no file is accepted with less than it says.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from microros_gen.application.model import ParameterDecl
from microros_gen.application.parameter_maps import MAP, Maps, is_group
from microros_gen.application.parameter_validation import check_rules, with_rule
from microros_gen.application.parameters import Places, check_declaration, value_of
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.tree_values import bool_of, child, entries, items, span_of, text_of
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
        maps = Maps.of(roots[0].value)
        declared = tuple(p for root in roots for p in _group(root.value, "", maps, found))
    diagnostics.extend(found)
    return () if found.has_errors() else declared


def _group(node: YamlNode, prefix: str, maps: Maps, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
    for entry in entries(node):
        name = f"{prefix}{entry.key}"
        if entry.key.startswith(MAP) and is_group(entry):
            within = maps.within(prefix)
            for index, value in enumerate(within.values(entry, diagnostics)):
                # What is wrong below is wrong for each value: it is reported once.
                found = Diagnostics() if index else diagnostics
                yield from _group(entry.value, f"{prefix}{value}.", within, found)
        elif not _NAME.fullmatch(entry.key) or entry.key.startswith(MAP):
            message = f"'{entry.key}' is no name of a parameter"
            diagnostics.error(message, entry.key_span, "Use letters, digits and underscores", id="MG-3065")
        elif text_of(child(entry.value, "type")) is not None:
            yield from _leaf(entry, name, maps, diagnostics)
        elif is_group(entry):
            yield from _group(entry.value, f"{name}.", maps, diagnostics)
        else:
            message = f"'{name}' has no type"
            diagnostics.error(message, entry.key_span, f"Write {entry.key}: {{type: int}}", id="MG-3066")


def _leaf(entry: Entry, name: str, maps: Maps, diagnostics: Diagnostics) -> Iterator[ParameterDecl]:
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
        read_only=bool_of(child(node, "read_only")) or name in maps.lists,
        span=entry.key_span,
        size=int(fixed.group(2)) if fixed else None,
        constraints=text_of(child(node, "additional_constraints")) or "",
    )
    validation = child(node, "validation")
    for rule in entries(validation):
        parameter = with_rule(parameter, rule, diagnostics)
    if parameter.is_array and not parameter.size and parameter.read_only:
        # Nothing changes it.
        default_size = len(parameter.default) if isinstance(parameter.default, tuple) else 0
        parameter = replace(parameter, size=max(default_size, 1))
    if parameter.is_array and not parameter.size:
        message = f"the array '{name}' has no largest size"
        hint = f"Write type: {type_text}_fixed_8, or validation: {{size_lt<>: [9]}}"
        diagnostics.error(message, entry.key_span, hint, id="MG-3069")
        return
    bounds = span_of(validation) if parameter.minimum is not None else None
    choices = items(child(validation, "one_of<>"))
    before = len(tuple(diagnostics))
    check_declaration(parameter, Places(default, bounds, choices[0] if choices else None), diagnostics)
    if len(tuple(diagnostics)) == before and default is not None and parameter.default is not None:
        what = f"the default of the parameter '{parameter.name}'"
        check_rules(parameter, parameter.default, default.span, what, diagnostics)
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
